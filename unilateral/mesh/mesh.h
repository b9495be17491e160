// A triangulation with named parts and regions.
#pragma once

#include "unilateral/mesh/curved_cells.h"

#include <deal.II/grid/tria.h>

#include <memory>
#include <string>
#include <vector>

namespace unilateral
{
  /// A coarse mesh, not yet refined, with the names its file or shape gives.
  template <int dim>
  struct Mesh
  {
    /// Its manifolds may refer to it (ball): a copy made by copy_triangulation() must not outlive it.
    std::unique_ptr<dealii::Triangulation<dim>> triangulation;
    std::vector<std::string>                    part_names;                  ///< index: boundary_id of the faces
    std::vector<std::string>                    region_names;                ///< index: material_id of the cells
    bool                                        curved = false;              ///< geometry of order > 1 is worth its price (ball, shell)
    bool                                        approximates_curves = false; ///< of the drawing that it was made from
    bool                                        simplex = false;
    std::shared_ptr<CurvedCells<dim>>           curved_cells; ///< of a file with elements of order 2, and simplices that follow a manifold
    std::vector<std::string>                    warnings;     ///< what was left out of a file, a sentence each
  };
} // namespace unilateral
