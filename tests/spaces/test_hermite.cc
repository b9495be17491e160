// Cubic and bicubic Hermite functions: C1 on graded meshes, hold the (bi)cubics, converge with their order, solve beams and plates.
#include "unilateral/spaces/hermite.h"

#include <deal.II/base/quadrature_lib.h>
#include <deal.II/dofs/dof_tools.h>
#include <deal.II/fe/fe_interface_values.h>
#include <deal.II/fe/fe_values.h>
#include <deal.II/fe/mapping_q1.h>
#include <deal.II/grid/grid_generator.h>
#include <deal.II/grid/grid_tools.h>
#include <deal.II/lac/affine_constraints.h>
#include <deal.II/lac/dynamic_sparsity_pattern.h>
#include <deal.II/lac/sparse_direct.h>
#include <deal.II/lac/sparse_matrix.h>
#include <deal.II/numerics/solution_transfer.h>
#include <deal.II/numerics/vector_tools_point_gradient.h>
#include <deal.II/numerics/vector_tools_point_value.h>

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <random>
#include <stdexcept>

namespace
{
  using namespace unilateral;
  using namespace dealii;

  using VectorType = LinearAlgebra::distributed::Vector<double>;

  const UpdateFlags all_derivatives = update_values | update_gradients | update_hessians | update_3rd_derivatives;

  /// Steps of four sizes, 0.5 a vertex, in another order in each direction; opposite sides have the boundary ids 0 1, 2 3, 4 5.
  template <int dim>
  void make_graded(Triangulation<dim> &mesh, const Point<dim> &lowest = Point<dim>())
  {
    std::vector<std::vector<double>> steps;
    for (unsigned d = 0; d < dim; ++d)
    {
      steps.push_back({0.1, 0.4, 0.15, 0.35});
      std::rotate(steps.back().begin(), steps.back().begin() + d, steps.back().end());
    }
    Point<dim> highest = lowest;
    for (unsigned d = 0; d < dim; ++d)
      highest[d] += 1;
    GridGenerator::subdivided_hyper_rectangle(mesh, steps, lowest, highest, true);
  }

  /// V_h on a mesh, at first the graded one.
  template <int dim>
  struct Space
  {
    explicit Space(const unsigned refinements = 0) : dof_handler(mesh)
    {
      make_graded(mesh);
      mesh.refine_global(refinements);
      dof_handler.distribute_dofs(*fe);
    }

    void refine()
    {
      mesh.refine_global(1);
      dof_handler.distribute_dofs(*fe);
    }

    VectorType interpolant(const std::function<double(const Point<dim> &, const DerivativeIndex<dim> &)> &w) const
    {
      const auto nodes = hermite_nodes(dof_handler);
      VectorType u(dof_handler.n_dofs());
      for (unsigned i = 0; i < u.size(); ++i)
        u(i) = w(nodes[i].location, nodes[i].derivative);
      return u;
    }

    VectorType random_function(const unsigned seed = 1) const
    {
      std::mt19937                           engine(seed);
      std::uniform_real_distribution<double> number(-1, 1);
      VectorType                             u(dof_handler.n_dofs());
      for (auto &u_i : u)
        u_i = number(engine);
      return u;
    }

    Triangulation<dim>                  mesh;
    std::unique_ptr<FiniteElement<dim>> fe = make_hermite_element<dim>();
    DoFHandler<dim>                     dof_handler;
    MappingQ1<dim>                      mapping;
  };

  /// The k-th derivative of t^n.
  double power(const double t, const unsigned n, const unsigned k)
  {
    if (k > n)
      return 0;
    double factor = 1;
    for (unsigned i = 0; i < k; ++i)
      factor *= n - i;
    return factor * std::pow(t, n - k);
  }

  /// x^n_1 y^n_2 z^n_3 and its derivatives; the origin outside the mesh.
  template <int dim>
  struct Monomial
  {
    std::array<unsigned, dim> degree;

