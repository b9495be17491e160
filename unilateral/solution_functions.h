// A solution as functions of position that outlive its mesh.
#pragma once

#include "unilateral/functions/cell_functions.h"
#include "unilateral/solution.h"

#include <map>
#include <memory>
#include <string>

namespace unilateral
{
  /// Of a component of a function: "u", or "ux", "uy", "uz" where it has several.
  std::string component_name(const std::string &function, unsigned component, unsigned n_components);

  /// Functions of V_h, components by component_name(): exactly, on curved cells as far as their sides are polynomials of the element's
  /// degree. Where several processes share the mesh each has its part; elsewhere there is no value.
  template <int dim>
  std::shared_ptr<const CellFunctions> functions_on_cells(const FunctionSpace<dim>                    &space,
                                                          const std::map<std::string, const Vector *> &functions);

  /// u, for a vector-valued u its components ux, uy, uz.
  template <int dim>
  std::shared_ptr<const CellFunctions> functions_of(const Solution<dim> &solution);

  /// The parts that @p processes have, on all of them. Collective.
  std::shared_ptr<const CellFunctions> together(const CellFunctions &part, const Processes &processes);
} // namespace unilateral
