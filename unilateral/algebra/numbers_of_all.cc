#include "unilateral/algebra/numbers_of_all.h"

#include <algorithm>

namespace unilateral
{
  NumbersOfAll::NumbersOfAll(const SharedUnknowns &shared, const std::size_t n_dofs)
    : shared(shared), number(shared.numbers_by_owner(n_dofs)), first_of_rank{0}
  {
    for (std::uint32_t dof = 0; dof < n_dofs; ++dof)
      if (shared.owns(dof))
        owned.push_back(dof);
    for (const std::uint64_t n_of_rank : shared.processes().gather(std::vector<std::uint64_t>{owned.size()}))
      first_of_rank.push_back(first_of_rank.back() + n_of_rank);
  }

  unsigned NumbersOfAll::owner(const std::uint64_t number) const
  {
    return std::upper_bound(first_of_rank.begin() + 1, first_of_rank.end(), number) - first_of_rank.begin() - 1;
  }
} // namespace unilateral
