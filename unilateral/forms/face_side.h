// What each of the two cells at a face knows of the terms there, so that one of them may be that of another process.
#pragma once

#include <deal.II/base/point.h>
#include <deal.II/lac/full_matrix.h>

#include <vector>

namespace unilateral
{
  /// Of the terms int_F -m(u) [v_n] - [u_n] m(v) + sigma [u_n] [v_n] ds, with [.] the jump, m the mean moment of both sides, what a cell
  /// K at F contributes. Rows: points of a rule on F; columns: functions on K.
  template <int dim>
  struct FaceSide
  {
    std::vector<dealii::Point<dim>> points;
    std::vector<double>             JxW;
    dealii::FullMatrix<double>      slope;                  ///< du/dn, n the outer normal of K: the jump is the sum of both sides
    dealii::FullMatrix<double>      moment;                 ///< half of M_nn(u): m is the sum of both sides
    std::vector<double>             penalty;                ///< its part of sigma, which is the sum of both sides
    double                          half_inverse_width = 0; ///< 1/(2h), with h = |K|/|F|
  };

  /// The jump of the slope and the mean moment, at the points of one side, of functions that stand on either side or on both.
  class FaceTraces
  {
  public:
    explicit FaceTraces(const unsigned n_functions) : n_functions(n_functions) {}

    /// Column k of @p side is of function @p function[k], none where that is dealii::numbers::invalid_unsigned_int; its point that lies at
    /// point q of the first side is @p place[q].
    template <int dim>
    void add(const FaceSide<dim> &side, const std::vector<unsigned> &function, const std::vector<unsigned> &place);

    /// Adds the terms of the face to a matrix whose rows are the first n functions.
    void add_terms(dealii::FullMatrix<double> &matrix) const;

    /// Adds int_F {1/h} [du/dn] [dv/dn] ds.
    void add_gram(dealii::FullMatrix<double> &matrix) const;

  private:
    unsigned                   n_functions;
    dealii::FullMatrix<double> jump, mean_moment;
    std::vector<double>        penalty, JxW;
    double                     mean_inverse_width = 0;
  };

  /// The place of each point of @p here among those of @p there: the two cells at a side may run through it either way.
  template <int dim>
  std::vector<unsigned> matching_points(const std::vector<dealii::Point<dim>> &here, const std::vector<dealii::Point<dim>> &there);
} // namespace unilateral
