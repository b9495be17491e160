// For the small program alone: the other one has Gmsh's library in any case, since deal.II needs it.
#include "cli/file_readers.h"

namespace unilateral
{
  MeshOutline gmsh_outline(const MeshDescription &spec)
  {
    static auto *const outline = reinterpret_cast<UnilateralGmshOutline *>(function_of_module(gmsh_module, gmsh_symbol));
    MeshOutline        result;
    outline(file_access(), spec, result);
    return result;
  }
} // namespace unilateral
