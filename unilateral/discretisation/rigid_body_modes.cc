#include "unilateral/discretisation/rigid_body_modes.h"

#include "unilateral/algebra/dense_solvers.h"
#include "unilateral/algebra/null_space.h"
#include "unilateral/discretisation/element_systems.h"
#include "unilateral/discretisation/motion_names.h"
#include "unilateral/discretisation/problem.h"
#include "unilateral/spaces/hermite.h"

#include <deal.II/base/bounding_box.h>

#include <algorithm>
#include <cmath>
#include <set>

namespace unilateral
{
  using namespace dealii;
  using Eigen::MatrixXd;
  using Eigen::VectorXd;

  namespace
  {
    /// The same for all processes that share the mesh.
    template <int dim>
    Point<dim> centre_of(const Problem<dim> &problem)
    {
      const auto &vertices = problem.space.mesh.triangulation->get_vertices();
      Point<dim>  sum;
      for (const auto &vertex : vertices)
        sum += vertex;
      const double n = problem.space.processes().sum(double(vertices.size()));
      for (unsigned d = 0; d < dim; ++d)
        sum[d] = problem.space.processes().sum(sum[d]) / n;
      return sum;
    }
  } // namespace

  template <int dim>
  std::vector<RigidBodyMode<dim>> rigid_body_modes(const Problem<dim> &problem)
  {
    auto modes = problem.form->rigid_body_modes(centre_of(problem));
    for (auto &mode : modes)
    {
      double largest = 0;
      for (const auto &vertex : problem.space.mesh.triangulation->get_vertices())
        largest = std::max(largest, mode.value(vertex).norm());
      largest = problem.space.processes().max(largest);
      const auto unscaled = mode.value;
      mode.value = [unscaled, largest](const Point<dim> &x) { return unscaled(x) / largest; };
    }
    return modes;
  }

  template <int dim>
  std::vector<Vector> interpolate(const Problem<dim> &problem, const std::vector<RigidBodyMode<dim>> &modes)
  {
    std::vector<Vector> values(modes.size(), Vector(problem.space.dof_handler.n_dofs()));
    if (modes.empty())
      return values;
    for (const auto &node : problem.space.nodal_values())
      for (std::size_t k = 0; k < modes.size(); ++k)
        values[k](node.dof) = modes[k].value(node.x)[node.component];
    if (problem.space.hermite())
    {
      // Modes are linear: a difference over any distance is the derivative, and mixed derivatives vanish.
      const auto nodes = hermite_nodes(problem.space.dof_handler);
      for (types::global_dof_index dof = 0; dof < nodes.size(); ++dof)
      {
        unsigned order = 0, direction = 0;
        for (unsigned d = 0; d < dim; ++d)
          if (nodes[dof].derivative[d] > 0)
          {
            ++order;
            direction = d;
          }
        if (order != 1)
          continue;
        Point<dim> ahead = nodes[dof].location;
        ahead[direction] += 1;
        for (std::size_t k = 0; k < modes.size(); ++k)
          values[k](dof) = modes[k].value(ahead)[0] - modes[k].value(nodes[dof].location)[0];
      }
    }
    return values;
  }

  template <int dim>
  MatrixXd mode_matrix(const Problem<dim> &problem, const std::vector<RigidBodyMode<dim>> &modes)
  {
    MatrixXd   values(problem.space.dof_handler.n_dofs(), modes.size());
    const auto at_unknowns = interpolate(problem, modes);
    for (std::size_t k = 0; k < modes.size(); ++k)
      std::copy(at_unknowns[k].begin(), at_unknowns[k].end(), values.col(k).begin());
    return values;
  }