    double operator()(const Point<dim> &x, const DerivativeIndex<dim> &taken) const
    {
      double product = 1;
      for (unsigned d = 0; d < dim; ++d)
        product *= power(x[d] - 0.3, degree[d], taken[d]);
      return product;
    }

    double derivative(const Point<dim> &x, const std::initializer_list<unsigned> directions) const
    {
      DerivativeIndex<dim> taken = {};
      for (const unsigned d : directions)
        ++taken[d];
      return (*this)(x, taken);
    }
  };

  /// Largest errors of u_h, first, second, third derivatives at the points of @p on.
  template <int dim>
  void compare(const FEValuesBase<dim> &on, const VectorType &u, const Monomial<dim> &w, std::array<double, 4> &largest)
  {
    const unsigned              n = on.n_quadrature_points;
    std::vector<double>         values(n);
    std::vector<Tensor<1, dim>> gradients(n);
    std::vector<Tensor<2, dim>> hessians(n);
    std::vector<Tensor<3, dim>> thirds(n);
    on.get_function_values(u, values);
    on.get_function_gradients(u, gradients);
    on.get_function_hessians(u, hessians);
    on.get_function_third_derivatives(u, thirds);
    const auto note = [&](const unsigned order, const double difference)
    { largest[order] = std::max(largest[order], std::abs(difference)); };
    for (unsigned q = 0; q < n; ++q)
    {
      const auto &x = on.quadrature_point(q);
      note(0, values[q] - w.derivative(x, {}));
      for (unsigned a = 0; a < dim; ++a)
      {
        note(1, gradients[q][a] - w.derivative(x, {a}));
        for (unsigned b = 0; b < dim; ++b)
        {
          note(2, hessians[q][a][b] - w.derivative(x, {a, b}));
          for (unsigned c = 0; c < dim; ++c)
            note(3, thirds[q][a][b][c] - w.derivative(x, {a, b, c}));
        }
      }
    }
  }

  template <int dim>
  void expect_reproduction()
  {
    const Space<dim>      space;
    const QGauss<dim>     inside(3);
    const QGauss<dim - 1> along(3);
    FEValues<dim>         in_cell(space.mapping, *space.fe, inside, all_derivatives | update_quadrature_points);
    FEFaceValues<dim>     on_face(space.mapping, *space.fe, along, all_derivatives | update_quadrature_points);
    FESubfaceValues<dim>  on_subface(space.mapping, *space.fe, along, all_derivatives | update_quadrature_points);
    std::array<double, 4> largest = {};
    for (unsigned m = 0; m < std::pow(4, dim); ++m)
    {
      Monomial<dim> w;
      for (unsigned d = 0; d < dim; ++d)
        w.degree[d] = m >> 2 * d & 3;
      if (dim == 3 && m % 12 != 3) // a sample, with the highest
        continue;
      const VectorType u = space.interpolant(w);
      for (const auto &cell : space.dof_handler.active_cell_iterators())
      {
        in_cell.reinit(cell);
        compare<dim>(in_cell, u, w, largest);
        for (const unsigned face : cell->face_indices())
        {
          on_face.reinit(cell, face);
          compare<dim>(on_face, u, w, largest);
          if (dim == 2)
            for (unsigned subface = 0; subface < GeometryInfo<dim>::max_children_per_face; ++subface)
              if (!cell->face(face)->at_boundary())
              {
                on_subface.reinit(cell, face, subface);
                compare<dim>(on_subface, u, w, largest);
              }
        }
      }
    }
    EXPECT_LE(largest[0], 1e-12);
    EXPECT_LE(largest[1], 1e-12);
    EXPECT_LE(largest[2], 1e-12 * (dim == 3 ? 10 : 1)); // h^-2 in front of differences of values
    EXPECT_LE(largest[3], 1e-10);
  }

