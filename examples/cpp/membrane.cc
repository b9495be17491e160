// A membrane, fixed on the rim of a square, stretched over a ball: the problem stated in C++, without a case file.
#include <unilateral/base/mpi_session.h>
#include <unilateral/solve.h>

#include <cmath>
#include <cstdio>

using namespace unilateral;

int main()
{
  const MpiSession mpi;

  ProblemStatement problem;
  problem.mesh = refined(box({-2, -2}, {2, 2}, {8, 8}), 5);
  problem.model.element = {ElementName::Family::Q, 1};
  problem.boundary = {{.part = "all", .value = 0.}};
  problem.constraints = {
    {.lower = FieldFunction([](const dealii::Point<2> &x) { return x.square() < 1 ? std::sqrt(1 - x.square()) : -1.; })}};
  problem.method.formulation = Method::Formulation::mixed;

  Diagnostics       warnings;
  Progress          silent;
  const Solution<2> solution = solve<2>(problem, warnings, silent);

  const RunResult &result = solution.result;
  std::printf("%s: contact force %.6f, energy %.6f\n", result.converged ? "solved" : result.reason.c_str(),
              result.constraints[0].total_contact_force, result.energy);
  std::printf("error of the solver at most %.1e, of the mesh about %.1e, in the energy norm\n", result.certificate->penalty_error_bound,
              result.discretisation_indicator);

  // The contact pressure is known at the points of the quadrature rule.
  std::size_t peak = 0;
  for (std::size_t i = 0; i < solution.constraint_set.size(); ++i)
    if (solution.contact_pressure(i) > solution.contact_pressure(peak))
      peak = i;
  const auto &x = solution.constraint_set.points[peak].x;
  std::printf("largest pressure %.4f at (%.3f, %.3f)\n", solution.contact_pressure(peak), x[0], x[1]);
  return result.converged ? 0 : 1;
}
