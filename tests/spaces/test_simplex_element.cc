// P1, P2 and P3 on triangles and tetrahedra: V_h is continuous, holds the polynomials, and converges with its order.
#include "unilateral/mesh/mesh_generators.h"
#include "unilateral/mesh/simplex_refinement.h"
#include "unilateral/output/solution_vtu.h"
#include "unilateral/spaces/simplex_element.h"

#include <deal.II/base/function_lib.h>
#include <deal.II/dofs/dof_renumbering.h>
#include <deal.II/dofs/dof_tools.h>
#include <deal.II/fe/fe_values.h>
#include <deal.II/fe/mapping_fe.h>
#include <deal.II/lac/dynamic_sparsity_pattern.h>
#include <deal.II/lac/precondition.h>
#include <deal.II/lac/solver_cg.h>
#include <deal.II/lac/sparse_matrix.h>
#include <deal.II/numerics/data_out.h>
#include <deal.II/numerics/matrix_tools.h>
#include <deal.II/numerics/solution_transfer.h>
#include <deal.II/numerics/vector_tools_boundary.h>
#include <deal.II/numerics/vector_tools_integrate_difference.h>
#include <deal.II/numerics/vector_tools_interpolate.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <numeric>
#include <random>
#include <sstream>

#include <unistd.h>

namespace
{
  using namespace unilateral;
  using dealii::DoFHandler;
  using dealii::FEFaceValues;
  using dealii::FEValues;
  using dealii::Point;
  using dealii::QGaussSimplex;
  using dealii::Tensor;
  using dealii::Triangulation;
  using dealii::types::global_dof_index;

  template <int dim>
  const dealii::MappingFE<dim> straight{dealii::FE_SimplexP<dim>(1)};

  /// A polynomial of the given degree that no symmetry of a mesh leaves alone.
  template <int dim>
  class Polynomial : public dealii::Function<dim>
  {
  public:
    explicit Polynomial(const unsigned degree) : degree(degree) {}
    double value(const Point<dim> &p, const unsigned = 0) const override
    {
      double sum = 0.3;
      for (unsigned d = 0; d < dim; ++d)
        sum += (d + 1.2) * p[d];
      // The constant keeps it away from 0: set_dof_values_by_interpolation() compares values relative to their size.
      return 20 + std::pow(sum, degree) - 2 * std::pow(p[0], degree) + p[dim - 1];
    }

  private:
    const unsigned degree;
  };

  /// sin(2 x) sin(2 y + 1) ..
  template <int dim>
  class Wave : public dealii::Function<dim>
  {
  public:
    double value(const Point<dim> &p, const unsigned = 0) const override
    {
      double product = 1;
      for (unsigned d = 0; d < dim; ++d)
        product *= std::sin(2 * p[d] + d);
      return product;
    }
    Tensor<1, dim> gradient(const Point<dim> &p, const unsigned = 0) const override
    {
      Tensor<1, dim> result;
      for (unsigned e = 0; e < dim; ++e)
      {
        result[e] = 2;
        for (unsigned d = 0; d < dim; ++d)
          result[e] *= d == e ? std::cos(2 * p[d] + d) : std::sin(2 * p[d] + d);
      }
      return result;
    }
  };

  template <int dim>
  struct NamedMesh
  {
    std::string                         name;
    std::shared_ptr<Triangulation<dim>> triangulation;
  };

  /// The active cells of a mesh in random order, each with its vertices turned at random: lines and faces run in all the ways that the
  /// mesh of a mesh generator can have.
  template <int dim>
  std::shared_ptr<Triangulation<dim>> shuffled(const Triangulation<dim> &original, const unsigned seed)
  {
    std::mt19937          random(seed);
    std::vector<unsigned> number(original.n_vertices());
    std::iota(number.begin(), number.end(), 0);
    std::shuffle(number.begin(), number.end(), random);
    std::vector<Point<dim>> points(number.size());
    for (unsigned v = 0; v < number.size(); ++v)
      points[number[v]] = original.get_vertices()[v];
    std::vector<dealii::CellData<dim>> cells;
    for (const auto &cell : original.active_cell_iterators())
    {
      dealii::CellData<dim> turned(dim + 1);
      for (const auto v : cell->vertex_indices())
        turned.vertices[v] = number[cell->vertex_index(v)];
      // Three vertices in a circle: an even permutation, and the volume stays positive.
      for (unsigned turn = 0; turn < 3; ++turn)
      {
        const unsigned first = random() % (dim - 1);
        for (unsigned times = random() % 3; times > 0; --times)
          std::rotate(turned.vertices.begin() + first, turned.vertices.begin() + first + 1, turned.vertices.begin() + first + 3);
      }
      cells.push_back(turned);
    }
    std::shuffle(cells.begin(), cells.end(), random);
    auto result = std::make_shared<Triangulation<dim>>();
    result->create_triangulation(points, cells, dealii::SubCellData());
    return result;
  }

