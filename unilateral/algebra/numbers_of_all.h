// One numbering of the unknowns of several processes, for libraries that solve systems of all of them.
#pragma once

#include "unilateral/base/shared_unknowns.h"

#include <cstddef>
#include <cstdint>
#include <vector>

namespace unilateral
{
  /// Every process has a range of numbers, for the unknowns that it owns, in their own order. Collective to make.
  struct NumbersOfAll
  {
    NumbersOfAll(const SharedUnknowns &shared, std::size_t n_dofs);

    std::uint64_t n() const { return first_of_rank.back(); }
    std::uint64_t first_own() const { return first_of_rank[shared.processes().rank()]; }
    unsigned      owner(std::uint64_t number) const; ///< by rank

    SharedUnknowns             shared;
    std::vector<std::uint64_t> number;        ///< of each unknown of this process
    std::vector<std::uint32_t> owned;         ///< unknowns, by number
    std::vector<std::uint64_t> first_of_rank; ///< and, last, how many there are
  };
} // namespace unilateral
