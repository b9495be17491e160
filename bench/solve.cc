// What the solve costs, level by level, in seconds of the processor and in applications of A; no certificate, no estimator, no files.
// Usage: build/bench/solve CASE...
#include "unilateral/case/problem_of_case.h"
#include "unilateral/case/read_case.h"
#include "unilateral/discretisation/problem.h"
#include "unilateral/discretisation/solver_choice.h"
#include "unilateral/inequality/method_of_multipliers.h"
#include "unilateral/inequality/penalty_parameter.h"
#include "unilateral/nested_iteration.h"

#include <deal.II/base/multithread_info.h>

#include <fmt/format.h>

#include <ctime>
#include <fstream>
#include <iostream>
#include <sstream>

namespace
{
  using namespace unilateral;

  double cpu_seconds()
  {
    timespec now;
    clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &now);
    return now.tv_sec + 1e-9 * now.tv_nsec;
  }

  template <int dim>
  void solve_levels(const Case &request, const std::string &name, Diagnostics &diagnostics)
  {
    Problem<dim>        problem(problem_of(request), diagnostics);
    Discretisation<dim> discretisation(problem);
    PenaltyParameter    penalty(request.method, request.constrains_boundary());
    StartingGuess       guess;
    Vector              u, lambda;
    Progress            progress;
    double              all_levels = 0;
    fmt::print("{}\n", name);
    for (unsigned level = 0; level <= request.mesh.refine; ++level)
    {
      const auto K_h = problem.make_constraint_set();
      const auto discrete = discretisation.on_level(problem, K_h);
      penalty.start_level(*discrete);
      start_from(guess, *discrete, problem, K_h, u, lambda);
      const MultiplierParameters parameters{.epsilon = penalty.epsilon(),
                                            .tolerance = request.method.tolerance,
                                            .shift = suitable_shift(K_h.at_nodes()),
                                            .max_newton_steps = request.method.max_iterations};
      const std::size_t          before = discrete->n_operator_applications();
      const double               start = cpu_seconds();
      const auto                 outcome = method_of_multipliers(*discrete, parameters, guess.predicted_active, u, lambda, progress);
      const double               seconds = cpu_seconds() - start;
      all_levels += seconds;
      fmt::print("level {:2} {:9} unknowns: {:3} Newton {:4} linear {:5} applications {:8.4f} s, {:6.0f} ns an unknown, {} {:.1e}\n", level,
                 u.size(), outcome.history.size(), outcome.linear_iterations, discrete->n_operator_applications() - before, seconds,
                 1e9 * seconds / u.size(), outcome.converged ? "" : "FAILED: " + outcome.reason,
                 std::max(outcome.equilibrium, outcome.complementarity));
      problem.space.dirichlet.distribute(u);
      if (level < request.mesh.refine)
      {
        guess = guess_from(problem, K_h, u, lambda);
        problem.refine(guess.functions, /*smoothly=*/true);
      }
    }
    fmt::print("all levels {:.4f} s\n", all_levels);
  }
} // namespace

int main(int argc, char **argv)
{
  dealii::MultithreadInfo::set_thread_limit(1);
  for (int k = 1; k < argc; ++k)
  {
    std::ifstream     file(argv[k]);
    std::stringstream text;
    text << file.rdbuf();
    Diagnostics diagnostics;
    const Case  request = parse_case(text.str(), argv[k], {}, diagnostics);
    if (request.dimension == 2)
      solve_levels<2>(request, argv[k], diagnostics);
    else if (request.dimension == 3)
      solve_levels<3>(request, argv[k], diagnostics);
  }
}
