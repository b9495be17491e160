#include "unilateral/discretisation/loose_pieces.h"

#include "unilateral/algebra/null_space.h"
#include "unilateral/base/point_text.h"
#include "unilateral/discretisation/rigid_body_modes.h"

#include <fmt/format.h>

#include <algorithm>
#include <numeric>
#include <set>
#include <vector>

namespace unilateral
{
  using namespace dealii;

  namespace
  {
    constexpr double not_felt = 1e-7;

    /// Sets of unknowns that are joined one by one.
    class DisjointSets
    {
    public:
      explicit DisjointSets(const std::size_t n) : parent(n) { std::iota(parent.begin(), parent.end(), 0); }

      std::size_t find(std::size_t i)
      {
        while (parent[i] != i)
          i = parent[i] = parent[parent[i]];
        return i;
      }

      void join(const std::size_t i, const std::size_t j) { parent[find(i)] = find(j); }

    private:
      std::vector<std::size_t> parent;
    };

    /// By unknown: a number that all unknowns of a piece have.
    template <int dim>
    std::vector<std::size_t> pieces_of_unknowns(const Problem<dim> &problem)
    {
      DisjointSets                         sets(problem.space.dof_handler.n_dofs());
      std::vector<types::global_dof_index> dofs(problem.space.fe->n_dofs_per_cell());
      for (const auto &cell : problem.space.dof_handler.active_cell_iterators())
      {
        cell->get_dof_indices(dofs);
        for (const auto dof : dofs)
          sets.join(dof, dofs[0]);
      }
      for (const auto &line : problem.space.dirichlet.get_lines())
        for (const auto &[dof, factor] : line.entries)
          sets.join(line.index, dof);
      std::vector<std::size_t> pieces(problem.space.dof_handler.n_dofs());
      for (std::size_t i = 0; i < pieces.size(); ++i)
        pieces[i] = sets.find(i);
      return pieces;
    }
    /// What the conditions leave free of the modes of a piece, its contact could stop.
    template <int dim>
    bool is_held(const Problem<dim> &problem, const ConstraintSet<dim> &set, const Eigen::MatrixXd &modes_of_piece)
    {
      const Eigen::MatrixXd free = modes_of_piece * free_combinations(problem, modes_of_piece);
      Eigen::MatrixXd       felt = Eigen::MatrixXd::Zero(free.cols(), free.cols());
      for (std::size_t i = 0; i < set.size(); ++i)
      {
        Eigen::RowVectorXd at_point = Eigen::RowVectorXd::Zero(free.cols());
        for (std::size_t k = 0; k < set.trace[i].dofs.size(); ++k)
          at_point += set.trace[i].values[k] * free.row(set.trace[i].dofs[k]);
        felt += at_point.transpose() * at_point;
      }
      return free.cols() == 0 || null_space(felt / std::max<double>(1, set.size()), not_felt).cols() == 0;
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
