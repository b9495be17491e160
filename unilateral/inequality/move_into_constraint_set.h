// From a function of V_h to one of K_h close to it.
#pragma once

#include "unilateral/inequality/discrete_problem.h"

#include <vector>

namespace unilateral
{
  /// Moves a function of V_h into K_h by changes as small as they can be, in the norm of diag(B'WB). Keeps a reference to the problem.
  class MoveIntoConstraintSet
  {
  public:
    explicit MoveIntoConstraintSet(const DiscreteProblem &problem);

    /// Onto the obstacle at the points of @p contact: conjugate gradients for min |Bv - s| there. At a rule of nodes one step is exact;
    /// where points contradict each other (rules with a kernel) a remainder stays.
    void onto(const std::vector<bool> &contact, Vector &v);

    /// Out of the obstacle everywhere: steepest descent on the excess over s - slack, the slack shrinking with the excess. False where it
    /// does not get there.
    bool out_of_obstacle(Vector &v);

    /// By how much v may be beyond the obstacle all the same.
    double round_off_met() const { return round_off; }

  private:
    void   evaluate_excess(const Vector &v);
    double weighted(const Vector &a, const Vector &b) const;
    double descent_step();

    const DiscreteProblem &problem;
    Vector                 excess, image, sizes, gradient, step, direction;
    double                 round_off = 0;
  };
} // namespace unilateral
