// The same problem through both implementations of DiscreteProblem.
#pragma once

#include "small_problem.h"

#include "unilateral/case/problem_of_case.h"
#include "unilateral/discretisation/matrix_free.h"
#include "unilateral/discretisation/mesh_hierarchy.h"
#include "unilateral/discretisation/rigid_body_modes.h"

#include <memory>
#include <random>
#include <string>
#include <vector>

namespace unilateral
{
  /// After all refinements that the case asks for; unknowns and points have the same numbers.
  template <int dim>
  struct BothWays
  {
    explicit BothWays(const std::string &text) : assembled(text)
    {
      Diagnostics         diagnostics;
      const Case          request = case_of(text);
      Problem<dim>        problem(problem_of(request), diagnostics);
      auto                hierarchy = std::make_shared<LevelHierarchy>();
      Vector              load = add_level(*hierarchy, problem);
      std::vector<Vector> nothing;
      for (unsigned level = 0; level < request.mesh.n_refinements(); ++level)
      {
        problem.refine(nothing);
        load = add_level(*hierarchy, problem);
      }
      matrix_free =
        std::make_unique<MatrixFree>(hierarchy, ConstraintTrace(assembled.constraint_set, assembled.problem->space.dirichlet), load,
                                     modes_at_unknowns(problem, problem.null_space), modes_at_unknowns(problem, problem.unsupported),
                                     MatrixFree::Parameters{.multigrid = Multigrid::Parameters::for_volume_to_shape_stiffness(
                                                              problem.form->volume_to_shape_stiffness())});
      this->hierarchy = hierarchy;
    }

    Vector random_function(const unsigned seed) const
    {
      std::mt19937                           generator(seed);
      std::uniform_real_distribution<double> uniform(-1, 1);
      Vector                                 v = assembled.zero_dofs();
      for (double &entry : v)
        entry = uniform(generator);
      assembled.problem->space.dirichlet.set_zero(v);
      return v;
    }

    SmallProblem<dim>               assembled;
    std::unique_ptr<MatrixFree>     matrix_free;
    std::shared_ptr<LevelHierarchy> hierarchy;
  };
} // namespace unilateral
