#include "unilateral/equilibration/cut_faces.h"

#include <algorithm>
#include <array>
#include <utility>
#include <vector>

namespace unilateral
{
  using namespace dealii;

  template <int dim>
  CutFaces<dim>::CutFaces(const Problem<dim> &problem)
  {
    if (!problem.space.subdomain)
      return;
    struct Face
    {
      std::array<double, dim> centre;
      unsigned                process, region;
    };
    // Each face is told at all its vertices, so that every process that has it hears of it at each of them.
    struct OwnFace
    {
      Point<dim> centre;
      double     size;
      unsigned   vertex; ///< the unknown at one of its vertices
      unsigned   cell, face;
    };
    const unsigned                         own_rank = problem.space.processes().rank();
    std::vector<OwnFace>                   own;
    std::vector<std::pair<unsigned, Face>> told;
    for (const auto &cell : problem.space.dof_handler.active_cell_iterators())
      for (const unsigned f : cell->face_indices())
        if (cell->at_boundary(f) && !problem.space.is_outside(cell, f))
        {
          const auto face = cell->face(f);
          own.push_back({face->center(), cell->diameter(), unsigned(face->vertex_dof_index(0, 0)), cell->active_cell_index(), f});
          Face record{{}, own_rank, cell->material_id()};
          for (unsigned d = 0; d < dim; ++d)
            record.centre[d] = own.back().centre[d];
          for (const unsigned v : face->vertex_indices())
            told.emplace_back(face->vertex_dof_index(v, 0), record);
        }
    problem.space.shared().share(told);
    for (const OwnFace &face : own)
    {
      // The same corners, summed in another order.
      const double slack = 1e-9 * (face.size + face.centre.norm() * 1e-3);
      const auto   is_other_side = [&](const Face &other)
      {
        double square = 0;
        for (unsigned d = 0; d < dim; ++d)
          square += (other.centre[d] - face.centre[d]) * (other.centre[d] - face.centre[d]);
        return other.process != own_rank && square <= slack * slack;
      };
      auto at = std::lower_bound(told.begin(), told.end(), face.vertex,
                                 [](const auto &entry, const unsigned vertex) { return entry.first < vertex; });
      while (at != told.end() && at->first == face.vertex && !is_other_side(at->second))
        ++at;
      if (at == told.end() || at->first != face.vertex)
        complete = false;
      else
        beyond[{face.cell, face.face}] = {at->second.process, types::material_id(at->second.region)};
    }
  }

  template class CutFaces<1>;
  template class CutFaces<2>;
  template class CutFaces<3>;
} // namespace unilateral
