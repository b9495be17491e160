#include "unilateral/multigrid/distributed_amg.h"

#include "unilateral/algebra/ml_preconditioner.h"

#include <deal.II/lac/trilinos_sparse_matrix.h>
#include <deal.II/lac/trilinos_sparsity_pattern.h>

#include <algorithm>
#include <utility>

namespace unilateral
{
  using namespace dealii;

  struct DistributedAmg::Trilinos
  {
    IndexSet                                           owned;
    TrilinosWrappers::SparseMatrix                     T;
    std::unique_ptr<TrilinosWrappers::PreconditionAMG> amg;
    Vector                                             x, r; ///< what this process owns
  };

  DistributedAmg::DistributedAmg(const SparseMatrix<double> &A,
                                 const SparseRows           &B,
                                 const SharedUnknowns       &shared,
                                 const unsigned              block_size,
                                 std::vector<Vector>         near_null_space)
    : A(A), B(B), shared(shared), block_size(block_size), near_null_space(std::move(near_null_space)),
      number(shared.numbers_by_owner(A.m())), trilinos(std::make_unique<Trilinos>())
  {
    const Processes    &processes = shared.processes();
    const std::uint64_t n_owned = A.m() - shared.n_not_owned(), n = processes.sum(n_owned);
    IndexSet            present(n);
    trilinos->owned.set_size(n);
    std::vector<types::global_dof_index> sorted, of_owned;
    for (std::size_t i = 0; i < number.size(); ++i)
    {
      sorted.push_back(number[i]);
      if (shared.owns(i))
        of_owned.push_back(number[i]);
    }
    std::sort(sorted.begin(), sorted.end());
    present.add_indices(sorted.begin(), sorted.end());
    trilinos->owned.add_indices(of_owned.begin(), of_owned.end());

    TrilinosWrappers::SparsityPattern    pattern(trilinos->owned, trilinos->owned, present, processes.communicator());
    std::vector<types::global_dof_index> columns;
    for (std::size_t i = 0; i < A.m(); ++i)
    {
      columns.clear();
      for (auto entry = A.begin(i); entry != A.end(i); ++entry)
        columns.push_back(number[entry->column()]);
      pattern.add_entries(number[i], columns.begin(), columns.end());
    }
    pattern.compress();
    trilinos->T.reinit(pattern);
    trilinos->x.reinit(trilinos->owned, processes.communicator());
    trilinos->r.reinit(trilinos->x);
  }

  DistributedAmg::~DistributedAmg() = default;

  std::uint64_t DistributedAmg::size() const
  {
    return trilinos->owned.size();
  }

  void DistributedAmg::set_diagonal(const Vector &d)
  {
    auto                &T = trilinos->T;
    SparseMatrix<double> own(A.get_sparsity_pattern());
    own.copy_from(A);
    add_penalty(own, B, d);
    T = 0.;
    std::vector<types::global_dof_index> columns;
    std::vector<double>                  values;
    for (std::size_t i = 0; i < own.m(); ++i)
    {
      columns.clear();
      values.clear();
      for (auto entry = own.begin(i); entry != own.end(i); ++entry)
      {
        columns.push_back(number[entry->column()]);
        values.push_back(entry->value());
      }
      T.add(number[i], columns.size(), columns.data(), values.data());
    }
    T.compress(VectorOperation::add);
    std::vector<std::vector<double>> modes;
    for (const Vector &mode : near_null_space)
    {
      modes.emplace_back();
      for (std::size_t i = 0; i < number.size(); ++i)
        if (shared.owns(i))
          modes.back().push_back(mode(i));
    }
    trilinos->amg.reset(); // before the next one takes memory
    trilinos->amg = ml_preconditioner(T.trilinos_matrix(), modes, block_size, MlParameters());
  }

  void DistributedAmg::vmult(Vector &x, const Vector &r) const
  {
    const std::uint64_t first = trilinos->owned.n_elements() > 0 ? trilinos->owned.nth_index_in_set(0) : 0;
    for (std::size_t i = 0; i < number.size(); ++i)
      if (shared.owns(i))
        trilinos->r.local_element(number[i] - first) = r(i);
    trilinos->amg->vmult(trilinos->x, trilinos->r);
    for (std::size_t i = 0; i < number.size(); ++i)
      x(i) = shared.owns(i) ? trilinos->x.local_element(number[i] - first) : 0;
    shared.take_from_owner(x.begin());
  }
} // namespace unilateral
