// Forms that a program brings along.
#include "unilateral/forms/membrane.h"
#include "unilateral/solve.h"

#include <gtest/gtest.h>

#include <memory>

using namespace unilateral;

namespace
{
  ProblemStatement membrane_under_a_bound(const double stiffness)
  {
    ProblemStatement problem;
    problem.mesh = refined(box({0, 0}, {1, 1}, {4, 4}), 2);
    problem.model.coefficients.stiffness = {FieldFunction(stiffness)};
    problem.model.coefficients.load = {FieldFunction(16.)};
    problem.boundary = {{.part = "all", .value = 0.}};
    problem.constraints = {{.upper = FieldFunction(0.2)}};
    problem.method.formulation = Method::Formulation::mixed;
    return problem;
  }

  RunResult solved(const ProblemStatement &problem)
  {
    Diagnostics diagnostics;
    Progress    quiet;
    return solve<2>(problem, diagnostics, quiet).result;
  }

  /// What solving @p problem is refused for.
  std::string refusal(const ProblemStatement &problem)
  {
    try
    {
      solved(problem);
    }
    catch (const InputError &error)
    {
      return error.what();
    }
    return "";
  }

  std::unique_ptr<BilinearForm<2>> twice_as_stiff(std::vector<Coefficients> coefficients, const std::vector<PartCondition> &conditions)
  {
    for (auto &region : coefficients)
      region.stiffness = {FieldFunction(4.)};
    return std::make_unique<Membrane<2>>(coefficients, conditions);
  }
} // namespace

TEST(OwnForm, takes_the_place_of_the_form_that_the_model_names)
{
  ProblemStatement problem = membrane_under_a_bound(2);
  problem.own_form.in_2d = twice_as_stiff;
  const RunResult own = solved(problem), stiff = solved(membrane_under_a_bound(4)), soft = solved(membrane_under_a_bound(2));
  EXPECT_TRUE(own.converged);
  EXPECT_GT(own.constraints[0].n_active, 0u);
  EXPECT_DOUBLE_EQ(own.energy, stiff.energy);
  EXPECT_DOUBLE_EQ(own.constraints[0].total_contact_force, stiff.constraints[0].total_contact_force);
  EXPECT_GT(soft.constraints[0].total_contact_force, 1.1 * own.constraints[0].total_contact_force);
}

TEST(OwnForm, is_refused_where_it_does_not_fit_the_model)
{
  ProblemStatement problem = membrane_under_a_bound(1);
  problem.own_form.in_3d = [](const auto &coefficients, const auto &conditions)
  { return std::make_unique<Membrane<3>>(coefficients, conditions); };
  EXPECT_NE(refusal(problem).find("own_form has no in_2d"), std::string::npos) << refusal(problem);

  problem.own_form.in_2d = twice_as_stiff;
  problem.model.kind = Model::Kind::elasticity;
  EXPECT_NE(refusal(problem).find("a form of 1 components, for a model whose u has 2"), std::string::npos) << refusal(problem);

  problem.own_form.in_2d = [](const auto &, const auto &) { return nullptr; };
  EXPECT_NE(refusal(problem).find("in_2d returned no form"), std::string::npos) << refusal(problem);
}