  /// The unit box; all of its boundary has the number 0.
  template <int dim>
  std::shared_ptr<Triangulation<dim>> unit_box(const unsigned cells)
  {
    Point<dim> upper;
    for (unsigned d = 0; d < dim; ++d)
      upper[d] = 1;
    std::shared_ptr<Triangulation<dim>> box = box_mesh<dim>(Point<dim>(), upper, std::vector<unsigned>(dim, cells), true).triangulation;
    for (const auto &face : box->active_face_iterators())
      if (face->at_boundary())
        face->set_boundary_id(0);
    return box;
  }

  /// Box, ball and shell; coarse, refined in both ways, and shuffled.
  template <int dim>
  std::vector<NamedMesh<dim>> meshes()
  {
    std::vector<NamedMesh<dim>> all;
    const auto                  add = [&](const std::string &name, const auto &make)
    {
      const auto coarse = make();
      all.push_back({name, coarse});
      all.push_back({name + ", refined by deal.II", make()});
      all.back().triangulation->refine_global(4 - dim);
      all.push_back({name + ", refined", refine_simplices(*coarse, orders_by_shortest_diagonal(*coarse)).triangulation});
      for (const unsigned seed : {1, 2, 3})
      {
        all.push_back({name + ", shuffled and refined by deal.II", shuffled<dim>(*coarse, seed)});
        all.back().triangulation->refine_global(1);
      }
    };
    add("box", [] { return unit_box<dim>(2); });
    add("ball", [] { return shuffled<dim>(*ball_mesh<dim>(Point<dim>(), 1, true).triangulation, 7); });
    if (dim == 2)
      add("shell", [] { return shuffled<dim>(*shell_mesh<dim>(Point<dim>(), 0.5, 1, true).triangulation, 8); });
    return all;
  }

  template <int dim>
  struct Space
  {
    Space(const Triangulation<dim> &triangulation, const unsigned degree) : fe(make_simplex_element<dim>(degree)), dofs(triangulation)
    {
      distribute();
    }
    void distribute()
    {
      dofs.distribute_dofs(*fe);
      match_line_nodes(dofs);
    }
    std::unique_ptr<dealii::FiniteElement<dim>> fe;
    DoFHandler<dim>                             dofs;
  };

  template <int dim>
  Vector random_function(const DoFHandler<dim> &dofs)
  {
    std::mt19937                           random(5);
    std::uniform_real_distribution<double> between(-1, 1);
    Vector                                 u(dofs.n_dofs());
    for (double &value : u)
      value = between(random);
    return u;
  }

  template <int dim>
  double largest_difference(const DoFHandler<dim> &dofs, const Vector &u, const dealii::Function<dim> &f)
  {
    const QGaussSimplex<dim> quadrature(3);
    FEValues<dim>            values(straight<dim>, dofs.get_fe(), quadrature, dealii::update_values | dealii::update_quadrature_points);
    double                   largest = 0;
    std::vector<double>      at_points(quadrature.size());
    for (const auto &cell : dofs.active_cell_iterators())
    {
      values.reinit(cell);
      values.get_function_values(u, at_points);
      for (const auto q : values.quadrature_point_indices())
        largest = std::max(largest, std::abs(at_points[q] - f.value(values.quadrature_point(q))));
    }
    return largest;
  }

