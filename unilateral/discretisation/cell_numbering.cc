#include "unilateral/discretisation/cell_numbering.h"

#include <algorithm>
#include <cmath>

namespace unilateral
{
  using namespace dealii;

  template <int dim>
  CellNumbering<dim>::CellNumbering(const FiniteElement<dim> &fe, const unsigned degree)
    : degree(degree), n_components(fe.n_components()), simplex(dim > 1 && fe.reference_cell().is_simplex())
  {
    if (simplex)
      number_nodes_of_simplex(fe);
    else
      number_nodes_of_hypercube(fe);
  }

  template <int dim>
  void CellNumbering<dim>::number_nodes_of_hypercube(const FiniteElement<dim> &fe)
  {
    // The coordinates of nodes in one direction.
    std::vector<double> coordinates;
    for (unsigned i = 0; i < fe.n_dofs_per_cell(); ++i)
    {
      const double x = fe.unit_support_point(i)[0];
      if (std::none_of(coordinates.begin(), coordinates.end(), [&](const double node) { return std::abs(node - x) < 1e-8; }))
        coordinates.push_back(x);
    }
    std::sort(coordinates.begin(), coordinates.end());
    auto &index = element_indices[in_sequence];
    index.resize(fe.n_dofs_per_cell());
    nodes.resize(index.size() / n_components);
    for (unsigned i = 0; i < fe.n_dofs_per_cell(); ++i)
    {
      Place    place{};
      unsigned number = 0;
      for (unsigned d = dim; d-- > 0;)
      {
        place[d] = std::lower_bound(coordinates.begin(), coordinates.end(), fe.unit_support_point(i)[d] - 1e-8) - coordinates.begin();
        number = number * (degree + 1) + place[d];
      }
      nodes[number] = place;
      index[number * n_components + fe.system_to_component_index(i).first] = i;
    }
  }

  template <int dim>
  void CellNumbering<dim>::number_nodes_of_simplex(const FiniteElement<dim> &fe)
  {
    std::map<Place, std::vector<unsigned>> at_node; // unknowns by component
    for (unsigned i = 0; i < fe.n_dofs_per_cell(); ++i)
    {
      Place place{};
      place[0] = degree;
      for (unsigned d = 0; d < dim; ++d)
      {
        place[d + 1] = std::lround(degree * fe.unit_support_point(i)[d]);
        place[0] -= place[d + 1];
      }
      auto &unknowns = at_node[place];
      if (unknowns.empty())
        nodes.push_back(place);
      unknowns.resize(n_components);
      unknowns[fe.system_to_component_index(i).first] = i;
    }
    CornerOrder order = in_sequence;
    do
    {
      auto &index = element_indices[order];
      for (const Place &node : nodes)
      {
        Place on_cell{};
        for (unsigned k = 0; k <= dim; ++k)
          on_cell[order[k]] = node[k];
        index.insert(index.end(), at_node[on_cell].begin(), at_node[on_cell].end());
      }
    } while (std::next_permutation(order.begin(), order.begin() + dim + 1));
  }

  namespace
  {
    template <int dim>
    std::vector<std::vector<double>> prolongations_to_simplices(const FiniteElement<dim> &fe, const CellNumbering<dim> &numbering)
    {
      std::vector<std::vector<double>> to_child;
      const auto                      &index = numbering.element_index();
      const unsigned                   n = numbering.size(), n_components = numbering.n_components;
      for (const auto &corners : children_of_simplex<dim>())
      {
        std::vector<double> &P = to_child.emplace_back(n * n, 0.);
        for (unsigned i = 0; i < n; ++i)
        {
          Point<dim> x;
          for (unsigned k = 0; k <= dim; ++k)
            x += double(numbering.nodes[i / n_components][k]) / numbering.degree * Tensor<1, dim>(reference_point<dim>(corners[k]));
          for (unsigned j = i % n_components; j < n; j += n_components)
            P[i * n + j] = fe.shape_value_component(index[j], x, i % n_components);
        }
      }
      return to_child;
    }

    /// Nodes get numbers when they are first met.
    template <typename Place>
    class LatticeNumbers
    {
    public:
      unsigned operator()(const Place &place) { return numbers.try_emplace(place, numbers.size()).first->second; }
      unsigned size() const { return numbers.size(); }

    private:
      std::map<Place, unsigned> numbers;
    };

    /// Corners of cells by their barycentric coordinates in the patch, times 2^(levels of refinement).
    template <int dim>
    class SimplicesOfPatch
    {
    public:
      using Corners = std::array<std::array<unsigned, dim + 1>, dim + 1>;

      SimplicesOfPatch(const CellNumbering<dim> &numbering, const unsigned n_levels) : numbering(numbering)
      {
        Corners corners{};
        for (unsigned k = 0; k <= dim; ++k)
          corners[k][k] = 1u << n_levels;
        shape.n_cell_dofs = numbering.size();
        shape.n_cells = 0;
        add(corners, n_levels);
        shape.n_patch_dofs = number_of.size() * numbering.n_components;
      }

