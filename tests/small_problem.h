// A problem from the text of a case, and what the solvers need of it.
#pragma once

#include "unilateral/case/problem_of_case.h"
#include "unilateral/case/read_case.h"
#include "unilateral/discretisation/assembled.h"
#include "unilateral/discretisation/problem.h"
#include "unilateral/inequality/method_of_multipliers.h"

#include <memory>
#include <string>
#include <vector>

namespace unilateral
{
  inline Case case_of(const std::string &text, const std::vector<Override> &overrides = {})
  {
    Diagnostics diagnostics;
    return parse_case(text, "test.toml", overrides, diagnostics);
  }

  /// Problem, K_h and the matrices after the refinements that the case asks for.
  template <int dim>
  struct SmallProblem
  {
    explicit SmallProblem(const std::string &text, const std::vector<Override> &overrides = {}, const bool with_gram = false)
    {
      const Case  request = case_of(text, overrides);
      Diagnostics diagnostics;
      problem = std::make_unique<Problem<dim>>(problem_of(request), diagnostics);
      std::vector<Vector> nothing;
      for (unsigned level = 0; level < request.mesh.n_refinements(); ++level)
        problem->refine(nothing);
      constraint_set = problem->make_constraint_set();
      discrete = assemble(*problem, constraint_set, {.solver = request.method.solver}, with_gram);
    }

    Vector zero_dofs() const
    {
      Vector v;
      discrete->initialize_dof_vector(v);
      return v;
    }

    Vector zero_points() const
    {
      Vector q;
      discrete->initialize_point_vector(q);
      return q;
    }

    std::unique_ptr<Problem<dim>> problem;
    ConstraintSet<dim>            constraint_set;
    std::unique_ptr<Assembled>    discrete;
  };

  /// I_G(q r).
  inline double pairing(const DiscreteProblem &discrete, const Vector &q, const Vector &r)
  {
    double sum = 0;
    for (std::size_t i = 0; i < q.size(); ++i)
      sum += discrete.weights()(i) * q(i) * r(i);
    return sum;
  }

  /// I_G(lambda): the total contact force.
  inline double contact_force(const DiscreteProblem &discrete, const Vector &lambda)
  {
    double sum = 0;
    for (std::size_t i = 0; i < lambda.size(); ++i)
      sum += discrete.weights()(i) * lambda(i);
    return sum;
  }

  /// J(u) = 1/2 u'Au - f'u, without what the Dirichlet data add.
  inline double energy_of(const DiscreteProblem &discrete, const Vector &u)
  {
    Vector Au;
    discrete.initialize_dof_vector(Au);
    discrete.apply_stiffness(Au, u);
    return 0.5 * (u * Au) - u * discrete.load();
  }

  /// u'Au to the power 1/2.
  inline double energy_norm(const DiscreteProblem &discrete, const Vector &u)
  {
    Vector Au;
    discrete.initialize_dof_vector(Au);
    discrete.apply_stiffness(Au, u);
    return std::sqrt(u * Au);
  }
} // namespace unilateral
