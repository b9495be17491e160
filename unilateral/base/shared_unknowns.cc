#include "unilateral/base/shared_unknowns.h"

#include <algorithm>
#include <array>
#include <map>

namespace unilateral
{
  SharedUnknowns::SharedUnknowns(const Processes &processes, const std::size_t n_dofs, const std::vector<Entry> &entries) : team(processes)
  {
    std::map<unsigned, Neighbor> by_rank;
    use.assign(n_dofs, own);
    for (const auto &[dof, ranks] : entries)
    {
      use[dof] = ranks[0] == team.rank() ? owned_and_shared : elsewhere;
      if (use[dof] == elsewhere)
        not_owned.push_back(dof);
      for (const unsigned rank : ranks)
        if (rank != team.rank())
        {
          by_rank[rank].dofs.push_back(dof);
          by_rank[rank].place.push_back(dofs.size());
        }
      dofs.push_back(dof);
    }
    for (auto &[rank, neighbor] : by_rank)
    {
      neighbor.rank = rank;
      neighbors.push_back(std::move(neighbor));
    }
  }

  std::vector<SharedUnknowns::Entry> SharedUnknowns::entries() const
  {
    std::vector<Entry> result;
    for (const auto dof : dofs)
      result.push_back({dof, {team.rank()}});
    for (const Neighbor &neighbor : neighbors)
      for (const auto place : neighbor.place)
        result[place].ranks.push_back(neighbor.rank);
    for (Entry &entry : result)
      std::sort(entry.ranks.begin(), entry.ranks.end());
    return result;
  }

  std::vector<std::vector<char>> SharedUnknowns::exchange(const std::vector<std::vector<char>> &messages) const
  {
    std::vector<std::uint64_t> sizes(neighbors.size()), own_sizes(neighbors.size());
    std::vector<MPI_Request>   requests(2 * neighbors.size());
    for (std::size_t n = 0; n < neighbors.size(); ++n)
    {
      own_sizes[n] = messages[n].size();
      MPI_Irecv(&sizes[n], 1, MPI_UINT64_T, neighbors[n].rank, 1, team.communicator(), &requests[2 * n]);
      MPI_Isend(&own_sizes[n], 1, MPI_UINT64_T, neighbors[n].rank, 1, team.communicator(), &requests[2 * n + 1]);
    }
    MPI_Waitall(requests.size(), requests.data(), MPI_STATUSES_IGNORE);
    std::vector<std::vector<char>> answers(neighbors.size());
    for (std::size_t n = 0; n < neighbors.size(); ++n)
    {
      answers[n].resize(sizes[n]);
      MPI_Irecv(answers[n].data(), sizes[n], MPI_CHAR, neighbors[n].rank, 2, team.communicator(), &requests[2 * n]);
      MPI_Isend(messages[n].data(), own_sizes[n], MPI_CHAR, neighbors[n].rank, 2, team.communicator(), &requests[2 * n + 1]);
    }
    MPI_Waitall(requests.size(), requests.data(), MPI_STATUSES_IGNORE);
    return answers;
  }

  template <typename Number>
  std::vector<std::vector<Number>> SharedUnknowns::send(const Number *const values) const
  {
    const MPI_Datatype               type = sizeof(Number) == sizeof(float) ? MPI_FLOAT : MPI_DOUBLE;
    std::vector<std::vector<Number>> sent(neighbors.size()), received(neighbors.size());
    std::vector<MPI_Request>         requests(2 * neighbors.size());
    for (std::size_t n = 0; n < neighbors.size(); ++n)
    {
      const int size = neighbors[n].dofs.size();
      received[n].resize(size);
      MPI_Irecv(received[n].data(), size, type, neighbors[n].rank, 3, team.communicator(), &requests[2 * n]);
      sent[n].resize(size);
      for (int k = 0; k < size; ++k)
        sent[n][k] = values[neighbors[n].dofs[k]];
      MPI_Isend(sent[n].data(), size, type, neighbors[n].rank, 3, team.communicator(), &requests[2 * n + 1]);
    }
    MPI_Waitall(requests.size(), requests.data(), MPI_STATUSES_IGNORE);
    return received;
  }

