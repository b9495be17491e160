#include "unilateral/discretisation/free_mode_report.h"

#include "unilateral/algebra/nonnegative_least_squares.h"
#include "unilateral/algebra/null_space.h"
#include "unilateral/discretisation/motion_names.h"
#include "unilateral/discretisation/problem.h"
#include "unilateral/discretisation/rigid_body_modes.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <vector>

namespace unilateral
{
  using namespace dealii;
  using Eigen::MatrixXd;
  using Eigen::VectorXd;

  namespace
  {
    /// The resultant of a load on an uneven mesh of a symmetric body is this part of the load's size off its plane of symmetry. A mode that
    /// so little drives, and no obstacle feels, is stopped by a side condition, which says what it bears.
    constexpr double largest_unevenness = 1e-3;

    /// What drives a body away with more than this part of the load is no rounding of resultants.
    constexpr double rounding_of_forces = 1e-10;

    /// The points of a block, those of all processes, have one direction: their surface is flat, and its normal is exact.
    template <int dim>
    bool flat(const ConstraintSet<dim> &set, const ConstraintBlock &block, const Processes &processes)
    {
      std::vector<double> first;
      for (unsigned d = 0; d < dim && !set.directions.empty() && block.begin < block.end; ++d)
        first.push_back(set.directions[block.begin][d]);
      first = processes.gather(first);
      bool curved = false;
      for (std::size_t i = block.begin; i < block.end && !curved; ++i)
      {
        double distance = set.directions.empty() ? 1. : 0.;
        for (unsigned d = 0; d < dim && !set.directions.empty(); ++d)
          distance = std::hypot(distance, set.directions[i][d] - first[d]);
        curved = distance > 1e-6;
      }
      return !processes.any(curved);
    }

    /// The directions in which contact acts.
    enum class Directions
    {
      exact_on_flat,          ///< where the body is flat
      exact_on_flat_and_round ///< and where it is known to be round
    };