  template <int dim>
  WorkOnModes work_on_modes(const Problem<dim> &problem, const MatrixXd &modes)
  {
    const unsigned k = modes.cols();
    WorkOnModes    work{MatrixXd::Zero(k, k), VectorXd::Zero(k), VectorXd::Zero(k)};
    const auto     add_load = [&](const LocalSystem &system)
    {
      for (unsigned i = 0; i < system.dofs.size(); ++i)
        for (unsigned a = 0; a < k; ++a)
        {
          const double product = system.load(i) * modes(system.dofs[i], a);
          work.load(a) += product;
          work.load_size(a) += std::abs(product);
        }
    };
    for_each_cell_load<dim>(problem, add_load);
    for_each_local_system_outside_cells<dim>(
      problem,
      [&](const LocalSystem &system)
      {
        add_load(system);
        if (!system.springs)
          return;
        const unsigned n = system.dofs.size();
        for (unsigned i = 0; i < n; ++i)
          for (unsigned j = 0; j < n; ++j)
            for (unsigned a = 0; a < k; ++a)
              for (unsigned b = 0; b < k; ++b)
                work.springs(a, b) += modes(system.dofs[i], a) * system.matrix(i, j) * modes(system.dofs[j], b);
      },
      Volumes::of_vertices_apart); // no mode changes a volume
    const Processes &processes = problem.space.processes();
    processes.sum(work.springs.data(), work.springs.size());
    processes.sum(work.load.data(), k);
    processes.sum(work.load_size.data(), k);
    return work;
  }

  namespace
  {
    /// r_k.r_l of what the modes do to prescribed values.
    template <int dim>
    MatrixXd violation_of_supports(const Problem<dim> &problem, const MatrixXd &at)
    {
      MatrixXd held = MatrixXd::Zero(at.cols(), at.cols());
      for (const auto &line : problem.space.dirichlet.get_lines())
      {
        if (!problem.space.shared().owns(line.index))
          continue;
        Eigen::RowVectorXd violation = at.row(line.index);
        for (const auto &[dof, factor] : line.entries)
          violation -= factor * at.row(dof);
        held += violation.transpose() * violation;
      }
      problem.space.processes().sum(held.data(), held.size());
      return held;
    }

    /// The same with what springs do.
    template <int dim>
    MatrixXd held_by_conditions(const Problem<dim> &problem, const MatrixXd &at)
    {
      MatrixXd       held = violation_of_supports(problem, at);
      const MatrixXd springs = work_on_modes(problem, at).springs;
      if (springs.cwiseAbs().maxCoeff() > 0)
        held += springs / springs.cwiseAbs().maxCoeff();
      return held;
    }

    constexpr double not_held = 1e-9;
  } // namespace

  template <int dim>
  MatrixXd free_modes(const Problem<dim> &problem)
  {
    const auto modes = rigid_body_modes(problem);
    if (modes.empty() || problem.form->holds_rigid_body_modes())
      return MatrixXd(modes.size(), 0);
    return free_combinations(problem, mode_matrix(problem, modes));
  }

  template <int dim>
  MatrixXd free_combinations(const Problem<dim> &problem, const MatrixXd &at)
  {
    return null_space(held_by_conditions(problem, at), not_held);
  }

  template <int dim>
  MatrixXd unsupported_modes(const Problem<dim> &problem)
  {
    const auto modes = rigid_body_modes(problem);
    if (modes.empty())
      return MatrixXd(0, 0);
    return null_space(violation_of_supports(problem, mode_matrix(problem, modes)), not_held);
  }

