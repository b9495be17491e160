#include "cli/file_readers.h"

#include <fmt/format.h>

#include <string>
#include <system_error>

#include <dlfcn.h>

namespace unilateral
{
  namespace fs = std::filesystem;

  FileReaderIsAbsent::FileReaderIsAbsent(const std::string &module, const std::string &reason)
    : message(fmt::format("the program is incomplete, {} cannot be loaded: {}; build or install it anew", module, reason))
  {
  }

  std::vector<fs::path> folders_of_program()
  {
    std::error_code failure;
    const fs::path  here = fs::read_symlink("/proc/self/exe", failure).parent_path();
    return {here, (here / "../libexec/unilateral").lexically_normal()};
  }

  void *function_of_module(const char *const module, const char *const symbol)
  {
    std::string     reason = fmt::format("it is not beside the program in '{}'", folders_of_program().front().string());
    std::error_code failure;
    for (const fs::path &folder : folders_of_program())
      if (fs::exists(folder / module, failure))
      {
        if (void *const library = dlopen((folder / module).c_str(), RTLD_LAZY | RTLD_LOCAL))
          if (void *const address = dlsym(library, symbol))
            return address;
        reason = dlerror();
      }
    throw FileReaderIsAbsent(module, reason);
  }

  RasterPixels read_raster_file(const std::string &file, const bool placed_by_file)
  {
    static auto *const read = reinterpret_cast<UnilateralReadRasterFile *>(function_of_module(gdal_module, gdal_symbol));
    RasterPixels       result;
    read(file, placed_by_file, result);
    return result;
  }
} // namespace unilateral
