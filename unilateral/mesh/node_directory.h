// The nodes of a mesh file on many processes.
#pragma once

#include "unilateral/base/processes.h"
#include "unilateral/mesh/msh_pieces.h"

#include <array>
#include <cstdint>
#include <cstring>
#include <utility>
#include <vector>

namespace unilateral
{
  /// Each node is on one process, which its number (tag) in the file says. Operations are collective.
  class NodeDirectory
  {
  public:
    /// @p read: those that this process has read.
    NodeDirectory(MshNodes read, const Processes &processes);

    /// Two nodes of this process have the same number.
    bool has_repeated_numbers() const;

    /// Where the nodes @p tags are. @p missing: one of them is not there.
    std::vector<std::array<double, 3>> places_of(const std::vector<std::uint64_t> &tags, bool &missing) const;

  private:
    struct Node
    {
      std::uint64_t         tag;
      std::array<double, 3> x;
    };

    Processes         processes;
    std::vector<Node> nodes; ///< by their numbers
  };

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
