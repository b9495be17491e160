// The processes that share the work on a problem, and what they say to each other.
#pragma once

#include <mpi.h>

#include <chrono>
#include <cstddef>
#include <cstdint>
#include <type_traits>
#include <vector>

namespace unilateral
{
  /// A group of processes. Every operation is collective, and every process gets the same bits. With one process nothing is sent.
  class Processes
  {
  public:
    Processes() = default; ///< this one alone
    static Processes all();

    /// One of a group that does not run: for what is decided without a message.
    Processes(const unsigned rank, const unsigned size) : own_rank(rank), n_processes(size) {}

    unsigned rank() const { return own_rank; }
    unsigned size() const { return n_processes; }
    bool     alone() const { return n_processes == 1; }

    /// Of the blocks of @p length processes with consecutive ranks the one with this process; @p length divides size(). Collective.
    Processes block(unsigned length) const;

    /// The processes whose ranks differ from this one's by multiples of @p stride, which divides size(). Collective.
    Processes every(unsigned stride) const;

    double        sum(double value) const;
    std::uint64_t sum(std::uint64_t value) const;
    std::uint64_t sum_of_lower_ranks(std::uint64_t value) const;
    double        max(double value) const;
    double        min(double value) const;
    bool          any(bool value) const; ///< true on one process or more
    void          sum(double *values, std::size_t n) const;
    void          sum(std::uint64_t *values, std::size_t n) const;
    void          sum(float *values, std::size_t n) const;
    void          max(double *values, std::size_t n) const;

    /// What process @p root has, on every process; sizes are equal.
    void broadcast(double *values, std::size_t n, unsigned root) const;

    /// The lists of all processes, one behind the other.
    std::vector<char> gather(const std::vector<char> &own) const;

    template <typename T>
    std::vector<T> gather(const std::vector<T> &own) const
    {
      static_assert(std::is_trivially_copyable_v<T>);
      const char *const       bytes = reinterpret_cast<const char *>(own.data());
      const std::vector<char> all = gather(std::vector<char>(bytes, bytes + own.size() * sizeof(T)));
      const T *const          begin = reinterpret_cast<const T *>(all.data());
      return std::vector<T>(begin, begin + all.size() / sizeof(T));
    }

    /// The k-th smallest of all values of all processes (k from 0).
    double nth_smallest(const std::vector<double> &values, std::uint64_t k) const;

    /// From one process to another, any number of bytes.
    void              send(const std::vector<char> &bytes, unsigned to) const;
    std::vector<char> receive(unsigned from) const;

    /// Sends @p to_each process its bytes, and returns those from each; nothing is sent where there are none.
    std::vector<std::vector<char>> exchange(std::vector<std::vector<char>> to_each) const;

    unsigned n_on_this_machine() const; ///< of these processes, this one included

    /// Waits for all to come here; false when some do not within the time.
    bool all_arrive(std::chrono::milliseconds patience) const;

    MPI_Comm communicator() const { return comm; }

  private:
    enum class Choice
    {
      block,
      every
    };
    Processes group(Choice choice, unsigned number, unsigned n_groups, unsigned rank_in_group) const;

    MPI_Comm comm = MPI_COMM_SELF;
    unsigned own_rank = 0, n_processes = 1;
  };
} // namespace unilateral