  /// The largest jump of u at points of the inner faces.
  template <int dim>
  double largest_jump(const DoFHandler<dim> &dofs, const Vector &u)
  {
    const auto &fe = dofs.get_fe();
    const auto  quadrature = []
    {
      if constexpr (dim == 2)
        return dealii::QGauss<1>(3);
      else
        return QGaussSimplex<2>(3);
    }();
    FEFaceValues<dim>             here(straight<dim>, fe, quadrature, dealii::update_values | dealii::update_quadrature_points);
    std::vector<double>           at_points(quadrature.size());
    std::vector<global_dof_index> there(fe.n_dofs_per_cell());
    double                        largest = 0;
    for (const auto &cell : dofs.active_cell_iterators())
      for (const auto face : cell->face_indices())
        if (!cell->at_boundary(face))
        {
          here.reinit(cell, face);
          here.get_function_values(u, at_points);
          const auto neighbor = cell->neighbor(face);
          neighbor->get_dof_indices(there);
          for (const auto q : here.quadrature_point_indices())
          {
            const auto x = straight<dim>.transform_real_to_unit_cell(neighbor, here.quadrature_point(q));
            double     value = 0;
            for (unsigned i = 0; i < there.size(); ++i)
              value += u(there[i]) * fe.shape_value(i, x);
            largest = std::max(largest, std::abs(value - at_points[q]));
          }
        }
    return largest;
  }

  template <int dim>
  void check_on_meshes()
  {
    for (const auto &[name, triangulation] : meshes<dim>())
      for (const unsigned degree : {1, 2, 3})
      {
        SCOPED_TRACE(name + ", dim " + std::to_string(dim) + " P" + std::to_string(degree));
        Space<dim> space(*triangulation, degree);
        EXPECT_LT(largest_jump(space.dofs, random_function(space.dofs)), 1e-12);

        const Polynomial<dim> f(degree);
        Vector                u(space.dofs.n_dofs());
        dealii::VectorTools::interpolate(straight<dim>, space.dofs, f, u);
        EXPECT_LT(largest_difference(space.dofs, u, f), 1e-11);

        // The nodes are where they are said to be.
        std::vector<Point<dim>> nodes(space.dofs.n_dofs());
        dealii::DoFTools::map_dofs_to_support_points(straight<dim>, space.dofs, nodes);
        for (unsigned i = 0; i < nodes.size(); ++i)
          ASSERT_NEAR(u(i), f.value(nodes[i]), 1e-12);

        // Values at the boundary, and at all of its nodes.
        std::map<global_dof_index, double> boundary;
        dealii::VectorTools::interpolate_boundary_values(straight<dim>, space.dofs, 0, f, boundary);
        EXPECT_EQ(boundary.size(), dealii::DoFTools::extract_boundary_dofs(space.dofs).n_elements());
        for (const auto &[dof, value] : boundary)
          ASSERT_NEAR(value, u(dof), 1e-12);
      }
  }

  TEST(SimplexElement, IsContinuousAndInterpolatesOnTriangles)
  {
    check_on_meshes<2>();
  }
  TEST(SimplexElement, IsContinuousAndInterpolatesOnTetrahedra)
  {
    check_on_meshes<3>();
  }

  TEST(SimplexElement, HasTheNodesOfAContinuousElement)
  {
    for (const unsigned p : {1, 2, 3})
    {
      EXPECT_EQ(make_simplex_element<1>(p)->n_dofs_per_cell(), p + 1);
      EXPECT_EQ(make_simplex_element<2>(p)->n_dofs_per_cell(), (p + 1) * (p + 2) / 2);
      EXPECT_EQ(make_simplex_element<3>(p)->n_dofs_per_cell(), (p + 1) * (p + 2) * (p + 3) / 6);
    }
    const auto element = make_simplex_element<3>(3);
    for (unsigned i = 0; i < element->n_dofs_per_cell(); ++i)
    {
      Tensor<1, 3> sum;
      for (unsigned j = 0; j < element->n_dofs_per_cell(); ++j)
      {
        EXPECT_NEAR(element->shape_value(j, element->unit_support_point(i)), i == j, 1e-13);
        sum += element->shape_grad(j, element->unit_support_point(i));
      }
      EXPECT_LT(sum.norm(), 1e-12);
    }
    EXPECT_THROW(make_simplex_element<2>(4), std::invalid_argument);
    EXPECT_THROW(make_simplex_element<3>(0), std::invalid_argument);
  }

