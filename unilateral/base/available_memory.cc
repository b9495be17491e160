#include "unilateral/base/available_memory.h"

#include <fstream>
#include <limits>
#include <string>

namespace unilateral
{
  std::optional<double> available_memory()
  {
    std::ifstream file("/proc/meminfo");
    for (std::string word; file >> word;)
    {
      if (double kilobytes = 0; word == "MemAvailable:" && file >> kilobytes)
        return 1024 * kilobytes;
      file.ignore(std::numeric_limits<std::streamsize>::max(), '\n');
    }
    return {};
  }
} // namespace unilateral
