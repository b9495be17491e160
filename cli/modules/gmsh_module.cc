// unilateral-gmsh.so: see cli/file_readers.h.
#include "unilateral/mesh/gmsh_file.h"

extern "C" void unilateral_gmsh_outline(const unilateral::MeshDescription &spec, unilateral::MeshOutline &outline)
{
  outline = unilateral::gmsh_outline(spec);
}
