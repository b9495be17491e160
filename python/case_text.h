// Cases from dicts of Python: what a case file can say becomes its text, functions and meshes are handed over beside it.
#pragma once

#include "unilateral/case/case.h"
#include "unilateral/functions/nodal_function.h"

#include <pybind11/pybind11.h>

#include <filesystem>
#include <memory>
#include <string>

namespace unilateral
{
  struct PythonCase : Case
  {
    std::shared_ptr<const NodalMesh> nodes; ///< of a mesh by arrays: where {"values": ..} are given
  };

  /// The case with the keys of a case file; see given_values.h and mesh_arrays.h for what stands in place of functions and meshes.
  /// Throws InputError with all mistakes; TypeError and ValueError for what is no case at all.
  PythonCase case_of_dict(const pybind11::dict &content, const std::string &name);

  /// The case in a file, with some keys set.
  PythonCase case_of_file(const std::filesystem::path &path, const pybind11::dict &settings);

  /// The same case with some keys set.
  PythonCase case_with_settings(const PythonCase &request, const pybind11::dict &settings);

  /// Warnings of the library as those of Python; throws where they are errors there.
  void warn(const Diagnostics &diagnostics);
} // namespace unilateral
