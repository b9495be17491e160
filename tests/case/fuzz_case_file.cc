// For libFuzzer: clang++ -fsanitize=fuzzer,address with the sources of the library that it needs. Not part of the default build; the
// bounded twin that is, is test_fuzz_case_file.cc.

#include "unilateral/case/read_case.h"

#include <cstddef>
#include <cstdint>
#include <string>

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t *bytes, const std::size_t size)
{
  unilateral::Diagnostics diagnostics;
  try
  {
    unilateral::parse_case(std::string(reinterpret_cast<const char *>(bytes), size), "/cases/fuzz.toml", {}, diagnostics);
  }
  catch (const unilateral::InputError &)
  {
  }
  return 0;
}
