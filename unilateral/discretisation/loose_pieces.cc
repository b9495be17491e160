#include "unilateral/discretisation/loose_pieces.h"

#include "unilateral/algebra/null_space.h"
#include "unilateral/base/point_text.h"
#include "unilateral/discretisation/rigid_body_modes.h"

#include <boost/pending/disjoint_sets.hpp>

#include <fmt/format.h>

#include <algorithm>
#include <set>
#include <vector>

namespace unilateral
{
  using namespace dealii;

  namespace
  {
    /// By unknown: a number that all unknowns of a piece have.
    template <int dim>
    std::vector<std::size_t> pieces_of_unknowns(const Problem<dim> &problem)
    {
      boost::disjoint_sets_with_storage<>  sets(problem.space.dof_handler.n_dofs());
      std::vector<types::global_dof_index> dofs(problem.space.fe->n_dofs_per_cell());
      for (const auto &cell : problem.space.dof_handler.active_cell_iterators())
      {
        cell->get_dof_indices(dofs);
        for (const auto dof : dofs)
          sets.union_set(dof, dofs[0]);
      }
      for (const auto &line : problem.space.dirichlet.get_lines())
        for (const auto &[dof, factor] : line.entries)
          sets.union_set(line.index, dof);
      std::vector<std::size_t> pieces(problem.space.dof_handler.n_dofs());
      for (std::size_t i = 0; i < pieces.size(); ++i)
        pieces[i] = sets.find_set(i);
      return pieces;
    }

    enum class HeldBy
    {
      conditions,
      contact, // at best
      nothing
    };

    /// What the conditions leave free of the modes of a piece, its contact could stop.
    template <int dim>
    HeldBy held_by(const Problem<dim> &problem, const ConstraintSet<dim> &set, const Eigen::MatrixXd &modes_of_piece)
    {
      const Eigen::MatrixXd free = modes_of_piece * free_combinations(problem, modes_of_piece);
      if (free.cols() == 0)
        return HeldBy::conditions;
      const Eigen::MatrixXd contact = contact_on_modes(set, free);
      return null_space(contact * contact.transpose() / std::max<double>(1, contact.cols()), not_felt).cols() == 0 ? HeldBy::contact
                                                                                                                   : HeldBy::nothing;
    }
  } // namespace

  template <int dim>
  void check_loose_pieces(const Problem<dim> &problem, Diagnostics &diagnostics)
  {
    const auto modes = rigid_body_modes(problem);
    if (modes.empty() || problem.form->order() > 1 || problem.form->holds_rigid_body_modes() || problem.space.subdomain)
      return;
    const auto                  pieces = pieces_of_unknowns(problem);
    const std::set<std::size_t> different(pieces.begin(), pieces.end());
    if (different.size() < 2)
      return;
    const ConstraintSet<dim> set = problem.make_constraint_set();
    const Eigen::MatrixXd    at = mode_matrix(problem, modes);
    for (const std::size_t piece : different)
    {
      Eigen::MatrixXd of_piece = at;
      for (std::size_t i = 0; i < pieces.size(); ++i)
        if (pieces[i] != piece)
          of_piece.row(i).setZero();
      const HeldBy held = held_by(problem, set, of_piece);
      if (held == HeldBy::conditions)
        continue;
      std::vector<types::global_dof_index> dofs(problem.space.fe->n_dofs_per_cell());
      for (const auto &cell : problem.space.dof_handler.active_cell_iterators())
      {
        cell->get_dof_indices(dofs);
        if (pieces[dofs[0]] != piece)
          continue;
        const auto text = [&](const std::string &what)
        {
          return fmt::format("the mesh falls into {} pieces that share no node, and {} the one at {}", different.size(), what,
                             point_text(cell->center()));
        };
        if (held == HeldBy::contact)
        {
          diagnostics.warning(problem.statement.model.where,
                              text("nothing but contact can hold") +
                                ": where the solver does not find that contact at once, it finds no minimum of the energy; "
                                "compute the piece alone, or hold it by a weak spring",
                              MessageName("hardly-held"));
          break;
        }
        throw InputError(problem.statement.model.where,
                         text("[boundary] and contact leave free to move") +
                           ": join the pieces in the mesh, compute this one alone, or hold it, be it by a weak spring",
                         MessageName("loose-piece"));
      }
    }
  }

  template void check_loose_pieces(const Problem<1> &, Diagnostics &);
  template void check_loose_pieces(const Problem<2> &, Diagnostics &);
  template void check_loose_pieces(const Problem<3> &, Diagnostics &);
} // namespace unilateral
