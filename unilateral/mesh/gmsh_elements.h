// What the reader of meshes needs to know of Gmsh's element types. Gmsh has to be switched on, see start_gmsh().
#pragma once

#include "unilateral/mesh/cell_list.h"

#include <optional>
#include <string>
#include <vector>

namespace unilateral
{
  /// One of Gmsh's element types, "Triangle 6": how many of its nodes are corners.
  struct ElementType
  {
    std::string         name;
    int                 dim = 0, order = 0, n_nodes = 0, n_corners = 0, type;
    std::vector<double> coordinates; ///< of the nodes in the reference cell, dim numbers each

    explicit ElementType(int type);

    bool hypercube() const { return n_corners == 1 << dim; }
    /// What its cells are; nothing for kinds that there are no elements for.
    std::optional<CellKind> kind() const;
  };

  /// The points of a cell of order 2 that are no corners: which corners each lies in the middle of, and the weights of the element's
  /// nodes there, whatever its order and family.
  struct MiddlePoints
  {
    std::vector<std::vector<unsigned>> corners;
    std::vector<double>                weights; ///< n_nodes for each

    explicit MiddlePoints(const ElementType &type);
  };

  /// Which nodes of an element are the equidistant_points() of a cell, and where its corners alone would have them.
  struct EquidistantNodes
  {
    std::vector<unsigned> nodes;   ///< none for elements that have not all of them (serendipity)
    std::vector<double>   weights; ///< of the corners at each node of the element, n_corners for each

    explicit EquidistantNodes(const ElementType &type);
  };
} // namespace unilateral
