// Lists of records between processes.
#pragma once

#include "unilateral/base/processes.h"

#include <cstring>
#include <type_traits>
#include <utility>
#include <vector>

namespace unilateral
{
  /// Sends each process its records, and returns those from each. Collective.
  template <typename T>
  std::vector<std::vector<T>> exchange_records(const std::vector<std::vector<T>> &to_each, const Processes &processes)
  {
    static_assert(std::is_trivially_copyable_v<T>);
    std::vector<std::vector<char>> bytes;
    for (const auto &records : to_each)
    {
      const char *const begin = reinterpret_cast<const char *>(records.data());
      bytes.emplace_back(begin, begin + records.size() * sizeof(T));
    }
    std::vector<std::vector<T>> from_each;
    for (const auto &received : processes.exchange(std::move(bytes)))
    {
      auto &records = from_each.emplace_back(received.size() / sizeof(T));
      if (!records.empty())
        std::memcpy(static_cast<void *>(records.data()), received.data(), records.size() * sizeof(T));
    }
    return from_each;
  }
} // namespace unilateral
