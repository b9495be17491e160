// What a run that did not converge is to be told about its rules.
#pragma once

#include "unilateral/constraints/constraint_set.h"
#include "unilateral/discretisation/problem.h"

#include <string>

namespace unilateral
{
  /// Of each rule that is not the element's default one: whether it has more points than there are unknowns that its points can press on,
  /// so that some pressures are undetermined, and which commands say more. Newton's method may find no rest with such a rule. Empty where
  /// all rules are the default ones.
  template <int dim>
  std::string remark_on_rules(const Problem<dim> &problem, const ConstraintSet<dim> &constraint_set);
} // namespace unilateral
