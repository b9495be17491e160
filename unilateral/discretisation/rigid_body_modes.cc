#include "unilateral/discretisation/rigid_body_modes.h"

#include "unilateral/algebra/dense_solvers.h"
#include "unilateral/algebra/nonnegative_least_squares.h"
#include "unilateral/discretisation/element_systems.h"
#include "unilateral/discretisation/problem.h"
#include "unilateral/spaces/hermite.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

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

  namespace
  {
    /// The modes as functions of V_h: n x k.
    template <int dim>
    MatrixXd at_nodes(const Problem<dim> &problem, const std::vector<RigidBodyMode<dim>> &modes)
    {
      MatrixXd values(problem.space.dof_handler.n_dofs(), modes.size());
      for (std::size_t k = 0; k < modes.size(); ++k)
      {
        const Vector mode = interpolate(problem, modes[k]);
        for (Eigen::Index i = 0; i < values.rows(); ++i)
          values(i, k) = mode(i);
      }
      return values;
    }

    /// The points of a block have one direction: their surface is flat, and its normal is exact.
    template <int dim>
    bool flat(const ConstraintSet<dim> &set, const ConstraintBlock &block)
    {
      for (std::size_t i = block.begin; i < block.end; ++i)
        if (set.directions.empty() || (set.directions[i] - set.directions[block.begin]).norm() > 1e-6)
          return false;
      return true;
    }

    /// The mean over the points of (r_k.N)(r_l.N), N the normal of the obstacle where the point would touch it. A surface that slides along
    /// itself under a mode does not resist it, though facets of a curved body do: their normals, and those at rims, are not exact. Where
    /// the body is flat, or the obstacle has no normal (a gap as a function, triangles), the direction of the constraint counts: column i
    /// of
    /// @p contact.
    template <int dim>
    MatrixXd felt_by_obstacles(const Problem<dim>                    &problem,
                               const ConstraintSet<dim>              &set,
                               const std::vector<RigidBodyMode<dim>> &modes,
                               const MatrixXd                        &contact)
    {
      MatrixXd felt = MatrixXd::Zero(modes.size(), modes.size());
      VectorXd at_point(modes.size());
      for (std::size_t b = 0; b < set.blocks.size(); ++b)
      {
        const bool exact = flat(set, set.blocks[b]);
        for (std::size_t i = set.blocks[b].begin; i < set.blocks[b].end; ++i)
        {
          at_point = contact.col(i);
          if (const auto &surface = problem.conditions[b].surface; surface && !exact)
          {
            const Point<dim>      touch = set.points[i].x + set.points[i].bound * set.directions[i];
            std::array<double, 3> p{};
            for (unsigned d = 0; d < dim; ++d)
              p[d] = touch[d];
            if (const auto normal = surface->normal(p))
              for (std::size_t k = 0; k < modes.size(); ++k)
              {
                const Tensor<1, dim> r = modes[k].value(touch);
                at_point(k) = 0;
                for (unsigned d = 0; d < dim; ++d)
                  at_point(k) += r[d] * (*normal)[d];
              }
          }
          felt += at_point * at_point.transpose();
        }
      }
      return felt / std::max<double>(1, set.size());
    }

    /// r_k' K r_l of the springs, f(r_k), and the sum of the sizes of what adds up to it.
    struct Work
    {
      MatrixXd springs;
      VectorXd load, load_size;
    };

    template <int dim>
    Work work_of(const Problem<dim> &problem, const MatrixXd &modes)
    {
      const unsigned k = modes.cols();
      Work           work{MatrixXd::Zero(k, k), VectorXd::Zero(k), VectorXd::Zero(k)};
      MatrixXd       local;
      for_each_local_system<dim>(problem,
                                 [&](const LocalSystem &system)
                                 {
                                   const unsigned n = system.dofs.size();
                                   local.resize(n, k);
                                   for (unsigned i = 0; i < n; ++i)
                                     local.row(i) = modes.row(system.dofs[i]);
                                   for (unsigned i = 0; i < n; ++i)
                                     for (unsigned a = 0; a < k; ++a)
                                     {
                                       work.load(a) += system.load(i) * local(i, a);
                                       work.load_size(a) += std::abs(system.load(i) * local(i, a));
                                       if (system.springs)
                                         for (unsigned j = 0; j < n; ++j)
                                           for (unsigned b = 0; b < k; ++b)
                                             work.springs(a, b) += local(i, a) * system.matrix(i, j) * local(j, b);
                                     }
                                 });
      return work;
    }

    /// An orthonormal basis of the vectors that the symmetric matrix takes to (nearly) nothing.
    MatrixXd null_space(const MatrixXd &matrix, const double threshold)
    {
      const Eigen::SelfAdjointEigenSolver<MatrixXd> eigen(matrix);
      Eigen::Index                                  n = 0;
      while (n < matrix.rows() && eigen.eigenvalues()(n) < threshold)
        ++n;
      return eigen.eigenvectors().leftCols(n);
    }

    /// "translation along x" or "rotation about z with translation along -y".
    template <int dim>
    std::string describe(const VectorXd &coefficients, const std::vector<RigidBodyMode<dim>> &modes)
    {
      std::vector<std::pair<double, std::string>> parts;
      for (Eigen::Index k = 0; k < coefficients.size(); ++k)
        if (std::abs(coefficients(k)) > 0.05 * coefficients.cwiseAbs().maxCoeff())
        {
          std::string name = modes[k].name;
          if (coefficients(k) < 0 && name.rfind("translation", 0) == 0)
            name.insert(name.size() - 1, "-");
          parts.emplace_back(-std::abs(coefficients(k)), name);
        }
      std::sort(parts.begin(), parts.end());
      std::vector<std::string> names;
      for (const auto &part : parts)
        names.push_back(part.second);
      return fmt::format("{}", fmt::join(names, " with "));
    }
  } // namespace

  template <int dim>
  Vector interpolate(const Problem<dim> &problem, const RigidBodyMode<dim> &mode)
  {
    Vector values(problem.space.dof_handler.n_dofs());
    for (const auto &node : problem.space.nodal_values())
      values(node.dof) = mode.value(node.x)[node.component];
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
        values(dof) = mode.value(ahead)[0] - mode.value(nodes[dof].location)[0];
      }
    }
    return values;
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
        Eigen::RowVectorXd violation = at.row(line.index);
        for (const auto &[dof, factor] : line.entries)
          violation -= factor * at.row(dof);
        held += violation.transpose() * violation;
      }
      return held;
    }

    constexpr double not_held = 1e-9, not_felt = 1e-7;
  } // namespace

  template <int dim>
  MatrixXd free_modes(const Problem<dim> &problem)
  {
    const auto modes = rigid_body_modes(problem);
    if (modes.empty() || problem.form->holds_rigid_body_modes())
      return MatrixXd(modes.size(), 0);
    const MatrixXd at = at_nodes(problem, modes);
    const Work     work = work_of(problem, at);
    MatrixXd       held = violation_of_supports(problem, at);
    if (work.springs.cwiseAbs().maxCoeff() > 0)
      held += work.springs / work.springs.cwiseAbs().maxCoeff();
    return null_space(held, not_held);
  }

  template <int dim>
  MatrixXd unsupported_modes(const Problem<dim> &problem)
  {
    const auto modes = rigid_body_modes(problem);
    if (modes.empty())
      return MatrixXd(0, 0);
    return null_space(violation_of_supports(problem, at_nodes(problem, modes)), not_held);
  }

  template <int dim>
  std::vector<RigidBodyMode<dim>> combined_modes(const Problem<dim> &problem, const MatrixXd &coefficients)
  {
    const auto                      modes = rigid_body_modes(problem);
    std::vector<RigidBodyMode<dim>> result;
    for (Eigen::Index j = 0; j < coefficients.cols(); ++j)
    {
      const VectorXd column = coefficients.col(j);
      result.push_back({describe(column, modes), [modes, column](const Point<dim> &x)
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
  FreeModeReport judge_free_modes(const Problem<dim> &problem, const ConstraintSet<dim> &set, const MatrixXd &free)
  {
    const auto     modes = rigid_body_modes(problem);
    const MatrixXd at = at_nodes(problem, modes);
    const Work     work = work_of(problem, at);
    VectorXd       load = free.transpose() * work.load;
    const double   load_size = work.load_size.maxCoeff();

    // Column i: what a unit pressure at point i does on the modes.
    MatrixXd contact = MatrixXd::Zero(at.cols(), set.size());
    for (std::size_t i = 0; i < set.size(); ++i)
      for (std::size_t k = 0; k < set.trace[i].dofs.size(); ++k)
        contact.col(i) += set.points[i].sign * set.trace[i].values[k] * at.row(set.trace[i].dofs[k]).transpose();
    const MatrixXd contact_of_modes = contact;
    contact = free.transpose() * contact;

    FreeModeReport report;
    const bool     body = problem.form->n_components() > 1;
    const auto     in_modes = [&](const VectorXd &of_free) -> VectorXd { return free * of_free; };
    // Facets of a curved surface resist a little where the surface itself does not: what the obstacles' own surfaces feel decides.
    const MatrixXd    felt = free.transpose() * felt_by_obstacles(problem, set, modes, contact_of_modes) * free;
    MatrixXd          unfelt = null_space(felt, not_felt);
    VectorXd          driven = unfelt.transpose() * load;
    const std::string held_by = body ? "[boundary] and contact leave the body free" : "the solution is free to move as a whole";
    if (driven.size() > 0 && driven.cwiseAbs().maxCoeff() > 1e-6 * load_size)
    {
      // The mode among them that the load drives is for the constraints as they are to stop, facets and all.
      const VectorXd direction = (unfelt * driven).normalized();
      if ((contact.transpose() * direction).squaredNorm() <= not_felt * set.size())
      {
        report.error =
          fmt::format("{}: nothing stops a {}, and the load drives it; fix a part, a component of it or a plane of symmetry, or "
                      "add a spring",
                      held_by, describe(in_modes(direction), modes));
        return report;
      }
      unfelt = unfelt * null_space(driven * driven.transpose(), 0.5 * driven.squaredNorm());
      driven = unfelt.transpose() * load;
    }
    report.indifferent = free * unfelt;
    load -= unfelt * driven;

    const MatrixXd pressed = null_space(unfelt * unfelt.transpose(), 0.5); // the modes that contact feels
    if (pressed.cols() == 0)
      return report;
    const MatrixXd cone = pressed.transpose() * contact;
    const VectorXd force = pressed.transpose() * load;
    const auto     outside = [&](const VectorXd &f) -> VectorXd { return f - cone * nonnegative_least_squares(cone, f); };
    if (load_size == 0 || force.cwiseAbs().maxCoeff() <= 1e-10 * load_size)
    {
      // Contact all round needs no load: a ring on a shaft.
      bool encloses = true;
      for (Eigen::Index j = 0; j < force.size(); ++j)
        for (const double sign : {-1., 1.})
          encloses &= outside(sign * VectorXd::Unit(force.size(), j)).norm() <= 1e-8;
      if (encloses)
        return report;
      report.error = held_by + (body ? ", and the load has no resultant that presses it against the obstacle; fix a part, add a spring "
                                       "or a load"
                                     : ": no boundary value, spring or reaction holds it, and the load has no resultant that presses it "
                                       "against an obstacle; give a [boundary] value, a spring, a reaction or a load");
      return report;
    }
    if (const VectorXd escape = outside(force); escape.norm() > 1e-8 * force.norm())
    {
      const VectorXd mode = in_modes(pressed * escape);
      if (body)
        report.error = fmt::format("{}, and the load does not press it against the obstacle: nothing stops a {}; fix a part, add a spring "
                                   "or a plane of symmetry, or check the direction of the load",
                                   held_by, describe(mode, modes));
      else
        report.error = fmt::format("{}: no boundary value, spring or reaction holds it, and the total load {:.6g} moves it {}, where there "
                                   "is no obstacle",
                                   held_by, work.load(0), mode(0) > 0 ? "upward" : "downward");
      return report;
    }
    for (Eigen::Index j = 0; j < force.size(); ++j)
      for (const double sign : {-1., 1.})
      {
        VectorXd changed = force;
        changed(j) += sign * 1e-3 * force.norm();
        if (outside(changed).norm() > 1e-8 * force.norm())
          report.warning = fmt::format("the load presses the {} against the obstacle only just: a small change of it starts a {}",
                                       body ? "body" : "solution", describe(in_modes(pressed * outside(changed)), modes));
      }
    return report;
  }

  template <int dim>
  std::vector<Pin<dim>> pins_against(const Problem<dim> &problem, const MatrixXd &indifferent)
  {
    const auto modes = rigid_body_modes(problem);
    // Every component at every vertex of the boundary.
    std::vector<Pin<dim>> candidates;
    std::set<unsigned>    seen;
    for (const auto &cell : problem.space.dof_handler.active_cell_iterators())
      for (const auto face : cell->face_indices())
      {
        if (!cell->at_boundary(face))
          continue;
        for (const auto v : cell->face(face)->vertex_indices())
          if (const auto corners = cell->face(face);
              !problem.space.hanging_nodes.is_constrained(corners->vertex_dof_index(v, 0)) && seen.insert(corners->vertex_index(v)).second)
            for (unsigned c = 0; c < problem.form->n_components(); ++c)
              candidates.push_back({corners->vertex(v), c});
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
      Eigen::Index row, column;
      rows.cwiseAbs().maxCoeff(&row, &column);
      pins.push_back(candidates[row]);
      const VectorXd           pivot_column = rows.col(column) / rows(row, column);
      const Eigen::RowVectorXd pivot_row = rows.row(row);
      rows -= pivot_column * pivot_row;
    }
    return pins;
  }

  template <int dim>
  std::vector<Vector> modes_at_unknowns(const Problem<dim> &problem, const std::vector<RigidBodyMode<dim>> &modes)
  {
    std::vector<Vector> result;
    for (const auto &mode : modes)
    {
      result.push_back(interpolate(problem, mode));
      problem.space.dirichlet.set_zero(result.back());
    }
    return result;
  }

#define INSTANTIATE(dim)                                                                                                                   \
  template std::vector<RigidBodyMode<dim>> rigid_body_modes(const Problem<dim> &);                                                         \
  template Vector                          interpolate(const Problem<dim> &, const RigidBodyMode<dim> &);                                  \
  template std::vector<Vector>             modes_at_unknowns(const Problem<dim> &, const std::vector<RigidBodyMode<dim>> &);               \
  template MatrixXd                        free_modes(const Problem<dim> &);                                                               \
  template MatrixXd                        unsupported_modes(const Problem<dim> &);                                                        \
  template std::vector<RigidBodyMode<dim>> combined_modes(const Problem<dim> &, const MatrixXd &);                                         \
  template FreeModeReport                  judge_free_modes(const Problem<dim> &, const ConstraintSet<dim> &, const MatrixXd &);           \
  template std::vector<Pin<dim>>           pins_against(const Problem<dim> &, const MatrixXd &);
  INSTANTIATE(1)
  INSTANTIATE(2)
  INSTANTIATE(3)
#undef INSTANTIATE
} // namespace unilateral
