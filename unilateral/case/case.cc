#include "unilateral/case/case.h"

#include <algorithm>

#include <stdexcept>

namespace unilateral
{
  FieldSpec FieldSpec::constant(const double value)
  {
    FieldSpec spec;
    spec.kind = Kind::constant;
    spec.value = value;
    return spec;
  }

  FieldSpec FieldSpec::expression(std::string text)
  {
    FieldSpec spec;
    spec.kind = Kind::expression;
    spec.text = std::move(text);
    return spec;
  }

  std::string ElementSpec::name() const
  {
    switch (family)
    {
    case Family::Q:
      return "Q" + std::to_string(degree);
    case Family::P:
      return "P" + std::to_string(degree);
    case Family::discontinuous:
      return "discontinuous";
    case Family::hermite:
      return "hermite";
    case Family::c0ip:
      return "c0ip" + std::to_string(degree) + (triangles ? "-triangles" : "");
    }
    throw std::logic_error("element family without a name");
  }

  std::optional<ElementSpec> parse_element(const std::string &name)
  {
    if (name == "discontinuous")
      return ElementSpec{ElementSpec::Family::discontinuous, 1};
    if (name == "hermite")
      return ElementSpec{ElementSpec::Family::hermite, 3};
    for (const unsigned degree : {2, 3, 4})
      for (const bool triangles : {false, true})
        if (const ElementSpec element{ElementSpec::Family::c0ip, degree, triangles}; element.name() == name && !(degree == 4 && triangles))
          return element;
    // On segments P4..P8 are Q4..Q8; whether the mesh consists of segments is not known here.
    if (name.size() == 2 && (name[0] == 'Q' || name[0] == 'P') && name[1] >= '1' && name[1] <= '8')
      return ElementSpec{name[0] == 'Q' ? ElementSpec::Family::Q : ElementSpec::Family::P, static_cast<unsigned>(name[1] - '0')};
    return {};
  }

  unsigned MeshSpec::n_refinements() const
  {
    unsigned n = refine;
    for (const Local &refinement : local)
      n += refinement.times;
    return n;
  }

  const FieldSpec *MeshSpec::place_of_refinement(const unsigned level) const
  {
    unsigned end = refine;
    for (const Local &refinement : local)
      if (level >= end && level < (end += refinement.times))
        return &refinement.where;
    return nullptr;
  }

  bool Case::constrains_boundary() const
  {
    return std::any_of(constraints.begin(), constraints.end(), [](const ConstraintSpec &constraint) { return !constraint.on.empty(); });
  }
} // namespace unilateral
