#include "unilateral/base/mpirun.h"

#include <cstdlib>

namespace unilateral
{
  bool started_by_mpirun()
  {
    const auto is_set = [](const char *const name) { return std::getenv(name) != nullptr; };
    return is_set("OMPI_COMM_WORLD_SIZE") || is_set("PMIX_RANK") || is_set("PMI_RANK");
  }
} // namespace unilateral
