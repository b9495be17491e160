#include "unilateral/mesh/gmsh_elements.h"

#include "unilateral/mesh/drawn_cells.h"

#include <algorithm>
#include <cmath>
#include <map>

#include <gmsh.h>

namespace unilateral
{
  namespace
  {
    /// Of @p type at places in the reference cell with three coordinates each: n_nodes numbers for each place.
    std::vector<double> shape_functions(const int type, const std::vector<double> &places)
    {
      std::vector<double> values;
      int                 n_components = 0, n_orientations = 0;
      gmsh::model::mesh::getBasisFunctions(type, places, "Lagrange", n_components, values, n_orientations);
      return values;
    }
  } // namespace

  ElementType::ElementType(const int type) : type(type)
  {
    gmsh::model::mesh::getElementProperties(type, name, dim, order, n_nodes, coordinates, n_corners);
  }

  std::optional<CellKind> ElementType::kind() const
  {
    for (const auto &[start, kind] : std::map<std::string, CellKind>{{"Line", CellKind::segment},
                                                                     {"Triangle", CellKind::triangle},
                                                                     {"Quadrilateral", CellKind::quadrilateral},
                                                                     {"Tetrahedron", CellKind::tetrahedron},
                                                                     {"Hexahedron", CellKind::hexahedron}})
      if (name.rfind(start, 0) == 0)
        return kind;
    return {};
  }

  MiddlePoints::MiddlePoints(const ElementType &type)
  {
    const bool hypercube = type.hypercube();
    const auto coordinate = [&](const unsigned node, const int d) { return type.coordinates[node * type.dim + d]; };
    // Lines, and of hypercubes all that some coordinates fix: a choice of corners is one when it has as many as coordinates leave free.
    for (unsigned a = 0; a < unsigned(type.n_corners); ++a)
      for (unsigned b = a + 1; b < unsigned(type.n_corners); ++b)
      {
        std::vector<unsigned> chosen;
        for (unsigned v = 0; v < unsigned(type.n_corners); ++v)
        {
          bool between = hypercube || v == a || v == b;
          for (int d = 0; hypercube && d < type.dim; ++d)
            between = between && (coordinate(a, d) != coordinate(b, d) || coordinate(v, d) == coordinate(a, d));
          if (between)
            chosen.push_back(v);
        }
        if (std::find(corners.begin(), corners.end(), chosen) == corners.end())
          corners.push_back(chosen);
      }
    std::vector<double> places;
    for (const auto &chosen : corners)
      for (int d = 0; d < 3; ++d)
      {
        double x = 0;
        for (const unsigned v : chosen)
          x += d < type.dim ? coordinate(v, d) / double(chosen.size()) : 0;
        places.push_back(x);
      }
    weights = shape_functions(type.type, places);
  }

  EquidistantNodes::EquidistantNodes(const ElementType &type)
  {
    const auto points = equidistant_points(!type.hypercube(), type.dim, type.order);
    for (const auto &i : points)
      for (unsigned node = 0; node < unsigned(type.n_nodes); ++node)
      {
        bool same = true;
        for (int d = 0; d < type.dim; ++d)
        {
          const double x = type.coordinates[node * type.dim + d];
          same = same && std::abs((type.hypercube() ? (x + 1) / 2 : x) * type.order - i[d]) < 1e-6;
        }
        if (same)
          nodes.push_back(node);
      }
    if (nodes.size() != points.size())
      nodes.clear();
    std::vector<double> places;
    for (int node = 0; node < type.n_nodes; ++node)
      for (int d = 0; d < 3; ++d)
        places.push_back(d < type.dim ? type.coordinates[node * type.dim + d] : 0);
    // Gmsh's numbers of the elements that have corners alone, in the order of CellKind: line, triangle, quadrangle, tetrahedron,
    // hexahedron.
    weights = shape_functions(1 + static_cast<int>(type.kind().value()), places);
  }
} // namespace unilateral