      PatchShape shape;

    private:
      void add(const Corners &corners, const unsigned n_levels)
      {
        if (n_levels == 0)
          return add_cell(corners);
        for (const auto &child : children_of_simplex<dim>())
        {
          Corners of_child{};
          for (unsigned k = 0; k <= dim; ++k)
            for (unsigned c = 0; c <= dim; ++c)
              of_child[k][c] = (corners[child[k].first][c] + corners[child[k].second][c]) / 2;
          add(of_child, n_levels - 1);
        }
      }

      void add_cell(const Corners &corners)
      {
        ++shape.n_cells;
        for (const auto &node : numbering.nodes)
        {
          std::array<unsigned, dim + 1> place{};
          for (unsigned k = 0; k <= dim; ++k)
            for (unsigned c = 0; c <= dim; ++c)
              place[c] += node[k] * corners[k][c];
          const unsigned number = number_of(place);
          for (unsigned component = 0; component < numbering.n_components; ++component)
            shape.cell_dofs.push_back(number * numbering.n_components + component);
        }
      }

      const CellNumbering<dim>                     &numbering;
      LatticeNumbers<std::array<unsigned, dim + 1>> number_of;
    };

    template <int dim>
    PatchShape patch_of_hypercubes(const CellNumbering<dim> &numbering, const unsigned n_levels)
    {
      PatchShape     shape;
      const unsigned p = numbering.degree, n_components = numbering.n_components;
      shape.n_cell_dofs = numbering.size();
      shape.n_cells = 1u << (dim * n_levels);
      const unsigned n_nodes = p * (1u << n_levels) + 1;
      shape.n_patch_dofs = std::pow(n_nodes, dim) * n_components;
      for (unsigned cell = 0; cell < shape.n_cells; ++cell)
      {
        // Bit d of the child at each level of refinement is its place in direction d.
        std::array<unsigned, dim> corner{};
        for (unsigned l = 0; l < n_levels; ++l)
          for (unsigned d = 0; d < dim; ++d)
            corner[d] += (cell >> (dim * l + d) & 1u) << l;
        for (const auto &node : numbering.nodes)
        {
          unsigned number = 0, stride = 1;
          for (unsigned d = 0; d < dim; ++d)
          {
            number += stride * (corner[d] * p + node[d]);
            stride *= n_nodes;
          }
          for (unsigned component = 0; component < n_components; ++component)
            shape.cell_dofs.push_back(number * n_components + component);
        }
      }
      return shape;
    }
  } // namespace

  template <int dim>
  std::vector<std::vector<double>> prolongations_to_children(const FiniteElement<dim> &fe, const CellNumbering<dim> &numbering)
  {
    if constexpr (dim > 1)
      if (numbering.simplex)
        return prolongations_to_simplices(fe, numbering);
    std::vector<std::vector<double>> to_child;
    for (unsigned c = 0; c < GeometryInfo<dim>::max_children_per_cell; ++c)
    {
      const auto          &P = fe.get_prolongation_matrix(c);
      std::vector<double> &matrix = to_child.emplace_back();
      for (const unsigned i : numbering.element_index())
        for (const unsigned j : numbering.element_index())
          matrix.push_back(P(i, j));
    }
    return to_child;
  }

  template <int dim>
  PatchShape patch_shape(const CellNumbering<dim> &numbering, const unsigned n_levels)
  {
    if constexpr (dim > 1)
      if (numbering.simplex)
        return SimplicesOfPatch<dim>(numbering, n_levels).shape;
    return patch_of_hypercubes(numbering, n_levels);
  }

  template <int dim>
  unsigned levels_of_patch(const CellNumbering<dim> &numbering, const unsigned level)
  {
    constexpr double most_unknowns = 260;
    const auto       unknowns = [&](const unsigned levels)
    {
      const double n = (1u << levels) * numbering.degree + 1; // nodes along a line of the patch
      double       nodes = 1;
      for (unsigned d = 0; d < dim; ++d)
        nodes *= numbering.simplex ? (n + d) / (d + 1) : n;
      return numbering.n_components * nodes;
    };
    unsigned levels = std::min(level, 1u);
    while (levels < std::min(level, 3u) && unknowns(levels + 1) <= most_unknowns)
      ++levels;
    return levels;
  }

#define INSTANTIATE(dim)                                                                                                                   \
  template class CellNumbering<dim>;                                                                                                       \
  template std::vector<std::vector<double>> prolongations_to_children(const FiniteElement<dim> &, const CellNumbering<dim> &);             \
  template PatchShape                       patch_shape(const CellNumbering<dim> &, unsigned);                                             \
  template unsigned                         levels_of_patch(const CellNumbering<dim> &, unsigned);
  INSTANTIATE(1)
  INSTANTIATE(2)
  INSTANTIATE(3)
#undef INSTANTIATE
} // namespace unilateral
