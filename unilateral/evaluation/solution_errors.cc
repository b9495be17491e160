#include "unilateral/evaluation/solution_errors.h"

#include "unilateral/forms/elasticity.h"
#include "unilateral/forms/membrane.h"
#include "unilateral/functions/expression_code.h"
#include "unilateral/mesh/rule_of_total_degree.h"
#include "unilateral/spaces/function_on_cells.h"

#include <deal.II/base/quadrature_lib.h>

#include <Eigen/Core>

#include <algorithm>
#include <cmath>

namespace unilateral
{
  using namespace dealii;
  using VectorType = LinearAlgebra::distributed::Vector<double>;

  namespace
  {
    /// Its energy is what [exact] can be compared with: not where changes of volume are integrated in a reduced way, since u has others
    /// between the points then, which do not count.
    template <int dim>
    const Elasticity<dim> *body_with_energy(const Problem<dim> &problem)
    {
      const auto *const body = dynamic_cast<const Elasticity<dim> *>(problem.form.get());
      if (!body)
        return nullptr;
      bool reduced = false;
      for (const auto &cell : problem.space.dof_handler.active_cell_iterators())
        reduced = reduced || body->lame_parameters(cell->material_id(), cell->center()).reduced;
      return problem.space.processes().any(reduced) ? nullptr : body;
    }

    /// eps : C eps = lambda (tr G + h)^2 + mu (G : G + G : G^T + 2 h^2) of the displacement whose gradient is G, h the hoop strain u_r/r of
    /// a body of revolution, else 0.
    template <int dim>
    double strain_energy(const typename Elasticity<dim>::LameParameters &lame, const Tensor<2, dim> &G, const double hoop)
    {
      double trace = hoop, with_transpose = 2 * hoop * hoop;
      for (unsigned i = 0; i < dim; ++i)
      {
        trace += G[i][i];
        for (unsigned j = 0; j < dim; ++j)
          with_transpose += G[i][j] * (G[i][j] + G[j][i]);
      }
      return lame.lambda * trace * trace + lame.mu * with_transpose;
    }

    /// As many as expressions take: its components then share what they have in common.
    constexpr std::size_t n_points_at_a_time = ExpressionColumn::n_points;

    /// A function and its derivatives at points of several cells: others are evaluated at many points at a time.
    template <int dim>
    struct PointsOfCells
    {
      std::vector<Point<dim>>                  x;
      std::vector<types::material_id>          regions;
      Eigen::VectorXd                          weights;
      Eigen::MatrixXd                          values;    ///< points x components
      Eigen::MatrixXd                          gradients; ///< (points x directions) x components
      std::vector<std::vector<Tensor<2, dim>>> hessians;  ///< components x points, or nothing

      PointsOfCells(const unsigned n_components, const std::size_t most)
        : weights(most), values(most, n_components), gradients(most * dim, n_components), hessians(n_components)
      {
      }

      std::size_t size() const { return x.size(); }
      bool        has_room_for(const std::size_t n) const { return size() + n <= std::size_t(weights.size()); }

      void add(const Problem<dim> &problem, const FunctionOnCells<dim> &u, const types::material_id region, const bool second_derivatives)
      {
        const std::size_t begin = size(), n = u.points().size();
        x.insert(x.end(), u.points().begin(), u.points().end());
        regions.resize(begin + n, region);
        for (unsigned q = 0; q < n; ++q)
          weights(begin + q) = u.weight(q) * problem.form->measure(u.points()[q]);
        values.middleRows(begin, n) = u.values_at_points();
        gradients.middleRows(begin * dim, n * dim) = u.gradients_at_points();
        for (unsigned c = 0; c < hessians.size() && second_derivatives; ++c)
          for (unsigned q = 0; q < n; ++q)
            hessians[c].push_back(u.hessian(q, c));
      }

      void subtract(const std::vector<FieldFunction> &exact)
      {
        static_assert(sizeof(Tensor<1, dim>) == dim * sizeof(double));
        for (unsigned c = 0; c < exact.size() && !x.empty(); ++c)
        {
          exact[c].values_and_gradients(x, exact_at, exact_gradient_at);
          values.col(c).head(size()) -= Eigen::Map<const Eigen::VectorXd>(exact_at.data(), size());
          gradients.col(c).head(size() * dim) -= Eigen::Map<const Eigen::VectorXd>(exact_gradient_at[0].begin_raw(), size() * dim);
          for (std::size_t q = 0; q < hessians[c].size(); ++q)
            hessians[c][q] -= exact[c].hessian(x[q]);
        }
      }

      /// Of component c at point q.
      Tensor<1, dim> gradient(const std::size_t q, const unsigned c) const
      {
        Tensor<1, dim> result;
        for (unsigned d = 0; d < dim; ++d)
          result[d] = gradients(q * dim + d, c);
        return result;
      }

      void clear()
      {
        x.clear();
        regions.clear();
        for (auto &of_component : hessians)
          of_component.clear();
      }

    private:
      std::vector<double>         exact_at;
      std::vector<Tensor<1, dim>> exact_gradient_at;
    };

    /// The squares of L2 norm, H1 and H2 seminorm, and of the energy norm of a membrane or body.
    struct ErrorSquares
    {
      double L2 = 0, H1_semi = 0, H2_semi = 0, energy = 0;
    };

