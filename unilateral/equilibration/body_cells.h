// The cells of a body with their composite stresses and the points at which integrals are taken.
#pragma once

#include "unilateral/discretisation/problem.h"
#include "unilateral/equilibration/composite_stresses.h"
#include "unilateral/equilibration/stress_basis.h"
#include "unilateral/equilibration/tabulated_element.h"

#include <map>
#include <memory>
#include <optional>
#include <vector>

namespace unilateral
{
  /// Parallelograms, parallelepipeds and simplices are affine images of the reference cell and share its CompositeStresses. Other
  /// quadrilaterals have their own, in coordinates X, x = centre + size X.
  template <int dim>
  class BodyCells
  {
  public:
    BodyCells(const Problem<dim> &problem, unsigned stress_degree);

    /// Points in all parts of the split.
    struct Rule
    {
      TabulatedElement<dim> element;   ///< the displacement's, at the points; weights are those in the coordinates of the stresses
      Eigen::MatrixXd       functions; ///< of the stresses on the part: points x functions
      std::vector<unsigned> part;
    };

    /// What is needed on a cell: x = origin + J X takes the coordinates of the stresses to the cell.
    struct OnCell
    {
      StraightCell<dim>                    straight;
      const CompositeStresses<dim>        *stresses;
      const StressBasis                   *basis; ///< null where the stresses are those of this cell alone
      const Rule                          *rule;
      dealii::Tensor<2, dim>               J, inverse_J;
      double                               det; ///< |det J|
      dealii::Point<dim>                   origin;
      typename StraightCell<dim>::AtPoints at;
      bool                                 affine;
      std::shared_ptr<const void>          own[2]; ///< what belongs to this cell alone

      dealii::Point<dim> place(const dealii::Point<dim> &X) const { return origin + J * X; }
    };
    using Cell = typename dealii::DoFHandler<dim>::active_cell_iterator;

    /// @p fine: for data that are no polynomials. Throws std::domain_error on hexahedra that are no parallelepipeds.
    OnCell on(const Cell &cell, bool fine) const;

    const unsigned degree; ///< of the stresses

  private:
    static Rule make_rule(const CompositeStresses<dim>          &stresses,
                          const dealii::FiniteElement<dim>      &element,
                          unsigned                               degree,
                          const std::vector<dealii::Point<dim>> *corners);

    const Problem<dim> &problem;
    const bool          simplex;
    const unsigned      plain_degree;
    struct Reference;
    const Reference &reference;
    const Rule       plain, fine;
  };
} // namespace unilateral
