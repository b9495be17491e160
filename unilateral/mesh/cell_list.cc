#include "unilateral/mesh/cell_list.h"

#include <fmt/format.h>

#include <algorithm>

namespace unilateral
{
  std::string plural_name(const CellKind kind)
  {
    switch (kind)
    {
    case CellKind::segment:
      return "segments";
    case CellKind::triangle:
      return "triangles";
    case CellKind::quadrilateral:
      return "quadrilaterals";
    case CellKind::tetrahedron:
      return "tetrahedra";
    case CellKind::hexahedron:
      break;
    }
    return "hexahedra";
  }

  unsigned dimension(const CellKind kind)
  {
    switch (kind)
    {
    case CellKind::segment:
      return 1;
    case CellKind::triangle:
    case CellKind::quadrilateral:
      return 2;
    case CellKind::tetrahedron:
    case CellKind::hexahedron:
      break;
    }
    return 3;
  }

  bool is_simplex(const CellKind kind)
  {
    return kind == CellKind::triangle || kind == CellKind::tetrahedron;
  }

  MeshOutline outline_of(const CellList &list)
  {
    MeshOutline outline{dimension(list.kind), list.part_names, list.region_names};
    if (std::find(outline.part_names.begin(), outline.part_names.end(), "boundary") == outline.part_names.end())
      outline.part_names.emplace_back("boundary");
    return outline;
  }

  void check_kind_of_cells(const CellKind kind, const bool simplex, const SourceLocation &where)
  {
    if (kind != CellKind::segment && is_simplex(kind) != simplex)
      throw InputError(where,
                       is_simplex(kind) ? fmt::format("the mesh has {}; use element = \"P1\", \"P2\" or \"P3\"", plural_name(kind))
                                        : fmt::format("the mesh has {}; use element = \"Q1\", \"Q2\", ..., \"Q8\"", plural_name(kind)),
                       MessageName("mesh-does-not-fit"));
  }
} // namespace unilateral
