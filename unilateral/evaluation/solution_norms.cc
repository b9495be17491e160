#include "unilateral/evaluation/solution_norms.h"

#include "unilateral/algebra/dense_solvers.h"
#include "unilateral/discretisation/element_systems.h"
#include "unilateral/evaluation/equilibrium.h"
#include "unilateral/mesh/congruent_cells.h"
#include "unilateral/mesh/gauss_rule.h"
#include "unilateral/spaces/function_on_cells.h"

#include <deal.II/base/quadrature_lib.h>

#include <cmath>

namespace unilateral
{
  using namespace dealii;
  using VectorType = LinearAlgebra::distributed::Vector<double>;

  namespace
  {
    /// The squares of the norms on one cell after another. What they sum up depends on the cell's unknowns in the same way on cells of one
    /// shape, component by component.
    template <int dim>
    class NormsOnCells
    {
    public:
      explicit NormsOnCells(const Problem<dim> &problem)
        : problem(problem), values(*problem.space.mapping, *problem.space.fe, problem.cell_quadrature(), cell_flags(*problem.form)),
          shapes(*problem.space.mesh.triangulation,
                 *problem.space.mapping,
                 std::vector<bool>(problem.space.mesh.region_names.size(), !problem.axisymmetric())),
          n_components(problem.form->n_components()), bending(problem.form->order() > 1), dofs(problem.space.fe->n_dofs_per_cell()),
          local_u(dofs.size() / n_components, n_components), at_points(problem.space, problem.cell_quadrature(), bending)
      {
      }

      void add(const typename DoFHandler<dim>::active_cell_iterator &cell, const VectorType &u, SolutionNorms &squares)
      {
        const unsigned shape = shapes(cell);
        if (shape == shapes.none)
        {
          add_at_points(cell, u, squares);
          return;
        }
        if (shape == known.size())
        {
          values.reinit(cell);
          known.push_back(roots());
        }
        cell->get_dof_indices(dofs);
        for (unsigned i = 0; i < dofs.size(); ++i)
        {
          const auto [component, function] = problem.space.fe->system_to_component_index(i);
          local_u(function, component) = u(dofs[i]);
        }
        const auto square = [&](const Eigen::MatrixXd &root)
        {
          double sum = 0;
          for (unsigned c = 0; c < n_components; ++c)
          {
            image.noalias() = root * local_u.col(c);
            sum += image.squaredNorm();
          }
          return sum;
        };
        squares.L2 += square(known[shape].L2);
        squares.H1_semi += square(known[shape].H1_semi);
        if (bending)
          squares.H2_semi += square(known[shape].H2_semi);
      }

    private:
      /// R with |R v|^2 the square of the norm, v the unknowns of a component: unlike v'Mv it does not cancel.
      struct Roots
      {
        Eigen::MatrixXd L2, H1_semi, H2_semi;
      };

      Roots roots() const
      {
        // Derivatives at the points times the roots of their weights, reduced to as many rows as there are functions.
        const unsigned  n_q = values.n_quadrature_points, n = local_u.rows();
        Eigen::MatrixXd zeroth(n_q, n), first(n_q * dim, n), second(bending ? n_q * dim * dim : 0, n);
        for (unsigned q = 0; q < n_q; ++q)
          for (unsigned k = 0; k < n; ++k)
          {
            const unsigned i = problem.space.fe->component_to_system_index(0, k);
            const double   w = std::sqrt(values.JxW(q));
            zeroth(q, k) = w * values.shape_value(i, q);
            for (unsigned d = 0; d < dim; ++d)
              first(q * dim + d, k) = w * values.shape_grad(i, q)[d];
            for (unsigned d = 0; bending && d < dim * dim; ++d)
              second(q * dim * dim + d, k) = w * values.shape_hessian(i, q)[d / dim][d % dim];
          }
        const auto reduced = [n](const Eigen::MatrixXd &F) -> Eigen::MatrixXd
        {
          if (F.rows() <= n)
            return F;
          return Eigen::HouseholderQR<Eigen::MatrixXd>(F).matrixQR().topRows(n).template triangularView<Eigen::Upper>();
        };
        return {reduced(zeroth), reduced(first), reduced(second)};
      }

