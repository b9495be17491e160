// Which way is up in pictures of bodies in space.
#pragma once

#include "unilateral/discretisation/problem_statement.h"

namespace unilateral
{
  /// 0, 1, 2: x, y, z. Up is opposite to a load that is constant and acts downwards along an axis, as weight does. Without one, in a box
  /// the side in contact lies below or above: the axis across `bottom` and `top`, or `front` and `back`, and y where neither is in contact,
  /// since `bottom` is where y is least. Meshes of other sources have z up.
  unsigned upward_axis(const ProblemStatement &statement);
} // namespace unilateral