  /// Largest jumps of values, gradients and second derivatives of u between cells.
  template <int dim>
  std::array<double, 3> largest_jumps(const Space<dim> &space, const VectorType &u)
  {
    FEInterfaceValues<dim> on_face(space.mapping, *space.fe, QGauss<dim - 1>(4),
                                   update_values | update_gradients | update_hessians | update_JxW_values);
    std::array<double, 3>  largest = {};
    for (const auto &cell : space.dof_handler.active_cell_iterators())
      for (const unsigned face : cell->face_indices())
      {
        if (cell->face(face)->at_boundary())
          continue;
        const unsigned none = numbers::invalid_unsigned_int;
        on_face.reinit(cell, face, none, cell->neighbor(face), cell->neighbor_of_neighbor(face), none);
        const auto dofs = on_face.get_interface_dof_indices();
        for (const unsigned q : on_face.quadrature_point_indices())
        {
          double         value = 0;
          Tensor<1, dim> gradient;
          Tensor<2, dim> hessian;
          for (unsigned i = 0; i < dofs.size(); ++i)
          {
            value += u(dofs[i]) * on_face.jump_in_shape_values(i, q);
            gradient += u(dofs[i]) * on_face.jump_in_shape_gradients(i, q);
            hessian += u(dofs[i]) * on_face.jump_in_shape_hessians(i, q);
          }
          largest[0] = std::max(largest[0], std::abs(value));
          largest[1] = std::max(largest[1], gradient.norm());
          largest[2] = std::max(largest[2], hessian.norm());
        }
      }
    return largest;
  }

  template <int dim>
  void expect_C1()
  {
    const Space<dim> space;
    const auto       jumps = largest_jumps(space, space.random_function());
    EXPECT_LE(jumps[0], 1e-13);
    EXPECT_LE(jumps[1], 1e-12);
    EXPECT_GT(jumps[2], 1); // no more than C1
  }

  /// At the vertices of each cell the derivatives alpha of the shape functions are 0 and 1.
  template <int dim>
  void expect_physical_dofs()
  {
    const Space<dim> space;
    FEValues<dim>    at_vertices(space.mapping, *space.fe, QTrapezoid<dim>(), all_derivatives | update_quadrature_points);
    const auto       dofs = hermite_cell_dofs<dim>();
    ASSERT_EQ(dofs.size(), space.fe->n_dofs_per_cell());
    ASSERT_EQ(space.fe->n_dofs_per_vertex(), 1u << dim);
    for (const auto &cell : space.dof_handler.active_cell_iterators())
    {
      at_vertices.reinit(cell);
      for (const unsigned v : cell->vertex_indices())
      {
        ASSERT_LE(cell->vertex(v).distance(at_vertices.quadrature_point(v)), 1e-14);
        for (unsigned k = 0; k < dofs.size(); ++k)
          for (unsigned i = 0; i < dofs.size(); ++i)
          {
            if (dofs[i].vertex != v)
              continue;
            std::vector<unsigned> directions;
            for (unsigned d = 0; d < dim; ++d)
              if (dofs[i].derivative[d] == 1)
                directions.push_back(d);
            const double value = directions.empty()       ? at_vertices.shape_value(k, v)
                                 : directions.size() == 1 ? at_vertices.shape_grad(k, v)[directions[0]]
                                 : directions.size() == 2 ? at_vertices.shape_hessian(k, v)[directions[0]][directions[1]]
                                                          : at_vertices.shape_3rd_derivative(k, v)[0][1][2 % dim];
            EXPECT_NEAR(value, i == k, 1e-13);
          }
      }
    }
  }

  /// EI u''v'' of a beam with EI = D; on a plate D [nu Lap u Lap v + (1 - nu) D^2 u : D^2 v] with Poisson's ratio nu.
  template <int dim>
  double bending(const double D, const double nu, const Tensor<2, dim> &u, const Tensor<2, dim> &v)
  {
    return D * (nu * trace(u) * trace(v) + (1 - nu) * scalar_product(u, v));
  }

  template <int dim>
  struct System
  {
    AffineConstraints<double> fixed;
    SparsityPattern           pattern;
    SparseMatrix<double>      A;
    VectorType                f;
  };

