// Random problems of every kind, and the proof that what the program calls solved is the solution, that its certificate holds.
#pragma once

#include "dense_problem.h"
#include "random_problem.h"

#include "unilateral/case/problem_of_case.h"
#include "unilateral/case/read_case.h"
#include "unilateral/solve.h"

#include <gtest/gtest.h>

#include <array>
#include <cstdio>
#include <cstdlib>
#include <map>
#include <string>

namespace unilateral
{
  /// How far an answer is from what it should be; lengths in parts of the energy norm of the solution.
  struct Verdict
  {
    enum class Ending
    {
      solved,        ///< and proved to be the solution
      refused,       ///< InputError
      not_converged, ///< said so
      wrong          ///< "solved", and it is not
    };
    Ending      ending = Ending::solved;
    std::string what;
    std::size_t n_unknowns = 0, n_points = 0, n_active = 0;
    double      equilibrium = 0;     ///< (r'A^-1 r)^1/2, r = A u + B'W lambda - f
    double      complementarity = 0; ///< (sum w tau c^2)^1/2, c = lambda - (lambda + (Bu - s - epsilon lambda)/tau)^+
    double      distance = 0;        ///< of u from that of the dense solver
    double      pressures = 0;       ///< the same of lambda, (sum w tau d^2)^1/2, where it is determined
    bool        compared = false;    ///< with the dense solver
    bool        certified = false;
    double      error = 0, bound = 0; ///< the distance from the mixed solution, and what the certificate says of it
  };

  /// What an answer that is called solved may be off by, in parts of the energy norm: a hundred times the default tolerance, which is asked
  /// of a residual in the norm of a preconditioner.
  constexpr double largest_distance = 1e-6;

  /// Solves it by the program and by dense matrices.
  template <int dim>
  Verdict solve_and_compare(const RandomProblem &drawn)
  {
    Verdict       verdict;
    Diagnostics   diagnostics;
    Progress      quiet;
    Solution<dim> solution;
    try
    {
      const Case request = parse_case(drawn.text, "random.toml", {}, diagnostics);
      solution = solve<dim>(problem_of(request), diagnostics, quiet);
    }
    catch (const InputError &error)
    {
      verdict.ending = Verdict::Ending::refused;
      verdict.what = error.what();
      return verdict;
    }
    const RunResult &result = solution.result;
    verdict.what = result.reason;
    verdict.ending = result.converged ? Verdict::Ending::solved : Verdict::Ending::not_converged;

    const Problem<dim> &problem = *solution.problem;
    const auto          assembled = assemble(problem, solution.constraint_set, {.solver = Method::Solver::direct}, /*with_gram=*/false);
    const DenseProblem  dense(*assembled, problem.space.dirichlet);
    const Column        u = dense.restricted(solution.displacement), lambda = DenseProblem::at_points(solution.contact_pressure);
    const Real          epsilon = result.epsilon;
    verdict.n_unknowns = std::size_t(u.size());
    verdict.n_points = std::size_t(lambda.size());
    verdict.n_active = std::size_t((lambda.array() > 0).count());
    if (!result.converged)
      return verdict;

    // The conditions alone prove a solution. Where there are too many points for the dense solver, or a body hangs on so few that it does
    // not come to rest, it is left out.
    DenseProblem::Solution exact{u, lambda}, mixed = exact;
    if (verdict.n_points <= 400)
      try
      {
        exact = dense.solve(epsilon);
        mixed = epsilon > 0 ? dense.solve(0) : exact;
        verdict.compared = true;
      }
      catch (const std::runtime_error &)
      {
        exact = mixed = {u, lambda};
      }
    const Real size = std::max({dense.energy_norm(exact.u), dense.pressure_norm(exact.lambda), Real(1e-300)});
    // Rounding of what is subtracted here counts for no difference.
    const Column Bu = dense.B * u, open = Bu - dense.s - epsilon * lambda;
    const Column rounding = 1e-13L * (dense.B.cwiseAbs() * u.cwiseAbs() + dense.s.cwiseAbs()).cwiseQuotient(dense.compliance);
    Column       conflict = (lambda - (lambda + open.cwiseQuotient(dense.compliance)).cwiseMax(0)).cwiseAbs() - rounding;
    conflict = conflict.cwiseMax(0);
    verdict.complementarity = double(dense.pressure_norm(conflict) / size);
    Column residual = dense.f - dense.A * u - dense.B.transpose() * dense.w.cwiseProduct(lambda);
    residual -= dense.modes * (dense.modes.transpose() * residual);
    verdict.equilibrium = double(dense.dual_norm(residual) / size);
    verdict.distance = double(dense.energy_norm(u - exact.u) / size);
    if (epsilon > 0)
      verdict.pressures =
        double(std::min(Real(1), epsilon / dense.compliance.maxCoeff()) * dense.pressure_norm(lambda - exact.lambda) / size);
    verdict.error = double(dense.energy_norm(u - mixed.u) / size);
    verdict.certified = result.certificate->available;
    verdict.bound = double(result.certificate->penalty_error_bound / size);

    const bool right = lambda.minCoeff() >= 0 && verdict.complementarity <= largest_distance && verdict.equilibrium <= largest_distance &&
                       verdict.distance <= largest_distance && verdict.pressures <= largest_distance &&
                       (!verdict.certified || verdict.error <= verdict.bound * (1 + 1e-9));
    if (!right)
      verdict.ending = Verdict::Ending::wrong;
    verdict.what += fmt::format(
      "; {} unknowns, {} of {} points: equilibrium {:.1e}, complementarity {:.1e}, distance {:.1e}, pressures {:.1e}, error {:.2e}, "
      "bound {:.2e}",
      verdict.n_unknowns, verdict.n_active, verdict.n_points, verdict.equilibrium, verdict.complementarity, verdict.distance,
      verdict.pressures, verdict.error, verdict.certified ? verdict.bound : NAN);
    return verdict;
  }

