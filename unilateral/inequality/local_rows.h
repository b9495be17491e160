// Rows of A and B for some unknowns: what a local correction of u needs to know.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

namespace unilateral
{
  struct LocalRows
  {
    /// Rows one behind the other.
    struct Rows
    {
      std::vector<std::size_t>   start = {0};
      std::vector<std::uint32_t> columns;
      std::vector<double>        values;
    };

    std::vector<std::uint32_t> unknowns; ///< in ascending order
    Rows                       A;        ///< a row for each of them; of one on a cut what the own cells contribute
    std::vector<std::uint32_t> points;   ///< all points that see one of them
    Rows                       B;        ///< a row for each of those
  };
} // namespace unilateral
