#include "unilateral/multigrid/multigrid_level.h"

#include "unilateral/multigrid/scaled_eigenvalue.h"

namespace unilateral
{
  MultigridLevel::MultigridLevel(const CellOperator &stiffness, const PatchSweep &sweep, const SharedUnknowns &shared_unknowns)
    : stiffness(&stiffness), sweep(&sweep), stiffness_eigenvalue(shared_unknowns.processes().max(largest_scaled_eigenvalue(stiffness)))
  {
    for (auto *const v : {&x, &b, &step, &terms, &inverse_diagonal, &receives, &sends})
      v->resize(sweep.size(), 0.f);
    prepare_exchange(shared_unknowns);
    is_fixed.assign(stiffness.n_dofs(), false);
    for (const auto dof : stiffness.fixed())
      is_fixed[dof] = true;
    diagonal.resize(stiffness.n_dofs());
    for (std::size_t dof = 0; dof < diagonal.size(); ++dof)
      reset(dof);
  }

  void MultigridLevel::prepare_exchange(const SharedUnknowns &shared_unknowns)
  {
    shared = shared_unknowns.renumbered(sweep->positions(), sweep->size());
    if (shared.empty())
      return;
    on_cuts.resize(sweep->size(), 0.f);
    std::vector<unsigned char> shares(stiffness->n_dofs(), 0), cell_shares(stiffness->n_cells());
    for (const auto dof : shared_unknowns.all())
      shares[dof] = 1;
    stiffness->collect_flags(shares.data(), cell_shares.data());
    const unsigned             n = stiffness->n_cell_dofs();
    std::vector<std::uint32_t> dofs(n);
    std::vector<double>        matrix(n * n);
    for (std::size_t cell = 0; cell < cell_shares.size(); ++cell)
      if (cell_shares[cell] && !stiffness->dependent(cell)) // whose matrices are blocks
      {
        stiffness->cell_dofs(cell, dofs.data());
        stiffness->cell_matrix(cell, matrix.data());
        for (const auto dof : dofs)
          cut_positions.push_back(sweep->positions()[dof]);
        cut_matrices.insert(cut_matrices.end(), matrix.begin(), matrix.end());
      }
  }

  std::vector<double> MultigridLevel::diagonal_on_cuts(const SharedUnknowns &unknowns) const
  {
    std::vector<double> base;
    for (const auto dof : unknowns.all())
      base.push_back(diagonal[dof]);
    return base;
  }

  void MultigridLevel::add_diagonal_of_others(const SharedUnknowns &unknowns, const std::vector<double> &base)
  {
    for (std::size_t k = 0; k < base.size(); ++k)
      diagonal[unknowns.all()[k]] -= base[k];
    unknowns.add(diagonal.data());
    for (std::size_t k = 0; k < base.size(); ++k)
      diagonal[unknowns.all()[k]] += base[k];
    touched.insert(touched.end(), unknowns.all().begin(), unknowns.all().end());
  }

  void MultigridLevel::receive(const std::uint32_t place, const float value)
  {
    receives[place] = value;
    sends[place] = shared.owns(place) ? value : 0;
  }

  void MultigridLevel::reset(const std::uint32_t dof)
  {
    const auto place = sweep->positions()[dof];
    diagonal[dof] = stiffness->diagonal()[dof];
    inverse_diagonal[place] = is_fixed[dof] ? 0 : 1 / diagonal[dof];
    receive(place, is_fixed[dof] ? 0 : 1);
  }

  void MultigridLevel::add_block(const std::vector<std::uint32_t> &dofs, const double *const matrix)
  {
    for (const auto dof : dofs)
      block_positions.push_back(sweep->positions()[dof]);
    block_start.push_back(block_positions.size());
    block_matrices.insert(block_matrices.end(), matrix, matrix + dofs.size() * dofs.size());
  }

  namespace
  {
    /// y += M x for a small matrix M at some positions; returns what follows M.
    const float *add_product(const float *matrix, const std::uint32_t *const places, const unsigned n, const float *const x, float *const y)
    {
      for (unsigned i = 0; i < n; ++i)
      {
        float sum = 0;
        for (unsigned j = 0; j < n; ++j)
          sum += *matrix++ * x[places[j]];
        y[places[i]] += sum;
      }
      return matrix;
    }
  } // namespace

  void MultigridLevel::add_terms(const float *const x)
  {
    const float *matrix = block_matrices.data();
    for (std::size_t k = 0; k + 1 < block_start.size(); ++k)
      matrix = add_product(matrix, block_positions.data() + block_start[k], block_start[k + 1] - block_start[k], x, terms.data());
    if (shared.empty())
      return;
    for (const auto place : cut_positions)
      on_cuts[place] = 0;
    for (const auto place : shared.all())
      on_cuts[place] = terms[place];
    const unsigned n = stiffness->n_cell_dofs();
    matrix = cut_matrices.data();
    for (std::size_t k = 0; k < cut_positions.size(); k += n)
      matrix = add_product(matrix, cut_positions.data() + k, n, x, on_cuts.data());
    shared.add_of_others(on_cuts.data(), terms.data());
  }
} // namespace unilateral