    template <int dim>
    double energy_of(const Membrane<dim> &membrane, const PointsOfCells<dim> &error)
    {
      double sum = 0;
      for (std::size_t q = 0; q < error.size(); ++q)
      {
        const auto          &coefficients = membrane.coefficients_in(error.regions[q]);
        const Tensor<1, dim> gradient = error.gradient(q, 0);
        sum += (gradient * (coefficients.stiffness_tensor(error.x[q]) * gradient) +
                coefficients.reaction.value(error.x[q]) * error.values(q, 0) * error.values(q, 0)) *
               error.weights(q);
      }
      return sum;
    }

    template <int dim>
    double energy_of(const Elasticity<dim> &body, const bool axisymmetric, const PointsOfCells<dim> &error)
    {
      double                                   sum = 0;
      typename Elasticity<dim>::LameParameters lame;
      bool                                     uniform = false;
      for (std::size_t q = 0; q < error.size(); ++q)
      {
        const bool other_region = q == 0 || error.regions[q] != error.regions[q - 1];
        if (other_region)
          uniform = body.uniform_in(error.regions[q]);
        if (other_region || !uniform)
          lame = body.lame_parameters(error.regions[q], error.x[q]);
        Tensor<2, dim> gradient;
        for (unsigned c = 0; c < dim; ++c)
          gradient[c] = error.gradient(q, c);
        const double hoop = axisymmetric ? error.values(q, 0) / error.x[q][0] : 0.; // points of cells are off the axis
        sum += strain_energy<dim>(lame, gradient, hoop) * error.weights(q);
      }
      return sum;
    }

    template <int dim>
    void add_squares(const Problem<dim> &problem, const Elasticity<dim> *const body, const PointsOfCells<dim> &error, ErrorSquares &squares)
    {
      const auto weights = error.weights.head(error.size());
      for (unsigned c = 0; c < error.values.cols(); ++c)
      {
        const Eigen::Map<const Eigen::Matrix<double, dim, Eigen::Dynamic>> gradients(error.gradients.col(c).data(), dim, error.size());
        squares.L2 += error.values.col(c).head(error.size()).cwiseAbs2().dot(weights);
        squares.H1_semi += gradients.colwise().squaredNorm() * weights;
        for (std::size_t q = 0; q < error.hessians[c].size(); ++q)
          squares.H2_semi += error.hessians[c][q].norm_square() * weights(q);
      }
      if (body)
        squares.energy += energy_of(*body, problem.axisymmetric(), error);
      else if (const auto *const membrane = dynamic_cast<const Membrane<dim> *>(problem.form.get()))
        squares.energy += energy_of(*membrane, error);
    }

    /// L2, H1 and, of order 4, H2 seminorm of u - exact, by a rule of total degree 2p + 3. What leads in the error of a smooth function is
    /// a polynomial of degree p + 1 on each cell, its square one of degree 2p + 2.
    template <int dim>
    void add_errors_on_cells(const Problem<dim> &problem, const VectorType &u, const std::vector<FieldFunction> &exact, Errors &errors)
    {
      const Quadrature<dim> rule = rule_of_total_degree<dim>(problem.space.element.simplex(), problem.space.element.degree + 2);
      const bool            bending = problem.form->order() > 1;
      FunctionOnCells<dim>  u_on_cell(problem.space, rule, bending);
      PointsOfCells<dim>    points(exact.size(), std::max<std::size_t>(n_points_at_a_time, rule.size()));
      const auto *const     body = body_with_energy(problem);
      ErrorSquares          squares;
      const auto            add_points = [&]
      {
        points.subtract(exact);
        add_squares(problem, body, points, squares);
        points.clear();
      };
      for (const auto &cell : problem.space.dof_handler.active_cell_iterators())
      {
        u_on_cell.reinit(cell, u);
        if (!points.has_room_for(rule.size()))
          add_points();
        points.add(problem, u_on_cell, cell->material_id(), bending);
      }
      add_points();

      const Processes &processes = problem.space.processes();
      errors.L2 = std::sqrt(processes.sum(squares.L2));
      errors.H1_semi = std::sqrt(processes.sum(squares.H1_semi));
      if (body || dynamic_cast<const Membrane<dim> *>(problem.form.get()))
        errors.energy = std::sqrt(std::max(0., processes.sum(squares.energy)));
      if (bending)
        errors.H2_semi = std::sqrt(processes.sum(squares.H2_semi));
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
      std::size_t n_nodes = 0;
      for (std::size_t c = 0; c < exact.size(); ++c)
      {
        n += dofs[c].size();
        n_nodes = std::max(n_nodes, dofs[c].size());
      }
      // The nodes of all components are the same.
      std::vector<double>     exact_at;
      std::vector<Point<dim>> some;
      for (std::size_t begin = 0; begin < n_nodes; begin += n_points_at_a_time)
        for (std::size_t c = 0; c < exact.size(); ++c)
        {
          const std::size_t end = std::min(begin + n_points_at_a_time, dofs[c].size());
          if (begin >= end)
            continue;
          some.assign(points[c].begin() + begin, points[c].begin() + end);
          exact[c].values(some, exact_at);
          for (std::size_t i = begin; i < end; ++i)
          {
            const double error = std::abs(u(dofs[c][i]) - exact_at[i - begin]);
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

#define INSTANTIATE(dim)                                                                                                                   \
  template Errors solution_errors(const Problem<dim> &, const ConstraintSet<dim> &, const VectorType &, const VectorType &);
  INSTANTIATE(1)
  INSTANTIATE(2)
  INSTANTIATE(3)
#undef INSTANTIATE
} // namespace unilateral
