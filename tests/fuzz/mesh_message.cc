// What the process that reads a mesh file sends, which may be anything when the file has taken it over. What is accepted is written again
// byte by byte, and its cells make a mesh or are refused.
#include "fuzzed_bytes.h"

#include "unilateral/mesh/mesh_message.h"

#include <stdexcept>

namespace
{
  using namespace unilateral;

  template <int dim>
  void mesh_or_refused(const CellList &list)
  {
    try
    {
      mesh_of_cells<dim>(list, {"fuzz.toml", 1, 1});
    }
    catch (const InputError &)
    {
    }
  }
} // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t *bytes, const std::size_t size)
{
  const std::string message = fuzzed::text(bytes, size);
  try
  {
    fuzzed::require(to_bytes(outline_of_bytes(message)) == message);
  }
  catch (const std::runtime_error &)
  {
  }
  try
  {
    const auto [outline, cells] = outline_and_cells_of_bytes(message);
    fuzzed::require(to_bytes(outline, cells) == message);
  }
  catch (const std::runtime_error &)
  {
  }
  CellList list;
  try
  {
    list = cells_of_bytes(message);
  }
  catch (const std::runtime_error &)
  {
    return 0;
  }
  fuzzed::require(to_bytes(list) == message);
  mesh_or_refused<1>(list);
  mesh_or_refused<2>(list);
  mesh_or_refused<3>(list);
  return 0;
}
