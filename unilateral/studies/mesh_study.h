// How the error falls with the mesh, and how small epsilon has to be for that.
#pragma once

#include "unilateral/base/progress.h"
#include "unilateral/discretisation/problem_statement.h"
#include "unilateral/output/results.h"
#include "unilateral/studies/adaptive_meshes.h"

#include <nlohmann/json_fwd.hpp>

#include <functional>
#include <optional>
#include <string>
#include <vector>

namespace unilateral
{
  struct MeshStudy
  {
    struct Row
    {
      unsigned              level = 0;
      double                h = 0; ///< diameter of the largest cell
      std::size_t           n_dofs = 0;
      double                epsilon = 0;                       ///< 0: mixed
      std::optional<Errors> errors;                            ///< against [exact]
      std::optional<Errors> mixed_errors;                      ///< those of the mixed method on the same mesh, when epsilon is prescribed
      std::optional<double> difference_L2, difference_H1_semi; ///< to the next finer level, without [exact]
      double                total_contact_force = 0, contact_measure = 0, max_contact_pressure = 0, energy = 0;
      std::optional<double> max_von_mises;       ///< of a body
      std::optional<double> penalty_error_bound; ///< certified, energy norm
      double                discretisation_indicator = 0;
      unsigned              newton_iterations = 0, linear_iterations = 0;
      double                seconds = 0;
      bool                  converged = false;
    };
    std::vector<Row>              rows;
    std::string                   element, quadrature, epsilon_rule; ///< "auto", "0.01", "0.1 (h/h0)^1"
    std::optional<AdaptiveMeshes> adaptive;
  };

  struct MeshStudyOptions
  {
    unsigned              n_levels = 0;     ///< 0: up to the case's own refinement
    std::optional<double> epsilon;          ///< on the coarsest level; absent: what the case says
    std::optional<double> power;            ///< epsilon ~ h^power; absent: the same epsilon on every level
    bool                  adaptive = false; ///< also meshes that are refined by the error, from the coarsest level to as many unknowns
  };

  /// Solves the case on each level by itself.
  /// A power without an epsilon starts from the case's own, or from the power of ten next to ||u||_0 / ||p||_0 on the coarsest mesh.
  /// Where @p processes are several, all of them call this together, share each solve as solve() does, and get the same numbers.
  /// Throws InputError and Interrupted.
  template <int dim>
  MeshStudy study_mesh(const ProblemStatement &statement,
                       const MeshStudyOptions &options,
                       Diagnostics            &diagnostics,
                       Progress               &progress,
                       const Processes        &processes = {});

  /// A number of each row that may be missing, and its name: what tables and rates are made of.
  struct MeshStudyColumn
  {
    std::string                                                  name;
    std::function<std::optional<double>(const MeshStudy::Row &)> value;
  };

  /// Errors or differences, as far as the study has them.
  std::vector<MeshStudyColumn> error_columns(const MeshStudy &study);

  /// log(e_k-1 / e_k) / log(h_k-1 / h_k) for k = 1, 2, ...
  std::vector<std::optional<double>> rates(const MeshStudy &study, const MeshStudyColumn &column);

  /// study_mesh.json.
  nlohmann::ordered_json to_json(const MeshStudy &study, const CaseSource &source);

  /// study_mesh.csv.
  std::string to_csv(const MeshStudy &study);
} // namespace unilateral
