// Finite elements by name.
#pragma once

#include <optional>
#include <string>

namespace unilateral
{
  /// Q1..Q8, P1..P3, discontinuous, hermite, c0ip2..c0ip4 (c0ip2-triangles, c0ip3-triangles).
  struct ElementName
  {
    enum class Family
    {
      Q,             ///< tensor-product Lagrange on segments, quadrilaterals, hexahedra
      P,             ///< Lagrange on segments, triangles, tetrahedra
      discontinuous, ///< on each segment, quadrilateral, hexahedron the polynomials given by their values at the points of a tensor rule
      hermite,
      c0ip
    };
    Family   family = Family::Q;
    unsigned degree = 1;
    bool     triangles = false; ///< c0ip on triangles

    bool        simplex() const { return family == Family::P || triangles; }
    std::string name() const;
  };

  /// The element called @p name ("Q2", "P1", "hermite", "c0ip3"), or nothing.
  std::optional<ElementName> parse_element(const std::string &name);
} // namespace unilateral
