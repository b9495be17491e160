#include "unilateral/base/processes.h"

#include <algorithm>
#include <array>
#include <cstring>
#include <limits>
#include <map>
#include <stdexcept>
#include <thread>
#include <tuple>

namespace unilateral
{
  Processes Processes::all()
  {
    Processes all;
    int       started = 0, n = 1, rank = 0;
    MPI_Initialized(&started);
    if (!started)
      return all;
    MPI_Comm_size(MPI_COMM_WORLD, &n);
    MPI_Comm_rank(MPI_COMM_WORLD, &rank);
    all.comm = MPI_COMM_WORLD;
    all.n_processes = n;
    all.own_rank = rank;
    return all;
  }

  Processes Processes::block(const unsigned length) const
  {
    return group(Choice::block, own_rank / length, n_processes / length, own_rank % length);
  }

  Processes Processes::every(const unsigned stride) const
  {
    return group(Choice::every, own_rank % stride, stride, own_rank / stride);
  }

  /// That with this @p number of @p n_groups. Communicators are kept, since to free one is collective; they serve again.
  Processes Processes::group(const Choice choice, const unsigned number, const unsigned n_groups, const unsigned rank_in_group) const
  {
    if (n_groups == 1)
      return *this;
    Processes result(rank_in_group, n_processes / n_groups);
    if (result.alone() || comm == MPI_COMM_SELF)
      return result;
    static std::map<std::tuple<MPI_Comm, Choice, unsigned>, MPI_Comm> made;
    const auto [entry, is_new] = made.try_emplace({comm, choice, n_groups}, MPI_COMM_NULL);
    if (is_new)
      MPI_Comm_split(comm, number, rank_in_group, &entry->second);
    result.comm = entry->second;
    return result;
  }

  namespace
  {
    /// To the first process and back from there: an all-to-all reduction need not round alike everywhere.
    template <typename Number>
    void reduce(Number *const values, std::size_t n, const MPI_Datatype type, const MPI_Op operation, const Processes &processes)
    {
      if (processes.alone())
        return;
      constexpr std::size_t most = std::numeric_limits<int>::max() / 2;
      for (std::size_t begin = 0; begin < n; begin += most)
      {
        const int count = std::min(most, n - begin);
        if (processes.rank() == 0)
          MPI_Reduce(MPI_IN_PLACE, values + begin, count, type, operation, 0, processes.communicator());
        else
          MPI_Reduce(values + begin, nullptr, count, type, operation, 0, processes.communicator());
        MPI_Bcast(values + begin, count, type, 0, processes.communicator());
      }
    }
  } // namespace

  void Processes::sum(double *const values, const std::size_t n) const
  {
    reduce(values, n, MPI_DOUBLE, MPI_SUM, *this);
  }

  void Processes::sum(float *const values, const std::size_t n) const
  {
    reduce(values, n, MPI_FLOAT, MPI_SUM, *this);
  }

  void Processes::sum(std::uint64_t *const values, const std::size_t n) const
  {
    reduce(values, n, MPI_UINT64_T, MPI_SUM, *this);
  }

  void Processes::max(double *const values, const std::size_t n) const
  {
    reduce(values, n, MPI_DOUBLE, MPI_MAX, *this);
  }

  double Processes::sum(double value) const
  {
    sum(&value, 1);
    return value;
  }

  std::uint64_t Processes::sum(std::uint64_t value) const
  {
    sum(&value, 1);
    return value;
  }

  std::uint64_t Processes::sum_of_lower_ranks(const std::uint64_t value) const
  {
    std::uint64_t sum = 0;
    if (!alone())
      MPI_Exscan(&value, &sum, 1, MPI_UINT64_T, MPI_SUM, comm);
    return rank() == 0 ? 0 : sum;
  }

  double Processes::max(double value) const
  {
    max(&value, 1);
    return value;
  }

  double Processes::min(const double value) const
  {
    return -max(-value);
  }

  bool Processes::any(const bool value) const
  {
    return max(value ? 1. : 0.) > 0;
  }

  void Processes::broadcast(double *const values, const std::size_t n, const unsigned root) const
  {
    if (!alone())
      MPI_Bcast(values, n, MPI_DOUBLE, root, comm);
  }

  std::vector<char> Processes::gather(const std::vector<char> &own) const
  {
    if (alone())
      return own;
    const std::uint64_t        n = own.size();
    std::vector<std::uint64_t> sizes(n_processes);
    MPI_Allgather(&n, 1, MPI_UINT64_T, sizes.data(), 1, MPI_UINT64_T, comm);
    std::vector<int> counts(n_processes), offsets(n_processes);
    std::uint64_t    total = 0;
    for (unsigned r = 0; r < n_processes; ++r)
    {
      counts[r] = sizes[r];
      offsets[r] = total;
      total += sizes[r];
    }
    if (total > std::uint64_t(std::numeric_limits<int>::max()))
      throw std::runtime_error("a list is too long to be sent to every process");
    std::vector<char> all(total);
    MPI_Allgatherv(own.data(), n, MPI_CHAR, all.data(), counts.data(), offsets.data(), MPI_CHAR, comm);
    return all;
  }

