// Plates: orders of convergence for every condition on an edge, known deflections, moments and energies, coercivity.
#include "edge_conditions.h"

#include "unilateral/forms/plate.h"
#include "unilateral/mesh/make_mesh.h"
#include "unilateral/spaces/hermite.h"
#include "unilateral/spaces/simplex_element.h"

#include <deal.II/base/quadrature_lib.h>
#include <deal.II/dofs/dof_tools.h>
#include <deal.II/fe/fe_q.h>
#include <deal.II/fe/fe_simplex_p.h>
#include <deal.II/fe/mapping_fe.h>
#include <deal.II/fe/mapping_q.h>
#include <deal.II/grid/grid_generator.h>
#include <deal.II/grid/grid_tools.h>
#include <deal.II/lac/affine_constraints.h>
#include <deal.II/lac/dynamic_sparsity_pattern.h>
#include <deal.II/lac/sparse_direct.h>
#include <deal.II/lac/sparse_matrix.h>
#include <deal.II/numerics/vector_tools_boundary.h>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <Eigen/Dense>

#include <cmath>
#include <functional>
#include <random>

namespace
{
  using namespace unilateral;
  using namespace dealii;

  using RealVector = dealii::Vector<double>;

  /// u = sin(ax + c) sin(by + d) and its derivatives.
  struct Wave
  {
    double a = 1.3, c = 0.4, b = 1.7, d = 0.9;

    double operator()(const Point<2> &x, const unsigned i, const unsigned j) const
    {
      return std::pow(a, i) * std::sin(a * x[0] + c + i * M_PI / 2) * std::pow(b, j) * std::sin(b * x[1] + d + j * M_PI / 2);
    }

    std::string text(const unsigned i, const unsigned j) const
    {
      return fmt::format("({:.17g}*sin({:.17g}*x+{:.17g})*sin({:.17g}*y+{:.17g}))", std::pow(a, i) * std::pow(b, j), a, c + i * M_PI / 2, b,
                         d + j * M_PI / 2);
    }
  };

  using Exact = std::function<double(const Point<2> &, unsigned, unsigned)>;

  const Exact zero = [](const Point<2> &, unsigned, unsigned) { return 0.; };

  struct PlateData
  {
    Coefficients                                    coefficients;
    std::optional<Coefficients>                     others; ///< of the region with material_id 1
    std::map<types::boundary_id, BoundaryCondition> edges;
    Exact                                           exact = zero; ///< gives the prescribed values and, on Hermite elements, slopes
  };

  const BoundaryCondition free_edge;

  FieldFunction plus(const FieldFunction &f, const FieldFunction &g)
  {
    return [f, g](const Point<2> &x) { return f.value(x) + g.value(x); };
  }

  PlateData uniform_load(const double q, const double nu, const std::vector<BoundaryCondition> &edges)
  {
    PlateData data;
    data.coefficients.load = {number(q)};
    data.coefficients.poisson = number(nu);
    for (unsigned i = 0; i < edges.size(); ++i)
      data.edges[i] = edges[i];
    return data;
  }

  /// A name: "hermite", "Q2".."Q4" and "P2", "P3" with the C0 interior penalty method.
  std::unique_ptr<FiniteElement<2>> make_element(const std::string &name)
  {
    if (name == "hermite")
      return make_hermite_element<2>();
    const unsigned degree = name[1] - '0';
    if (name[0] == 'P')
      return make_simplex_element<2>(degree);
    return std::make_unique<FE_Q<2>>(degree);
  }

  /// V_h, A, H and f of a plate on a mesh, assembled face by face, and the solution.
  struct PlateProblem
  {
    PlateProblem(
      const std::string &element, Triangulation<2> &mesh, const PlateData &data, const bool curved = false, const double penalty_factor = 1)
      : conforming(element == "hermite"), fe(make_element(element)), dof_handler(mesh), exact(data.exact)
    {
      std::vector<PartCondition> parts(256);
      for (const auto &[id, edge] : data.edges)
        static_cast<BoundaryCondition &>(parts[id]) = edge;
      form = std::make_unique<Plate>(std::vector<Coefficients>{data.coefficients, data.others.value_or(data.coefficients)}, parts,
                                     !conforming, penalty_factor);

      if (element[0] == 'P')
      {
        mapping = std::make_unique<MappingFE<2>>(FE_SimplexP<2>(1));
        quadrature = QGaussSimplex<2>(4);
      }
      else
      {
        mapping = std::make_unique<MappingQ<2>>(curved ? fe->degree : 1);
        quadrature = QGauss<2>(fe->degree + 2);
      }
      dof_handler.distribute_dofs(*fe);
      match_line_nodes(dof_handler);
      set_supports(data);
      assemble();
    }

    void set_supports(const PlateData &data)
    {
      DoFTools::make_hanging_node_constraints(dof_handler, supports);
      const ScalarFunctionFromFunctionObject<2>         value([&](const Point<2> &x) { return exact(x, 0, 0); });
      std::map<types::boundary_id, const Function<2> *> functions;
      for (const auto &[id, edge] : data.edges)
      {
        if (edge.value)
          functions[id] = &value;
        if (!conforming)
          continue;
        const auto nodes = hermite_nodes(dof_handler);
        for (const unsigned k : {0, 1})
          if (k == 0 ? edge.value.has_value() : edge.slope.has_value() || edge.symmetry)
            for (const auto dof : hermite_boundary_dofs(dof_handler, {id}, k))
              if (!supports.is_constrained(dof))
              {
                supports.add_line(dof);
                supports.set_inhomogeneity(dof, exact(nodes[dof].location, nodes[dof].derivative[0], nodes[dof].derivative[1]));
              }
      }
      if (!conforming)
        VectorTools::interpolate_boundary_values(*mapping, dof_handler, functions, supports);
      supports.close();
    }

