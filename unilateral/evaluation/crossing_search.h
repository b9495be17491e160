// Obstacles that u crosses between the points where a rule compares them.
#pragma once

#include "unilateral/algebra/vector.h"
#include "unilateral/discretisation/problem.h"
#include "unilateral/functions/field_function.h"

#include <deal.II/base/point.h>
#include <deal.II/fe/fe_values.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <memory>
#include <vector>

namespace unilateral
{
  /// How far a bound s of u is beyond u, D = s - u (of an upper bound u - s), is searched for in cells. With c the middle of a part of a
  /// cell and S, G intervals that contain the slopes of s and u on it, D <= D(c) + sum_d max |S_d - G_d| |x_d - c_d|. A part where
  /// that is no more than what counts is left out, of the others the one where it is largest is halved next, 400 times at most, and in all
  /// cells together 100 000 times and once for every other cell. Where u
  /// lies on the obstacle the slopes are nearly the same, so that one look is enough.
  ///
  /// What counts: D more than @p tolerance, and more than 1.5 times the largest D at the points that are seen, or where the slopes of s are
  /// none that those points with D > 0 show, or u has (all points, in cells where u touches s at a node), but for half of their range: what
  /// judges u sees a part of s then, and not how it gets there. Slopes and second derivatives of u on a cell are those at the nodes of its
  /// element, and on either side a fifth of their range; exact for P1 and P2. On a part the slopes are those in its middle and what the
  /// second derivatives add.
  template <int dim>
  class CrossingSearch
  {
  public:
    enum class Verdict
    {
      nothing,
      found,
      seen,   ///< it is what the points see, and what judges u takes into account; but nowhere in the cell does u touch s at a node
      unknown ///< the search has ended before
    };

    /// Points in the reference cell where what judges u looks at s.
    struct PointsSeen
    {
      std::vector<dealii::Point<dim>> always;
      std::vector<dealii::Point<dim>> closer; ///< where s is beyond u at one of the others, or as near as twice what its interpolant misses
    };

    /// s has to have a range and slopes.
    CrossingSearch(
      const Problem<dim> &problem, const FieldFunction &s, Side side, const PointsSeen &seen, const Vector &u, double tolerance);

    Verdict look_into(const typename dealii::DoFHandler<dim>::active_cell_iterator &cell);

    /// From here on no smaller D counts.
    void ask_for_more_than(double D) { tolerance = std::max(tolerance, D); }

    /// What was found: about the largest D, where it is, the value of s there, and those at the points that are seen.
    double             excess = 0;
    dealii::Point<dim> where;
    double             value = 0;
    Interval           shown;

  private:
    using Cell = typename dealii::DoFHandler<dim>::active_cell_iterator;

    struct Part
    {
      double                          most;    ///< that D may be
      std::vector<dealii::Point<dim>> corners; ///< in the reference cell
      std::array<Interval, 3>         slopes;  ///< of s

      bool operator<(const Part &other) const { return most < other.most; }
    };

    /// The part with what D may be; takes D in its middle into account where it is above the threshold and all that was found.
    Part    judge(const Cell &cell, std::vector<dealii::Point<dim>> corners, double threshold);
    Verdict search(const Cell &cell, double threshold, unsigned most_steps);
    Verdict search_for_slopes(const Cell &cell);
    bool    touches_at_nodes(const Cell &cell) const;
    void    take_slopes_at(const std::vector<dealii::Point<dim>> &points, std::array<Interval, 3> &slopes) const;
    bool    are_seen(const std::array<Interval, 3> &slopes, const std::array<Interval, 3> &box) const;

    double                          beyond(const double s, const double u) const { return side == Side::lower ? s - u : u - s; }
    double                          seen_beyond(const Cell &cell, bool touches);
    dealii::Point<dim>              place(const Cell &cell, const dealii::Point<dim> &unit) const;
    std::array<Interval, 3>         box_of(const Cell &cell, const std::vector<dealii::Point<dim>> &corners) const;
    std::vector<dealii::Point<dim>> corners_of_cell() const;
    double                          u_at(const dealii::Point<dim> &unit) const;
    void                            take_u(const Cell &cell);
    std::array<Interval, 3>         slopes_on(const Cell &cell, const dealii::Point<dim> &unit, const std::array<double, dim> &reach) const;

    const Problem<dim>                               &problem;
    const FieldFunction                              &s;
    const Side                                        side;
    const Vector                                     &u;
    double                                            tolerance;
    std::size_t                                       steps_left; ///< of all cells
    const bool                                        simplex, curved;
    std::shared_ptr<const dealii::FiniteElement<dim>> polynomials; ///< of Lagrange, that u consists of on each cell
    dealii::FEValues<dim>                             at_nodes, at_seen;
    std::unique_ptr<dealii::FEValues<dim>>            at_closer;
    std::vector<double>                               u_at_nodes;
    std::vector<dealii::Tensor<1, dim>>               gradients;
    std::vector<dealii::Tensor<2, dim>>               hessians;
    std::vector<dealii::types::global_dof_index>      dofs;
    std::array<Interval, 3>                           slopes_of_u{}, slopes_seen{}; ///< the latter: see look_into()
    std::array<std::array<Interval, dim>, dim>        second_derivatives_of_u{};
  };
} // namespace unilateral
