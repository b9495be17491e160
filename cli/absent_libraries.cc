#include "cli/absent_libraries.h"

#include "unilateral/functions/raster_file.h"
#include "unilateral/mesh/gmsh_file.h"

namespace unilateral
{
  MeshOutline gmsh_outline(const MeshDescription &)
  {
    throw LibraryIsAbsent();
  }

  RasterPixels read_raster_file(const std::string &, bool)
  {
    throw LibraryIsAbsent();
  }
} // namespace unilateral
