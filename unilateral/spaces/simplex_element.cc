#include "unilateral/spaces/simplex_element.h"

#include <deal.II/base/polynomials_barycentric.h>
#include <deal.II/base/quadrature_lib.h>
#include <deal.II/dofs/dof_accessor.templates.h>
#include <deal.II/fe/fe_q.h>
#include <deal.II/fe/fe_simplex_p.h>
#include <deal.II/grid/grid_generator.h>
#include <deal.II/grid/tria.h>

#include <fmt/format.h>

#include <array>
#include <cmath>
#include <stdexcept>
#include <vector>

namespace unilateral
{
  using namespace dealii;

  namespace
  {
    /// First and second vertex of the lines of a tetrahedron; the first three are those of a triangle.
    constexpr std::array<std::array<unsigned, 2>, 6> line_vertices = {{{0, 1}, {1, 2}, {2, 0}, {0, 3}, {1, 3}, {2, 3}}};

    template <int dim>
    constexpr unsigned n_lines = dim *(dim + 1) / 2;

    /// The barycentric coordinates of a node, times the degree.
    template <int dim>
    using NodeIndex = std::array<unsigned, dim + 1>;

    /// The nodes of P3: vertices, lines, the centres of the triangles. Tetrahedra have no inner node.
    template <int dim>
    std::vector<NodeIndex<dim>> cubic_nodes()
    {
      std::vector<NodeIndex<dim>> nodes;
      for (unsigned v = 0; v <= dim; ++v)
      {
        nodes.push_back({});
        nodes.back()[v] = 3;
      }
      for (unsigned line = 0; line < n_lines<dim>; ++line)
        for (const unsigned from_first : {1, 2})
        {
          nodes.push_back({});
          nodes.back()[line_vertices[line][0]] = 3 - from_first;
          nodes.back()[line_vertices[line][1]] = from_first;
        }
      if constexpr (dim == 2)
        nodes.push_back({1, 1, 1});
      constexpr unsigned char standard_orientation = 1;
      if constexpr (dim == 3)
        for (unsigned face = 0; face < 4; ++face)
        {
          nodes.push_back({});
          for (unsigned v = 0; v < 3; ++v)
            nodes.back()[ReferenceCells::Tetrahedron.face_to_cell_vertices(face, v, standard_orientation)] = 1;
        }
      return nodes;
    }

    template <int dim>
    std::vector<Point<dim>> cubic_node_points()
    {
      std::vector<Point<dim>> points;
      for (const auto &node : cubic_nodes<dim>())
      {
        points.emplace_back();
        for (unsigned d = 0; d < dim; ++d)
          points.back()[d] = node[d + 1] / 3.;
      }
      return points;
    }

    /// 1 at one node and 0 at the others: phi_alpha = prod_v prod_{m < alpha_v} (3 lambda_v - m) / (alpha_v - m), in the barycentric
    /// coordinates lambda. Ciarlet, The Finite Element Method for Elliptic Problems, 2.2.
    template <int dim>
    BarycentricPolynomials<dim> cubic_polynomials()
    {
      using Polynomial = BarycentricPolynomial<dim>;
      std::vector<Polynomial> polynomials;
      for (const auto &node : cubic_nodes<dim>())
      {
        Polynomial phi(TableIndices<dim + 1>(), 1.);
        for (unsigned v = 0; v <= dim; ++v)
          for (unsigned m = 0; m < node[v]; ++m)
            phi = phi * ((Polynomial::monomial(v) * 3. - double(m)) / double(node[v] - m));
        polynomials.push_back(phi);
      }
      return BarycentricPolynomials<dim>(polynomials);
    }

    /// How many nodes lie inside a vertex, a line, a triangle, a tetrahedron.
    template <int dim>
    std::vector<unsigned> nodes_per_object()
    {
      std::vector<unsigned> n = {1, 2, 1, 0};
      n.resize(dim + 1);
      return n;
    }

    template <int dim>
    std::vector<Point<dim - 1>> cubic_face_points()
    {
      if constexpr (dim == 2)
        return {Point<1>(0.), Point<1>(1.), Point<1>(1. / 3), Point<1>(2. / 3)};
      else
        return cubic_node_points<dim - 1>();
    }

