// Reads back the VTU files that the program writes.
#pragma once

#include "unilateral/output/vtu_file.h"

#include <string>

namespace unilateral
{
  /// The grid in a file of write_vtu(), or the grids of all pieces that a file of to_pvtu() names, one after the other. Arrays that not all
  /// pieces have are left out. Other VTU files, compressed ones for example, are not understood.
  /// Throws InputError with the file's name and what is wrong with it; nothing in the file is trusted.
  VtuGrid read_vtu(const std::string &path);
} // namespace unilateral
