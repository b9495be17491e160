// Callables and arrays of Python where a case has a function of position.
#pragma once

#include "unilateral/functions/given_function.h"
#include "unilateral/functions/nodal_function.h"

#include <pybind11/numpy.h>
#include <pybind11/pybind11.h>

#include <memory>

namespace unilateral
{
  /// @p value stands for a function of position: a callable, {"array": .., "extent": ..} or {"values": ..}.
  bool is_given_value(const pybind11::handle &value);

  /// That function.
  ///   f(points): called with an array (n, dim), returns n numbers or one for all. Values are remembered, so that it is called for many
  ///     points at once; it must depend on the points alone. What it raises ends the solution and is raised there.
  ///   {"array": a, "extent": [[x0, y0], [x1, y1]]}: samples of a regular grid as those of a raster, the first row at the top (y1), also
  ///     scale, offset, nodata; in 1-D a list of samples and [[x0], [x1]].
  ///   {"values": v}: at the points of @p mesh, or of the dict's own "points" and "cells".
  /// Throws ValueError or TypeError.
  std::shared_ptr<const GivenFunction> given_value(const pybind11::handle &value, const std::shared_ptr<const NodalMesh> &mesh);
} // namespace unilateral
