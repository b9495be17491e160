// The physical groups of a .msh file.
#pragma once

#include "unilateral/base/number_of_name.h"
#include "unilateral/mesh/msh_scanner.h"

#include <cstdint>
#include <map>
#include <set>
#include <string>
#include <utility>
#include <vector>

namespace unilateral::msh
{
  /// Which groups there are, what they are called, and the entities (points, lines, surfaces and volumes) in them.
  class Groups
  {
  public:
    /// The lines of the section $PhysicalNames.
    void read_names(Scanner &scanner)
    {
      const std::string head(scanner.line());
      for (auto n = Numbers(head).next<std::uint64_t>(); n > 0; --n)
      {
        const std::string line(scanner.line());
        Numbers           numbers(line);
        const auto        dimension = numbers.next<unsigned>();
        const int         group = numbers.next<int>();
        const std::size_t first = line.find('"'), last = line.rfind('"');
        require(first != std::string::npos && last > first);
        name_of_number[{dimension, group}] = line.substr(first + 1, last - first - 1);
      }
    }

    void add(const unsigned dim, const int entity, const int group)
    {
      require(group > 0); // Gmsh turns entities of negative ones around
      with_entities.insert({dim, group});
      group_of.try_emplace({dim, entity}, group);
    }

    /// Of the entity's first group; empty: it is in none.
    std::string name_of(const unsigned dim, const int entity) const
    {
      const auto group = group_of.find({dim, entity});
      return group == group_of.end() ? "" : name_of_group(dim, group->second);
    }

    /// Those of all groups of a dimension that have entities, by their numbers.
    std::vector<std::string> names(const unsigned dim) const
    {
      std::vector<std::string> result;
      for (const auto &[d, group] : with_entities)
        if (d == dim)
          number_of_name(name_of_group(dim, group), result);
      return result;
    }

  private:
    std::string name_of_group(const unsigned dim, const int group) const
    {
      const auto name = name_of_number.find({dim, group});
      return name == name_of_number.end() || name->second.empty() ? std::to_string(group) : name->second;
    }

    using DimAndTag = std::pair<unsigned, int>;
    std::map<DimAndTag, std::string> name_of_number;
    std::map<DimAndTag, int>         group_of; ///< of an entity the first one
    std::set<DimAndTag>              with_entities;
  };
} // namespace unilateral::msh
