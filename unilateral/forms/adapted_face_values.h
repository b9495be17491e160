// Integrals over faces of functions that may jump there.
#pragma once

#include "unilateral/functions/field_function.h"

#include <deal.II/base/quadrature.h>
#include <deal.II/fe/fe_values.h>
#include <deal.II/grid/tria.h>

#include <Eigen/Core>

#include <memory>
#include <optional>
#include <vector>

namespace unilateral
{
  /// FEFaceValues at the points of a rule, or at more of them on a face where a function needs them.
  ///
  /// A rule is compared with itself on the halves of the face (the quarters in 3-D): where the integrals of a function over the face differ
  /// by more than 1e-3 of its largest value, the face is cut where they differ, again and again, down to 2^-30 of its size in 2-D and to
  /// 2^-4 in 3-D, where a jump runs along a line, and no further where more pieces differ than a jump would leave. A function that is
  /// smooth on the scale of the face keeps the rule, and what a jump adds to the load is then right to about 1e-9 in 2-D and 1e-2 in 3-D of
  /// what the face bears. A jump between the outermost points and the end of the face is seen by values there that are not those of the
  /// polynomial through the points. A peak that lies between all points of the halves is not seen.
  template <int dim>
  class AdaptedFaceValues
  {
  public:
    AdaptedFaceValues(const dealii::Mapping<dim>        &mapping,
                      const dealii::FiniteElement<dim>  &fe,
                      const dealii::Quadrature<dim - 1> &rule,
                      dealii::UpdateFlags                flags);

    using Cell = typename dealii::DoFHandler<dim>::active_cell_iterator;

    /// The values on face number @p face of @p cell, valid until the next call.
    const dealii::FEFaceValues<dim> &reinit(const Cell &cell, unsigned face, const std::vector<FieldFunction> &functions);

    /// A function jumps between the outermost points of the rule and an end of the face, and is smooth at the points, as far as its values
    /// show.
    bool jumps_beyond_points(const Cell &cell, unsigned face, const std::vector<FieldFunction> &functions);

  private:
    /// The reference face, shrunk by `size` and moved to `corner`; a negative size turns it about, as the triangle in the middle of four.
    struct Piece
    {
      dealii::Point<dim - 1> corner;
      double                 size = 1;
    };
    class Subdivision; // of one face

    /// The ends of the reference face, corners and middles of edges in 3-D, from just inside, and what a polynomial has there.
    struct Ends
    {
      explicit Ends(const AdaptedFaceValues &values);

      std::vector<dealii::Point<dim - 1>> points;
      Eigen::MatrixXd                     from_rule;    ///< ends x points of the rule
      Eigen::MatrixXd                     highest_part; ///< coefficients of the highest degree x points of the rule
      dealii::Quadrature<dim - 1>         with_rule;    ///< the points of the rule, then these
      dealii::FEFaceValues<dim>           on_face;
    };

    Eigen::MatrixXd             placing_functions(const std::vector<dealii::Point<dim - 1>> &parameters) const;
    std::vector<Piece>          halves(const Piece &piece) const;
    std::vector<Piece>          halves(const std::vector<Piece> &pieces) const;
    dealii::Quadrature<dim - 1> on_pieces(const std::vector<Piece> &pieces) const;

    /// The pieces of the face that are to have the rule each; nothing where the rule itself will do.
    std::optional<std::vector<Piece>> pieces_for(const Cell &cell, unsigned face, const std::vector<FieldFunction> &functions);

    const dealii::Mapping<dim>                &mapping;
    const dealii::FiniteElement<dim>          &fe;
    const dealii::Quadrature<dim - 1>          rule;
    const dealii::UpdateFlags                  flags;
    dealii::FEFaceValues<dim>                  ordinary;
    std::unique_ptr<dealii::FEFaceValues<dim>> adapted, halves_of_face;
    std::unique_ptr<Ends>                      ends;
    Eigen::MatrixXd                            placing_at_halves, fit_of_placing; ///< placing_functions() at the points of all halves
  };
} // namespace unilateral
