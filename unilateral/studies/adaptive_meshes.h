// How the error falls with the number of unknowns where it decides which cells are refined.
#pragma once

#include "unilateral/base/progress.h"
#include "unilateral/discretisation/problem_statement.h"
#include "unilateral/evaluation/run_result.h"

#include <nlohmann/json_fwd.hpp>

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

namespace unilateral
{
  struct AdaptiveMeshes
  {
    struct Row
    {
      std::size_t           n_cells = 0, n_dofs = 0;
      double                discretisation_indicator = 0; ///< estimated error of the mesh in the energy norm, see estimator.h
      double                total = 0, relative = 0;      ///< of the whole error: a bound where `guaranteed`, else an estimate
      bool                  guaranteed = false;
      std::optional<Errors> errors; ///< against [exact]
      double                total_contact_force = 0;
      double                seconds = 0; ///< since the beginning
    };
    std::vector<Row> rows;
    double           tolerance = 0; ///< 0: refined until there are too many unknowns
    std::size_t      max_unknowns = 0;
    bool             converged = false;
  };

  /// The case with mesh.adapt from the uniform mesh of @p coarsest refinements on; without mesh.adapt, or where its tolerance is that of
  /// another number, refined until the next mesh would have more than @p max_unknowns. @p processes: as for solve(). Throws InputError and
  /// Interrupted.
  template <int dim>
  AdaptiveMeshes study_adaptive_meshes(
    const ProblemStatement &statement, unsigned coarsest, std::size_t max_unknowns, Progress &progress, const Processes &processes = {});

  /// log(e_k-1 / e_k) / log(n_k / n_k-1) for k = 1, 2, ..., n the unknowns and e the error in the energy norm against [exact], or else its
  /// estimate: p/d for elements of degree p in d dimensions where the meshes are as good as they can be.
  std::vector<std::optional<double>> orders(const AdaptiveMeshes &study);

  nlohmann::ordered_json to_json(const AdaptiveMeshes &study);

  /// study_mesh_adaptive.csv.
  std::string to_csv(const AdaptiveMeshes &study);
} // namespace unilateral
