#include "cli/file_readers.h"

#include <fmt/format.h>

#include <string>
#include <system_error>

#include <dlfcn.h>

namespace unilateral
{
  namespace fs = std::filesystem;

  FileReaderIsAbsent::FileReaderIsAbsent(const std::string &module)
    : message(fmt::format(
        "the program is incomplete, {} is not beside it in '{}'; build or install it anew", module, folders_of_program().front().string()))
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
    for (const fs::path &folder : folders_of_program())
      if (void *const library = dlopen((folder / module).c_str(), RTLD_LAZY | RTLD_LOCAL))
        if (void *const address = dlsym(library, symbol))
          return address;
    throw FileReaderIsAbsent(module);
  }

  RasterPixels read_raster_file(const std::string &file, const bool placed_by_file)
  {
    static auto *const read = reinterpret_cast<UnilateralReadRasterFile *>(function_of_module(gdal_module, gdal_symbol));
    RasterPixels       result;
    read(file, placed_by_file, result);
    return result;
  }
} // namespace unilateral
