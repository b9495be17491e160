// Gmsh's formats, and who reads the parts of a file in each of them.
#pragma once

#include "unilateral/mesh/mesh_outline.h"
#include "unilateral/mesh/msh_index.h"
#include "unilateral/mesh/msh_scanner.h"

#include <cstdint>

namespace unilateral::msh
{
  /// The section $MeshFormat, with which a file begins.
  struct Format
  {
    double version = 0;
    bool   binary = false;
  };

  /// From what follows that section on. Each throws NotRead.
  MeshOutline outline_of_format_4(Scanner &scanner, const Format &format);
  MshIndex    index_of_format_4(Scanner &scanner, const Format &format, std::uint64_t most_in_piece);
  MeshOutline outline_of_format_2(Scanner &scanner, const Format &format);
  MshIndex    index_of_format_2(Scanner &scanner, const Format &format, std::uint64_t most_in_piece);
} // namespace unilateral::msh
