// A matrix by what it does.
#pragma once

#include "unilateral/algebra/vector.h"

#include <functional>

namespace unilateral
{
  /// y = T x.
  using LinearMap = std::function<void(Vector &y, const Vector &x)>;
} // namespace unilateral
