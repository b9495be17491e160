// The unknowns on the cuts between subdomains: who has them too, and how their values are brought together.
#pragma once

#include "unilateral/base/processes.h"

#include <algorithm>
#include <cstring>
#include <type_traits>
#include <utility>
#include <vector>

namespace unilateral
{
  /// Vectors of V_h on the part of a process hold the unknowns on its cuts as every other process does that has them: with equal values,
  /// the sum of what the cells of each contribute. One of them, that with the lowest rank, owns such an unknown; scalar products count it
  /// there.
  class SharedUnknowns
  {
  public:
    /// An unknown and all processes that have it, by rank.
    struct Entry
    {
      std::uint32_t         dof;
      std::vector<unsigned> ranks;
    };

    SharedUnknowns() = default; ///< nothing is shared

    /// @p entries: in an order that all processes agree on.
    SharedUnknowns(const Processes &processes, std::size_t n_dofs, const std::vector<Entry> &entries);

    bool owns(const std::size_t dof) const { return use.empty() || use[dof] != elsewhere; }
    bool shares(const std::size_t dof) const { return !use.empty() && use[dof] != own; } ///< another process has it too

    const Processes &processes() const { return team; }

    /// Entries of shared unknowns become the sum over all processes that have them, with the same bits on each.
    void add(double *values) const;
    void add(float *values) const;
    /// What others have at shared unknowns is added to @p target.
    void add_of_others(const float *own, float *target) const;
    void take_from_owner(double *values) const;
    void minimize(double *values) const; ///< the least instead of the sum

    /// Those that are shared, in the order that all processes agree on.
    std::vector<Entry> entries() const;

    bool                              empty() const { return dofs.empty(); }
    const std::vector<std::uint32_t> &all() const { return dofs; } ///< those that are shared

    /// The same for vectors in which unknown i stands at @p position[i].
    SharedUnknowns renumbered(const std::vector<std::uint32_t> &position, std::size_t size) const;

    /// Of a subspace: its unknown i is @p unknowns[i] of this space, or not_shared where no other process can have it. A process with an
    /// unknown of this space has it in the subspace, too, or no process has.
    static constexpr std::uint32_t not_shared = -1;
    SharedUnknowns                 of_subspace(const std::vector<std::uint32_t> &unknowns) const;

    /// A product that counts every unknown once.
    double dot(const double *a, const double *b, std::size_t n) const;

    /// Records that belong to unknowns, those of other processes taken in; sorted by unknown, then by process, then as they were.
    template <typename Record>
    void share(std::vector<std::pair<unsigned, Record>> &records) const
    {
      static_assert(std::is_trivially_copyable_v<Record>);
      const auto by_dof = [](const auto &a, const auto &b) { return a.first < b.first; };
      std::stable_sort(records.begin(), records.end(), by_dof);
      std::vector<std::vector<char>> messages(neighbors.size());
      for (std::size_t n = 0; n < neighbors.size(); ++n)
        for (std::uint32_t k = 0; k < neighbors[n].dofs.size(); ++k)
        {
          const std::pair<unsigned, Record> wanted(neighbors[n].dofs[k], Record());
          const auto [begin, end] = std::equal_range(records.begin(), records.end(), wanted, by_dof);
          for (auto record = begin; record != end; ++record)
          {
            const char *const number = reinterpret_cast<const char *>(&k), *const bytes = reinterpret_cast<const char *>(&record->second);
            messages[n].insert(messages[n].end(), number, number + sizeof(k));
            messages[n].insert(messages[n].end(), bytes, bytes + sizeof(Record));
          }
        }
      const auto answers = exchange(messages);
      auto       own = std::exchange(records, {});
      bool       own_taken = false;
      const auto take_own = [&]
      {
        if (!std::exchange(own_taken, true))
          records.insert(records.end(), own.begin(), own.end());
      };
      for (std::size_t n = 0; n < neighbors.size(); ++n)
      {
        if (neighbors[n].rank > team.rank())
          take_own();
        for (std::size_t place = 0; place < answers[n].size(); place += sizeof(std::uint32_t) + sizeof(Record))
        {
          std::uint32_t k;
          Record        record;
          std::memcpy(&k, answers[n].data() + place, sizeof(k));
          std::memcpy(&record, answers[n].data() + place + sizeof(k), sizeof(record));
          records.emplace_back(neighbors[n].dofs[k], record);
        }
      }
      take_own();
      std::stable_sort(records.begin(), records.end(), by_dof);
    }

    std::size_t n_not_owned() const { return not_owned.size(); }

    /// For each of the @p n_dofs unknowns of this process its number among those of all: by owners, the lowest rank first, and in the order
    /// that they have there. Collective.
    std::vector<std::uint64_t> numbers_by_owner(std::size_t n_dofs) const;

    struct Neighbor
    {
      unsigned                   rank;
      std::vector<std::uint32_t> dofs;  ///< in an order that both know
      std::vector<std::uint32_t> place; ///< of each among all that are shared
    };
    const std::vector<Neighbor> &all_neighbors() const { return neighbors; }

  private:
    /// Values at shared unknowns to all neighbours, and theirs from them.
    template <typename Number>
    std::vector<std::vector<Number>> send(const Number *values) const;

    template <typename Number, typename Operation>
    void combine(Number *values, const Operation &operation) const;

    std::vector<std::vector<char>> exchange(const std::vector<std::vector<char>> &messages) const;

    Processes                  team;
    std::vector<Neighbor>      neighbors; ///< by rank
    std::vector<std::uint32_t> dofs;      ///< all that are shared, once
    std::vector<std::uint32_t> not_owned; ///< those of `dofs` that others own

    static constexpr char own = 0, owned_and_shared = 1, elsewhere = 2;
    std::vector<char>     use; ///< of each unknown; empty: `own`
  };
} // namespace unilateral
