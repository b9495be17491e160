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
    /// What the conditions leave free of the modes of a piece, its contact could stop.
    template <int dim>
    bool is_held(const Problem<dim> &problem, const ConstraintSet<dim> &set, const Eigen::MatrixXd &modes_of_piece)
    {
      const Eigen::MatrixXd free = modes_of_piece * free_combinations(problem, modes_of_piece);
      const Eigen::MatrixXd contact = contact_on_modes(set, free);
      return free.cols() == 0 || null_space(contact * contact.transpose() / std::max<double>(1, contact.cols()), not_felt).cols() == 0;
    }
  } // namespace

  template <int dim>
  void check_loose_pieces(const Problem<dim> &problem)
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
      if (is_held(problem, set, of_piece))
        continue;
      std::vector<types::global_dof_index> dofs(problem.space.fe->n_dofs_per_cell());
      for (const auto &cell : problem.space.dof_handler.active_cell_iterators())
      {
        cell->get_dof_indices(dofs);
        if (pieces[dofs[0]] != piece)
          continue;
        throw InputError(
          problem.statement.model.where,
          fmt::format("the mesh falls into {} pieces that share no node, and neither [boundary] nor contact holds the one at {}: join "
                      "the pieces in the mesh, or hold this one, be it by a weak spring",
                      different.size(), point_text(cell->center())),
          MessageName("loose-piece"));
      }
    }
  }

  template void check_loose_pieces(const Problem<1> &);
  template void check_loose_pieces(const Problem<2> &);
  template void check_loose_pieces(const Problem<3> &);
} // namespace unilateral