  inline Verdict solve_and_compare(const RandomProblem &problem)
  {
    return problem.dim == 1   ? solve_and_compare<1>(problem)
           : problem.dim == 2 ? solve_and_compare<2>(problem)
                              : solve_and_compare<3>(problem);
  }

  /// Seeds @p first to @p last - 1, or only the one in the environment's UNILATERAL_SEED: none may end wrong, and few without a solution.
  inline void expect_right_answers(const unsigned first, const unsigned last)
  {
    std::map<std::string, std::array<unsigned, 4>> count;
    std::array<unsigned, 4>                        total = {0, 0, 0, 0};
    unsigned                                       n_certified = 0, n_in_contact = 0, n_compared = 0;
    double                                         farthest = 0, closest_bound = 0;
    const char *const                              only = std::getenv("UNILATERAL_SEED");
    for (unsigned seed = first; seed < last; ++seed)
    {
      if (only && seed != static_cast<unsigned>(std::atoi(only)))
        continue;
      const RandomProblem problem(seed);
      SCOPED_TRACE(fmt::format("seed {}, {}\n{}", seed, problem.kind, problem.text));
      Verdict verdict;
      ASSERT_NO_THROW(verdict = solve_and_compare(problem));
      EXPECT_NE(verdict.ending, Verdict::Ending::wrong) << verdict.what;
      ++count[problem.kind][std::size_t(verdict.ending)];
      ++total[std::size_t(verdict.ending)];
      if (verdict.ending == Verdict::Ending::solved)
      {
        n_certified += verdict.certified;
        n_in_contact += verdict.n_active > 0;
        n_compared += verdict.compared;
        farthest = std::max(farthest, verdict.distance);
        if (verdict.certified && verdict.bound > 0)
          closest_bound = std::max(closest_bound, verdict.error / verdict.bound);
      }
      if (std::getenv("UNILATERAL_SHOW"))
      {
        fmt::print("{} {} {}: {}\n", seed, int(verdict.ending), problem.kind, verdict.what);
        std::fflush(stdout);
      }
      else if (verdict.ending == Verdict::Ending::not_converged)
        fmt::print("seed {} not converged: {}\n{}\n", seed, verdict.what, problem.text);
    }
    for (const auto &[kind, n] : count)
      fmt::print("{}: {} proved, {} refused, {} not converged, {} wrong\n", kind, n[0], n[1], n[2], n[3]);
    fmt::print("all: {} proved, {} refused, {} not converged, {} wrong; {} in contact, {} compared, farthest {:.1e}; {} certified, error "
               "up to {:.3f} "
               "of the bound\n",
               total[0], total[1], total[2], total[3], n_in_contact, n_compared, farthest, n_certified, closest_bound);
    EXPECT_GE(total[0], (last - first) * 7 / 10);
    EXPECT_GE(n_in_contact, (last - first) / 2);
    EXPECT_GE(n_compared, total[0] * 8 / 10);
    EXPECT_LE(total[2], (last - first) / 50);
  }
} // namespace unilateral