    void assemble()
    {
      DynamicSparsityPattern pattern(dof_handler.n_dofs());
      if (form->has_interior_face_terms())
        DoFTools::make_flux_sparsity_pattern(dof_handler, pattern, supports, false);
      else
        DoFTools::make_sparsity_pattern(dof_handler, pattern, supports, false);
      sparsity.copy_from(pattern);
      stiffness.reinit(sparsity);
      gram.reinit(sparsity);
      load.reinit(dof_handler.n_dofs());

      const UpdateFlags    on_cells = update_values | update_gradients | update_hessians | update_quadrature_points | update_JxW_values;
      const UpdateFlags    on_faces = on_cells | update_normal_vectors;
      const QGauss<1>      face_quadrature(fe->degree + 2);
      FEValues<2>          values(*mapping, *fe, quadrature, on_cells);
      FEFaceValues<2>      face_values(*mapping, *fe, face_quadrature, on_faces);
      FEInterfaceValues<2> interface_values(*mapping, *fe, face_quadrature, on_faces);

      const unsigned                       n = fe->n_dofs_per_cell();
      FullMatrix<double>                   matrix(n, n), gram_matrix(n, n);
      RealVector                           rhs(n);
      std::vector<types::global_dof_index> dofs(n);
      for (const auto &cell : dof_handler.active_cell_iterators())
      {
        matrix = 0;
        gram_matrix = 0;
        rhs = 0;
        values.reinit(cell);
        form->add_cell_terms(values, matrix, rhs);
        form->add_gram_terms(values, gram_matrix);
        for (const unsigned f : cell->face_indices())
          if (cell->at_boundary(f))
          {
            const auto part = cell->face(f)->boundary_id();
            face_values.reinit(cell, f);
            if (form->has_face_terms(part))
              form->add_face_terms(face_values, part, matrix, rhs);
            if (form->has_slope_terms(part))
            {
              form->add_slope_terms(face_values, part, matrix, rhs);
              form->add_slope_gram(face_values, part, gram_matrix);
            }
          }
        cell->get_dof_indices(dofs);
        supports.distribute_local_to_global(matrix, rhs, dofs, stiffness, load);
        supports.distribute_local_to_global(gram_matrix, dofs, gram);
      }
      if (form->has_interior_face_terms())
        for_interior_faces(interface_values,
                           [&](const FEInterfaceValues<2> &face)
                           {
                             const unsigned     m = face.n_current_interface_dofs();
                             FullMatrix<double> face_matrix(m, m), face_gram(m, m);
                             RealVector         none(m);
                             form->add_interior_face_terms(face, face_matrix);
                             form->add_interior_face_gram(face, face_gram);
                             const auto indices = face.get_interface_dof_indices();
                             supports.distribute_local_to_global(face_matrix, none, indices, stiffness, load);
                             supports.distribute_local_to_global(face_gram, indices, gram);
                           });
    }

    /// Once for each face, from the smaller of its cells.
    void for_interior_faces(FEInterfaceValues<2> &values, const std::function<void(const FEInterfaceValues<2> &)> &visit) const
    {
      const unsigned none = numbers::invalid_unsigned_int;
      for (const auto &cell : dof_handler.active_cell_iterators())
        for (const unsigned f : cell->face_indices())
        {
          if (cell->at_boundary(f))
            continue;
          const auto neighbor = cell->neighbor(f);
          if (neighbor->has_children())
            continue;
          if (cell->neighbor_is_coarser(f))
          {
            const auto [face, subface] = cell->neighbor_of_coarser_neighbor(f);
            values.reinit(cell, f, none, neighbor, face, subface);
          }
          else if (cell->index() < neighbor->index())
            values.reinit(cell, f, none, neighbor, cell->neighbor_of_neighbor(f), none);
          else
            continue;
          visit(values);
        }
    }

    PlateProblem &solve()
    {
      SparseDirectUMFPACK factors;
      factors.initialize(stiffness);
      u = load;
      factors.solve(u);
      supports.distribute(u);
      return *this;
    }

    struct Errors
    {
      double L2, H2;
    };

    Errors errors() const
    {
      const bool          simplex = fe->reference_cell() == ReferenceCells::Triangle;
      const Quadrature<2> points = simplex ? Quadrature<2>(QGaussSimplex<2>(4)) : Quadrature<2>(QGauss<2>(fe->degree + 2));
      FEValues<2>         values(*mapping, *fe, points, update_values | update_hessians | update_quadrature_points | update_JxW_values);
      std::vector<double> u_q(points.size());
      std::vector<Tensor<2, 2>> hessian(points.size());
      Errors                    sum = {};
      for (const auto &cell : dof_handler.active_cell_iterators())
      {
        values.reinit(cell);
        values.get_function_values(u, u_q);
        values.get_function_hessians(u, hessian);
        for (unsigned q = 0; q < points.size(); ++q)
        {
          const auto  &x = values.quadrature_point(q);
          const double xx = hessian[q][0][0] - exact(x, 2, 0), xy = hessian[q][0][1] - exact(x, 1, 1),
                       yy = hessian[q][1][1] - exact(x, 0, 2);
          sum.L2 += std::pow(u_q[q] - exact(x, 0, 0), 2) * values.JxW(q);
          sum.H2 += (xx * xx + 2 * xy * xy + yy * yy) * values.JxW(q);
        }
      }
      return {std::sqrt(sum.L2), std::sqrt(sum.H2)};
    }

    /// u_h and M_h at a point.
    std::pair<double, Flux> at(const Point<2> &x) const
    {
      const auto [cell, unit] = GridTools::find_active_cell_around_point(*mapping, dof_handler, x);
      FEValues<2> values(*mapping, *fe, Quadrature<2>(unit),
                         update_values | update_gradients | update_hessians | update_quadrature_points | update_JxW_values);
      values.reinit(cell);
      std::vector<double> value(1);
      values.get_function_values(u, value);
      RealVector cell_u(fe->n_dofs_per_cell());
      cell->get_dof_values(u, cell_u);
      std::vector<Flux> M;
      form->flux(values, cell_u, M);
      return {value[0], M[0]};
    }

