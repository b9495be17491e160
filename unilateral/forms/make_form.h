// The form that a problem has.
#pragma once

#include "unilateral/forms/own_form.h"

#include <memory>
#include <string>
#include <vector>

namespace unilateral
{
  /// That of @p own, or the one that @p model names. @p coefficients, @p region_names: by material_id, @p conditions: by boundary_id. What
  /// does not fit together is added to @p diagnostics. Throws InputError where @p own has no form for this dimension or one whose
  /// components or order are not those of the model's kind, and for beams and plates in another dimension than theirs.
  template <int dim>
  std::unique_ptr<BilinearForm<dim>> make_form(const Model                      &model,
                                               const OwnForm                    &own,
                                               const std::vector<Coefficients>  &coefficients,
                                               const std::vector<std::string>   &region_names,
                                               const std::vector<PartCondition> &conditions,
                                               Diagnostics                      &diagnostics);
} // namespace unilateral
