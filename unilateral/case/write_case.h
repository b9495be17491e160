// Case -> TOML.
#pragma once

#include "unilateral/case/case.h"

#include <string>

namespace unilateral
{
  /// The case as TOML with every default written out and paths absolute; reading it again gives the same Case.
  std::string expand(const Case &request);
} // namespace unilateral