  double Processes::nth_smallest(const std::vector<double> &values, std::uint64_t k) const
  {
    if (alone())
    {
      std::vector<double> copy(values);
      std::nth_element(copy.begin(), copy.begin() + k, copy.end());
      return copy[k];
    }
    // Digit by digit of 8 bits, on unsigned integers that are ordered like the numbers.
    std::vector<std::uint64_t> keys(values.size());
    for (std::size_t i = 0; i < values.size(); ++i)
    {
      std::memcpy(&keys[i], &values[i], sizeof(double));
      keys[i] = keys[i] >> 63 ? ~keys[i] : keys[i] | std::uint64_t(1) << 63;
    }
    std::uint64_t found = 0;
    for (int shift = 56; shift >= 0; shift -= 8)
    {
      std::vector<std::uint64_t> count(256, 0);
      for (const auto key : keys)
        ++count[key >> shift & 0xff];
      sum(count.data(), count.size());
      std::uint64_t digit = 0;
      for (; digit + 1 < count.size() && k >= count[digit]; ++digit)
        k -= count[digit];
      found |= digit << shift;
      keys.erase(std::remove_if(keys.begin(), keys.end(), [&](const auto key) { return (key >> shift & 0xff) != digit; }), keys.end());
    }
    found = found >> 63 ? found & ~(std::uint64_t(1) << 63) : ~found;
    double value;
    std::memcpy(&value, &found, sizeof(double));
    return value;
  }

  namespace
  {
    constexpr int         tag_of_bytes = 2;
    constexpr std::size_t most_bytes_at_once = std::size_t(1) << 30; // MPI counts with 31 bits
  }                                                                  // namespace

  void Processes::send(const std::vector<char> &bytes, const unsigned to) const
  {
    const std::uint64_t size = bytes.size();
    MPI_Send(&size, 1, MPI_UINT64_T, to, tag_of_bytes, comm);
    for (std::size_t place = 0; place < size; place += most_bytes_at_once)
      MPI_Send(bytes.data() + place, std::min<std::size_t>(most_bytes_at_once, size - place), MPI_CHAR, to, tag_of_bytes, comm);
  }

  std::vector<char> Processes::receive(const unsigned from) const
  {
    std::uint64_t size = 0;
    MPI_Recv(&size, 1, MPI_UINT64_T, from, tag_of_bytes, comm, MPI_STATUS_IGNORE);
    std::vector<char> bytes(size);
    for (std::size_t place = 0; place < size; place += most_bytes_at_once)
      MPI_Recv(bytes.data() + place, std::min<std::size_t>(most_bytes_at_once, size - place), MPI_CHAR, from, tag_of_bytes, comm,
               MPI_STATUS_IGNORE);
    return bytes;
  }

  std::vector<std::vector<char>> Processes::exchange(std::vector<std::vector<char>> to_each) const
  {
    std::vector<std::uint64_t> sizes, sizes_from(n_processes);
    for (const auto &bytes : to_each)
      sizes.push_back(bytes.size());
    std::vector<std::vector<char>> from_each(n_processes);
    from_each[own_rank] = std::move(to_each[own_rank]);
    if (alone())
      return from_each;
    MPI_Alltoall(sizes.data(), 1, MPI_UINT64_T, sizes_from.data(), 1, MPI_UINT64_T, comm);
    std::vector<MPI_Request> requests;
    for (unsigned other = 0; other < n_processes; ++other)
      if (other != own_rank)
      {
        from_each[other].resize(sizes_from[other]);
        for (std::size_t place = 0; place < sizes_from[other]; place += most_bytes_at_once)
          MPI_Irecv(from_each[other].data() + place, std::min<std::size_t>(most_bytes_at_once, sizes_from[other] - place), MPI_CHAR, other,
                    tag_of_bytes, comm, &requests.emplace_back());
        for (std::size_t place = 0; place < sizes[other]; place += most_bytes_at_once)
          MPI_Isend(to_each[other].data() + place, std::min<std::size_t>(most_bytes_at_once, sizes[other] - place), MPI_CHAR, other,
                    tag_of_bytes, comm, &requests.emplace_back());
      }
    MPI_Waitall(requests.size(), requests.data(), MPI_STATUSES_IGNORE);
    return from_each;
  }

  unsigned Processes::n_on_this_machine() const
  {
    if (alone())
      return 1;
    MPI_Comm here;
    int      n = 1;
    MPI_Comm_split_type(comm, MPI_COMM_TYPE_SHARED, 0, MPI_INFO_NULL, &here);
    MPI_Comm_size(here, &n);
    MPI_Comm_free(&here);
    return n;
  }

  bool Processes::all_arrive(const std::chrono::milliseconds patience) const
  {
    MPI_Request request;
    MPI_Ibarrier(comm, &request);
    int        arrived = 0;
    const auto start = std::chrono::steady_clock::now();
    do
    {
      MPI_Test(&request, &arrived, MPI_STATUS_IGNORE);
      if (!arrived)
        std::this_thread::sleep_for(std::chrono::milliseconds(1));
    } while (!arrived && std::chrono::steady_clock::now() - start < patience);
    return arrived;
  }
} // namespace unilateral
