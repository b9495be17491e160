#include "unilateral/scalar_product.h"

namespace unilateral
{
  double scalar_product(const Vector &a, const Vector &b)
  {
    // Several sums side by side: a single one would wait for each addition.
    constexpr std::size_t width = 16;
    double                sums[width] = {};
    const double *const a_of = a.begin(), *const b_of = b.begin();
    const std::size_t n = a.locally_owned_size(), n_whole = n / width * width;
    for (std::size_t i = 0; i < n_whole; i += width)
      for (std::size_t l = 0; l < width; ++l)
        sums[l] += a_of[i + l] * b_of[i + l];
    double sum = 0;
    for (std::size_t i = n_whole; i < n; ++i)
      sum += a_of[i] * b_of[i];
    for (const double part : sums)
      sum += part;
    return sum;
  }
} // namespace unilateral