    bool                              conforming;
    std::unique_ptr<FiniteElement<2>> fe;
    std::unique_ptr<Mapping<2>>       mapping;
    Quadrature<2>                     quadrature;
    DoFHandler<2>                     dof_handler;
    Exact                             exact;
    std::unique_ptr<Plate>            form;
    AffineConstraints<double>         supports;
    SparsityPattern                   sparsity;
    SparseMatrix<double>              stiffness, gram;
    RealVector                        load, u;
  };

  /// The rows and columns of the unknowns that nothing prescribes.
  Eigen::MatrixXd free_block(const PlateProblem &problem, const SparseMatrix<double> &matrix)
  {
    std::vector<int> place(matrix.m(), -1);
    int              n = 0;
    for (unsigned i = 0; i < matrix.m(); ++i)
      if (!problem.supports.is_constrained(i))
        place[i] = n++;
    Eigen::MatrixXd block = Eigen::MatrixXd::Zero(n, n);
    for (const auto &entry : matrix)
      if (place[entry.row()] >= 0 && place[entry.column()] >= 0)
        block(place[entry.row()], place[entry.column()]) = entry.value();
    return block;
  }

  enum class MeshKind
  {
    cartesian,
    distorted,
    disc,
    triangles,
    distorted_triangles
  };

  /// The unit square with n cells a direction and boundary ids 0 1 2 3 (left, right, bottom, top), or the unit disc with id 0.
  void make_mesh(const MeshKind kind, const unsigned n, Triangulation<2> &mesh)
  {
    if (kind == MeshKind::disc)
    {
      GridGenerator::hyper_ball_balanced(mesh);
      mesh.refine_global(static_cast<unsigned>(std::lround(std::log2(n / 2.))));
      return;
    }
    if (kind == MeshKind::triangles || kind == MeshKind::distorted_triangles)
    {
      GridGenerator::subdivided_hyper_cube_with_simplices(mesh, n);
      for (const auto &face : mesh.active_face_iterators())
        if (face->at_boundary())
        {
          const auto x = face->center();
          face->set_boundary_id(x[0] < 1e-10 ? 0 : x[0] > 1 - 1e-10 ? 1 : x[1] < 1e-10 ? 2 : 3);
        }
    }
    else
      GridGenerator::subdivided_hyper_cube(mesh, n, 0, 1, true);
    for (const auto &cell : mesh.active_cell_iterators())
      cell->set_material_id(0); // the generator colours the cells too
    if (kind == MeshKind::distorted || kind == MeshKind::distorted_triangles)
      GridTools::transform(
        [n](const Point<2> &x)
        {
          // Vertex by vertex in another direction: the cells do not tend to parallelograms.
          const double angle = 7 * n * x[0] + 11 * n * x[1] + 1;
          const bool   inside = std::min({x[0], x[1], 1 - x[0], 1 - x[1]}) > 1e-10;
          return inside ? x + 0.18 / n * Point<2>(std::cos(angle), std::sin(angle)) : x;
        },
        mesh);
  }

  struct Convergence
  {
    std::string element;
    MeshKind    mesh;
    std::string edges;
    double      H2_order, L2_order;
  };

  std::ostream &operator<<(std::ostream &out, const Convergence &c)
  {
    const char *names[] = {"cartesian", "distorted", "disc", "triangles", "distorted triangles"};
    return out << c.element << ' ' << names[static_cast<int>(c.mesh)] << ' ' << c.edges;
  }

  /// D and k vary but where an edge is free; u, the load and what the edges prescribe are those of a wave.
  PlateData wave_data(const std::string &edges)
  {
    Wave wave;
    if (edges == "symmetry")
      wave.c = M_PI / 2;
    const bool        constant = edges == "free";
    const double      nu = 0.3;
    const std::string D = constant ? "2" : "(1+x^2/4+y/3)", D_x = constant ? "0" : "(x/2)", D_y = constant ? "0" : "(1/3)",
                      D_xx = constant ? "0" : "0.5";
    const auto        w = [&](const unsigned i, const unsigned j) { return wave.text(i, j); };
    const std::string M_xx = D + "*(" + w(2, 0) + "+0.3*" + w(0, 2) + ")", M_yy = D + "*(" + w(0, 2) + "+0.3*" + w(2, 0) + ")";

    PlateData data;
    data.coefficients.stiffness = {text(D)};
    data.coefficients.poisson = number(nu);
    data.coefficients.reaction = text("5+x");
    // D Lap^2 u + 2 grad D . grad Lap u + (1 - nu) Hess D : Hess u + nu Lap D Lap u + k u
    data.coefficients.load = {text(D + "*(" + w(4, 0) + "+2*" + w(2, 2) + "+" + w(0, 4) + ")+2*" + D_x + "*(" + w(3, 0) + "+" + w(1, 2) +
                                   ")+2*" + D_y + "*(" + w(2, 1) + "+" + w(0, 3) + ")+0.7*" + D_xx + "*" + w(2, 0) + "+0.3*" + D_xx + "*(" +
                                   w(2, 0) + "+" + w(0, 2) + ")+(5+x)*" + w(0, 0))};
    data.exact = wave;
    if (edges == "disc")
    {
      data.edges[0] = clamped(text(w(0, 0)), text("(x*" + w(1, 0) + "+y*" + w(0, 1) + ")/sqrt(x^2+y^2)"));
      return data;
    }
    data.edges[0] = clamped(text(w(0, 0)), text("-" + w(1, 0)));
    data.edges[1] = clamped(text(w(0, 0)), text(w(1, 0)));
    data.edges[2] = clamped(text(w(0, 0)), text("-" + w(0, 1)));
    data.edges[3] = clamped(text(w(0, 0)), text(w(0, 1)));
    if (edges == "supported")
      for (unsigned id = 0; id < 4; ++id)
      {
        data.edges[id].slope.reset();
        data.edges[id].moment = text(id < 2 ? M_xx : M_yy);
      }
    else if (edges == "symmetry")
      data.edges[0] = symmetric();
    else if (edges == "free")
      for (unsigned id = 2; id < 4; ++id)
      {
        data.edges[id] = {};
        data.edges[id].moment = text(M_yy);
        data.edges[id].flux = text((id == 2 ? "2*(" : "-2*(") + w(0, 3) + "+1.7*" + w(2, 1) + ")");
      }
    else if (edges == "springs")
    {
      // The same, with what the springs take added.
      data = wave_data("free");
      for (unsigned id = 2; id < 4; ++id)
      {
        auto &edge = data.edges[id];
        edge.spring = number(3);
        edge.slope_spring = number(4);
        edge.flux = plus(*edge.flux, text("3*" + w(0, 0)));
        edge.moment = plus(*edge.moment, text((id == 2 ? "-4*" : "4*") + w(0, 1)));
      }
    }
    return data;
  }
} // namespace