  /// A u = f on V_h with the DoFs @p fixed at zero.
  template <int dim>
  void assemble(const Space<dim>                                &space,
                const double                                     D,
                const double                                     nu,
                const std::function<double(const Point<dim> &)> &load,
                const std::vector<types::global_dof_index>      &fixed,
                System<dim>                                     &system)
  {
    for (const auto dof : fixed)
      system.fixed.add_line(dof);
    system.fixed.close();
    DynamicSparsityPattern pattern(space.dof_handler.n_dofs());
    DoFTools::make_sparsity_pattern(space.dof_handler, pattern, system.fixed);
    system.pattern.copy_from(pattern);
    system.A.reinit(system.pattern);
    system.f.reinit(space.dof_handler.n_dofs());
    FEValues<dim>                        on(space.mapping, *space.fe, QGauss<dim>(5),
                                            update_values | update_hessians | update_quadrature_points | update_JxW_values);
    const unsigned                       n = space.fe->n_dofs_per_cell();
    FullMatrix<double>                   A(n, n);
    dealii::Vector<double>               f(n);
    std::vector<types::global_dof_index> dofs(n);
    for (const auto &cell : space.dof_handler.active_cell_iterators())
    {
      on.reinit(cell);
      A = 0;
      f = 0;
      for (const unsigned q : on.quadrature_point_indices())
      {
        const double q_load = load(on.quadrature_point(q));
        for (unsigned i = 0; i < n; ++i)
        {
          f(i) += q_load * on.shape_value(i, q) * on.JxW(q);
          for (unsigned j = 0; j < n; ++j)
            A(i, j) += bending(D, nu, on.shape_hessian(i, q), on.shape_hessian(j, q)) * on.JxW(q);
        }
      }
      cell->get_dof_indices(dofs);
      system.fixed.distribute_local_to_global(A, dofs, system.A);
      system.fixed.distribute_local_to_global(f, dofs, system.f);
    }
  }

  template <int dim>
  VectorType solution(const System<dim> &system)
  {
    SparseDirectUMFPACK inverse;
    inverse.initialize(system.A);
    dealii::Vector<double> b(system.f.size()), x(system.f.size());
    std::copy(system.f.begin(), system.f.end(), b.begin());
    inverse.vmult(x, b);
    VectorType u(x.size());
    std::copy(x.begin(), x.end(), u.begin());
    system.fixed.distribute(u);
    return u;
  }

  /// All sides: u = 0, and du/dn = 0 when @p clamped.
  template <int dim>
  std::vector<types::global_dof_index> support(const Space<dim> &space, const bool clamped)
  {
    const auto sides = space.mesh.get_boundary_ids();
    auto       dofs = hermite_boundary_dofs(space.dof_handler, sides, 0);
    if (clamped)
      for (const auto dof : hermite_boundary_dofs(space.dof_handler, sides, 1))
        dofs.push_back(dof);
    return dofs;
  }

  /// The k-th derivative of sin^2(pi t) = (1 - cos(2 pi t))/2.
  double bump(const double t, const unsigned k)
  {
    const double a = 2 * numbers::PI;
    return (k == 0 ? 0.5 : 0.) - 0.5 * std::pow(a, k) * std::cos(a * t + k * numbers::PI / 2);
  }

