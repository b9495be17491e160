#include "unilateral/base/division_steps.h"

#include <algorithm>

namespace unilateral
{
  namespace
  {
    /// @p count factors of @p n, the largest first, none larger than @p most; empty: there are none.
    std::vector<unsigned> factors(const unsigned n, const unsigned count, const unsigned most)
    {
      if (count == 1)
        return n <= most ? std::vector<unsigned>{n} : std::vector<unsigned>();
      for (unsigned first = 2; first <= std::min(n, most); ++first)
        if (n % first == 0)
          if (auto others = factors(n / first, count - 1, first); !others.empty())
          {
            others.insert(others.begin(), first);
            return others;
          }
      return {};
    }

    unsigned largest_prime_factor(unsigned n)
    {
      unsigned largest = 1;
      for (unsigned p = 2; p * p <= n; ++p)
        for (; n % p == 0; n /= p)
          largest = p;
      return std::max(largest, n);
    }
  } // namespace

  std::vector<unsigned> division_steps(const unsigned n_processes, const unsigned at_once)
  {
    const unsigned most = std::max(at_once, largest_prime_factor(n_processes));
    for (unsigned count = 1;; ++count)
      if (auto steps = factors(n_processes, count, most); !steps.empty())
        return steps;
  }

  DivisionStep next_division(
    const std::vector<unsigned> &steps, const unsigned n_processes, const unsigned n_alike, const double n_cells, const double enough)
  {
    unsigned n_parts = 1;
    for (const unsigned step : steps)
    {
      if (n_parts >= n_processes / n_alike && n_cells < enough * n_parts * step)
        break;
      n_parts *= step;
    }
    return {n_parts / (n_processes / n_alike), n_processes / n_parts};
  }
} // namespace unilateral