class PlateConvergence : public testing::TestWithParam<Convergence>
{
};

TEST_P(PlateConvergence, has_full_order)
{
  const auto &[element, kind, edges, H2_order, L2_order] = GetParam();
  const PlateData      data = wave_data(edges);
  PlateProblem::Errors before = {};
  const bool           coarse = element == "Q4" || element == "hermite";
  for (const unsigned n : coarse ? std::vector<unsigned>{2, 4, 8} : std::vector<unsigned>{4, 8, 16})
  {
    Triangulation<2> mesh;
    make_mesh(kind, n, mesh);
    const auto now = PlateProblem(element, mesh, data, kind == MeshKind::disc).solve().errors();
    fmt::print("  n = {:2}: H2 {:.3e} order {:.2f}, L2 {:.3e} order {:.2f}\n", n, now.H2, std::log2(before.H2 / now.H2), now.L2,
               std::log2(before.L2 / now.L2));
    if (n == (coarse ? 8 : 16))
    {
      EXPECT_GT(std::log2(before.H2 / now.H2), H2_order - 0.2);
      EXPECT_GT(std::log2(before.L2 / now.L2), L2_order - 0.35);
    }
    before = now;
  }
}

INSTANTIATE_TEST_SUITE_P(Hermite,
                         PlateConvergence,
                         testing::Values(Convergence{"hermite", MeshKind::cartesian, "clamped", 2, 4},
                                         Convergence{"hermite", MeshKind::cartesian, "supported", 2, 4},
                                         Convergence{"hermite", MeshKind::cartesian, "symmetry", 2, 4},
                                         Convergence{"hermite", MeshKind::cartesian, "free", 2, 4},
                                         Convergence{"hermite", MeshKind::cartesian, "springs", 2, 4}));

namespace
{
  std::vector<Convergence> interior_penalty_cases()
  {
    std::vector<Convergence> cases;
    for (const unsigned p : {2, 3, 4})
    {
      const double      H2 = p - 1, L2 = p == 2 ? 2 : p + 1;
      const std::string Q = fmt::format("Q{}", p);
      for (const std::string edges : {"clamped", "supported", "symmetry", "free", "springs"})
        if (edges != "springs" || p == 3)
          cases.push_back({Q, MeshKind::cartesian, edges, H2, L2});
      for (const char *edges : {"clamped", "supported", "free"})
        cases.push_back({Q, MeshKind::distorted, edges, H2, L2});
      cases.push_back({Q, MeshKind::disc, "disc", H2, L2});
    }
    for (const unsigned p : {2, 3})
      for (const char *edges : {"clamped", "supported", "symmetry", "free"})
      {
        cases.push_back({fmt::format("P{}", p), MeshKind::triangles, edges, p - 1., p == 2 ? 2. : 4.});
        cases.push_back({fmt::format("P{}", p), MeshKind::distorted_triangles, edges, p - 1., p == 2 ? 2. : 4.});
      }
    return cases;
  }
} // namespace

INSTANTIATE_TEST_SUITE_P(InteriorPenalty, PlateConvergence, testing::ValuesIn(interior_penalty_cases()));

namespace
{
  /// u = x^2 - xy + 1, with cubic terms where @p cubic, D = 2, nu = 0.3: clamped left and right, free with forces and moments on the
  /// others.
  PlateData polynomial_data(const bool cubic)
  {
    const double c = cubic ? 1 : 0;
    PlateData    data;
    data.coefficients.stiffness = {number(2)};
    data.exact = [c](const Point<2> &p, const unsigned i, const unsigned j) -> double
    {
      const double x = p[0], y = p[1];
      switch (10 * i + j)
      {
      case 0:
        return x * x - x * y + 1 + c * (x * x * x - 2 * x * y * y + y * y * y / 2);
      case 10:
        return 2 * x - y + c * (3 * x * x - 2 * y * y);
      case 1:
        return -x + c * (-4 * x * y + 1.5 * y * y);
      case 20:
        return 2 + c * 6 * x;
      case 11:
        return -1 - c * 4 * y;
      case 2:
        return c * (-4 * x + 3 * y);
      }
      throw std::logic_error("not needed");
    };
    data.edges[0] = clamped(number(0), text(cubic ? "-(2*x-y+3*x^2-2*y^2)" : "-(2*x-y)"));
    data.edges[1] = clamped(number(0), text(cubic ? "2*x-y+3*x^2-2*y^2" : "2*x-y"));
    for (const unsigned id : {2, 3})
    {
      data.edges[id].moment = text(cubic ? "2*((-4*x+3*y)+0.3*(2+6*x))" : "2*0.3*2");
      data.edges[id].flux = number(c * (id == 2 ? 6 : -6));
    }
    // Corners between a clamped and a free edge: u is prescribed there, no force is missing.
    return data;
  }