    /// P3 on triangles and tetrahedra.
    template <int dim>
    class CubicSimplex : public FE_SimplexPoly<dim>
    {
    public:
      explicit CubicSimplex(const bool in_system)
        : FE_SimplexPoly<dim>(
            cubic_polynomials<dim>(),
            FiniteElementData<dim>(nodes_per_object<dim>(), ReferenceCells::get_simplex<dim>(), 1, 3, FiniteElementData<dim>::H1),
            cubic_node_points<dim>(),
            std::vector<std::vector<Point<dim - 1>>>(dim + 1, cubic_face_points<dim>()),
            FullMatrix<double>())
      {
        // A face whose line runs the other way finds its nodes swapped. deal.II asks this for the faces of tetrahedra; what cells need
        // is left to match_line_nodes().
        this->adjust_line_dof_index_for_line_orientation_table = std::vector<int>{1, -1};
        set_prolongation();
        // FESystem (deal.II 9.4) copies eight numbers for each node of a face, where triangles have six, and writes beyond its table. Of an
        // empty one it copies nothing: its own table then says, rightly, that the one node of a face stays where it is.
        if (in_system)
          for (auto &table : this->adjust_quad_dof_index_for_face_orientation_table)
            table.reinit(0, 0);
      }

      std::unique_ptr<FiniteElement<dim>> clone() const override { return std::make_unique<CubicSimplex<dim>>(*this); }
      std::string                         get_name() const override { return fmt::format("CubicSimplex<{}>(3)", dim); }

    private:
      /// Child by child the values of the mother's shape functions at the child's nodes.
      void set_prolongation()
      {
        // The children as the library cuts and numbers them.
        Triangulation<dim> mother;
        GridGenerator::reference_cell(mother, ReferenceCells::get_simplex<dim>());
        mother.refine_global(1);
        const auto nodes = cubic_nodes<dim>();
        auto      &matrices = this->prolongation[RefinementCase<dim>::isotropic_refinement - 1];
        for (unsigned c = 0; c < matrices.size(); ++c)
        {
          const auto child = mother.begin(0)->child(c);
          matrices[c].reinit(nodes.size(), nodes.size());
          for (unsigned i = 0; i < nodes.size(); ++i)
          {
            Point<dim> x;
            for (unsigned v = 0; v <= dim; ++v)
              x += nodes[i][v] / 3. * child->vertex(v);
            for (unsigned j = 0; j < nodes.size(); ++j)
              if (const double value = this->shape_value(j, x); std::abs(value) > 1e-13) // the rest is round-off
                matrices[c](i, j) = value;
          }
        }
      }
    };
  } // namespace

  template <int dim>
  std::unique_ptr<FiniteElement<dim>> make_simplex_element(const unsigned degree, const bool in_system)
  {
    if (degree < 1 || degree > 3)
      throw std::invalid_argument(
        fmt::format("there is no element P{} on triangles and tetrahedra: degrees 1, 2 and 3 are available", degree));
    if constexpr (dim == 1)
      return std::make_unique<FE_Q<1>>(QIterated<1>(QTrapezoid<1>(), degree));
    else if (degree < 3)
      return std::make_unique<FE_SimplexP<dim>>(degree);
    else
      return std::make_unique<CubicSimplex<dim>>(in_system);
  }

  template <int dim>
  void match_line_nodes(DoFHandler<dim> &dof_handler)
  {
    if constexpr (dim > 1)
    {
      const auto &fe = dof_handler.get_fe();
      // A system's nodes on a line come component by component.
      const unsigned n_components = fe.n_components(), n = fe.n_dofs_per_line() / n_components;
      if (n < 2 || !fe.reference_cell().is_simplex())
        return;
      for (const auto &cell : dof_handler.active_cell_iterators())
      {
        if (cell->is_artificial())
          continue;
        // deal.II 9.4 never turns the nodes of lines around: in the plane it does not look at the orientation it knows, and tetrahedra
        // claim that theirs is the standard one. What cells answer when asked for their DoFs is stored with the DoFHandler, cell by
        // cell; that is put right here.
        types::global_dof_index *const dofs =
          const_cast<types::global_dof_index *>(dealii::internal::DoFAccessorImplementation::Implementation::get_cache_ptr(
            &dof_handler, cell->level(), cell->index(), fe.n_dofs_per_cell()));
        for (unsigned l = 0; l < n_lines<dim>; ++l)
        {
          const auto line = cell->line(l);
          const bool along = line->vertex_index(0) == cell->vertex_index(line_vertices[l][0]);
          for (unsigned c = 0; c < n_components; ++c)
            for (unsigned k = 0; k < n; ++k)
              dofs[fe.get_first_line_index() + (l * n_components + c) * n + k] = line->dof_index(c * n + (along ? k : n - 1 - k));
        }
      }
    }
  }

#define INSTANTIATE(dim)                                                                                                                   \
  template std::unique_ptr<FiniteElement<dim>> make_simplex_element<dim>(unsigned, bool);                                                  \
  template void                                match_line_nodes(DoFHandler<dim> &);
  INSTANTIATE(1)
  INSTANTIATE(2)
  INSTANTIATE(3)
#undef INSTANTIATE
} // namespace unilateral
