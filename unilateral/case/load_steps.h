// The problems of a load history as cases of their own.
#pragma once

#include "unilateral/case/case.h"

#include <cstddef>

namespace unilateral
{
  /// Everything but the steps and what is expected at their end.
  Case without_steps(const Case &request);

  /// Step @p k, from 0, as a case without steps.
  Case case_of_step(const Case &request, std::size_t k);
} // namespace unilateral
