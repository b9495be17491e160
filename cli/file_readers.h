// Gmsh and GDAL in modules of their own, which are loaded where a case has a file for them: GDAL for both programs, Gmsh for the small one.
#pragma once

#include "unilateral/base/file_access.h"
#include "unilateral/functions/raster_file.h"
#include "unilateral/mesh/gmsh_file.h"

#include <exception>
#include <filesystem>
#include <string>
#include <vector>

namespace unilateral
{
  /// Thrown in the place of a call: the module is not there, or cannot be loaded.
  class FileReaderIsAbsent : public std::exception
  {
  public:
    /// @p reason: what the system says of it.
    FileReaderIsAbsent(const std::string &module, const std::string &reason);
    const char *what() const noexcept override { return message.c_str(); }

  private:
    std::string message;
  };

  /// Where this program looks for what belongs to it: its own folder, and where an installation puts it.
  std::vector<std::filesystem::path> folders_of_program();

  /// The function @p symbol of @p module, which stays loaded. Throws FileReaderIsAbsent.
  void *function_of_module(const char *module, const char *symbol);

  // What a module offers, by the name that it has in its table of symbols.
  constexpr const char *gmsh_module = "unilateral-gmsh.so", *gmsh_symbol = "unilateral_gmsh_outline";
  constexpr const char *gdal_module = "unilateral-gdal.so", *gdal_symbol = "unilateral_read_raster_file";
} // namespace unilateral

extern "C"
{
  // A module has file_access() of its own, which is to be that of the program.
  using UnilateralGmshOutline = void(const unilateral::FileAccess &, const unilateral::MeshDescription &, unilateral::MeshOutline &);
  using UnilateralReadRasterFile = void(const std::string &, bool, unilateral::RasterPixels &);
}