  /// Errors of the clamped beam and plate with u = prod_d sin^2(pi x_d): in L2 and in the seminorm of H2.
  template <int dim>
  std::array<double, 2> clamped_errors(const unsigned refinements)
  {
    const Space<dim> space(refinements);
    System<dim>      system;
    assemble<dim>(
      space, 1, 0.3,
      [](const Point<dim> &x)
      {
        if constexpr (dim == 1)
          return bump(x[0], 4);
        else
          return bump(x[0], 4) * bump(x[1], 0) + 2 * bump(x[0], 2) * bump(x[1], 2) + bump(x[0], 0) * bump(x[1], 4);
      },
      support(space, true), system);
    const VectorType            u = solution(system);
    FEValues<dim>               on(space.mapping, *space.fe, QGauss<dim>(6),
                                   update_values | update_hessians | update_quadrature_points | update_JxW_values);
    std::vector<double>         values(on.n_quadrature_points);
    std::vector<Tensor<2, dim>> hessians(on.n_quadrature_points);
    std::array<double, 2>       squares = {};
    for (const auto &cell : space.dof_handler.active_cell_iterators())
    {
      on.reinit(cell);
      on.get_function_values(u, values);
      on.get_function_hessians(u, hessians);
      for (const unsigned q : on.quadrature_point_indices())
      {
        const auto exact = [&](const unsigned a, const unsigned b)
        {
          double product = 1;
          for (unsigned d = 0; d < dim; ++d)
            product *= bump(on.quadrature_point(q)[d], (a == d) + (b == d));
          return product;
        };
        squares[0] += std::pow(values[q] - exact(dim, dim), 2) * on.JxW(q);
        for (unsigned a = 0; a < dim; ++a)
          for (unsigned b = 0; b < dim; ++b)
            squares[1] += std::pow(hessians[q][a][b] - exact(a, b), 2) * on.JxW(q);
      }
    }
    return {std::sqrt(squares[0]), std::sqrt(squares[1])};
  }

  template <int dim>
  void expect_rates(const unsigned coarse, const double finest_L2)
  {
    auto before = clamped_errors<dim>(coarse);
    for (unsigned refinements = coarse + 1; refinements < coarse + 3; ++refinements)
    {
      const auto errors = clamped_errors<dim>(refinements);
      EXPECT_NEAR(std::log2(before[0] / errors[0]), 4, 0.1);
      EXPECT_NEAR(std::log2(before[1] / errors[1]), 2, 0.1);
      before = errors;
    }
    EXPECT_LE(before[0], finest_L2);
  }

  /// The same function on both: values and gradients at points of the finer mesh.
  template <int dim>
  void expect_same(const Space<dim> &coarse, const VectorType &u, const Space<dim> &fine, const VectorType &v)
  {
    FEValues<dim>               on(fine.mapping, *fine.fe, QGauss<dim>(2), update_values | update_gradients | update_quadrature_points);
    std::vector<double>         values(on.n_quadrature_points);
    std::vector<Tensor<1, dim>> gradients(on.n_quadrature_points);
    for (const auto &cell : fine.dof_handler.active_cell_iterators())
    {
      on.reinit(cell);
      on.get_function_values(v, values);
      on.get_function_gradients(v, gradients);
      for (const unsigned q : on.quadrature_point_indices())
      {
        const auto &x = on.quadrature_point(q);
        EXPECT_NEAR(values[q], VectorTools::point_value(coarse.mapping, coarse.dof_handler, u, x), 1e-13);
        EXPECT_LE((gradients[q] - VectorTools::point_gradient(coarse.mapping, coarse.dof_handler, u, x)).norm(), 1e-12);
      }
    }
  }

  template <int dim>
  void expect_exact_refinement()
  {
    const Space<dim> coarse, twice_refined(2);
    const auto       u = coarse.random_function(1), w = coarse.random_function(2);

    Space<dim>                    refined;
    std::vector<VectorType>       functions = {u, w};
    const HermiteOnFinerMesh<dim> carried(refined.dof_handler, functions);
    refined.refine();
    carried.interpolate(refined.dof_handler, functions);
    ASSERT_EQ(functions.size(), 2u);
    expect_same(coarse, u, refined, functions[0]);
    expect_same(coarse, w, refined, functions[1]);

    carried.interpolate(twice_refined.dof_handler, functions);
    expect_same(coarse, u, twice_refined, functions[0]);

    // Step by step and at once.
    std::vector<VectorType>       further = {u, w};
    const HermiteOnFinerMesh<dim> from_coarse(coarse.dof_handler, further);
    from_coarse.interpolate(refined.dof_handler, further);
    const HermiteOnFinerMesh<dim> from_refined(refined.dof_handler, further);
    from_refined.interpolate(twice_refined.dof_handler, further);
    further[0] -= functions[0];
    EXPECT_LE(further[0].linfty_norm(), 1e-10); // mixed derivatives of size 1/h^2
  }

