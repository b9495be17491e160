#include "unilateral/algebra/mumps_factors.h"

#include "unilateral/base/available_memory.h"

#include <dmumps_c.h>

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <exception>
#include <limits>
#include <numeric>
#include <stdexcept>

namespace unilateral
{
  using namespace dealii;

  namespace
  {
    // Jobs and parameters, by the numbers of the users' guide.
    constexpr int                begin_job = -1, end_job = -2, analyse_job = 1, factorise_job = 2, solve_job = 3;
    constexpr int                singular = -10, root_not_positive_definite = -40;
    constexpr std::array<int, 6> too_little_memory_planned = {-8, -9, -14, -15, -17, -20};
    constexpr unsigned           errors_to = 1, diagnostics_to = 2, statistics_to = 3, verbosity = 4, percent_more_workspace = 14,
                       distributed_input = 18, right_hand_side = 20, distributed_solution = 21;
  } // namespace

  struct MumpsFactors::Instance
  {
    Instance(const MPI_Comm communicator, const bool symmetric, const bool positive_definite) : positive_definite(positive_definite)
    {
      id.comm_fortran = MPI_Comm_c2f(communicator);
      id.par = 1; // the first process works, too
      id.sym = positive_definite ? 1 : symmetric ? 2 : 0;
      run(begin_job);
      for (const unsigned output : {errors_to, diagnostics_to, statistics_to})
        parameter(output) = -1;
      parameter(verbosity) = 0;
      parameter(distributed_input) = 3;
      parameter(distributed_solution) = 1;
      parameter(right_hand_side) = 10; // distributed as well
    }

    ~Instance()
    {
      if (std::uncaught_exceptions() == 0) // else other processes may not come here
        run(end_job);
    }

    int &parameter(const unsigned number) { return id.icntl[number - 1]; }
    int  result_of_all(const unsigned number) const { return id.infog[number - 1]; }
    int  result(const unsigned number) const { return id.info[number - 1]; }

    void run(const int job)
    {
      id.job = job;
      dmumps_c(&id);
    }

    DMUMPS_STRUC_C      id{};
    bool                positive_definite;
    std::vector<double> rhs, solution;
    std::vector<int>    places_of_solution; ///< unknowns, from 1
  };

  MumpsFactors::MumpsFactors(const SharedUnknowns &shared, const std::size_t n_dofs, const bool symmetric)
    : numbers(shared, n_dofs), is_symmetric(symmetric)
  {
    for (const auto dof : numbers.owned)
      numbers_of_owned.push_back(int(numbers.number[dof]) + 1);
    instance = std::make_unique<Instance>(shared.processes().communicator(), is_symmetric, /*positive_definite=*/is_symmetric);
  }

  MumpsFactors::~MumpsFactors() = default;

  bool MumpsFactors::positive_definite() const
  {
    return instance->positive_definite;
  }

  /// Of symmetric matrices MUMPS wants each pair of entries once.
  void MumpsFactors::take_pattern(const SparseMatrix<double> &own, const std::vector<Entry> &further)
  {
    for (std::size_t row = 0; row < own.m(); ++row)
      for (auto entry = own.begin(row); entry != own.end(row); ++entry)
        if (!is_symmetric || entry->column() >= row)
        {
          rows.push_back(int(numbers.number[row]) + 1);
          columns.push_back(int(numbers.number[entry->column()]) + 1);
        }
    for (const Entry &entry : further)
      if (!is_symmetric || entry.column >= entry.row)
      {
        rows.push_back(int(entry.row) + 1);
        columns.push_back(int(entry.column) + 1);
      }
  }

  void MumpsFactors::factorise(const SparseMatrix<double> &own, const std::vector<Entry> &further)
  {
    if (numbers.n() > std::uint64_t(std::numeric_limits<int>::max()))
      throw std::runtime_error("the linear system is too large for a factorisation");
    if (rows.empty())
      take_pattern(own, further);
    values.clear();
    for (std::size_t row = 0; row < own.m(); ++row)
      for (auto entry = own.begin(row); entry != own.end(row); ++entry)
        if (!is_symmetric || entry->column() >= row)
          values.push_back(entry->value());
    for (const Entry &entry : further)
      if (!is_symmetric || entry.column >= entry.row)
        values.push_back(entry.value);
    way_is_known = false;
    if (!is_analysed)
      analyse();
    if (!compute())
    {
      is_analysed = false;
      instance.reset();
      instance = std::make_unique<Instance>(numbers.shared.processes().communicator(), is_symmetric, /*positive_definite=*/false);
      analyse();
      compute();
    }
  }

  void MumpsFactors::analyse()
  {
    auto &id = instance->id;
    id.n = int(numbers.n());
    id.nnz_loc = values.size();
    id.irn_loc = rows.data();
    id.jcn_loc = columns.data();
    id.a_loc = values.data();
    instance->run(analyse_job);
    if (instance->result_of_all(1) < 0)
      throw std::runtime_error(fmt::format("the linear system cannot be ordered for a factorisation (MUMPS: {}, {})",
                                           instance->result_of_all(1), instance->result_of_all(2)));
    check_memory(1);
    is_analysed = true;
  }

