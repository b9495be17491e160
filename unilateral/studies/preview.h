// A case looked over without solving it: mesh, names, spaces, gaps.
#pragma once

#include "unilateral/base/progress.h"
#include "unilateral/discretisation/problem_statement.h"
#include "unilateral/output/vtu_file.h"
#include "unilateral/studies/inf_sup_study.h"

#include <nlohmann/json_fwd.hpp>

#include <string>
#include <vector>

namespace unilateral
{
  /// What `unilateral check` shows.
  struct CheckReport
  {
    struct Level
    {
      unsigned    level = 0;
      std::size_t n_cells = 0, n_dofs = 0, n_points = 0;
    };
    /// Gap between the Dirichlet lift (0 inside) and the bound, per side of a constraint; negative where the lift violates it.
    struct Gap
    {
      std::string on, side, quadrature;
      bool        exact_pairing = false;
      std::size_t n_points = 0;
      double      min = 0, max = 0, share_violated = 0; ///< violated: initially penetrating
      std::size_t n_missed = 0;                         ///< points that never meet the surface of the obstacle
    };
    /// A part of the boundary on the finest mesh.
    struct Part
    {
      std::string         name;
      std::size_t         n_faces = 0;
      double              measure = 0; ///< area; in 2-D length; in 1-D the number of ends
      std::vector<double> centre;      ///< of its measure; empty without faces
      std::vector<double> normal;      ///< mean of the outward unit normal: of length 1 where the part is flat, 0 where it is closed
    };
    std::vector<Part>        parts;
    VtuGrid                  boundary; ///< if asked for: the faces of the finest mesh, each with the number of its part, and its normal
    std::vector<std::string> region_names;
    std::vector<Level>       levels;
    std::vector<Gap>         gaps;
    std::vector<InfSupStudy> stability; ///< per constraint: inf-sup constants of the coarsest levels, where they cost next to nothing
    double                   h_min = 0, h_max = 0;
    std::string              element;
    std::string              linear_solver; ///< that a run takes, and why
  };

  /// Builds everything up to the constraint sets on every level, and solves nothing. @p with_boundary: CheckReport::boundary, too.
  template <int dim>
  CheckReport check(const ProblemStatement &statement, Diagnostics &diagnostics, Progress &progress, bool with_boundary = false);

  /// What `unilateral check --json` prints.
  nlohmann::ordered_json to_json(const CheckReport &report, const CaseSource &source, unsigned dimension);
} // namespace unilateral
