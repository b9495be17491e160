// An indicator of the discretisation error, to measure other errors against.
#pragma once

#include "unilateral/discretisation/problem.h"
#include "unilateral/inequality/discrete_problem.h"

namespace unilateral
{
  template <int dim>
  class PatchRecovery;

  /// What a RecoveredFlux is for: of odd degrees from 3 on means give the sharper bounds and stresses, and estimates need patches, since
  /// means leave the flux at the nodes inside cells as it is, which hides most of an error that is not smooth.
  enum class FluxFor
  {
    values,
    indicator
  };

  /// The flux of a function of V_h (k grad u, or the stress) at the nodes: on each cell the polynomial of the element that fits it best,
  /// then the mean over the cells of a region that meet at a node, weighted with their volumes; for elements of even degree, and for the
  /// indicator of all but the lowest, by PatchRecovery instead.
  template <int dim>
  class RecoveredFlux
  {
  public:
    /// @p u with its prescribed values.
    RecoveredFlux(const Problem<dim> &problem, const Vector &u, FluxFor purpose = FluxFor::values);

    const dealii::DoFHandler<dim> *nodes; ///< as FunctionSpace::nodes(); where u is scalar and continuous, that of u

    Flux at(dealii::types::global_dof_index node, dealii::types::material_id region) const;

    /// Mean over the regions that meet at the node.
    Flux mean_at(dealii::types::global_dof_index node) const;

  private:
    std::size_t place(const dealii::types::global_dof_index node, const dealii::types::material_id region) const
    {
      return node + std::size_t(n_nodes) * region;
    }

    void add(std::vector<double> &sums, std::vector<double> &weights, std::size_t at, double weight, const double *flux) const;
    void share(const Problem<dim> &problem, std::vector<double> &sums, std::vector<double> &weights) const;
    void take_from_patches(const Problem<dim> &problem, PatchRecovery<dim> &patches);
    void make_continuous(const dealii::AffineConstraints<double> &hanging_nodes); ///< there

    template <int d>
    friend double discretisation_indicator(const Problem<d> &, const Vector &, const RecoveredFlux<d> &, std::vector<double> *);

    std::unique_ptr<dealii::DoFHandler<dim>> own_nodes;

    std::size_t         n_nodes, n_regions;
    unsigned            n_flux; ///< numbers at a place
    std::vector<double> values; ///< regions x nodes x n_flux
    std::vector<bool>   used;   ///< the node belongs to the region
  };

  /// eta = ( int (G - q) . C^-1 (G - q) )^1/2, q = k grad u or the stress, C^-1 its energy, G = RecoveredFlux: an estimate of
  /// ||u - u_h||_a, asymptotically right for smooth solutions, not a bound. G is averaged within each region, so that jumps of the
  /// stiffness do not count. Units of the energy norm. @p u with its prescribed values, and the flux recovered from it; where the indicator
  /// needs another one, see FluxFor, it is recovered here.
  /// Reference: O. C. Zienkiewicz, J. Z. Zhu, Int. J. Numer. Meth. Engng 24 (1987) 337-357.
  template <int dim>
  /// @p cell_squares, if given: its square cell by cell.
  double discretisation_indicator(const Problem<dim>       &problem,
                                  const Vector             &u,
                                  const RecoveredFlux<dim> &recovered,
                                  std::vector<double>      *cell_squares = nullptr);

  /// ||u||_a without springs, prescribed values included: ( int q . C^-1 q + c u^2 )^1/2, q the flux of u, c the reaction of a membrane.
  /// What the indicator is to be compared with; its unit.
  template <int dim>
  double energy_norm(const Problem<dim> &problem, const Vector &u);
} // namespace unilateral
