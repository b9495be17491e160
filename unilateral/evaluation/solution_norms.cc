#include "unilateral/evaluation/solution_norms.h"

#include "unilateral/algebra/dense_solvers.h"
#include "unilateral/discretisation/element_systems.h"
#include "unilateral/discretisation/regions_and_parts.h"
#include "unilateral/evaluation/equilibrium.h"
#include "unilateral/evaluation/estimator.h"
#include "unilateral/forms/elasticity.h"
#include "unilateral/mesh/congruent_cells.h"
#include "unilateral/spaces/point_location.h"

#include <deal.II/base/quadrature_lib.h>
#include <deal.II/grid/grid_tools.h>

#include <fmt/format.h>
#include <fmt/ranges.h>

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
          local_u(dofs.size() / n_components, n_components)
      {
      }

      void add(const typename DoFHandler<dim>::active_cell_iterator &cell, const VectorType &u, SolutionNorms &squares)
      {
        const unsigned shape = shapes(cell);
        if (shape == shapes.none)
        {
          values.reinit(cell);
          add_at_points(u, squares);
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

      void add_at_points(const VectorType &u, SolutionNorms &squares)
      {
        u_at.resize(values.n_quadrature_points, dealii::Vector<double>(problem.form->n_components()));
        gradient_at.resize(values.n_quadrature_points, std::vector<Tensor<1, dim>>(problem.form->n_components()));
        hessian_at.resize(values.n_quadrature_points);
        values.get_function_values(u, u_at);
        values.get_function_gradients(u, gradient_at);
        if (bending)
          values.get_function_hessians(u, hessian_at);
        for (const unsigned q : values.quadrature_point_indices())
        {
          const double w = values.JxW(q) * problem.form->measure(values.quadrature_point(q));
          squares.L2 += u_at[q].norm_sqr() * w;
          for (const auto &gradient : gradient_at[q])
            squares.H1_semi += gradient.norm_square() * w;
          if (bending)
            squares.H2_semi += hessian_at[q].norm_square() * w;
        }
      }

      const Problem<dim>                      &problem;
      FEValues<dim>                            values;
      CellShapes<dim>                          shapes;
      const unsigned                           n_components;
      const bool                               bending;
      std::vector<types::global_dof_index>     dofs;
      Eigen::MatrixXd                          local_u; ///< functions x components
      Eigen::VectorXd                          image;
      std::vector<Roots>                       known; ///< by shape
      std::vector<dealii::Vector<double>>      u_at;
      std::vector<std::vector<Tensor<1, dim>>> gradient_at;
      std::vector<Tensor<2, dim>>              hessian_at;
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
      problem.space.element.simplex() ? Quadrature<dim>(QGaussSimplex<dim>(4)) : Quadrature<dim>(QIterated<dim>(QTrapezoid<1>(), n));
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

  namespace
  {
    /// L2, H1 and, of order 4, H2 seminorm of u - exact, by quadrature with p + 3 points a direction.
    template <int dim>
    void add_errors_on_cells(const Problem<dim> &problem, const VectorType &u, const std::vector<FieldFunction> &exact, Errors &errors)
    {
      const unsigned        n_components = exact.size();
      const Quadrature<dim> quadrature = problem.space.element.simplex() ? Quadrature<dim>(QGaussSimplex<dim>(4))
                                                                         : Quadrature<dim>(QGauss<dim>(problem.space.element.degree + 3));
      const bool            bending = problem.form->order() > 1;
      // All components have the same shape functions: those of one are computed.
      const auto                           scalar = n_components > 1 ? problem.space.scalar_element() : nullptr;
      const FiniteElement<dim>            &fe = scalar ? *scalar : *problem.space.fe;
      const unsigned                       n = fe.n_dofs_per_cell();
      FEValues<dim>                        values(*problem.space.mapping, fe, quadrature, cell_flags(*problem.form));
      std::vector<types::global_dof_index> dofs(problem.space.fe->n_dofs_per_cell());
      std::vector<double>                  exact_at, u_local(n);
      std::vector<Tensor<1, dim>>          exact_gradient_at;
      double                               L2 = 0, H1_semi = 0, H2_semi = 0;
      for (const auto &cell : problem.space.dof_handler.active_cell_iterators())
      {
        values.reinit(typename Triangulation<dim>::active_cell_iterator(cell));
        cell->get_dof_indices(dofs);
        for (unsigned c = 0; c < n_components; ++c)
        {
          exact[c].values_and_gradients(values.get_quadrature_points(), exact_at, exact_gradient_at);
          for (unsigned k = 0; k < n; ++k)
            u_local[k] = u(dofs[problem.space.fe->component_to_system_index(c, k)]);
          for (const unsigned q : values.quadrature_point_indices())
          {
            double         error = -exact_at[q];
            Tensor<1, dim> error_of_gradient = -exact_gradient_at[q];
            Tensor<2, dim> error_of_hessian;
            if (bending)
              error_of_hessian = -exact[c].hessian(values.quadrature_point(q));
            for (unsigned k = 0; k < n; ++k)
            {
              error += u_local[k] * values.shape_value(k, q);
              error_of_gradient += u_local[k] * values.shape_grad(k, q);
              if (bending)
                error_of_hessian += u_local[k] * values.shape_hessian(k, q);
            }
            const double w = values.JxW(q) * problem.form->measure(values.quadrature_point(q));
            L2 += error * error * w;
            H1_semi += error_of_gradient.norm_square() * w;
            H2_semi += error_of_hessian.norm_square() * w;
          }
        }
      }
      const Processes &processes = problem.space.processes();
      errors.L2 = std::sqrt(processes.sum(L2));
      errors.H1_semi = std::sqrt(processes.sum(H1_semi));
      if (bending)
        errors.H2_semi = std::sqrt(H2_semi);
    }

    /// Largest and mean error of every component at every node.
    template <int dim>
    void add_errors_at_nodes(const Problem<dim> &problem, const VectorType &u, const std::vector<FieldFunction> &exact, Errors &errors)
    {
      const Processes                                  &processes = problem.space.processes();
      double                                            max = 0, sum = 0, n = 0;
      std::vector<std::vector<Point<dim>>>              points(exact.size());
      std::vector<std::vector<types::global_dof_index>> dofs(exact.size());
      for (const auto &node : problem.space.nodal_values())
        if (problem.space.shared().owns(node.dof))
        {
          points[node.component].push_back(node.x);
          dofs[node.component].push_back(node.dof);
        }
      std::vector<double> exact_at;
      for (std::size_t c = 0; c < exact.size(); ++c)
      {
        exact[c].values(points[c], exact_at);
        n += dofs[c].size();
        for (std::size_t i = 0; i < dofs[c].size(); ++i)
        {
          const double error = std::abs(u(dofs[c][i]) - exact_at[i]);
          max = std::max(max, error);
          sum += error;
        }
      }
      errors.max_nodal = processes.max(max);
      errors.mean_nodal = processes.sum(sum) / processes.sum(n);
    }
  } // namespace

  template <int dim>
  Errors solution_errors(const Problem<dim>       &problem,
                         const ConstraintSet<dim> &constraint_set,
                         const VectorType         &u,
                         const VectorType         &contact_pressure)
  {
    const auto running = problem.time_by_part.run("norms");
    const auto &[exact_u, exact_pressure] = problem.statement.exact;
    Errors errors;
    if (!exact_u.empty())
    {
      add_errors_on_cells(problem, u, exact_u, errors);
      add_errors_at_nodes(problem, u, exact_u, errors);
    }
    if (exact_pressure && !constraint_set.blocks.empty())
    {
      double sum = 0;
      for (std::size_t i = constraint_set.blocks[0].begin; i < constraint_set.blocks[0].end; ++i)
      {
        if (!constraint_set.owns(i))
          continue;
        const double error = contact_pressure(i) - exact_pressure->value(constraint_set.points[i].x);
        sum += constraint_set.points[i].weight * error * error;
      }
      errors.pressure_L2 = std::sqrt(problem.space.processes().sum(sum));
    }
    return errors;
  }

  namespace
  {
    /// Of several processes the one speaks in whose part the point lies.
    void take_from_nearest(const Processes &processes, const double outside, ProbeResult &result)
    {
      if (processes.alone())
        return;
      const bool          nearest = outside == processes.min(outside);
      const unsigned      speaker = processes.min(nearest ? processes.rank() : processes.size());
      std::vector<double> numbers(result.value);
      if (result.stress)
        numbers.insert(numbers.end(), result.stress->begin(), result.stress->end());
      numbers.push_back(result.von_mises);
      processes.broadcast(numbers.data(), numbers.size(), speaker);
      auto next = numbers.begin();
      for (double &value : result.value)
        value = *next++;
      if (result.stress)
        for (double &component : *result.stress)
          component = *next++;
      result.von_mises = *next;
    }
  } // namespace

  template <int dim>
  void check_probes(const Problem<dim> &problem)
  {
    Diagnostics diagnostics;
    const auto &output = problem.statement.output;
    for (std::size_t k = 0; k < output.probes.size(); ++k)
      if (problem.space.processes().min(locate(problem.space, to_point<dim>(output.probes[k])).outside) > outside_by_straight_sides)
        diagnostics.error(k < output.probes_where.size() ? output.probes_where[k] : problem.statement.mesh.where,
                          fmt::format("the probe ({:.6g}) lies in no cell of the mesh: there is no u; move it inside, or leave it out",
                                      fmt::join(output.probes[k], ", ")));
    diagnostics.throw_if_errors();
  }

  template <int dim>
  std::vector<ProbeResult> probe_values(const Problem<dim> &problem, const VectorType &u, const RecoveredFlux<dim> &flux)
  {
    std::vector<ProbeResult>             results;
    const auto                          &fe = *problem.space.fe;
    std::vector<types::global_dof_index> dofs(fe.n_dofs_per_cell());
    const bool                           body = problem.form->n_components() > 1;
    const auto                           scalar = body ? problem.space.scalar_element() : nullptr;
    std::vector<types::global_dof_index> nodes(body ? scalar->n_dofs_per_cell() : 0);
    for (const auto &coordinates : problem.statement.output.probes)
    {
      const auto [owner, unit, outside] = locate(problem.space, to_point<dim>(coordinates));
      ProbeResult result{
        coordinates, std::vector<double>(problem.form->n_components(), std::numeric_limits<double>::quiet_NaN()), {}, 0, {}};
      if (outside <= outside_by_straight_sides)
      {
        owner->get_dof_indices(dofs);
        result.value.assign(result.value.size(), 0.);
        FEValues<dim> at_point(*problem.space.mapping, fe, Quadrature<dim>(unit), cell_flags(*problem.form));
        at_point.reinit(owner);
        dealii::Vector<double> local(dofs.size());
        for (unsigned i = 0; i < dofs.size(); ++i)
        {
          local(i) = u(dofs[i]);
          result.value[fe.system_to_component_index(i).first] += local(i) * at_point.shape_value(i, 0);
        }
        if (problem.form->order() > 1)
        {
          std::vector<Flux> moments;
          problem.form->flux(at_point, local, moments);
          result.moments.assign(moments[0].begin(), moments[0].begin() + problem.form->n_flux_components());
        }
        if (body)
        {
          Stress stress{};
          typename DoFHandler<dim>::active_cell_iterator(&*problem.space.mesh.triangulation, owner->level(), owner->index(), &*flux.nodes)
            ->get_dof_indices(nodes);
          for (unsigned i = 0; i < nodes.size(); ++i)
            for (std::size_t c = 0; c < stress.size(); ++c)
              stress[c] += scalar->shape_value(i, unit) * flux.at(nodes[i], owner->material_id())[c];
          result.stress = stress;
          result.von_mises = von_mises(stress);
        }
      }
      else if (body)
      {
        result.stress.emplace();
        result.stress->fill(std::numeric_limits<double>::quiet_NaN());
        result.von_mises = std::numeric_limits<double>::quiet_NaN();
      }
      take_from_nearest(problem.space.processes(), outside, result);
      results.push_back(std::move(result));
    }
    return results;
  }

#define INSTANTIATE(dim)                                                                                                                   \
  template double        largest_violation(const Problem<dim> &, const UnilateralCondition &, const VectorType &);                         \
  template SolutionNorms solution_norms(const Problem<dim> &, const VectorType &);                                                         \
  template Errors        solution_errors(const Problem<dim> &, const ConstraintSet<dim> &, const VectorType &, const VectorType &);        \
  template std::vector<ProbeResult> probe_values(const Problem<dim> &, const VectorType &, const RecoveredFlux<dim> &);                    \
  template void                     check_probes(const Problem<dim> &);
  INSTANTIATE(1)
  INSTANTIATE(2)
  INSTANTIATE(3)
#undef INSTANTIATE
} // namespace unilateral