  /// The number of DoFs that are left, and what u and du/dn are on the boundary.
  template <int dim>
  void expect_boundary_conditions()
  {
    const Space<dim>      space;
    const QGauss<dim - 1> along(3);
    FEFaceValues<dim>     on(space.mapping, *space.fe, along, update_values | update_gradients | update_normal_vectors);
    for (const unsigned k : {0, 1})
      for (const types::boundary_id side : space.mesh.get_boundary_ids())
      {
        VectorType u = space.random_function();
        for (const auto dof : hermite_boundary_dofs(space.dof_handler, {side}, k))
          u(dof) = 0;
        double fixed = 0, other = 0;
        for (const auto &cell : space.dof_handler.active_cell_iterators())
          for (const unsigned face : cell->face_indices())
            if (cell->face(face)->at_boundary() && cell->face(face)->boundary_id() == side)
            {
              on.reinit(cell, face);
              std::vector<double>         values(on.n_quadrature_points);
              std::vector<Tensor<1, dim>> gradients(on.n_quadrature_points);
              on.get_function_values(u, values);
              on.get_function_gradients(u, gradients);
              for (const unsigned q : on.quadrature_point_indices())
              {
                const std::array<double, 2> trace = {std::abs(values[q]), std::abs(gradients[q] * on.normal_vector(q))};
                fixed = std::max(fixed, trace[k]);
                other = std::max(other, trace[1 - k]);
              }
            }
        EXPECT_LE(fixed, 1e-14) << "side " << side << ", k = " << k;
        EXPECT_GT(other, 0.1) << "side " << side << ", k = " << k;
      }
  }
} // namespace

TEST(Hermite, reproduces_cubics_in_1d)
{
  expect_reproduction<1>();
}
TEST(Hermite, reproduces_bicubics)
{
  expect_reproduction<2>();
}
TEST(Hermite, reproduces_tricubics)
{
  expect_reproduction<3>();
}

TEST(Hermite, is_continuously_differentiable)
{
  expect_C1<1>();
  expect_C1<2>();
  expect_C1<3>();
}

TEST(Hermite, dofs_are_physical_derivatives)
{
  expect_physical_dofs<1>();
  expect_physical_dofs<2>();
  expect_physical_dofs<3>();
}

TEST(Hermite, nodes_name_what_the_dofs_mean)
{
  const Space<2> space;
  const auto     nodes = hermite_nodes(space.dof_handler);
  ASSERT_EQ(nodes.size(), 4 * 25u);
  std::vector<unsigned> count(4);
  for (const auto &node : nodes)
    ++count[node.derivative[0] + 2 * node.derivative[1]];
  EXPECT_EQ(count, std::vector<unsigned>(4, 25));
  // The order of a cell: u, u_x, u_y, u_xy at each vertex.
  const auto dofs = hermite_cell_dofs<2>();
  EXPECT_EQ(dofs[1].derivative, (DerivativeIndex<2>{1, 0}));
  EXPECT_EQ(dofs[2].derivative, (DerivativeIndex<2>{0, 1}));
  EXPECT_EQ(dofs[7].derivative, (DerivativeIndex<2>{1, 1}));
  EXPECT_EQ(dofs[7].vertex, 1u);
}

