// Sorting by a small whole number, in linear time.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

namespace unilateral
{
  /// The numbers 0, ..., n - 1 by a key each; those of key k are numbers[begin[k]], ..., numbers[begin[k + 1] - 1], in their order.
  struct Buckets
  {
    std::vector<std::uint32_t> begin, numbers;

    /// @p key_of(i) < @p n_keys for i < @p n. It is called twice.
    template <typename KeyOf>
    Buckets(const std::size_t n_keys, const std::size_t n, const KeyOf &key_of) : begin(n_keys + 1, 0), numbers(n)
    {
      for (std::size_t i = 0; i < n; ++i)
        ++begin[key_of(i)];
      for (std::size_t k = 0, sum = 0; k <= n_keys; ++k)
        begin[k] = sum += begin[k];
      for (std::size_t i = n; i-- > 0;)
        numbers[--begin[key_of(i)]] = std::uint32_t(i);
    }
  };
} // namespace unilateral
