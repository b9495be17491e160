// The nodes of a mesh file on many processes.
#pragma once

#include "unilateral/base/processes.h"
#include "unilateral/mesh/msh_pieces.h"

#include <array>
#include <cstdint>
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
} // namespace unilateral
