// Cases to start from: `unilateral init`.
#pragma once

#include <string>
#include <vector>

namespace unilateral
{
  /// A case that comes with the program.
  struct CaseTemplate
  {
    std::string name, description, text;
  };

  /// All of them, compiled into the program from cli/init/ and examples/.
  const std::vector<CaseTemplate> &case_templates();

  /// See case_with_mesh.h.
  using CaseWithMesh = std::string (*)(const std::string &kind, const std::string &mesh_file, const std::string &path_in_case);

  /// Writes the case @p name to @p file, "" for NAME.toml, about the mesh in @p mesh_file if that is not empty, and returns what to say. An
  /// empty name gives the list of all. Throws InputError when there is no such case or the file exists.
  std::string init(const std::string &name, const std::string &file, const std::string &mesh_file, CaseWithMesh case_with_mesh);
} // namespace unilateral
