// Results as text for people.
#pragma once

#include "unilateral/output/results.h"
#include "unilateral/studies/epsilon_study.h"
#include "unilateral/studies/inf_sup_study.h"
#include "unilateral/studies/mesh_study.h"
#include "unilateral/studies/preview.h"
#include "unilateral/studies/quadrature_study.h"

#include <string>

namespace unilateral
{
  /// A line a constraint, then the solution, the errors and the expectations that hold; those that fail are messages of their own.
  std::string summary(const RunResult &result);

  /// One plain sentence: "solved: penetration 3.1e-09, contact force 4.27420; results in x.out", "not converged: ...", ...
  std::string last_line(const RunResult &result, const std::string &directory);

  /// Mesh, levels and the initial gap.
  std::string summary(const CheckReport &report, unsigned dimension);

  /// A line a level, and a table for the zone where there is one.
  std::string summary(const InfSupStudy &study);

  /// Constants, a line an epsilon, slopes, hypotheses and what was seen to hold.
  std::string summary(const EpsilonStudy &study);

  /// One sentence: which of the theorems hold here.
  std::string conclusion(const EpsilonStudy &study);
  std::string conclusion(const QuadratureStudy &study); ///< which rules are stable, and what is wrong with the others

  /// A line a mesh, rates beside the errors.
  std::string summary(const MeshStudy &study);

  /// A line a rule.
  std::string summary(const QuadratureStudy &study);
} // namespace unilateral