  template <typename Number, typename Operation>
  void SharedUnknowns::combine(Number *const values, const Operation &operation) const
  {
    if (dofs.empty())
      return;
    const auto received = send(values);
    // By rank, the own contribution in its place: rounding is the same everywhere.
    std::vector<Number> result(dofs.size());
    std::vector<char>   begun(dofs.size(), false);
    const auto          take = [&](const std::uint32_t place, const Number value)
    {
      result[place] = begun[place] ? operation(result[place], value) : value;
      begun[place] = true;
    };
    const auto take_own = [&]
    {
      for (std::uint32_t k = 0; k < dofs.size(); ++k)
        take(k, values[dofs[k]]);
    };
    bool own_taken = false;
    for (std::size_t n = 0; n < neighbors.size(); ++n)
    {
      if (!own_taken && neighbors[n].rank > team.rank())
      {
        take_own();
        own_taken = true;
      }
      for (std::uint32_t k = 0; k < received[n].size(); ++k)
        take(neighbors[n].place[k], received[n][k]);
    }
    if (!own_taken)
      take_own();
    for (std::uint32_t k = 0; k < dofs.size(); ++k)
      values[dofs[k]] = result[k];
  }

  void SharedUnknowns::add(double *const values) const
  {
    combine(values, [](const double a, const double b) { return a + b; });
  }

  void SharedUnknowns::add(float *const values) const
  {
    combine(values, [](const float a, const float b) { return a + b; });
  }

  void SharedUnknowns::add_of_others(const float *const own, float *const target) const
  {
    if (dofs.empty())
      return;
    const auto received = send(own);
    for (std::size_t n = 0; n < neighbors.size(); ++n)
      for (std::size_t k = 0; k < received[n].size(); ++k)
        target[neighbors[n].dofs[k]] += received[n][k];
  }

  void SharedUnknowns::take_from_owner(double *const values) const
  {
    for (const auto dof : not_owned)
      values[dof] = 0;
    add(values);
  }

  std::vector<std::uint64_t> SharedUnknowns::numbers_by_owner(const std::size_t n_dofs) const
  {
    std::uint64_t       next = team.sum_of_lower_ranks(n_dofs - n_not_owned());
    std::vector<double> numbers(n_dofs, 0);
    for (std::size_t dof = 0; dof < n_dofs; ++dof)
      if (owns(dof))
        numbers[dof] = double(next++);
    take_from_owner(numbers.data());
    return {numbers.begin(), numbers.end()};
  }

  SharedUnknowns SharedUnknowns::renumbered(const std::vector<std::uint32_t> &position, const std::size_t size) const
  {
    std::vector<std::uint32_t> unknowns(size, not_shared);
    for (std::size_t i = 0; i < use.size(); ++i)
      unknowns[position[i]] = i;
    return of_subspace(unknowns);
  }

  SharedUnknowns SharedUnknowns::of_subspace(const std::vector<std::uint32_t> &unknowns) const
  {
    SharedUnknowns result;
    result.team = team;
    if (use.empty())
      return result;
    std::vector<std::uint32_t> number(use.size(), not_shared);
    result.use.assign(unknowns.size(), SharedUnknowns::own);
    for (std::uint32_t i = 0; i < unknowns.size(); ++i)
      if (unknowns[i] != not_shared)
      {
        number[unknowns[i]] = i;
        result.use[i] = use[unknowns[i]];
      }
    std::vector<std::uint32_t> place(dofs.size(), not_shared); // among those that are shared there
    for (std::size_t k = 0; k < dofs.size(); ++k)
      if (number[dofs[k]] != not_shared)
      {
        place[k] = result.dofs.size();
        result.dofs.push_back(number[dofs[k]]);
      }
    for (const auto dof : not_owned)
      if (number[dof] != not_shared)
        result.not_owned.push_back(number[dof]);
    for (const Neighbor &neighbor : neighbors)
    {
      Neighbor there{neighbor.rank, {}, {}};
      for (std::size_t k = 0; k < neighbor.dofs.size(); ++k)
        if (number[neighbor.dofs[k]] != not_shared)
        {
          there.dofs.push_back(number[neighbor.dofs[k]]);
          there.place.push_back(place[neighbor.place[k]]);
        }
      if (!there.dofs.empty())
        result.neighbors.push_back(std::move(there));
    }
    return result;
  }

  void SharedUnknowns::minimize(double *const values) const
  {
    combine(values, [](const double a, const double b) { return std::min(a, b); });
  }

  double SharedUnknowns::dot(const double *const a, const double *const b, const std::size_t n) const
  {
    // Several sums side by side: a single one would wait for each addition, and gather more rounding.
    constexpr std::size_t     width = 16;
    std::array<double, width> sums{};
    std::size_t               i = 0;
    for (; i + width <= n; i += width)
      for (std::size_t k = 0; k < width; ++k)
        sums[k] += a[i + k] * b[i + k];
    double sum = 0;
    for (; i < n; ++i)
      sum += a[i] * b[i];
    for (const double part : sums)
      sum += part;
    for (const auto dof : not_owned)
      sum -= a[dof] * b[dof];
    return team.sum(sum);
  }
} // namespace unilateral
