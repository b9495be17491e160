#include "unilateral/spaces/element.h"

#include <stdexcept>

namespace unilateral
{
  std::string ElementName::name() const
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

  std::optional<ElementName> parse_element(const std::string &name)
  {
    if (name == "discontinuous")
      return ElementName{ElementName::Family::discontinuous, 1};
    if (name == "hermite")
      return ElementName{ElementName::Family::hermite, 3};
    for (const unsigned degree : {2, 3, 4})
      for (const bool triangles : {false, true})
        if (const ElementName element{ElementName::Family::c0ip, degree, triangles}; element.name() == name && !(degree == 4 && triangles))
          return element;
    // On segments P4..P8 are Q4..Q8; whether the mesh consists of segments is not known here.
    if (name.size() == 2 && (name[0] == 'Q' || name[0] == 'P') && name[1] >= '1' && name[1] <= '8')
      return ElementName{name[0] == 'Q' ? ElementName::Family::Q : ElementName::Family::P, static_cast<unsigned>(name[1] - '0')};
    return {};
  }
} // namespace unilateral
