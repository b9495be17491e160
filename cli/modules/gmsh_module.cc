// unilateral-gmsh.so: see cli/file_readers.h.
#include "unilateral/base/file_access.h"
#include "unilateral/mesh/gmsh_file.h"

extern "C" void
unilateral_gmsh_outline(const unilateral::FileAccess &access, const unilateral::MeshDescription &spec, unilateral::MeshOutline &outline)
{
  unilateral::set_file_access(access);
  outline = unilateral::gmsh_outline(spec);
}
