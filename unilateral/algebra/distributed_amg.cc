#include "unilateral/algebra/distributed_amg.h"

#include "unilateral/algebra/linear_solver.h"
#include "unilateral/algebra/ml_parameters.h"

#include <deal.II/base/index_set.h>
#include <deal.II/lac/trilinos_sparse_matrix.h>
#include <deal.II/lac/trilinos_sparsity_pattern.h>
#include <deal.II/lac/trilinos_vector.h>

#include <limits>
#include <stdexcept>
#include <vector>

namespace unilateral
{
  using namespace dealii;

  struct DistributedAmg::Trilinos
  {
    IndexSet                                           owned;
    TrilinosWrappers::SparseMatrix                     matrix;
    std::unique_ptr<TrilinosWrappers::PreconditionAMG> amg;
    mutable TrilinosWrappers::MPI::Vector              r, z;
  };

  DistributedAmg::DistributedAmg(const SharedUnknowns &shared, const std::size_t n_dofs, const bool higher_order)
    : numbers(shared, n_dofs), higher_order(higher_order), trilinos(std::make_unique<Trilinos>())
  {
    trilinos->owned.set_size(numbers.n());
    trilinos->owned.add_range(numbers.first_own(), numbers.first_own() + numbers.owned.size());
    trilinos->owned.compress();
    for (auto *const vector : {&trilinos->r, &trilinos->z})
      vector->reinit(trilinos->owned, shared.processes().communicator());
  }

  DistributedAmg::~DistributedAmg() = default;

  void DistributedAmg::set_matrix(const SparseMatrix<double> &own)
  {
    if (numbers.n() > std::numeric_limits<types::global_dof_index>::max())
      throw std::runtime_error("the linear system is too large for algebraic multigrid");
    const auto                          &owned = trilinos->owned;
    std::vector<types::global_dof_index> columns;
    std::vector<double>                  values;
    if (trilinos->matrix.m() != numbers.n())
    {
      TrilinosWrappers::SparsityPattern pattern(owned, numbers.shared.processes().communicator());
      for (std::size_t row = 0; row < own.m(); ++row)
      {
        columns.clear();
        for (auto entry = own.begin(row); entry != own.end(row); ++entry)
          columns.push_back(numbers.number[entry->column()]);
        pattern.add_entries(numbers.number[row], columns.begin(), columns.end());
      }
      pattern.compress();
      trilinos->matrix.reinit(pattern);
    }
    trilinos->matrix = 0.;
    for (std::size_t row = 0; row < own.m(); ++row)
    {
      columns.clear();
      values.clear();
      for (auto entry = own.begin(row); entry != own.end(row); ++entry)
      {
        columns.push_back(numbers.number[entry->column()]);
        values.push_back(entry->value());
      }
      trilinos->matrix.add(numbers.number[row], columns.size(), columns.data(), values.data());
    }
    trilinos->matrix.compress(VectorOperation::add);

    trilinos->amg = std::make_unique<TrilinosWrappers::PreconditionAMG>();
    trilinos->amg->initialize(trilinos->matrix,
                              ml_parameters(/*symmetric=*/false, higher_order, LinearSolver::Parameters().amg_drop_tolerance));
  }

  void DistributedAmg::vmult(Vector &z, const Vector &r) const
  {
    std::size_t k = 0;
    for (double &value : trilinos->r)
      value = r(numbers.owned[k++]);
    trilinos->amg->vmult(trilinos->z, trilinos->r);
    k = 0;
    for (const double value : trilinos->z)
      z(numbers.owned[k++]) = value;
    numbers.shared.take_from_owner(z.begin());
  }
} // namespace unilateral