  double max_error(const PlateProblem &problem)
  {
    const auto e = problem.errors();
    return std::max(e.L2, e.H2);
  }
} // namespace

TEST(Plate, polynomials_of_the_element_are_exact_on_every_mesh)
{
  for (const std::string element : {"hermite", "Q2", "Q3", "Q4", "P2", "P3"})
    for (const MeshKind kind : {MeshKind::cartesian, MeshKind::distorted, MeshKind::triangles, MeshKind::distorted_triangles})
      for (const bool hanging : {false, true})
      {
        const bool triangles = kind == MeshKind::triangles || kind == MeshKind::distorted_triangles;
        if (triangles != (element[0] == 'P') || (element == "hermite" && (kind != MeshKind::cartesian || hanging)) ||
            (triangles && hanging))
          continue;
        Triangulation<2> mesh;
        make_mesh(kind, 3, mesh);
        if (hanging)
          for (unsigned i = 0; i < 2; ++i)
          {
            mesh.begin_active()->set_refine_flag();
            std::next(mesh.begin_active(), 4)->set_refine_flag();
            mesh.execute_coarsening_and_refinement();
          }
        PlateProblem problem(element, mesh, polynomial_data(element[1] != '2'));
        EXPECT_LT(max_error(problem.solve()), 1e-8) << element << ' ' << static_cast<int>(kind) << hanging;
      }
}

TEST(Plate, stiffness_may_jump_between_cells)
{
  // Bent by a moment at its right end: u'' = M / D, piecewise quadratic.
  for (const std::string element : {"Q2", "Q3", "P2"})
    for (const bool by_region : {false, true})
    {
      Triangulation<2> mesh;
      make_mesh(element[0] == 'P' ? MeshKind::triangles : MeshKind::cartesian, 4, mesh);
      PlateData         data;
      BoundaryCondition end;
      end.moment = number(3);
      data.edges = {{0, clamped()}, {1, end}, {2, symmetric()}, {3, symmetric()}};
      data.coefficients.stiffness = {by_region ? number(1) : text("if(x < 0.5, 1, 100)")};
      if (by_region)
      {
        data.others = data.coefficients;
        data.others->stiffness = {number(100)};
        for (const auto &cell : mesh.active_cell_iterators())
          cell->set_material_id(cell->center()[0] > 0.5);
      }
      data.exact = [](const Point<2> &x, const unsigned i, const unsigned j) -> double
      {
        const double t = x[0] - 0.5;
        if (j > 0 || i > 2)
          return 0;
        if (i == 2)
          return t < 0 ? 3 : 0.03;
        return t < 0 ? 1.5 * x[0] * x[0] : 0.375 + 1.5 * t + 0.015 * t * t;
      };
      EXPECT_LT(max_error(PlateProblem(element, mesh, data).solve()), 1e-6) << element << by_region;
    }
}

TEST(Plate, coercive_with_a_margin)
{
  const auto has_margin = [](const std::string &element, Triangulation<2> &mesh, const double nu, const bool curved, const double factor)
  {
    PlateData         data = uniform_load(1, nu, {});
    BoundaryCondition slope_only;
    slope_only.slope = number(0);
    for (unsigned id = 0; id < 4; ++id)
      data.edges[id] = slope_only;
    data.coefficients.reaction = number(1e-3);
    const PlateProblem problem(element, mesh, data, curved, factor);
    return Eigen::LLT<Eigen::MatrixXd>(free_block(problem, problem.stiffness)).info() == Eigen::Success;
  };
  for (const std::string element : {"Q2", "Q3", "Q4", "P2", "P3"})
    for (const double nu : {-0.5, 0., 0.3, 0.5})
      for (const double stretch : {0.1, 1., 10.})
        for (const bool distorted : {false, true})
        {
          const bool       triangles = element[0] == 'P';
          Triangulation<2> mesh;
          make_mesh(triangles ? (distorted ? MeshKind::distorted_triangles : MeshKind::triangles)
                              : (distorted ? MeshKind::distorted : MeshKind::cartesian),
                    3, mesh);
          GridTools::transform([&](const Point<2> &x) { return Point<2>(x[0], stretch * x[1]); }, mesh);
          EXPECT_TRUE(has_margin(element, mesh, nu, false, 0.4)) << element << " nu " << nu << " stretch " << stretch << distorted;
          EXPECT_FALSE(has_margin(element, mesh, nu, false, 0.05)); // the test can tell
        }
  for (const std::string element : {"Q2", "Q3", "Q4"})
  {
    Triangulation<2> disc, five_cells;
    make_mesh(MeshKind::disc, 4, disc);
    GridGenerator::hyper_ball(five_cells);
    five_cells.refine_global(1);
    EXPECT_TRUE(has_margin(element, disc, 0.3, true, 0.5)) << element;
    EXPECT_TRUE(has_margin(element, five_cells, 0.3, true, 0.75)) << element;
  }
}