  template <int dim>
  std::optional<std::pair<std::string, double>> motion_held_by_weak_springs(const Problem<dim> &problem)
  {
    constexpr double weak = 1e-11;
    const MatrixXd   modes = unsupported_modes(problem);
    if (modes.cols() == 0 || problem.form->order() != 1)
      return {};
    const auto                                    all = rigid_body_modes(problem);
    const MatrixXd                                springs = work_on_modes<dim>(problem, mode_matrix(problem, all) * modes).springs;
    const Eigen::SelfAdjointEigenSolver<MatrixXd> eigen(springs);
    const double                                  most = eigen.eigenvalues().maxCoeff();
    const auto                                    held =
      std::find_if(eigen.eigenvalues().begin(), eigen.eigenvalues().end(), [&](const double value) { return value > not_held * most; });
    if (!(most > 0) || held == eigen.eigenvalues().end())
      return {};
    // A motion by 1 against the force of the cells for a strain of 1 over the size of the mesh.
    Flux unit{};
    unit[0] = 1;
    const auto   cell = problem.space.mesh.triangulation->begin_active();
    const auto   corners = BoundingBox<dim>(problem.space.mesh.triangulation->get_vertices()).get_boundary_points();
    const double stiffness =
      std::pow(corners.first.distance(corners.second), dim - 2.) / problem.form->flux_energy(unit, cell->material_id(), cell->center());
    if (!(*held < weak * stiffness))
      return {};
    const VectorXd coefficients = modes * eigen.eigenvectors().col(held - eigen.eigenvalues().begin());
    return std::pair(motion_name<dim>(coefficients, all), *held / stiffness);
  }

  template <int dim>
  MatrixXd contact_on_modes(const ConstraintSet<dim> &set, const MatrixXd &at)
  {
    MatrixXd contact = MatrixXd::Zero(at.cols(), set.size());
    for (std::size_t i = 0; i < set.size(); ++i)
      for (std::size_t k = 0; k < set.trace[i].dofs.size(); ++k)
        contact.col(i) += set.points[i].sign * set.trace[i].values[k] * at.row(set.trace[i].dofs[k]).transpose();
    return contact;
  }

  template <int dim>
  std::vector<RigidBodyMode<dim>> combined_modes(const Problem<dim> &problem, const MatrixXd &coefficients)
  {
    const auto                      modes = rigid_body_modes(problem);
    std::vector<RigidBodyMode<dim>> result;
    for (Eigen::Index j = 0; j < coefficients.cols(); ++j)
    {
      const VectorXd column = coefficients.col(j);
      result.push_back({motion_name(column, modes), [modes, column](const Point<dim> &x)
                        {
                          Tensor<1, dim> sum;
                          for (std::size_t k = 0; k < modes.size(); ++k)
                            sum += column(k) * modes[k].value(x);
                          return sum;
                        }});
    }
    return result;
  }

