// What the integrand of a functional can use of a solution.
#pragma once

#include <string>
#include <vector>

namespace unilateral
{
  /// A number at a point; directions and components count from 0.
  struct SolutionQuantity
  {
    enum class Kind
    {
      value,     ///< u, u_i
      gradient,  ///< du_i/dx_j
      hessian,   ///< d2u/dx_i dx_j, m = 2
      flux,      ///< component i of the recovered flux: k grad u, or the stress in the order of Flux; m = 1
      von_mises, ///< of the recovered stress
      normal,    ///< outward, or at constraint points the direction in which u is bounded
      pressure,  ///< lambda at constraint points
      gap        ///< distance to the bound at constraint points, negative where it is violated
    };
    std::string name;
    Kind        kind = Kind::value;
    unsigned    i = 0, j = 0;

    /// pressure and gap: an integral of it is the sum by I_G over the constraint points.
    bool at_constraint_points_only() const { return kind == Kind::pressure || kind == Kind::gap; }
  };

  /// All those of a solution with @p n_components of u, in H^m with m = @p order. One component: u, du_dx, d2u_dxdy, flux_x; several: ux,
  /// dux_dy, stress_xx, von_mises; always nx, pressure, gap.
  std::vector<SolutionQuantity> solution_quantities(unsigned n_components, unsigned order, unsigned dim);

  std::vector<std::string> names_of(const std::vector<SolutionQuantity> &quantities);
} // namespace unilateral
