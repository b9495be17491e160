// Functions that come from solutions, and the memory of functions that goes from step to step.
#pragma once

#include "unilateral/case/case.h"
#include "unilateral/functions/cell_functions.h"

#include <map>
#include <memory>
#include <set>
#include <string>
#include <vector>

namespace unilateral
{
  /// What the functions of a step need of the steps before.
  struct StepFields
  {
    bool                                 has_steps = false; ///< the solution of a step before has a meaning
    std::shared_ptr<const CellFunctions> previous;          ///< that solution; none before the first step

    /// Functions by what they are made of. One that has not changed is the same in the next step, and files are read once: see
    /// FieldFunction::same_as().
    std::map<std::string, FieldFunction>                        compiled;
    std::map<std::string, std::shared_ptr<const CellFunctions>> runs; ///< by the folder of the results
  };

  /// The parameters on which @p spec depends, directly or through other parameters.
  std::set<std::string> parameters_behind(const FieldSpec &spec, const std::vector<Parameter> &parameters);

  /// A text that two fields share only if they are the same function, given what @p parameters are; for those of the step before it is of
  /// no use, see depends_on_previous().
  std::string identity_of(const FieldSpec &spec, const std::vector<Parameter> &parameters);
  bool        depends_on_previous(const FieldSpec &spec, const std::vector<Parameter> &parameters);

  /// A field of Kind::run or Kind::previous on a mesh of @p dim dimensions. Throws InputError: no results in the folder, a file that is
  /// damaged, a quantity that the solution does not have, another dimension, a solution of a step before where there are no steps.
  FieldFunction solution_field(const FieldSpec &spec, unsigned dim, StepFields &fields);
} // namespace unilateral