  /// A renumbering forgets what cells were told: it can be said again, and saying it twice changes nothing.
  TEST(SimplexElement, CanBeMatchedAgain)
  {
    auto mesh = ball_mesh<3>(Point<3>(), 1, true);
    mesh.triangulation->refine_global(1);
    Space<3> space(*mesh.triangulation, 3);
    dealii::DoFRenumbering::random(space.dofs);
    match_line_nodes(space.dofs);
    match_line_nodes(space.dofs);
    EXPECT_LT(largest_jump(space.dofs, random_function(space.dofs)), 1e-12);
  }

  template <int dim>
  void check_prolongation()
  {
    for (const unsigned degree : {1, 2, 3})
      for (const unsigned seed : {1, 2})
      {
        SCOPED_TRACE("dim " + std::to_string(dim) + " P" + std::to_string(degree));
        const auto            mesh = shuffled<dim>(*unit_box<dim>(2), seed);
        Space<dim>            space(*mesh, degree);
        const Polynomial<dim> f(degree);
        for (unsigned level = 0; level < 2; ++level)
        {
          Vector u(space.dofs.n_dofs());
          dealii::VectorTools::interpolate(straight<dim>, space.dofs, f, u);
          dealii::SolutionTransfer<dim, Vector> transfer(space.dofs);
          mesh->set_all_refine_flags();
          mesh->prepare_coarsening_and_refinement();
          transfer.prepare_for_pure_refinement();
          mesh->execute_coarsening_and_refinement();
          space.distribute();
          Vector refined(space.dofs.n_dofs());
          transfer.refine_interpolate(u, refined);
          EXPECT_LT(largest_difference(space.dofs, refined, f), 1e-11);
        }
      }
  }

  TEST(SimplexElement, ProlongationIsExactOnTriangles)
  {
    check_prolongation<2>();
  }
  TEST(SimplexElement, ProlongationIsExactOnTetrahedra)
  {
    check_prolongation<3>();
  }

  /// L2 and H1 seminorm of the error of -Delta u = f with the values of u at the boundary.
  template <int dim>
  std::pair<double, double> poisson_errors(const Triangulation<dim> &triangulation, const unsigned degree)
  {
    Space<dim>                     space(triangulation, degree);
    const unsigned                 n_dofs = space.dofs.n_dofs(), n = space.fe->n_dofs_per_cell();
    dealii::DynamicSparsityPattern dynamic(n_dofs);
    dealii::DoFTools::make_sparsity_pattern(space.dofs, dynamic);
    dealii::SparsityPattern pattern;
    pattern.copy_from(dynamic);
    dealii::SparseMatrix<double> matrix(pattern);
    dealii::Vector<double>       u(n_dofs), load(n_dofs);

    const Wave<dim>               exact;
    const QGaussSimplex<dim>      quadrature(4);
    FEValues<dim>                 values(straight<dim>, *space.fe, quadrature,
                                         dealii::update_values | dealii::update_gradients | dealii::update_quadrature_points | dealii::update_JxW_values);
    std::vector<global_dof_index> dofs(n);
    dealii::FullMatrix<double>    cell_matrix(n, n);
    for (const auto &cell : space.dofs.active_cell_iterators())
    {
      values.reinit(cell);
      cell->get_dof_indices(dofs);
      cell_matrix = 0;
      for (const auto q : values.quadrature_point_indices())
        for (unsigned i = 0; i < n; ++i)
        {
          for (unsigned j = 0; j < n; ++j)
            cell_matrix(i, j) += values.shape_grad(i, q) * values.shape_grad(j, q) * values.JxW(q);
          load(dofs[i]) += 4 * dim * exact.value(values.quadrature_point(q)) * values.shape_value(i, q) * values.JxW(q);
        }
      matrix.add(dofs, cell_matrix);
    }
    std::map<global_dof_index, double> boundary;
    dealii::VectorTools::interpolate_boundary_values(straight<dim>, space.dofs, 0, exact, boundary);
    dealii::MatrixTools::apply_boundary_values(boundary, matrix, u, load);
    dealii::SolverControl                    control(2000, 1e-12 * load.l2_norm());
    dealii::SolverCG<dealii::Vector<double>> cg(control);
    dealii::PreconditionSSOR<>               smoother;
    smoother.initialize(matrix, 1.2);
    cg.solve(matrix, u, load, smoother);

    const auto error = [&](const dealii::VectorTools::NormType norm)
    {
      dealii::Vector<float> of_cell(triangulation.n_active_cells());
      dealii::VectorTools::integrate_difference(straight<dim>, space.dofs, u, exact, of_cell, quadrature, norm);
      return dealii::VectorTools::compute_global_error(triangulation, of_cell, norm);
    };
    return {error(dealii::VectorTools::L2_norm), error(dealii::VectorTools::H1_seminorm)};
  }

