#include "unilateral/multigrid/sparse_transfer.h"

#include "unilateral/multigrid/cell_operator.h"

#include <cmath>
#include <limits>

namespace unilateral
{
  namespace
  {
    constexpr float         negligible = 1e-12f;
    constexpr std::uint32_t none = std::numeric_limits<std::uint32_t>::max();

    /// For each free unknown the first cell that has it, and its number there.
    struct Owner
    {
      std::uint32_t parent = none, child = 0, number = 0;
    };

    std::vector<Owner> find_owners(const ChildrenInPlaces           &children,
                                   const unsigned                    n_children,
                                   const std::vector<std::uint32_t> &dofs_of_cells,
                                   const unsigned                    n_cell_dofs,
                                   const std::vector<bool>          &is_free)
    {
      std::vector<Owner> owners(is_free.size());
      for (std::uint32_t parent = 0; parent < children.first.size(); ++parent)
      {
        const auto [first, end] = children.of(parent, n_children);
        for (std::size_t cell = first; cell < end; ++cell)
          for (std::uint32_t i = 0; i < n_cell_dofs; ++i)
            if (const auto dof = dofs_of_cells[cell * n_cell_dofs + i]; is_free[dof] && owners[dof].parent == none)
              owners[dof] = {parent, std::uint32_t(cell - first), i};
      }
      return owners;
    }
  } // namespace

  SparseTransfer transfer_in_places(const CellOperator                     &coarse,
                                    const std::vector<std::vector<double>> &to_child,
                                    const ChildrenInPlaces                 &children,
                                    const std::vector<std::uint32_t>       &dofs_of_cells,
                                    const std::vector<bool>                &is_free)
  {
    const unsigned             n = coarse.n_cell_dofs();
    std::vector<std::uint32_t> dofs(n);
    std::vector<float>         row(n), on_masters;
    SparseTransfer             transfer;
    transfer.row_start.reserve(is_free.size() + 1);
    for (const auto &[parent, child, number] : find_owners(children, to_child.size(), dofs_of_cells, n, is_free))
    {
      if (parent != none)
      {
        // A cell that stays as it is has its functions.
        const bool stays = children.stays[parent];
        for (unsigned j = 0; j < n; ++j)
          row[j] = stays ? (j == number ? 1 : 0) : to_child[child][number * n + j];
        const auto add = [&](const std::vector<std::uint32_t> &unknowns, const std::vector<float> &weights)
        {
          for (std::size_t j = 0; j < unknowns.size(); ++j)
            if (std::abs(weights[j]) > negligible)
            {
              transfer.columns.push_back(unknowns[j]);
              transfer.weights.push_back(weights[j]);
            }
        };
        if (const DependentCell *const cell = coarse.dependent(parent))
        {
          const auto &[masters, C] = cell->dependence;
          on_masters.assign(masters.size(), 0);
          for (unsigned j = 0; j < n; ++j)
            for (std::size_t k = 0; k < masters.size(); ++k)
              on_masters[k] += row[j] * float(C[j * masters.size() + k]);
          add(masters, on_masters);
        }
        else
        {
          coarse.cell_dofs(parent, dofs.data());
          add(dofs, row);
        }
      }
      transfer.row_start.push_back(transfer.columns.size());
    }
    transfer.columns.shrink_to_fit();
    transfer.weights.shrink_to_fit();
    return transfer;
  }
} // namespace unilateral
