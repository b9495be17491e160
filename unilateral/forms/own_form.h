// A form of a program's own, in place of those of this folder.
#pragma once

#include "unilateral/forms/bilinear_form.h"
#include "unilateral/forms/model.h"
#include "unilateral/spaces/boundary_condition.h"

#include <functional>
#include <memory>
#include <vector>

namespace unilateral
{
  /// Makes the form of coefficients by material_id and boundary conditions by boundary_id; it may ignore both. The values that conditions
  /// prescribe are dealt with elsewhere, fluxes, tractions and springs are the form's.
  template <int dim>
  using FormMaker =
    std::function<std::unique_ptr<BilinearForm<dim>>(const std::vector<Coefficients> &, const std::vector<PartCondition> &)>;

  /// The one for the dimension of the mesh is called; without any the kind of the model chooses the form.
  struct OwnForm
  {
    FormMaker<1> in_1d;
    FormMaker<2> in_2d;
    FormMaker<3> in_3d;

    explicit operator bool() const { return in_1d || in_2d || in_3d; }

    template <int dim>
    const FormMaker<dim> &in() const
    {
      if constexpr (dim == 1)
        return in_1d;
      else if constexpr (dim == 2)
        return in_2d;
      else
        return in_3d;
    }
  };
} // namespace unilateral
