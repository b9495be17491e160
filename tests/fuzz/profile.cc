// Tables of two columns: what is read has a value everywhere between its ends, between those of its rows.
#include "fuzzed_bytes.h"

#include "unilateral/functions/profile.h"

#include <cmath>
#include <stdexcept>

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t *bytes, const std::size_t size)
{
  try
  {
    const unilateral::Profile profile(fuzzed::file(bytes, size));
    fuzzed::require(profile.spacing() > 0);
    for (const double x : {-1e308, -1., 0., 1e-3, 0.5, 1., 7., 1e308})
      try
      {
        fuzzed::require(std::isfinite(profile.sample(x)));
      }
      catch (const std::domain_error &)
      {
      }
  }
  catch (const std::runtime_error &)
  {
  }
  return 0;
}
