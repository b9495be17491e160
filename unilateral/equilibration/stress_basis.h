// All stresses on a cell with given tractions and divergence.
#pragma once

#include "unilateral/equilibration/composite_stresses.h"

#include <Eigen/Core>

namespace unilateral
{
  /// The stress with data d is `particular` d plus any combination of the columns of `bubbles`, which are orthonormal and have no traction
  /// and no divergence. By a QR decomposition that shows the rank, for shapes that many cells have.
  struct StressBasis
  {
    /// Throws std::domain_error where tractions and divergence cannot all be had.
    template <int dim>
    explicit StressBasis(const CompositeStresses<dim> &stresses);

    Eigen::MatrixXd particular, bubbles;
  };
} // namespace unilateral
