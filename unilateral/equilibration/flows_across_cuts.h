// Flows through the cuts between subdomains.
#pragma once

#include "unilateral/discretisation/cut_faces.h"
#include "unilateral/discretisation/problem.h"

#include <map>
#include <utility>
#include <vector>

namespace unilateral
{
  /// What FaceBalance finds for all cells at once is found in two steps where the mesh is divided: first flows between processes, spread
  /// evenly over their common cuts, after which each part as a whole is in balance; then, by each process, those between its cells. The
  /// first are F_pq = a_pq (mu_p - mu_q), a_pq the area of the common cut, and F_p = a_p mu_p out of the parts of the boundary that are
  /// open, a_p their area: a system with one unknown for each process.
  template <int dim>
  class FlowsAcrossCuts
  {
  public:
    /// @p closed: parts of the boundary that no flow passes, by boundary_id.
    FlowsAcrossCuts(const Problem<dim> &problem, const CutFaces<dim> &cuts, const std::vector<bool> &closed);

    /// @p r by active cell: what each is short of. Takes the flows through cuts off it. Collective.
    void solve(std::vector<double> &r);

    /// The flow out of active cell @p cell through its face; zero where that is on no cut.
    double flow(unsigned cell, unsigned face) const;

  private:
    struct CutFace
    {
      unsigned cell, face, beyond; ///< active cell, its face, the process there
      double   area;
    };
    Processes                                       processes;
    std::vector<CutFace>                            cut_faces;
    double                                          open_area = 0;
    std::map<std::pair<unsigned, unsigned>, double> flows; ///< by cell and face
  };
} // namespace unilateral
