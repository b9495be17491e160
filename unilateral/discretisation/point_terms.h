// Forces, moments and springs at single points: what [[point_load]] and [[support]] add to A and f.
#pragma once

#include "unilateral/discretisation/problem.h"

#include <deal.II/lac/full_matrix.h>
#include <deal.II/lac/vector.h>

#include <vector>

namespace unilateral
{
  /// force v(x) + moment v'(x) in f, spring u(x) v(x) in a.
  struct PointTerm
  {
    std::vector<dealii::types::global_dof_index> dofs; ///< of the cell that holds x
    dealii::FullMatrix<double>                   matrix;
    dealii::Vector<double>                       load;
  };

  /// Of several processes each has those that lie in its part, and one of them those on a cut. Collective. Throws InputError where a point
  /// does not lie in the mesh.
  template <int dim>
  std::vector<PointTerm> point_terms(const Problem<dim> &problem);
} // namespace unilateral