TEST(Plate, constants_do_not_depend_on_the_mesh)
{
  // The extreme eigenvalues of (A, H): m and M.
  for (const std::string element : {"hermite", "Q2", "Q3", "P2", "P3"})
    for (const unsigned n : {2, 4, 8})
    {
      if (n == 8 && element[1] == '3')
        continue;
      Triangulation<2> mesh;
      make_mesh(element[0] == 'P' ? MeshKind::triangles : MeshKind::cartesian, n, mesh);
      const PlateProblem    problem(element, mesh, uniform_load(1, 0.3, {clamped(), clamped(), clamped(), clamped()}));
      const Eigen::MatrixXd A = free_block(problem, problem.stiffness), H = free_block(problem, problem.gram);
      EXPECT_LT((A - A.transpose()).norm(), 1e-13 * A.norm());
      EXPECT_LT((H - H.transpose()).norm(), 1e-13 * H.norm());
      const Eigen::VectorXd eigenvalues =
        Eigen::GeneralizedSelfAdjointEigenSolver<Eigen::MatrixXd>(A, H, Eigen::EigenvaluesOnly).eigenvalues();
      fmt::print("  {} n = {}: m = {:.3f}, M = {:.3f}\n", element, n, eigenvalues.minCoeff(), eigenvalues.maxCoeff());
      EXPECT_GT(eigenvalues.minCoeff(), 0.3);
      EXPECT_LT(eigenvalues.maxCoeff(), element == "hermite" ? 1.3 : 40);
    }
}

TEST(Plate, vanishes_on_its_motions)
{
  for (const std::string element : {"hermite", "Q2", "Q3", "P3"})
  {
    Triangulation<2> mesh;
    make_mesh(element == "hermite" ? MeshKind::cartesian
              : element[0] == 'P'  ? MeshKind::distorted_triangles
                                   : MeshKind::distorted,
              3, mesh);
    const PlateProblem problem(element, mesh, uniform_load(1, 0.3, {free_edge, free_edge, free_edge, free_edge}));
    const Point<2>     centre(0.2, 0.7);
    for (const auto &mode : problem.form->rigid_body_modes(centre))
    {
      RealVector u(problem.dof_handler.n_dofs()), Au(u.size());
      if (problem.conforming)
      {
        const auto nodes = hermite_nodes(problem.dof_handler);
        const auto value = [&](const Point<2> &x) { return mode.value(x)[0]; };
        for (unsigned i = 0; i < u.size(); ++i)
        {
          const auto &[x, alpha] = nodes[i];
          Point<2> step = x;
          step[0] += alpha[0];
          step[1] += alpha[1];
          u(i) = alpha[0] + alpha[1] == 0 ? value(x) : alpha[0] + alpha[1] == 1 ? value(step) - value(x) : 0;
        }
      }
      else
        for (const auto &cell : problem.dof_handler.active_cell_iterators())
          for (unsigned i = 0; i < problem.fe->n_dofs_per_cell(); ++i)
          {
            std::vector<types::global_dof_index> dofs(problem.fe->n_dofs_per_cell());
            cell->get_dof_indices(dofs);
            u(dofs[i]) = mode.value(problem.mapping->transform_unit_to_real_cell(cell, problem.fe->unit_support_point(i)))[0];
          }
      problem.stiffness.vmult(Au, u);
      EXPECT_LT(Au.linfty_norm(), 1e-9) << element << ' ' << mode.name;
    }
    EXPECT_EQ(problem.form->rigid_body_modes(centre).size(), 3);
    if (problem.conforming)
      continue;
    // And on nothing else.
    const Eigen::VectorXd eigenvalues =
      Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd>(free_block(problem, problem.stiffness), Eigen::EigenvaluesOnly).eigenvalues();
    EXPECT_LT(std::abs(eigenvalues(2)), 1e-9);
    EXPECT_GT(eigenvalues(3), 1e-3);
  }
}

TEST(Plate, energy_of_the_moments_is_that_of_the_form)
{
  // By the moments, which know nothing of the matrix; then Au - f by differences of the energy.
  Triangulation<2> mesh;
  make_mesh(MeshKind::cartesian, 3, mesh);
  PlateData data = wave_data("supported");
  data.edges.clear();
  const PlateProblem problem("hermite", mesh, data);
  const auto         energy = [&](const RealVector &u)
  {
    FEValues<2>               values(*problem.mapping, *problem.fe, problem.quadrature,
                                     update_values | update_gradients | update_hessians | update_quadrature_points | update_JxW_values);
    const FieldFunction       q = data.coefficients.load->front(), k = *data.coefficients.reaction;
    RealVector                cell_u(16);
    std::vector<Flux>         M;
    std::vector<double>       u_q(values.n_quadrature_points);
    std::pair<double, double> sum; // 1/2 M : C^-1 M, and the rest
    for (const auto &cell : problem.dof_handler.active_cell_iterators())
    {
      values.reinit(cell);
      cell->get_dof_values(u, cell_u);
      values.get_function_values(u, u_q);
      problem.form->flux(values, cell_u, M);
      for (const unsigned i : values.quadrature_point_indices())
      {
        const auto &x = values.quadrature_point(i);
        sum.first += 0.5 * problem.form->flux_energy(M[i], 0, x) * values.JxW(i);
        sum.second += (0.5 * k.value(x) * u_q[i] * u_q[i] - q.value(x) * u_q[i]) * values.JxW(i);
      }
    }
    return sum.first + sum.second;
  };
  std::mt19937                           random(5);
  std::uniform_real_distribution<double> uniform(-1, 1);
  RealVector                             u(problem.load.size()), v(u.size()), Au(u.size());
  for (unsigned i = 0; i < u.size(); ++i)
  {
    u(i) = uniform(random);
    v(i) = uniform(random);
  }
  problem.stiffness.vmult(Au, u);
  EXPECT_NEAR(energy(u), 0.5 * (u * Au) - problem.load * u, 1e-10 * std::abs(energy(u)));
  RealVector plus = u, minus = u;
  plus.add(1, v);
  minus.add(-1, v);
  const double derivative = Au * v - problem.load * v;
  EXPECT_NEAR(0.5 * (energy(plus) - energy(minus)), derivative, 1e-9 * std::abs(energy(u))); // exact: the energy is quadratic
}