  /// The order between two meshes, the second of half the size.
  template <int dim>
  void check_order(const unsigned degree, const Triangulation<dim> &coarse, const Triangulation<dim> &fine)
  {
    SCOPED_TRACE("dim " + std::to_string(dim) + " P" + std::to_string(degree));
    const auto   on_coarse = poisson_errors(coarse, degree), on_fine = poisson_errors(fine, degree);
    const double L2 = std::log2(on_coarse.first / on_fine.first), H1 = std::log2(on_coarse.second / on_fine.second);
    EXPECT_GT(L2, degree + 0.8);
    EXPECT_GT(H1, degree - 0.1);
  }

  TEST(SimplexElement, ConvergesWithItsOrderOnTriangles)
  {
    for (const unsigned degree : {1, 2, 3})
    {
      check_order<2>(degree, *unit_box<2>(8), *unit_box<2>(16));
      const auto coarse = shuffled<2>(*unit_box<2>(4), 3);
      const auto fine = shuffled<2>(*unit_box<2>(4), 3);
      coarse->refine_global(1);
      fine->refine_global(2);
      check_order<2>(degree, *coarse, *fine);
    }
  }

  TEST(SimplexElement, ConvergesWithItsOrderOnTetrahedra)
  {
    for (const unsigned degree : {1, 2, 3})
    {
      const unsigned n = degree == 1 ? 8 : 4;
      check_order<3>(degree, *shuffled<3>(*unit_box<3>(n), 4), *shuffled<3>(*unit_box<3>(2 * n), 4));
    }
  }

  template <int dim>
  void check_output()
  {
    const auto mesh = unit_box<dim>(2);
    for (const unsigned degree : {1, 2, 3})
    {
      Space<dim>            space(*mesh, degree);
      const Polynomial<dim> f(degree);
      Vector                u(space.dofs.n_dofs());
      dealii::VectorTools::interpolate(straight<dim>, space.dofs, f, u);
      dealii::DataOut<dim> data_out;
      data_out.attach_dof_handler(space.dofs);
      data_out.add_data_vector(u, "u");
      data_out.build_patches(straight<dim>, std::min(degree, 2u)); // deal.II's own output stops at quadratic simplices
      std::ostringstream text;
      data_out.write_vtu(text);
      EXPECT_GT(text.str().size(), 1000u);

      const std::string path =
        (std::filesystem::temp_directory_path() / ("unilateral_test_simplex_element_" + std::to_string(getpid()) + ".vtu")).string();
      write_solution_vtu<dim>(path, straight<dim>, space.dofs, u, degree);
      std::ifstream file(path);
      std::string   vtu{std::istreambuf_iterator<char>(file), {}};
      std::filesystem::remove(path);
      // As many points as V_h has nodes, and each cell in degree^dim.
      EXPECT_NE(vtu.find("NumberOfPoints=\"" + std::to_string(space.dofs.n_dofs()) + "\""), std::string::npos);
      const auto n_pieces = mesh->n_active_cells() * static_cast<unsigned>(std::pow(degree, dim) + 0.5);
      EXPECT_NE(vtu.find("NumberOfCells=\"" + std::to_string(n_pieces) + "\""), std::string::npos);
    }
  }

  TEST(SimplexElement, CanBeWrittenForParaView)
  {
    check_output<2>();
    check_output<3>();
  }
} // namespace
