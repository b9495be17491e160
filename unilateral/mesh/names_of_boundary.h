// Names of the parts of a boundary, as a file has them -> numbers of parts.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

namespace unilateral
{
  /// Parts get their numbers in the order of @p names, those without a face on the boundary get none, which @p warnings say; equal names
  /// are one part. @p n_faces of each, and of the faces without a name, which become the part "boundary". Appends to @p part_names, and
  /// returns the number of each.
  std::vector<unsigned> names_of_boundary(const std::vector<std::string>   &names,
                                          const std::vector<std::uint64_t> &n_faces,
                                          std::vector<std::string>         &part_names,
                                          std::vector<std::string>         &warnings);
} // namespace unilateral