  template <int dim>
  std::vector<Pin<dim>> pins_against(const Problem<dim> &problem, const MatrixXd &indifferent)
  {
    const auto modes = rigid_body_modes(problem);
    // Every component at every vertex of the boundary, but for those that others follow: what a pin bears there could not be told from
    // what passes through.
    std::vector<Pin<dim>>             candidates;
    std::set<unsigned>                seen;
    std::set<types::global_dof_index> coupled;
    for (const auto &tie : problem.space.couplings.ties)
    {
      coupled.insert(tie.dof);
      for (const auto &[dof, factor] : tie.entries)
        coupled.insert(dof);
    }
    const auto cut = problem.space.subdomain ? types::boundary_id(problem.space.mesh.part_names.size() - 1) : numbers::invalid_boundary_id;
    const auto collect = [&]
    {
      for (const auto &cell : problem.space.dof_handler.active_cell_iterators())
        for (const auto face : cell->face_indices())
        {
          if (!cell->at_boundary(face) || cell->face(face)->boundary_id() == cut)
            continue;
          for (const auto v : cell->face(face)->vertex_indices())
            if (const auto corners = cell->face(face); !problem.space.hanging_nodes.is_constrained(corners->vertex_dof_index(v, 0)) &&
                                                       seen.insert(corners->vertex_index(v)).second)
              for (unsigned c = 0; c < problem.form->n_components(); ++c)
                if (!coupled.count(corners->vertex_dof_index(v, c)))
                  candidates.push_back({corners->vertex(v), c});
        }
    };
    collect();
    const Processes &processes = problem.space.processes();
    if (!processes.any(!candidates.empty()))
    {
      coupled.clear();
      seen.clear();
      collect();
    }
    // rows(i, j): what mode j does to candidate i. Greedy elimination: the largest entry left is the next pin.
    MatrixXd rows(candidates.size(), indifferent.cols());
    for (std::size_t i = 0; i < candidates.size(); ++i)
      for (Eigen::Index j = 0; j < indifferent.cols(); ++j)
      {
        double value = 0;
        for (std::size_t k = 0; k < modes.size(); ++k)
          value += indifferent(k, j) * modes[k].value(candidates[i].x)[candidates[i].component];
        rows(i, j) = value;
      }
    std::vector<Pin<dim>> pins;
    for (Eigen::Index j = 0; j < indifferent.cols(); ++j)
    {
      Eigen::Index   row = 0, column = 0;
      const double   largest_here = candidates.empty() ? -1. : rows.cwiseAbs().maxCoeff(&row, &column);
      const double   largest = processes.max(largest_here);
      const unsigned owner = unsigned(processes.min(double(largest_here == largest ? processes.rank() : processes.size())));
      // Point, component and row of the pin, on all processes.
      std::vector<double> chosen(dim + 1 + indifferent.cols());
      if (processes.rank() == owner)
      {
        for (unsigned d = 0; d < dim; ++d)
          chosen[d] = candidates[row].x[d];
        chosen[dim] = candidates[row].component;
        for (Eigen::Index k = 0; k < indifferent.cols(); ++k)
          chosen[dim + 1 + k] = rows(row, k);
      }
      processes.broadcast(chosen.data(), chosen.size(), owner);
      Pin<dim> &pin = pins.emplace_back();
      for (unsigned d = 0; d < dim; ++d)
        pin.x[d] = chosen[d];
      pin.component = unsigned(chosen[dim]);
      const Eigen::RowVectorXd pivot_row = Eigen::Map<const Eigen::RowVectorXd>(chosen.data() + dim + 1, indifferent.cols());
      pivot_row.cwiseAbs().maxCoeff(&column);
      const VectorXd pivot_column = rows.col(column) / pivot_row(column);
      rows -= pivot_column * pivot_row;
    }
    return pins;
  }

  template <int dim>
  std::vector<Vector> modes_at_unknowns(const Problem<dim> &problem, const std::vector<RigidBodyMode<dim>> &modes)
  {
    auto result = interpolate(problem, modes);
    for (Vector &mode : result)
      problem.space.dirichlet.set_zero(mode);
    return result;
  }

#define INSTANTIATE(dim)                                                                                                                   \
  template std::vector<RigidBodyMode<dim>>               rigid_body_modes(const Problem<dim> &);                                           \
  template std::vector<Vector>                           interpolate(const Problem<dim> &, const std::vector<RigidBodyMode<dim>> &);       \
  template std::vector<Vector>                           modes_at_unknowns(const Problem<dim> &, const std::vector<RigidBodyMode<dim>> &); \
  template MatrixXd                                      free_modes(const Problem<dim> &);                                                 \
  template MatrixXd                                      free_combinations(const Problem<dim> &, const MatrixXd &);                        \
  template MatrixXd                                      contact_on_modes(const ConstraintSet<dim> &, const MatrixXd &);                   \
  template MatrixXd                                      unsupported_modes(const Problem<dim> &);                                          \
  template std::vector<RigidBodyMode<dim>>               combined_modes(const Problem<dim> &, const MatrixXd &);                           \
  template MatrixXd                                      mode_matrix(const Problem<dim> &, const std::vector<RigidBodyMode<dim>> &);       \
  template WorkOnModes                                   work_on_modes(const Problem<dim> &, const MatrixXd &);                            \
  template std::optional<std::pair<std::string, double>> motion_held_by_weak_springs(const Problem<dim> &);                                \
  template std::vector<Pin<dim>>                         pins_against(const Problem<dim> &, const MatrixXd &);
  INSTANTIATE(1)
  INSTANTIATE(2)
  INSTANTIATE(3)
#undef INSTANTIATE
} // namespace unilateral