  /// Linux gives memory that is not there, and ends processes that use it.
  void MumpsFactors::check_memory(const double part) const
  {
    const auto       available = available_memory();
    const Processes &processes = numbers.shared.processes();
    const double     needed = part * 1e6 * instance->result_of_all(16) * processes.n_on_this_machine(); // the largest, in megabytes
    if (processes.any(available && needed > *available))
      throw std::runtime_error(fmt::format("the factors of the linear system need {:.1f} GB on each process, for which memory is lacking",
                                           part * 1e-3 * instance->result_of_all(16)));
  }

  bool MumpsFactors::compute()
  {
    instance->id.a_loc = values.data();
    instance->run(factorise_job);
    const auto needs_more = [&]
    {
      const auto &errors = too_little_memory_planned;
      return std::find(errors.begin(), errors.end(), instance->result_of_all(1)) != errors.end();
    };
    for (unsigned attempt = 0; attempt < 4 && needs_more(); ++attempt)
    {
      instance->parameter(percent_more_workspace) = std::max(2 * instance->parameter(percent_more_workspace), 50);
      check_memory(1 + 0.01 * instance->parameter(percent_more_workspace));
      instance->run(factorise_job);
    }
    const int error = instance->result_of_all(1), n_negative = instance->result_of_all(12);
    if (instance->positive_definite && (error == singular || error == root_not_positive_definite || (error >= 0 && n_negative > 0)))
      return false;
    if (error == singular)
      throw std::runtime_error("the linear system is singular");
    if (error < 0)
      throw std::runtime_error(fmt::format("the linear system cannot be factorised (MUMPS: {}, {})", error, instance->result_of_all(2)));
    return true;
  }

  void MumpsFactors::plan_return_of_solution() const
  {
    const Processes &processes = numbers.shared.processes();
    const auto      &places = instance->places_of_solution;
    way_back = {};
    way_back.place_to_send.resize(places.size());
    std::iota(way_back.place_to_send.begin(), way_back.place_to_send.end(), 0);
    std::sort(way_back.place_to_send.begin(), way_back.place_to_send.end(),
              [&](const auto a, const auto b) { return places[a] < places[b]; }); // which sorts them by owner
    way_back.n_to.assign(processes.size(), 0);
    way_back.n_from.assign(processes.size(), 0);
    std::vector<int> to_send;
    for (const auto place : way_back.place_to_send)
    {
      to_send.push_back(places[place] - 1);
      ++way_back.n_to[numbers.owner(places[place] - 1)];
    }
    MPI_Alltoall(way_back.n_to.data(), 1, MPI_INT, way_back.n_from.data(), 1, MPI_INT, processes.communicator());
    const auto starts = [](const std::vector<int> &n)
    {
      std::vector<int> start(n.size(), 0);
      std::partial_sum(n.begin(), n.end() - 1, start.begin() + 1);
      return start;
    };
    way_back.start_to = starts(way_back.n_to);
    way_back.start_from = starts(way_back.n_from);
    std::vector<int> come(numbers.owned.size());
    MPI_Alltoallv(to_send.data(), way_back.n_to.data(), way_back.start_to.data(), MPI_INT, come.data(), way_back.n_from.data(),
                  way_back.start_from.data(), MPI_INT, processes.communicator());
    for (const int number : come)
      way_back.unknowns.push_back(numbers.owned[number - numbers.first_own()]);
    way_is_known = true;
  }

  void MumpsFactors::solve(Vector &x, const Vector &b) const
  {
    auto &id = instance->id;
    auto &rhs = instance->rhs, &solution = instance->solution;
    rhs.clear();
    for (const auto dof : numbers.owned)
      rhs.push_back(b(dof));
    id.nrhs = 1;
    id.nloc_rhs = int(rhs.size());
    id.lrhs_loc = int(rhs.size());
    id.irhs_loc = const_cast<int *>(numbers_of_owned.data());
    id.rhs_loc = rhs.data();
    const int n_left = instance->result(23);
    solution.resize(n_left);
    instance->places_of_solution.resize(n_left);
    id.lsol_loc = n_left;
    id.sol_loc = solution.data();
    id.isol_loc = instance->places_of_solution.data();
    instance->run(solve_job);
    if (instance->result_of_all(1) < 0)
      throw std::runtime_error(
        fmt::format("no solution by the factors (MUMPS: {}, {})", instance->result_of_all(1), instance->result_of_all(2)));
    if (!way_is_known)
      plan_return_of_solution();

    std::vector<double> to_send, come(way_back.unknowns.size());
    for (const auto place : way_back.place_to_send)
      to_send.push_back(solution[place]);
    MPI_Alltoallv(to_send.data(), way_back.n_to.data(), way_back.start_to.data(), MPI_DOUBLE, come.data(), way_back.n_from.data(),
                  way_back.start_from.data(), MPI_DOUBLE, numbers.shared.processes().communicator());
    for (std::size_t k = 0; k < come.size(); ++k)
      x(way_back.unknowns[k]) = come[k];
    numbers.shared.take_from_owner(x.begin());
  }
} // namespace unilateral
