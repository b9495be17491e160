#include "unilateral/equilibration/flows_across_cuts.h"

#include <Eigen/Dense>

#include <numeric>

namespace unilateral
{
  using namespace dealii;

  template <int dim>
  FlowsAcrossCuts<dim>::FlowsAcrossCuts(const Problem<dim> &problem, const CutFaces<dim> &cuts, const std::vector<bool> &closed)
    : processes(problem.space.processes())
  {
    if constexpr (dim > 1)
      for (const auto &cell : problem.space.mesh.triangulation->active_cell_iterators())
        for (const unsigned f : cell->face_indices())
        {
          if (const auto *const beyond = cuts.find(cell->active_cell_index(), f))
            cut_faces.push_back({cell->active_cell_index(), f, beyond->process, cell->face(f)->measure()});
          else if (cell->at_boundary(f) && !closed[cell->face(f)->boundary_id()])
            open_area += cell->face(f)->measure();
        }
  }

  template <int dim>
  void FlowsAcrossCuts<dim>::solve(std::vector<double> &r)
  {
    flows.clear();
    if (processes.alone())
      return;
    const unsigned      n = processes.size();
    std::vector<double> area(n, 0.); // of the cut to each other process; of the open boundary
    for (const CutFace &face : cut_faces)
      area[face.beyond] += face.area;
    area[processes.rank()] = open_area;
    const std::vector<double> areas = processes.gather(area),
                              sums = processes.gather(std::vector<double>{std::accumulate(r.begin(), r.end(), 0.)});
    Eigen::MatrixXd matrix = Eigen::MatrixXd::Zero(n, n);
    // Both sides measure a cut, and round.
    const auto common = [&](const unsigned p, const unsigned q) { return 0.5 * (areas[p * n + q] + areas[q * n + p]); };
    for (unsigned p = 0; p < n; ++p)
      for (unsigned q = 0; q < n; ++q)
        if (p == q)
          matrix(p, p) += areas[p * n + p];
        else
        {
          matrix(p, p) += common(p, q);
          matrix(p, q) -= common(p, q);
        }
    const Eigen::VectorXd mu = matrix.ldlt().solve(Eigen::Map<const Eigen::VectorXd>(sums.data(), n));
    const unsigned        own = processes.rank();
    for (const CutFace &face : cut_faces)
    {
      const double flow = common(own, face.beyond) * (mu(own) - mu(face.beyond)) * face.area / area[face.beyond];
      flows[{face.cell, face.face}] = flow;
      r[face.cell] -= flow;
    }
  }

  template <int dim>
  double FlowsAcrossCuts<dim>::flow(const unsigned cell, const unsigned face) const
  {
    const auto found = flows.find({cell, face});
    return found == flows.end() ? 0 : found->second;
  }

  template class FlowsAcrossCuts<1>;
  template class FlowsAcrossCuts<2>;
  template class FlowsAcrossCuts<3>;
} // namespace unilateral
