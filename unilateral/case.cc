#include "unilateral/case.h"

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
    case Family::hermite:
      return "hermite";
    case Family::c0ip:
      return "c0ip" + std::to_string(degree);
    }
    throw std::logic_error("element family without a name");
  }

  std::optional<ElementSpec> parse_element(const std::string &name)
  {
    if (name == "hermite")
      return ElementSpec{ElementSpec::Family::hermite, 3};
    if (name == "c0ip2")
      return ElementSpec{ElementSpec::Family::c0ip, 2};
    if (name == "c0ip3")
      return ElementSpec{ElementSpec::Family::c0ip, 3};
    // On segments P4..P8 are Q4..Q8; whether the mesh consists of segments is not known here.
    if (name.size() == 2 && (name[0] == 'Q' || name[0] == 'P') && name[1] >= '1' && name[1] <= '8')
      return ElementSpec{name[0] == 'Q' ? ElementSpec::Family::Q : ElementSpec::Family::P, static_cast<unsigned>(name[1] - '0')};
    return {};
  }
} // namespace unilateral
