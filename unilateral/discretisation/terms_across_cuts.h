// Terms of A on faces between cells of two processes, each of which has one of the cells.
#pragma once

#include "unilateral/algebra/mumps_factors.h"
#include "unilateral/algebra/vector.h"
#include "unilateral/discretisation/cut_faces.h"
#include "unilateral/forms/face_side.h"

#include <deal.II/lac/full_matrix.h>
#include <deal.II/lac/sparse_matrix.h>
#include <deal.II/lac/vector.h>

#include <functional>
#include <utility>
#include <vector>

namespace unilateral
{
  /// A face on a cut: the own cell with its unknowns, and what the process beyond has sent, at the same points.
  template <int dim>
  struct FaceOnCut
  {
    typename dealii::DoFHandler<dim>::active_cell_iterator cell;
    unsigned                                               process = 0; ///< that has the other cell
    std::vector<dealii::types::global_dof_index>           dofs;
    FaceSide<dim>                                          here;   ///< columns: the unknowns of the cell
    FaceSide<dim>                                          beyond; ///< columns: the functions that were sent
    std::vector<double>                                    labels; ///< that came with them
  };

  /// What a process tells of its side: combinations of the functions of its cell, a column each, and numbers with them.
  struct SentFunctions
  {
    dealii::FullMatrix<double> combination; ///< unknowns of the cell x functions
    std::vector<double>        labels;
  };

  /// A function with the given values at the unknowns.
  template <typename ValueAt>
  SentFunctions one_function(const std::vector<dealii::types::global_dof_index> &dofs, const ValueAt &value_at)
  {
    SentFunctions sent{dealii::FullMatrix<double>(dofs.size(), 1), {}};
    for (std::size_t i = 0; i < dofs.size(); ++i)
      sent.combination(i, 0) = value_at(dofs[i]);
    return sent;
  }

  /// Visits the faces on cuts where the form has terms on faces between cells; @p functions: what process @p beyond is told of a cell.
  /// Collective, but each process has visits of its own.
  template <int dim>
  void for_each_face_on_cut(
    const Problem<dim>                                                                                            &problem,
    const std::function<SentFunctions(const std::vector<dealii::types::global_dof_index> &dofs, unsigned beyond)> &functions,
    const std::function<void(const FaceOnCut<dim> &)>                                                             &visit);

  /// a_F(u, v), v the functions of the own cell (rows), u these and those that were sent (columns).
  template <int dim>
  dealii::FullMatrix<double> rows_of_own_side(const FaceOnCut<dim> &face);

  /// Every process has the rows of its own side: a_F(u, v) for v on its cell, and u on both. That of u on the other cell is kept apart
  /// from the matrix of the own cells. Unknowns beyond the cut are known by their number among those of all processes (NumbersOfAll).
  class TermsAcrossCuts
  {
  public:
    TermsAcrossCuts() = default; ///< none

    /// Adds what couples unknowns of one cell to @p own, and what prescribed values make of all to @p load. Collective.
    template <int dim>
    TermsAcrossCuts(const Problem<dim> &problem, dealii::SparseMatrix<double> &own, dealii::Vector<double> &load);

    bool empty() const { return !present; } ///< on all processes

    /// Au += what unknowns beyond the cuts make of the own rows; sums over processes are still to come. Collective.
    void add_product(Vector &Au, const Vector &u) const;

    void add_diagonal(Vector &diagonal) const;

    const std::vector<MumpsFactors::Entry> &entries() const { return of_all; }

    std::vector<std::uint32_t> rows() const; ///< unknowns with such terms

  private:
    struct Coupling
    {
      std::uint32_t row, beyond; ///< unknown, place among those that come
    };
    bool                                    present = false;
    Processes                               team;
    std::vector<MumpsFactors::Entry>        of_all;    ///< by rows
    std::vector<Coupling>                   couplings; ///< of each of these
    std::vector<std::vector<std::uint32_t>> to_send;   ///< unknowns, by process
  };

  /// Adds what the faces on cuts make of prescribed values to @p load. Collective.
  template <int dim>
  void add_load_across_cuts(const Problem<dim> &problem, dealii::Vector<double> &load);
} // namespace unilateral
