// Changes of volume, averaged at vertices: what keeps triangles and tetrahedra from locking.
#pragma once

#include "unilateral/algebra/vector.h"
#include "unilateral/base/shared_unknowns.h"
#include "unilateral/discretisation/problem.h"

#include <deal.II/lac/full_matrix.h>

#include <functional>
#include <vector>

namespace unilateral
{
  /// Where the form says so (BilinearForm::averages_volume_in), a(u, v) has in place of int lambda div u div v the sum
  ///
  ///     sum over vertices of lambda_v m_v theta_v(u) theta_v(v),    m_v theta_v(u) = int psi_v div u,    m_v = int psi_v,
  ///
  /// psi_v the linear function of the vertex on the cells of one region, lambda_v the mean of lambda with the weight psi_v. It is the limit
  /// of the mixed method with continuous linear pressures as the mass matrix of the pressures is lumped: with P2 the element of Taylor and
  /// Hood, stable and of full order; with P1 the nodal averages of Bonet and Burton. References: C. Taylor, P. Hood, Computers & Fluids 1
  /// (1973) 73-100; J. Bonet, A. J. Burton, Comm. Numer. Meth. Engng 14 (1998) 437-449.
  template <int dim>
  class VertexVolumes
  {
  public:
    /// Of a part of the mesh: volumes and moduli are those of the whole, dofs and changes those of the own cells. A vertex on a cut that
    /// some process has a patch for has one, be it without unknowns, on all that have the vertex.
    explicit VertexVolumes(const Problem<dim> &problem);

    /// Some region takes part.
    static bool any(const Problem<dim> &problem);

    /// A vertex with the cells of one region around it.
    struct Patch
    {
      std::vector<dealii::types::global_dof_index> dofs;
      std::vector<double>                          change;      ///< int psi_v div phi of these
      double                                       volume = 0;  ///< m_v
      double                                       modulus = 0; ///< lambda_v m_v

      /// The part of a(., .): n x n. Of a patch that is not shared.
      dealii::FullMatrix<double> matrix() const;
    };

    const std::vector<Patch> &patches() const { return all; }
    const SharedUnknowns     &shared() const { return shared_patches; }

    /// lambda_v theta_v(u) of all patches, tensions: what a patch contributes to A u is its change times that.
    std::vector<double> tensions(const Vector &u) const;

    /// The number of the patch at a corner of a cell; the region of the cell takes part.
    unsigned patch_at(const typename dealii::DoFHandler<dim>::active_cell_iterator &cell, const unsigned corner) const
    {
      return number[std::size_t(cell->material_id()) * n_vertices + cell->vertex_index(corner)];
    }

  private:
    void share(const Problem<dim> &problem);

    std::size_t           n_vertices;
    std::vector<unsigned> number; ///< regions x vertices
    std::vector<Patch>    all;
    SharedUnknowns        shared_patches;
  };
} // namespace unilateral