// EI/h^3 [12 6h -12 6h; 6h 4h^2 -6h 2h^2; -12 -6h 12 -6h; 6h 2h^2 -6h 4h^2].
TEST(Hermite, stiffness_of_a_beam_cell)
{
  const Space<1> space;
  const double   EI = 2.5;
  FEValues<1>    on(space.mapping, *space.fe, QGauss<1>(2), update_hessians | update_JxW_values);
  for (const auto &cell : space.dof_handler.active_cell_iterators())
  {
    on.reinit(cell);
    const double h = cell->measure(), c = EI / (h * h * h);
    const double expected[4][4] = {
      {12, 6 * h, -12, 6 * h}, {6 * h, 4 * h * h, -6 * h, 2 * h * h}, {-12, -6 * h, 12, -6 * h}, {6 * h, 2 * h * h, -6 * h, 4 * h * h}};
    for (unsigned i = 0; i < 4; ++i)
      for (unsigned j = 0; j < 4; ++j)
      {
        double a = 0;
        for (const unsigned q : on.quadrature_point_indices())
          a += EI * on.shape_hessian(i, q)[0][0] * on.shape_hessian(j, q)[0][0] * on.JxW(q);
        EXPECT_NEAR(a, c * expected[i][j], 1e-13 * c);
      }
  }
}

// Cubic Hermite beams are exact at the nodes: the Green's function of a node lies in V_h.
TEST(Hermite, beams_under_uniform_load_are_exact_at_the_nodes)
{
  const double EI = 2, q = 3;
  for (const bool clamped : {true, false})
  {
    Space<1> space;
    space.refine();
    System<1> system;
    assemble<1>(
      space, EI, 0, [q](const Point<1> &) { return q; }, support(space, clamped), system);
    const VectorType u = solution(system);
    const auto       exact = [&](const Point<1> &point, const DerivativeIndex<1> &taken)
    {
      const double x = point[0], c = q / (24 * EI);
      if (clamped) // x^2 (1 - x)^2
        return c * (taken[0] == 0 ? x * x * (1 - x) * (1 - x) : 2 * x * (1 - x) * (1 - 2 * x));
      return c * (taken[0] == 0 ? x - 2 * x * x * x + x * x * x * x : 1 - 6 * x * x + 4 * x * x * x);
    };
    const VectorType nodal = space.interpolant(exact);
    for (unsigned i = 0; i < u.size(); ++i)
      EXPECT_NEAR(u(i), nodal(i), 1e-12);
    // q L^4 / 384 EI at the centre, five times that on simple supports.
    EXPECT_NEAR(VectorTools::point_value(space.mapping, space.dof_handler, u, Point<1>(0.5)), (clamped ? 1 : 5) * q / (384 * EI), 1e-13);
  }
}

TEST(Hermite, clamped_beam_converges_with_its_order)
{
  expect_rates<1>(2, 1e-6);
}
TEST(Hermite, clamped_plate_converges_with_its_order)
{
  expect_rates<2>(2, 1e-5);
}

// J(u) = a(u, u)/2 - f(u) from derivatives of u_h at points; its derivative is A u - f.
TEST(Hermite, derivative_of_the_energy)
{
  const Space<2> space;
  const double   D = 1.7, nu = 0.3;
  const auto     load = [](const Point<2> &x) { return 1 + x[0] - 2 * x[1]; };
  System<2>      system;
  assemble<2>(space, D, nu, load, {}, system);
  const auto energy = [&](const VectorType &u)
  {
    FEValues<2> on(space.mapping, *space.fe, QGauss<2>(5), update_values | update_hessians | update_quadrature_points | update_JxW_values);
    std::vector<double>       values(on.n_quadrature_points);
    std::vector<Tensor<2, 2>> hessians(on.n_quadrature_points);
    double                    J = 0;
    for (const auto &cell : space.dof_handler.active_cell_iterators())
    {
      on.reinit(cell);
      on.get_function_values(u, values);
      on.get_function_hessians(u, hessians);
      for (const unsigned q : on.quadrature_point_indices())
        J += (bending(D, nu, hessians[q], hessians[q]) / 2 - load(on.quadrature_point(q)) * values[q]) * on.JxW(q);
    }
    return J;
  };
  const VectorType u = space.random_function(3), v = space.random_function(4);
  VectorType       gradient(u.size()), plus(u), minus(u);
  system.A.vmult(gradient, u);
  gradient -= system.f;
  plus += v;
  minus -= v; // J is quadratic: the central difference is exact
  EXPECT_NEAR((energy(plus) - energy(minus)) / 2, gradient * v, 1e-11 * energy(u));
}

