#include "unilateral/equilibration/flows_across_cuts.h"

#include "unilateral/equilibration/system_of_parts.h"

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
    std::map<unsigned, double> area; // of the cut to each other process; of the open boundary
    for (const CutFace &face : cut_faces)
      area[face.beyond] += face.area;
    area[processes.rank()] = open_area;
    std::map<unsigned, Eigen::MatrixXd> couplings;
    for (const auto &[process, of_cut] : area)
      couplings[process] = Eigen::MatrixXd::Constant(1, 1, of_cut);
    const SystemOfParts   system(processes, 1, couplings);
    const Eigen::VectorXd mu = system.solve(Eigen::VectorXd::Constant(1, std::accumulate(r.begin(), r.end(), 0.)));
    for (const CutFace &face : cut_faces)
    {
      const double flow = system.coupling(face.beyond)(0, 0) * (mu(processes.rank()) - mu(face.beyond)) * face.area / area[face.beyond];
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