      void add_at_points(const typename DoFHandler<dim>::active_cell_iterator &cell, const VectorType &u, SolutionNorms &squares)
      {
        at_points.reinit(cell, u);
        for (unsigned q = 0; q < at_points.points().size(); ++q)
        {
          const double w = at_points.weight(q) * problem.form->measure(at_points.points()[q]);
          for (unsigned c = 0; c < n_components; ++c)
          {
            squares.L2 += at_points.value(q, c) * at_points.value(q, c) * w;
            squares.H1_semi += at_points.gradient(q, c).norm_square() * w;
            if (bending)
              squares.H2_semi += at_points.hessian(q, c).norm_square() * w;
          }
        }
      }

      const Problem<dim>                  &problem;
      FEValues<dim>                        values;
      CellShapes<dim>                      shapes;
      const unsigned                       n_components;
      const bool                           bending;
      std::vector<types::global_dof_index> dofs;
      Eigen::MatrixXd                      local_u; ///< functions x components
      Eigen::VectorXd                      image;
      std::vector<Roots>                   known;     ///< by shape
      FunctionOnCells<dim>                 at_points; ///< on cells that are like no other
    };
  } // namespace

  template <int dim>
  SolutionNorms solution_norms(const Problem<dim> &problem, const VectorType &u)
  {
    const auto        running = problem.time_by_part.run("norms");
    SolutionNorms     norms;
    NormsOnCells<dim> on_cells(problem);
    for (const auto &cell : problem.space.dof_handler.active_cell_iterators())
      on_cells.add(cell, u, norms);
    norms.energy = energy(problem, u);
    const Processes &processes = problem.space.processes();
    for (double *const sum : {&norms.L2, &norms.H1_semi, &norms.H2_semi})
      *sum = processes.sum(*sum);
    norms.L2 = std::sqrt(norms.L2);
    norms.H1_semi = std::sqrt(norms.H1_semi);
    norms.H2_semi = std::sqrt(norms.H2_semi);
    norms.min = std::numeric_limits<double>::max();
    norms.max = std::numeric_limits<double>::lowest();
    const auto is_value = problem.space.values_among_unknowns();
    for (types::global_dof_index dof = 0; dof < u.size(); ++dof)
      if (is_value[dof])
      {
        norms.min = std::min(norms.min, u(dof));
        norms.max = std::max(norms.max, u(dof));
      }
    norms.min = processes.min(norms.min);
    norms.max = processes.max(norms.max);
    return norms;
  }

  template <int dim>
  double largest_violation(const Problem<dim> &problem, const UnilateralCondition &condition, const VectorType &u)
  {
    const unsigned        n = 4 * std::max(problem.space.element.degree, 1u);
    const Quadrature<dim> lattice =
      problem.space.element.simplex() ? gauss_rule<dim>(true, 4) : Quadrature<dim>(QIterated<dim>(QTrapezoid<1>(), n));
    FEValues<dim>       values(*problem.space.mapping, *problem.space.fe, lattice, update_values | update_quadrature_points);
    std::vector<double> u_at(lattice.size());
    double              largest = 0;
    for (const auto &cell : problem.space.dof_handler.active_cell_iterators())
    {
      values.reinit(cell);
      values.get_function_values(u, u_at);
      for (const unsigned q : values.quadrature_point_indices())
      {
        const double excess = u_at[q] - condition.bound.value(values.quadrature_point(q));
        largest = std::max(largest, condition.side == Side::upper ? excess : -excess);
      }
    }
    return largest;
  }

#define INSTANTIATE(dim)                                                                                                                   \
  template double        largest_violation(const Problem<dim> &, const UnilateralCondition &, const VectorType &);                         \
  template SolutionNorms solution_norms(const Problem<dim> &, const VectorType &);
  INSTANTIATE(1)
  INSTANTIATE(2)
  INSTANTIATE(3)
#undef INSTANTIATE
} // namespace unilateral
