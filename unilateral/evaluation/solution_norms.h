// Energy and norms of a discrete solution, and how far it passes a bound.
#pragma once

#include "unilateral/discretisation/problem.h"

#include <deal.II/lac/la_parallel_vector.h>

namespace unilateral
{
  struct SolutionNorms
  {
    double energy = 0; ///< 1/2 a(u,u) - f(u), boundary flux and springs included
    double L2 = 0, H1_semi = 0;
    double H2_semi = 0;      ///< m = 2; cell by cell
    double min = 0, max = 0; ///< over the nodes, and the components of u
  };

  template <int dim>
  SolutionNorms solution_norms(const Problem<dim> &problem, const dealii::LinearAlgebra::distributed::Vector<double> &u);

  /// max (u - bound)^+ (of a lower bound (bound - u)^+) over a lattice in every cell, four times as fine as the nodes.
  template <int dim>
  double largest_violation(const Problem<dim>                                       &problem,
                           const UnilateralCondition                                &condition,
                           const dealii::LinearAlgebra::distributed::Vector<double> &u);
} // namespace unilateral
