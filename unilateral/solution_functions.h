// A solution as functions of position that outlive its mesh.
#pragma once

#include "unilateral/functions/cell_functions.h"
#include "unilateral/solution.h"

#include <memory>

namespace unilateral
{
  /// u, for a vector-valued u its components ux, uy, uz: exactly the functions of V_h, on curved cells as far as their sides are
  /// polynomials of the element's degree. Where several processes share the mesh each has its part; elsewhere there is no value.
  template <int dim>
  std::shared_ptr<const CellFunctions> functions_of(const Solution<dim> &solution);

  /// The parts that @p processes have, on all of them. Collective.
  std::shared_ptr<const CellFunctions> together(const CellFunctions &part, const Processes &processes);
} // namespace unilateral