    /// The mean over the points of (r_k.N)(r_l.N), N the normal of the obstacle where the point would touch it. A surface that slides along
    /// itself under a mode does not resist it, though facets of a curved body do: their normals, and those at rims, are not exact. Where
    /// they are, or the obstacle has no normal (a gap as a function, triangles), the direction of the constraint counts: column i of @p
    /// contact.
    template <int dim>
    MatrixXd felt_by_obstacles(const Problem<dim>                    &problem,
                               const ConstraintSet<dim>              &set,
                               const std::vector<RigidBodyMode<dim>> &modes,
                               const MatrixXd                        &contact,
                               const Directions                       directions)
    {
      const Processes &processes = problem.space.processes();
      MatrixXd         felt = MatrixXd::Zero(modes.size(), modes.size());
      VectorXd         at_point(modes.size());
      std::uint64_t    n_points = 0;
      for (std::size_t b = 0; b < set.blocks.size(); ++b)
      {
        const bool exact =
          flat(set, set.blocks[b], processes) || (directions == Directions::exact_on_flat_and_round && problem.conditions[b].round);
        for (std::size_t i = set.blocks[b].begin; i < set.blocks[b].end; ++i)
        {
          if (!set.owns(i))
            continue;
          ++n_points;
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
      processes.sum(felt.data(), felt.size());
      return felt / std::max<double>(1, processes.sum(n_points));
    }

    /// The columns at the points of all processes.
    template <int dim>
    MatrixXd at_all_points(const MatrixXd &columns, const ConstraintSet<dim> &set, const Processes &processes)
    {
      std::vector<double> own;
      for (std::size_t i = 0; i < set.size(); ++i)
        if (set.owns(i))
          own.insert(own.end(), columns.col(i).begin(), columns.col(i).end());
      const std::vector<double> all = processes.gather(own);
      return Eigen::Map<const MatrixXd>(all.data(), columns.rows(), Eigen::Index(all.size()) / columns.rows());
    }

    /// The forces that contact can take up: non-negative combinations of columns.
    struct ContactCone
    {
      MatrixXd columns;

      /// What is left of a force.
      VectorXd outside(const VectorXd &force) const { return force - columns * nonnegative_least_squares(columns, force); }

      /// Every force, whichever way it goes.
      bool is_everything() const
      {
        bool everything = true;
        for (Eigen::Index j = 0; j < columns.rows(); ++j)
          for (const double sign : {-1., 1.})
            everything &= outside(sign * VectorXd::Unit(columns.rows(), j)).norm() <= 1e-8;
        return everything;
      }
    };

    /// judge_free_modes() with the forces on the free modes.
    template <int dim>
    class FreeModeJudge
    {
    public:
      FreeModeJudge(const Problem<dim> &problem, const ConstraintSet<dim> &set, const MatrixXd &free)
        : free(free), modes(rigid_body_modes(problem)), body(problem.form->n_components() > 1),
          held_by(body ? "[boundary] and contact leave the body free" : "the solution is free to move as a whole")
      {
        const MatrixXd    at = mode_matrix(problem, modes);
        const WorkOnModes work = work_on_modes(problem, at);
        total_load = work.load(0);
        load = free.transpose() * work.load;
        load_size = work.load_size.maxCoeff();
        const MatrixXd contact_of_modes = contact_on_modes(set, at);
        contact = at_all_points<dim>(free.transpose() * contact_of_modes, set, problem.space.processes());
        felt = free.transpose() * felt_by_obstacles(problem, set, modes, contact_of_modes, Directions::exact_on_flat_and_round) * free;
        const MatrixXd all_felt =
          free.transpose() * felt_by_obstacles(problem, set, modes, contact_of_modes, Directions::exact_on_flat) * free;
        const MatrixXd translations = free_translations();
        along_obstacles = translations * null_space(translations.transpose() * all_felt * translations, not_felt);
      }

      FreeModeReport judge()
      {
        FreeModeReport report;
        const VectorXd along = along_obstacles.transpose() * load;
        if (along.size() > 0 && along.norm() > largest_unevenness * load_size)
        {
          report.error = nothing_stops((along_obstacles * along).normalized(), along.norm() / load_size);
          return report;
        }
        MatrixXd unfelt = not_felt_by_both();
        VectorXd driven = unfelt.transpose() * load;
        if (driven.size() > 0 && driven.cwiseAbs().maxCoeff() > (body ? largest_unevenness : 1e-6) * load_size)
        {
          // The mode among them that the load drives is for the constraints as they are to stop, facets and all.
          const VectorXd direction = (unfelt * driven).normalized();
          if ((contact.transpose() * direction).squaredNorm() <= not_felt * contact.cols())
          {
            report.error = nothing_stops(direction, driven.norm() / load_size);
            return report;
          }
          unfelt = unfelt * null_space(driven * driven.transpose(), 0.5 * driven.squaredNorm());
          driven = unfelt.transpose() * load;
        }
        report.indifferent = free * unfelt;
        load -= unfelt * driven;
        judge_modes_that_contact_feels(null_space(unfelt * unfelt.transpose(), 0.5), report);
        return report;
      }

    private:
      /// Of a body, the translations among the free modes: those without a share of a rotation.
      MatrixXd free_translations() const
      {
        MatrixXd turns = MatrixXd::Zero(modes.size(), free.cols());
        for (std::size_t k = 0; k < modes.size() && body; ++k)
          for (unsigned d = 0; d < dim; ++d)
            if ((modes[k].value(Point<dim>::unit_vector(d)) - modes[k].value(Point<dim>())).norm() > 0)
              turns.row(k) = free.row(k);
        return body ? null_space(turns.transpose() * turns, 1e-12) : MatrixXd(free.cols(), 0);
      }

      /// The modes that the obstacles, or the points of contact as they are, do not feel: a ball whose points all move along lines through
      /// its centre turns freely, whatever it lies on. With them the translations along the obstacles, as along a trough, which normals of
      /// a ball feel that does not touch there.
      MatrixXd not_felt_by_both() const
      {
        const MatrixXd by_obstacles = null_space(felt, not_felt);
        const MatrixXd by_points = null_space(contact * contact.transpose() / std::max<double>(1, contact.cols()), not_felt);
        const MatrixXd both =
          by_obstacles * by_obstacles.transpose() + by_points * by_points.transpose() + along_obstacles * along_obstacles.transpose();
        const MatrixXd others = null_space(both, 1e-6); // the two may be nearly the same
        return null_space(others * others.transpose(), 0.5);
      }

      /// @p pressed: their coefficients in the free modes.
      void judge_modes_that_contact_feels(const MatrixXd &pressed, FreeModeReport &report) const
      {
        if (pressed.cols() == 0)
          return;
        const ContactCone cone{pressed.transpose() * contact};
        const VectorXd    force = pressed.transpose() * load;
        if (load_size == 0 || force.cwiseAbs().maxCoeff() <= 1e-10 * load_size)
        {
          // Contact all round needs no load: a ring on a shaft.
          if (!cone.is_everything())
            report.error = no_resultant();
        }
        else if (const VectorXd escape = cone.outside(force); escape.norm() > rounding_of_forces * force.norm())
          report.error = load_drives_away(pressed * escape);
        else
          for (Eigen::Index j = 0; j < force.size(); ++j)
            for (const double sign : {-1., 1.})
            {
              VectorXd changed = force;
              changed(j) += sign * 1e-3 * force.norm();
              if (cone.outside(changed).norm() > 1e-8 * force.norm())
                report.warning = presses_only_just(pressed * cone.outside(changed));
            }
      }

      std::string name_of(const VectorXd &direction) const { return motion_name<dim>(free * direction, modes); }

      /// @p drive: of the load, in the unit of its own size.
      std::string nothing_stops(const VectorXd &direction, const double drive) const
      {
        return fmt::format("{}: nothing stops a {}, and the load drives it{}; fix a part, a component of it or a plane of symmetry, or "
                           "add a spring",
                           held_by, name_of(direction),
                           drive < 0.05 ? fmt::format(" with {:.1e} of its size, which an uneven mesh may cause", drive) : "");
      }

      std::string no_resultant() const
      {
        return held_by + (body ? ", and the load has no resultant that presses it against the obstacle; fix a part, add a spring "
                                 "or a load"
                               : ": no boundary value, spring or reaction holds it, and the load has no resultant that presses it "
                                 "against an obstacle; give a [boundary] value, a spring, a reaction or a load");
      }

      std::string load_drives_away(const VectorXd &direction) const
      {
        if (body)
          return fmt::format("{}, and the load does not press it against the obstacle: nothing stops a {}; fix a part, add a spring "
                             "or a plane of symmetry, or check the direction of the load",
                             held_by, name_of(direction));
        const VectorXd mode = free * direction;
        const char    *held_by_nothing = "no boundary value, spring or reaction holds it";
        // The first mode is u = 1. One that goes against the load, or next to nowhere, tips.
        if (mode(0) * total_load > 0 && std::abs(mode(0)) > 0.5 * mode.norm())
          return fmt::format("{}: {}, and the total load {:.6g} moves it {}, where there is no obstacle", held_by, held_by_nothing,
                             total_load, mode(0) > 0 ? "upward" : "downward");
        return fmt::format("{}: {}, and the load {:.6g} does not press it against the obstacle but tips it off: its resultant lies "
                           "outside all contact",
                           held_by, held_by_nothing, total_load);
      }

      std::string presses_only_just(const VectorXd &direction) const
      {
        return fmt::format("the load presses the {} against the obstacle only just: a small change of it starts a {}",
                           body ? "body" : "solution", name_of(direction));
      }

      const MatrixXd                       &free; ///< coefficients of the free modes in all of them, column by column
      const std::vector<RigidBodyMode<dim>> modes;
      const bool                            body; ///< not a membrane
      const std::string                     held_by;

      // On the free modes, but for the first.
      double   total_load, load_size;
      VectorXd load;
      MatrixXd contact; ///< column i: of a unit pressure at point i
      /// By the obstacles' own surfaces: facets of a curved one resist a little where the surface itself does not.
      MatrixXd felt;
      MatrixXd along_obstacles; ///< translations that no obstacle feels, be the body round or not
    };
  } // namespace

  template <int dim>
  FreeModeReport judge_free_modes(const Problem<dim> &problem, const ConstraintSet<dim> &set, const MatrixXd &free)
  {
    return FreeModeJudge<dim>(problem, set, free).judge();
  }

  template FreeModeReport judge_free_modes(const Problem<1> &, const ConstraintSet<1> &, const MatrixXd &);
  template FreeModeReport judge_free_modes(const Problem<2> &, const ConstraintSet<2> &, const MatrixXd &);
  template FreeModeReport judge_free_modes(const Problem<3> &, const ConstraintSet<3> &, const MatrixXd &);
} // namespace unilateral