TEST(Plate, interior_penalty_matrix_is_the_form_term_by_term)
{
  // a(u, u) and f(u) with jumps and means taken from functions, not from shape functions; nu and D vary.
  Triangulation<2> mesh;
  make_mesh(MeshKind::distorted, 3, mesh);
  mesh.begin_active()->set_refine_flag();
  mesh.execute_coarsening_and_refinement();
  PlateData data;
  data.coefficients.stiffness = {text("1+x*y")};
  data.coefficients.poisson = text("0.2+x/10");
  data.edges[1].slope = text("1+y");
  PlateProblem problem("Q3", mesh, data);
  problem.supports.clear();
  problem.supports.close();
  problem.assemble();
  RealVector                             u(problem.load.size()), Au(u.size());
  std::mt19937                           random(7);
  std::uniform_real_distribution<double> uniform(-1, 1);
  for (auto &u_i : u)
    u_i = uniform(random);
  problem.stiffness.vmult(Au, u);

  const auto moment = [](const Tensor<2, 2> &H, const Tensor<1, 2> &n, const Point<2> &x)
  {
    const double nu = 0.2 + x[0] / 10;
    return (1 + x[0] * x[1]) * ((1 - nu) * (n * (H * n)) + nu * trace(H));
  };
  const auto width = [](const FEFaceValuesBase<2> &side)
  { return side.get_cell()->measure() / side.get_cell()->face(side.get_face_number())->measure(); };
  const double sigma = Plate::slope_penalty(3, false);
  const auto   flags = update_gradients | update_hessians | update_quadrature_points | update_JxW_values | update_normal_vectors;
  double       a = 0, f = 0;
  {
    FEValues<2> values(*problem.mapping, *problem.fe, problem.quadrature, update_hessians | update_quadrature_points | update_JxW_values);
    std::vector<Tensor<2, 2>> H(values.n_quadrature_points);
    for (const auto &cell : problem.dof_handler.active_cell_iterators())
    {
      values.reinit(cell);
      values.get_function_hessians(u, H);
      for (const unsigned q : values.quadrature_point_indices())
      {
        const auto  &x = values.quadrature_point(q);
        const double nu = 0.2 + x[0] / 10;
        a += (1 + x[0] * x[1]) * ((1 - nu) * scalar_product(H[q], H[q]) + nu * std::pow(trace(H[q]), 2)) * values.JxW(q);
      }
    }
  }
  const auto side_values = [&](const FEFaceValuesBase<2> &side, std::vector<Tensor<1, 2>> &gradient, std::vector<Tensor<2, 2>> &H)
  {
    gradient.resize(side.n_quadrature_points);
    H.resize(side.n_quadrature_points);
    side.get_function_gradients(u, gradient);
    side.get_function_hessians(u, H);
  };
  std::vector<Tensor<1, 2>> here, there;
  std::vector<Tensor<2, 2>> H_here, H_there;
  FEInterfaceValues<2>      face_values(*problem.mapping, *problem.fe, QGauss<1>(5), flags);
  problem.for_interior_faces(face_values,
                             [&](const FEInterfaceValues<2> &face)
                             {
                               const auto &first = face.get_fe_face_values(0), &second = face.get_fe_face_values(1);
                               side_values(first, here, H_here);
                               side_values(second, there, H_there);
                               for (unsigned q = 0; q < 5; ++q)
                               {
                                 const auto  &x = first.quadrature_point(q);
                                 const auto  &n = first.normal_vector(q);
                                 const double jump = n * (here[q] - there[q]);
                                 const double mean = 0.5 * (moment(H_here[q], n, x) + moment(H_there[q], n, x));
                                 const double penalty = sigma * (1 + x[0] * x[1]) * 0.5 * (1 / width(first) + 1 / width(second));
                                 a += (penalty * jump * jump - 2 * mean * jump) * first.JxW(q);
                               }
                             });
  FEFaceValues<2> edge_values(*problem.mapping, *problem.fe, QGauss<1>(5), flags);
  for (const auto &cell : problem.dof_handler.active_cell_iterators())
    for (const unsigned i : cell->face_indices())
      if (cell->at_boundary(i) && cell->face(i)->boundary_id() == 1)
      {
        edge_values.reinit(cell, i);
        side_values(edge_values, here, H_here);
        for (unsigned q = 0; q < 5; ++q)
        {
          const auto  &x = edge_values.quadrature_point(q);
          const auto  &n = edge_values.normal_vector(q);
          const double slope = n * here[q], M = moment(H_here[q], n, x), g = 1 + x[1];
          const double penalty = 2 * sigma * (1 + x[0] * x[1]) / width(edge_values);
          a += (penalty * slope * slope - 2 * M * slope) * edge_values.JxW(q);
          f += g * (penalty * slope - M) * edge_values.JxW(q);
        }
      }
  EXPECT_NEAR(u * Au, a, 1e-7 * std::abs(a));
  EXPECT_NEAR(u * problem.load, f, 1e-7 * std::abs(f));
}

TEST(Plate, clamped_and_supported_circular_plates)
{
  // w = q (R^2 - r^2)^2 / (64 D) clamped; (5 + nu) / (1 + nu) q R^4 / (64 D) at the centre of the supported one.
  for (const std::string element : {"Q2", "Q3", "Q4"})
  {
    Triangulation<2> mesh;
    make_mesh(MeshKind::disc, 8, mesh);
    auto clamped_plate = PlateProblem(element, mesh, uniform_load(64, 0.3, {clamped()}), true);
    auto supported_plate = PlateProblem(element, mesh, uniform_load(64, 0.3, {supported()}), true);
    // The middle of this mesh is a vertex.
    const auto [w, M] = clamped_plate.solve().at(Point<2>(1e-6, 1e-6));
    const auto [w_supported, M_supported] = supported_plate.solve().at(Point<2>(1e-6, 1e-6));
    fmt::print("  {}: w {:.8f} (1), M {:.6f} (-5.2); supported w {:.8f} (4.07692308), M {:.6f} (-13.2)\n", element, w, M[0], w_supported,
               M_supported[0]);
    const double tolerance = element == "Q2" ? 0.02 : element == "Q3" ? 1e-5 : 1e-7;
    const double M_tolerance = element == "Q2" ? 0.03 : element == "Q3" ? 0.015 : 1e-5;
    EXPECT_NEAR(w, 1, tolerance);
    EXPECT_NEAR(w_supported, 5.3 / 1.3, 5.3 / 1.3 * tolerance);
    EXPECT_NEAR(M[0], -4 * 1.3, M_tolerance * 5.2);
    EXPECT_NEAR(M_supported[0], -4 * 3.3, M_tolerance * 13.2);
  }
}

