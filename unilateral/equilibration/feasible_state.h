// A function that keeps the bounds everywhere, next to a discrete one that keeps them at points.
#pragma once

#include "unilateral/algebra/vector.h"
#include "unilateral/discretisation/problem.h"
#include "unilateral/equilibration/tabulated_element.h"

#include <deal.II/base/tensor.h>

#include <vector>

namespace unilateral
{
  /// v in K, the set of the continuous problem, close to u_h in V_h: v has the prescribed values of the boundary and keeps the bounds at
  /// every place, not only at the points of I_G. With psi a bound, I its interpolant, chi in V_h one at the nodes with pressure and zero at
  /// the others,
  ///     v = max(u_h + eta + chi (psi - I psi), psi)      for u >= psi, min for u <= psi,
  /// eta the difference between the prescribed values and those of u_h, blended to zero across the cells at the boundary (2-D). In contact
  /// v is the bound itself. Where the trace on a part of the boundary is bounded, u_h is first moved off the bound by what it violates.
  ///
  /// rho >= 0 is the positive part of a pressure in V_h, in the domain times a factor for each cell with which it exerts the force of the
  /// whole: where it is a force at a few nodes, as at ridges of a bound or at a free edge, polynomials of degree 2 and more turn negative
  /// next to them.
  template <int dim>
  class FeasibleState
  {
  public:
    /// @p u with its prescribed values; @p pressures: functions of V_h, by block of the constraint set, see nodal_pressure().
    FeasibleState(const Problem<dim> &problem, const Vector &u, const std::vector<Vector> &pressures);

    /// Why v would not be in K as far as that is known; empty: it is. Throws InputError where a bound has no value.
    std::string obstacle() const { return reason; }

    struct AtPoints
    {
      std::vector<double>                 u, v;
      std::vector<dealii::Tensor<1, dim>> u_gradient, v_gradient;
      std::vector<std::vector<double>>    pressure, distance; ///< by bound: rho, and |v - psi|; of bounds in the domain, on faces too
      bool                                kink = false;       ///< v changes, or may change, from u_h to a bound between these points, or a
                                                              ///< pressure ends
      bool rough = false;                                     ///< the interpolant of a bound that v touches misses some of it
    };
    using Cell = typename dealii::DoFHandler<dim>::active_cell_iterator;
    enum class Wanted
    {
      u_and_pressure, ///< all else of @p state means nothing then
      values,         ///< the gradients of @p state are empty then
      values_and_gradients
    };
    void evaluate(const Cell                                 &cell,
                  const StraightCell<dim>                    &straight,
                  const TabulatedElement<dim>                &tabulated,
                  const typename StraightCell<dim>::AtPoints &at,
                  Wanted                                      wanted,
                  AtPoints                                   &state) const;

    /// A bound that v touches in the cell jumps, inside or on a face: v is not in H^1 then. Looked for between points: a jump that no pair
    /// of them straddles is not seen.
    bool bound_jumps(const Cell                                 &cell,
                     const StraightCell<dim>                    &straight,
                     const typename StraightCell<dim>::AtPoints &at,
                     const AtPoints                             &state) const;

    /// The pressure ends in the cell.
    bool at_free_boundary(const Cell &cell) const;

  private:
    struct Bound
    {
      /// At one of these unknowns.
      bool in_contact_at(const std::vector<dealii::types::global_dof_index> &dofs) const;

      const UnilateralCondition *condition;
      Vector                     pressure, interpolant, contact; ///< the latter two of bounds in the domain
      mutable std::vector<float> kept_shares;                    ///< by active cell; negative: not known yet
    };
    /// By vertex: whether prescribed values hold it, and by how much it has to move up or down.
    struct VertexMoves
    {
      std::vector<bool>   held;
      std::vector<double> up, down;
    };
    void        interpolate_bounds();
    VertexMoves vertices_held() const;                                       // collective
    void        find_moves(VertexMoves &of_vertices);                        // where u crosses bounds on the boundary
    void        move_off_boundary_bounds(VertexMoves &of_vertices);          // collective
    void        take_largest_at_vertices(std::vector<double> &values) const; // collective
    void        agree_on_lifted_parts();                                     // collective
    void        add_boundary_values(const Cell                                 &cell,
                                    const StraightCell<dim>                    &straight,
                                    const TabulatedElement<dim>                &tabulated,
                                    const typename StraightCell<dim>::AtPoints &at,
                                    AtPoints                                   &state) const;
    struct OnCell;
    /// Force of the pressure over that of its positive part.
    double kept_share(std::size_t b, const Cell &cell, const StraightCell<dim> &straight) const;
    /// The bound and its gradient at the points.
    struct Psi
    {
      std::vector<double>                 values;
      std::vector<dealii::Tensor<1, dim>> gradients; ///< where they have been needed
    };
    /// chi (psi - I psi) is added to v; finds psi.
    void follow_bound(std::size_t b, const OnCell &functions, Psi &psi, AtPoints &state) const;
    /// v becomes max(v, psi), or min.
    void cut_off_at_bound(std::size_t b, const OnCell &functions, Psi &psi, AtPoints &state) const;
    void look_at_boundary_values();

    const Problem<dim>                &problem;
    const Vector                      &u;
    std::vector<TabulatedElement<dim>> faces, at_boundary; ///< a few points on each; more
    TabulatedElement<dim>              fine;               ///< many in the cell
    Vector                             moved;              ///< u off the bounds on the boundary
    bool                               moves = false;
    std::vector<Bound>                 bounds;   ///< by block
    std::vector<bool>                  lifted;   ///< by boundary_id: the prescribed values are no function of V_h
    double                             size = 0; ///< of u and the bounds it meets
    std::string                        reason;
  };
} // namespace unilateral
