#include "unilateral/forms/make_form.h"

#include "unilateral/forms/beam.h"
#include "unilateral/forms/elasticity.h"
#include "unilateral/forms/membrane.h"
#include "unilateral/forms/plate.h"
#include "unilateral/forms/projection.h"

#include <fmt/format.h>

namespace unilateral
{
  namespace
  {
    template <int dim>
    std::unique_ptr<BilinearForm<dim>> make_own_form(const Model                      &model,
                                                     const FormMaker<dim>             &make,
                                                     const std::vector<Coefficients>  &coefficients,
                                                     const std::vector<PartCondition> &conditions)
    {
      if (!make)
        throw InputError(model.where, fmt::format("the mesh has dimension {0}, and own_form has no in_{0}d", dim), MessageName("own-form"));
      auto           form = make(coefficients, conditions);
      const unsigned n_components = model.kind == ModelChoices::Kind::elasticity ? dim : 1;
      if (!form)
        throw InputError(model.where, fmt::format("own_form.in_{}d returned no form", dim), MessageName("own-form"));
      if (form->n_components() != n_components)
        throw InputError(model.where,
                         fmt::format("a form of {} components, for a model whose u has {}: u has as many components as "
                                     "dimensions where the model's kind is elasticity, else one",
                                     form->n_components(), n_components),
                         MessageName("own-form"));
      const bool     bends = model.kind == ModelChoices::Kind::beam || model.kind == ModelChoices::Kind::plate;
      const unsigned order = bends ? 2 : model.kind == ModelChoices::Kind::projection ? 0 : 1;
      if (form->order() != order)
        throw InputError(model.where,
                         fmt::format("a form on H^{}, for a model on H^{}, whose elements it gets: order 2 is that of beams and "
                                     "plates, 0 that of projections, 1 that of the others",
                                     form->order(), order),
                         MessageName("own-form"));
      return form;
    }
  } // namespace

  template <int dim>
  std::unique_ptr<BilinearForm<dim>> make_form(const Model                      &model,
                                               const OwnForm                    &own,
                                               const std::vector<Coefficients>  &coefficients,
                                               const std::vector<std::string>   &region_names,
                                               const std::vector<PartCondition> &conditions,
                                               Diagnostics                      &diagnostics)
  {
    if (own)
      return make_own_form<dim>(model, own.in<dim>(), coefficients, conditions);
    switch (model.kind)
    {
    case ModelChoices::Kind::elasticity:
      return std::make_unique<Elasticity<dim>>(model, coefficients, region_names, conditions, diagnostics);
    case ModelChoices::Kind::beam:
      if constexpr (dim == 1)
        return std::make_unique<Beam>(coefficients, conditions);
      break;
    case ModelChoices::Kind::plate:
      if constexpr (dim == 2)
        return std::make_unique<Plate>(coefficients, conditions, model.element.family != ElementName::Family::hermite);
      break;
    case ModelChoices::Kind::projection:
      return std::make_unique<Projection<dim>>(coefficients);
    case ModelChoices::Kind::membrane:
      return std::make_unique<Membrane<dim>>(coefficients, conditions);
    }
    throw InputError(model.where, fmt::format("a beam needs a mesh of dimension 1, a plate one of dimension 2; this one has {}", dim),
                     MessageName("kind-does-not-fit"));
  }

#define INSTANTIATE(dim)                                                                                                                   \
  template std::unique_ptr<BilinearForm<dim>> make_form(const Model &, const OwnForm &, const std::vector<Coefficients> &,                 \
                                                        const std::vector<std::string> &, const std::vector<PartCondition> &,              \
                                                        Diagnostics &);
  INSTANTIATE(1)
  INSTANTIATE(2)
  INSTANTIATE(3)
#undef INSTANTIATE
} // namespace unilateral
