// Cases from dicts of Python: what a case file can say becomes its text, functions and meshes are handed over beside it.
#pragma once

#include "unilateral/case/case.h"
#include "unilateral/functions/nodal_function.h"

#include <pybind11/pybind11.h>

#include <filesystem>
#include <memory>
#include <string>
#include <vector>

namespace unilateral
{
  struct PythonCase : Case
  {
    std::shared_ptr<const NodalMesh> nodes;            ///< of a mesh by arrays: where {"values": ..} are given
    std::string                      text;             ///< that messages point into, where that is not the file at `path`
    std::string                      file_in_messages; ///< as messages call it
  };

  /// The case with the keys of a case file; see given_values.h and mesh_arrays.h for what stands in place of functions and meshes.
  /// Throws InputError with all mistakes; TypeError and ValueError for what is no case at all.
  PythonCase case_of_dict(const pybind11::dict &content, const std::string &name);

  /// The case in a file, with some keys set.
  PythonCase case_of_file(const std::filesystem::path &path, const pybind11::dict &settings);

  /// The same case with some keys set.
  PythonCase case_with_settings(const PythonCase &request, const pybind11::dict &settings);

  /// Messages that point into @p text, whose name is @p file, with the keys of a dict for their places: case['model']['load'].
  std::vector<Diagnostic> with_keys(std::vector<Diagnostic> diagnostics, const std::string &text, const std::string &file);

  /// Warnings of the library as those of Python; throws where they are errors there.
  void warn(const Diagnostics &diagnostics, const PythonCase &request);
} // namespace unilateral
