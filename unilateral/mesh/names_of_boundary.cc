#include "unilateral/mesh/names_of_boundary.h"

#include <fmt/format.h>

#include <algorithm>

namespace unilateral
{
  std::vector<unsigned> names_of_boundary(const std::vector<std::string>   &names,
                                          const std::vector<std::uint64_t> &n_faces,
                                          std::vector<std::string>         &part_names,
                                          std::vector<std::string>         &warnings)
  {
    std::vector<unsigned> numbers;
    for (std::size_t p = 0; p <= names.size(); ++p)
    {
      const bool        unnamed = p == names.size();
      const std::string name = unnamed ? "boundary" : names[p];
      const auto        same = std::find(part_names.begin(), part_names.end(), name);
      numbers.push_back(same - part_names.begin());
      if (n_faces[p] > 0 && same == part_names.end())
        part_names.push_back(name);
      else if (n_faces[p] == 0 && !unnamed)
        warnings.push_back(fmt::format("part '{}' of the mesh has no face on the boundary and is left out", name));
    }
    return numbers;
  }
} // namespace unilateral
