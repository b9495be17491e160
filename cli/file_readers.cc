#include "cli/file_readers.h"

#include <string>
#include <system_error>

#include <dlfcn.h>

namespace unilateral
{
  namespace fs = std::filesystem;

  std::vector<fs::path> folders_of_program()
  {
    std::error_code failure;
    const fs::path  here = fs::read_symlink("/proc/self/exe", failure).parent_path();
    return {here, (here / "../libexec/unilateral").lexically_normal()};
  }

  namespace
  {
    /// The function @p symbol of @p module, which stays loaded.
    template <typename Function>
    Function *function_of(const char *const module, const char *const symbol)
    {
      for (const fs::path &folder : folders_of_program())
        if (void *const library = dlopen((folder / module).c_str(), RTLD_LAZY | RTLD_LOCAL))
          if (void *const address = dlsym(library, symbol))
            return reinterpret_cast<Function *>(address);
      throw FileReaderIsAbsent();
    }
  } // namespace

  MeshOutline gmsh_outline(const MeshDescription &spec)
  {
    static auto *const outline = function_of<UnilateralGmshOutline>(gmsh_module, gmsh_symbol);
    MeshOutline        result;
    outline(file_access(), spec, result);
    return result;
  }

  RasterPixels read_raster_file(const std::string &file, const bool placed_by_file)
  {
    static auto *const read = function_of<UnilateralReadRasterFile>(gdal_module, gdal_symbol);
    RasterPixels       result;
    read(file, placed_by_file, result);
    return result;
  }
} // namespace unilateral
