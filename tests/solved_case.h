// What a run makes of the text of a case.
#pragma once

#include "small_problem.h"

#include "unilateral/solve.h"

#include <string>
#include <vector>

namespace unilateral
{
  template <int dim>
  RunResult result_of(const std::string &text, const std::vector<Override> &overrides = {})
  {
    Diagnostics diagnostics;
    Progress    quiet;
    return solve<dim>(problem_of(case_of(text, overrides)), diagnostics, quiet).result;
  }
} // namespace unilateral
