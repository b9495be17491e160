// A case about the mesh of a file, its parts and regions named: `unilateral init KIND --mesh FILE`.
#pragma once

#include <string>

namespace unilateral
{
  /// The text of a case of the kind. @p path_in_case: how the case calls the file. Throws InputError where the mesh cannot be read or does
  /// not go with the kind.
  std::string case_with_mesh(const std::string &kind, const std::string &mesh_file, const std::string &path_in_case);
} // namespace unilateral