TEST(Hermite, refinement_keeps_the_function)
{
  expect_exact_refinement<1>();
  expect_exact_refinement<2>();
}

TEST(Hermite, a_mesh_that_is_no_refinement_is_refused)
{
  const Space<2>              fine(1), coarse;
  std::vector<VectorType>     functions = {fine.random_function()};
  const HermiteOnFinerMesh<2> carried(fine.dof_handler, functions);
  EXPECT_THROW(carried.interpolate(coarse.dof_handler, functions), std::invalid_argument);
}

TEST(Hermite, boundary_conditions)
{
  expect_boundary_conditions<1>();
  expect_boundary_conditions<2>();
  const Space<2> plate;
  // 25 vertices: of 100 DoFs 3 x 3 x 4 are left inside when clamped; a simple support leaves the slope across each side, u_xy in the
  // corners.
  EXPECT_EQ(hermite_boundary_dofs(plate.dof_handler, {0}, 0).size(), 10u);
  EXPECT_EQ(hermite_boundary_dofs(plate.dof_handler, {0, 1, 2, 3}, 0).size(), 12 * 2 + 4 * 3u);
  System<2> system;
  assemble<2>(
    plate, 1, 0.3, [](const Point<2> &) { return 1.; }, support(plate, true), system);
  EXPECT_EQ(system.fixed.n_constraints(), 64u);
  EXPECT_THROW(hermite_boundary_dofs(plate.dof_handler, {0}, 2), std::invalid_argument);
}

TEST(Hermite, other_cells_are_refused)
{
  EXPECT_TRUE(is_axis_parallel(Space<1>().mesh));
  EXPECT_TRUE(is_axis_parallel(Space<2>(1).mesh));
  EXPECT_TRUE(is_axis_parallel(Space<3>().mesh));

  const auto refused = [](const Triangulation<2> &mesh)
  {
    EXPECT_FALSE(is_axis_parallel(mesh));
    const auto    fe = make_hermite_element<2>();
    DoFHandler<2> dof_handler(mesh);
    dof_handler.distribute_dofs(*fe);
    FEValues<2> on(*fe, QGauss<2>(2), update_values);
    EXPECT_THROW(on.reinit(dof_handler.begin_active()), std::invalid_argument);
  };
  Triangulation<2> distorted, turned, sheared, triangles;
  make_graded(distorted);
  GridTools::distort_random(0.1, distorted, false);
  refused(distorted);

  // A square whose first reference direction is +y.
  turned.create_triangulation({{1, 0}, {1, 1}, {0, 0}, {0, 1}},
                              {[]
                               {
                                 CellData<2> cell;
                                 cell.vertices = {0, 1, 2, 3};
                                 return cell;
                               }()},
                              SubCellData());
  refused(turned);

  GridGenerator::parallelogram(sheared, {Point<2>(1, 0), Point<2>(0.1, 1)});
  refused(sheared);

  GridGenerator::subdivided_hyper_cube_with_simplices(triangles, 2);
  EXPECT_FALSE(is_axis_parallel(triangles));
}

// Nothing that rests on reference shape functions may give wrong numbers in silence.
TEST(Hermite, what_depends_on_h_is_refused)
{
  Space<2> space;
  EXPECT_FALSE(space.fe->has_support_points());
  EXPECT_ANY_THROW(space.fe->get_prolongation_matrix(0));
  EXPECT_ANY_THROW(space.fe->get_restriction_matrix(0));
  EXPECT_ANY_THROW(space.fe->shape_value(0, Point<2>()));
  EXPECT_ANY_THROW(space.fe->shape_grad(0, Point<2>()));

  SolutionTransfer<2, VectorType> transfer(space.dof_handler);
  const VectorType                u = space.random_function();
  space.mesh.set_all_refine_flags();
  transfer.prepare_for_pure_refinement();
  space.refine();
  VectorType refined(space.dof_handler.n_dofs());
  EXPECT_ANY_THROW(transfer.refine_interpolate(u, refined));
}
