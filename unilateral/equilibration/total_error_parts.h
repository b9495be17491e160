// A bound of the distance to the solution of the continuous problem, and what it consists of.
#pragma once

#include <string>
#include <vector>

namespace unilateral
{
  /// Of ||u - u_h||_a, u the solution of the variational inequality itself: mesh, penalty and solver together.
  struct TotalError
  {
    bool                available = false;
    std::string         reason;             ///< why it is not available
    double              bound = 0;          ///< of the energy norm of the error
    double              flux_misfit = 0;    ///< ||k^(-1/2) (y - k grad v)||, of bodies ||C^(-1/2) (tau - sigma(v))||
    double              contact_misfit = 0; ///< (rho, v - psi), of bodies (rho, s - v.n): pressure where v is off its bound
    double              data_oscillation = 0;
    bool                load_unresolved = false; ///< it varies within cells by more than their rules can follow
    std::vector<double> cell_squares;            ///< by active cell: what it adds to the square of the bound, as far as that can be divided
  };
} // namespace unilateral