TEST(Plate, point_load_on_a_clamped_circular_plate)
{
  // w = P R^2 / (16 pi D) under the load.
  Triangulation<2> mesh;
  make_mesh(MeshKind::disc, 16, mesh);
  PlateProblem problem("Q3", mesh, uniform_load(0, 0.3, {clamped()}), true);
  for (const auto &cell : problem.dof_handler.active_cell_iterators())
    for (const unsigned v : cell->vertex_indices())
      if (cell->vertex(v).norm() < 1e-10)
        problem.load(cell->vertex_dof_index(v, 0)) = 16 * M_PI;
  EXPECT_NEAR(problem.solve().at(Point<2>(1e-9, 0)).first, 1, 5e-3);
}

TEST(Plate, square_plates_under_uniform_load)
{
  // S. Timoshenko, S. Woinowsky-Krieger, Theory of Plates and Shells, 2nd ed. (1959), articles 30, 44, 48.
  struct Known
  {
    std::vector<BoundaryCondition> edges;
    double                         nu, w, w_tolerance, M_xx, M_tolerance;
  };
  const std::vector<Known> known = {{{supported(), supported(), supported(), supported()}, 0.3, 0.00406235, 2e-8, -0.0478863, 1e-5},
                                    {{clamped(), clamped(), clamped(), clamped()}, 0.3, 0.00126532, 2e-8, -0.0229051, 2e-5},
                                    {{supported(), supported(), free_edge, free_edge}, 0.3, 0.01309, 6e-6, -0.1225, 1e-4}};
  for (const auto &[edges, nu, w_known, w_tolerance, M_known, M_tolerance] : known)
  {
    std::map<std::string, double> w;
    for (const std::string element : {"hermite", "Q2", "Q3", "Q4", "P3"})
    {
      Triangulation<2> mesh;
      make_mesh(element[0] == 'P' ? MeshKind::triangles : MeshKind::cartesian, element == "Q2" ? 27 : 13, mesh);
      PlateProblem problem(element, mesh, uniform_load(1, nu, edges));
      const auto [deflection, M] = problem.solve().at(Point<2>(0.5, 0.5));
      fmt::print("  {}: w {:.8f} ({}), M {:.6f} ({})\n", element, deflection, w_known, M[0], M_known);
      w[element] = deflection;
      const bool rough = element[1] == '2', triangles = element[0] == 'P';
      EXPECT_NEAR(deflection, w_known,
                  rough ? 0.01 * w_known
                        : w_tolerance + (element == "Q4" ? 0
                                         : triangles     ? 1e-3 * w_known
                                                         : 2e-4 * w_known));
      EXPECT_NEAR(M[0], M_known, (rough || triangles ? 0.03 : 0.005) * std::abs(M_known) + M_tolerance);
    }
    EXPECT_NEAR(w["hermite"], w["Q4"], 1e-4 * w["Q4"]);
    EXPECT_NEAR(w["hermite"], w["Q3"], 2e-4 * w["Q3"]);
  }
}

TEST(Plate, cantilever_strips)
{
  // Cylinder bending, sides of symmetry: u = F x^2 (3 - x) / (6 D) + M x^2 / (2 D). With nu = 0 and free sides the same.
  for (const std::string element : {"hermite", "Q3", "P3"})
    for (const bool free_sides : {false, true})
    {
      Triangulation<2> mesh;
      make_mesh(element[0] == 'P' ? MeshKind::triangles : MeshKind::cartesian, 3, mesh);
      BoundaryCondition end;
      end.flux = number(6);
      end.moment = number(2);
      PlateData data = uniform_load(0, free_sides ? 0 : 0.4, {clamped(), end, symmetric(), symmetric()});
      if (free_sides)
        data.edges[2] = data.edges[3] = free_edge;
      data.exact = [](const Point<2> &p, const unsigned i, const unsigned j) -> double
      {
        const double x = p[0];
        if (j > 0)
          return 0;
        return i == 0 ? x * x * (3 - x) + x * x : i == 1 ? 8 * x - 3 * x * x : 8 - 6 * x;
      };
      auto       problem = PlateProblem(element, mesh, data);
      const auto M = problem.solve().at(Point<2>(0.4, 0.5)).second;
      EXPECT_LT(max_error(problem), 1e-9) << element << free_sides;
      EXPECT_NEAR(M[0], 8 - 6 * 0.4, 1e-9);
      EXPECT_NEAR(M[1], free_sides ? 0 : 0.4 * (8 - 6 * 0.4), 1e-9);
      EXPECT_NEAR(M[2], 0, 1e-9);
    }
}

TEST(Plate, coefficients_that_are_none_are_errors)
{
  Triangulation<2> mesh;
  make_mesh(MeshKind::cartesian, 2, mesh);
  PlateData data = uniform_load(1, 0.7, {});
  EXPECT_THROW(PlateProblem("Q2", mesh, data), InputError);
  data.coefficients.poisson = number(-1);
  EXPECT_THROW(PlateProblem("Q2", mesh, data), InputError);
  data.coefficients.poisson.reset();
  data.coefficients.stiffness = {text("x-0.5")};
  EXPECT_THROW(PlateProblem("hermite", mesh, data), InputError);
}
