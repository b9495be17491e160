#include "unilateral/equilibration/cut_faces.h"

#include <algorithm>
#include <vector>

namespace unilateral
{
  using namespace dealii;

  template <int dim>
  CutFaces<dim>::CutFaces(const Problem<dim> &problem)
  {
    if (!problem.space.subdomain)
      return;
    struct Record
    {
      Point<dim>         centre;
      double             size;
      unsigned           process, region;
      unsigned long long cell;
      unsigned           face;
    };
    const Processes    &processes = problem.space.processes();
    std::vector<Record> own;
    for (const auto &cell : problem.space.mesh.triangulation->active_cell_iterators())
      for (const unsigned f : cell->face_indices())
        if (cell->at_boundary(f) && !problem.space.is_outside(cell, f))
          own.push_back({cell->face(f)->center(), cell->diameter(), processes.rank(), cell->material_id(), cell->active_cell_index(), f});
    std::vector<Record> all = processes.gather(own);
    std::sort(all.begin(), all.end(), [](const Record &a, const Record &b) { return a.centre[0] < b.centre[0]; });
    for (const Record &face : own)
    {
      // The same corners, summed in another order.
      const double slack = 1e-9 * (face.size + face.centre.norm() * 1e-3);
      auto         other = std::lower_bound(all.begin(), all.end(), face.centre[0] - slack,
                                            [](const Record &record, const double x) { return record.centre[0] < x; });
      while (other != all.end() && other->centre[0] <= face.centre[0] + slack &&
             (other->process == processes.rank() || other->centre.distance(face.centre) > slack))
        ++other;
      if (other == all.end() || other->centre[0] > face.centre[0] + slack)
        complete = false;
      else
        beyond[{face.cell, face.face}] = {other->process, types::material_id(other->region)};
    }
  }

  template class CutFaces<1>;
  template class CutFaces<2>;
  template class CutFaces<3>;
} // namespace unilateral
