// Meshes by arrays of NumPy, or as objects of meshio.
#pragma once

#include "unilateral/functions/nodal_function.h"
#include "unilateral/mesh/cell_list.h"

#include <pybind11/pybind11.h>

#include <memory>
#include <string>
#include <utility>
#include <vector>

namespace unilateral
{
  struct ArrayMesh
  {
    std::shared_ptr<const CellList>  cells;
    std::shared_ptr<const NodalMesh> nodes; ///< all points, those of no cell included, with the numbers that they have in the arrays
    /// Parts that are an expression or a callable: name, function.
    std::vector<std::pair<std::string, pybind11::object>> parts_by_place;
  };

  /// The table [mesh] of a case has arrays, or is or holds an object of meshio.
  bool is_array_mesh(const pybind11::handle &mesh);

  /// {"points": (n, dim), "cells": (m, corners), "parts": {name: facets}, "regions": {name: cells}}: corners in VTK's order, which is
  /// meshio's; facets an array (k, corners) of point numbers, an expression, or a callable of points (n, dim) that says which belong;
  /// cells numbers, a mask (m,), or a callable of the centres. Or {"meshio": mesh} with the same parts and regions in addition.
  /// Points of which all have the same z lie in a plane. Throws ValueError or TypeError.
  ArrayMesh mesh_of_arrays(const pybind11::handle &mesh);
} // namespace unilateral
