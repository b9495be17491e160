// The text of a case: read or refused, and what is read can be written and read again.
#include "fuzzed_bytes.h"

#include "unilateral/case/read_case.h"
#include "unilateral/case/write_case.h"
#include "unilateral/mesh/gmsh_file.h"

namespace unilateral
{
  // Gmsh runs in a process of its own; what it sends has a fuzzer of its own, mesh_message.cc.
  MeshOutline gmsh_outline(const MeshDescription &spec)
  {
    throw InputError(spec.where, "no mesh files here");
  }
  CellList read_gmsh_file(const MeshDescription &spec, bool, unsigned)
  {
    throw InputError(spec.where, "no mesh files here");
  }
} // namespace unilateral

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t *bytes, const std::size_t size)
{
  using namespace unilateral;
  Diagnostics diagnostics;
  std::string expanded;
  try
  {
    expanded = expand(parse_case(fuzzed::text(bytes, size), "/cases/fuzz.toml", {}, diagnostics));
  }
  catch (const InputError &e)
  {
    fuzzed::require(!e.diagnostics.empty());
    return 0;
  }
  fuzzed::require(expand(parse_case(expanded, "/cases/fuzz.toml", {}, diagnostics)) == expanded);
  return 0;
}
