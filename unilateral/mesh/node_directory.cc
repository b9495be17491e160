#include "unilateral/mesh/node_directory.h"

#include "unilateral/base/exchange_records.h"

#include <algorithm>

namespace unilateral
{
  NodeDirectory::NodeDirectory(MshNodes read, const Processes &processes) : processes(processes)
  {
    std::vector<std::vector<Node>> to_each(processes.size());
    for (std::size_t k = 0; k < read.tags.size(); ++k)
      to_each[read.tags[k] % processes.size()].push_back({read.tags[k], read.x[k]});
    read = {};
    for (const auto &received : exchange_records(to_each, processes))
      nodes.insert(nodes.end(), received.begin(), received.end());
    std::sort(nodes.begin(), nodes.end(), [](const Node &a, const Node &b) { return a.tag < b.tag; });
  }

  bool NodeDirectory::has_repeated_numbers() const
  {
    return std::adjacent_find(nodes.begin(), nodes.end(), [](const Node &a, const Node &b) { return a.tag == b.tag; }) != nodes.end();
  }

  std::vector<std::array<double, 3>> NodeDirectory::places_of(const std::vector<std::uint64_t> &tags, bool &missing) const
  {
    std::vector<std::vector<std::uint64_t>> wanted(processes.size());
    for (const std::uint64_t tag : tags)
      wanted[tag % processes.size()].push_back(tag);
    std::vector<std::vector<Node>> answers(processes.size());
    const auto                     asked = exchange_records(wanted, processes);
    for (unsigned rank = 0; rank < processes.size(); ++rank)
      for (const std::uint64_t tag : asked[rank])
      {
        const auto node = std::lower_bound(nodes.begin(), nodes.end(), tag, [](const Node &a, const std::uint64_t t) { return a.tag < t; });
        if (node != nodes.end() && node->tag == tag)
          answers[rank].push_back(*node);
      }
    const auto                         found = exchange_records(answers, processes);
    std::vector<std::array<double, 3>> places;
    std::vector<std::size_t>           next(processes.size(), 0);
    missing = false;
    for (const std::uint64_t tag : tags)
    {
      const unsigned home = tag % processes.size();
      auto          &k = next[home];
      missing = missing || k == found[home].size() || found[home][k].tag != tag;
      places.push_back(missing ? std::array<double, 3>() : found[home][k++].x);
    }
    return places;
  }
} // namespace unilateral
