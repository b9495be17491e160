// Derivatives of a finite element function, recovered from the points where they are most accurate.
#pragma once

#include "unilateral/discretisation/problem.h"

#include <deal.II/fe/fe_values.h>

#include <Eigen/Core>

#include <array>
#include <functional>
#include <map>
#include <vector>

namespace unilateral
{
  /// At the points of Gauss with p in each direction the flux of a function of degree p is better than elsewhere by one order in h. Around
  /// each vertex the polynomial of degree p that fits it best in these points of the cells there (of one region) is taken for the flux at
  /// the nodes of these cells, with the weight of the vertex's hat function: superconvergent patch recovery. On triangles and tetrahedra
  /// the points are those of rules of degree 2.
  ///
  /// A patch around a vertex on a cut between subdomains has the cells of all processes there.
  ///
  /// Means of both sides do as well for odd p where u is smooth; for even p the errors on both sides of a node are alike, and means keep
  /// them. Reference:
  /// O. C. Zienkiewicz, J. Z. Zhu, Int. J. Numer. Meth. Engng 33 (1992) 1331-1364.
  template <int dim>
  class PatchRecovery
  {
  public:
    PatchRecovery(const Problem<dim> &problem, unsigned n_flux);

    /// Worth its price: derivatives of first order, and p is even, or at least 3 for an indicator.
    static bool is_better_than_means(const Problem<dim> &problem, bool for_indicator);

    /// The next cell, in the order of the active cells of FunctionSpace::dof_handler: the flux as a function of node_element(), @p n_flux
    /// numbers a node, and the numbers of its nodes.
    void add_cell(const typename dealii::DoFHandler<dim>::active_cell_iterator &cell,
                  const double                                                 *flux,
                  const std::vector<dealii::types::global_dof_index>           &nodes);

    /// Calls take(node, region, weight, flux) for the nodes of each cell at each vertex whose cells are enough for a polynomial.
    /// Collective.
    using Take = std::function<void(dealii::types::global_dof_index, dealii::types::material_id, double, const double *)>;
    void for_each_value(const Take &take);

  private:
    struct CellAtVertex
    {
      unsigned vertex, cell, corner;
      unsigned dof; ///< the first unknown there
    };
    /// The flux at one of the points, on whichever process.
    struct Sample
    {
      unsigned                   rank;
      dealii::types::material_id region;
      std::array<double, dim>    x;
      std::array<double, 6>      flux;
    };
    using SamplesByDof = std::map<unsigned, std::vector<Sample>>;
    /// Of the polynomial of a patch: where it is centred, its unit of length, coefficients x n_flux.
    struct Polynomial
    {
      dealii::Point<dim> center;
      double             size = 0;
      Eigen::MatrixXd    coefficients;
      bool               determined = false;
    };

    void powers(const dealii::Point<dim> &x, Eigen::VectorXd &result) const; ///< of scaled coordinates, to the degree p
    /// To the samples of the cells of a patch.
    Polynomial   fit(const CellAtVertex *first, const CellAtVertex *last, const SamplesByDof &of_others) const;
    void         append_samples(const CellAtVertex &cell, std::vector<Sample> &result) const;
    SamplesByDof samples_of_others() const; ///< at vertices on cuts

    const dealii::Point<dim> &node_of(const CellAtVertex &cell, const unsigned i) const
    {
      return points[std::size_t(cell.cell) * rule.size() + n_samples + i];
    }

    const Problem<dim>                          &problem;
    const unsigned                               n_flux, degree;
    unsigned                                     n_coefficients, n_samples, n_nodes;
    dealii::Quadrature<dim>                      rule; ///< sample points, then nodes
    dealii::FEValues<dim>                        places;
    Eigen::MatrixXd                              node_functions; ///< sample points x nodes
    std::vector<std::array<double, 8>>           hats;           ///< of the corners, at the nodes
    std::vector<dealii::Point<dim>>              points;         ///< by cell those of the rule
    std::vector<double>                          samples;        ///< by cell, sample points x n_flux
    std::vector<dealii::types::global_dof_index> nodes;          ///< by cell
    std::vector<dealii::types::material_id>      regions;        ///< by cell
    std::vector<CellAtVertex>                    at_vertices;
  };
} // namespace unilateral
