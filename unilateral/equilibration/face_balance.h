// Flows through faces that balance what each cell is short of.
#pragma once

#include "unilateral/algebra/vector.h"

#include <deal.II/grid/tria.h>

#include <vector>

namespace unilateral
{
  /// The flows c_E, one for each face E, with sum over the faces of K of +-c_E = r_K for all cells K and the least sum of c_E^2 / w_E,
  /// w_E about |E| k / (distance of the cells' centres): c = W S' mu with S W S' mu = r, a matrix with one unknown for each cell. Where one
  /// cell has several smaller neighbours on a face, the flow through it is spread evenly. No flow passes the parts of the boundary that
  /// are @p closed.
  template <int dim>
  class FaceBalance
  {
  public:
    /// @p stiffness of each active cell: an eigenvalue of k, or what stands for it; only the sharpness depends on it.
    FaceBalance(const dealii::Triangulation<dim> &triangulation, const std::vector<bool> &closed, const std::vector<double> &stiffness);

    /// @p r by active cell; where no part of the boundary is open its sum has to be zero. Throws std::runtime_error where the system cannot
    /// be factorised.
    void solve(const std::vector<double> &r);

    /// The flow out of active cell @p cell through its face.
    double flow(const std::size_t cell, const unsigned face) const { return flows[cell * n_faces + face]; }

  private:
    struct Entry
    {
      std::size_t cell;
      unsigned    face;
      double      share; ///< of the flow; negative: into the cell
    };
    struct Face
    {
      std::size_t begin, end; ///< its entries
      double      weight;
    };
    unsigned            n_faces = 0;
    bool                any_open = false; ///< of the boundary
    std::size_t         n_cells = 0;
    std::vector<Entry>  entries;
    std::vector<Face>   faces;
    std::vector<double> flows;
  };
} // namespace unilateral
