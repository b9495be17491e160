// The certificate and the automatic epsilon on every example: sharp, and harmless beside the error of the mesh.
#include "unilateral/case/problem_of_case.h"
#include "unilateral/case/read_case.h"
#include "unilateral/solve.h"
#include "unilateral/studies/epsilon_study.h"

#include <gtest/gtest.h>

#include <filesystem>
#include <string>
#include <vector>

using namespace unilateral;

namespace
{
  /// Every example, on a mesh that takes seconds with assertions.
  std::vector<Case> examples()
  {
    std::vector<Case> cases;
    for (const auto &entry : std::filesystem::directory_iterator(PROJECT_DIR "/examples"))
      if (entry.path().extension() == ".toml")
      {
        Diagnostics diagnostics;
        Case        request = read_case(entry.path(), {}, diagnostics);
        request.mesh.refine = std::min(request.mesh.refine, request.dimension == 3 ? 1u : request.dimension == 2 ? 3u : 6u);
        request.method.formulation = Method::Formulation::penalty;
        request.mesh.adapt.reset(); // the study takes one mesh for all epsilons
        request.method.epsilon.reset();
        request.expect.clear();
        cases.push_back(request);
      }
    return cases;
  }

  template <typename Action>
  void with_dimension(const unsigned dimension, const Action &action)
  {
    if (dimension == 1)
      action(std::integral_constant<int, 1>());
    else if (dimension == 2)
      action(std::integral_constant<int, 2>());
    else
      action(std::integral_constant<int, 3>());
  }
} // namespace

TEST(AutomaticEpsilon, adds_nothing_to_the_error_and_is_certified_sharply)
{
  const auto cases = examples();
  EXPECT_GE(cases.size(), 13u);
  for (const Case &request : cases)
    with_dimension(request.dimension,
                   [&](const auto dimension)
                   {
                     constexpr int dim = dimension;
                     SCOPED_TRACE(request.name);
                     Diagnostics diagnostics;
                     Progress    quiet;
                     const auto  automatic = solve<dim>(problem_of(request), diagnostics, quiet).result;
                     Case        mixed = request;
                     mixed.method.formulation = Method::Formulation::mixed;
                     const auto reference = solve<dim>(problem_of(mixed), diagnostics, quiet).result;
                     EXPECT_TRUE(automatic.converged);
                     if (reference.errors)
                     {
                       // What elements represent exactly has errors of rounding alone.
                       const double rounding = 1e-11, pressure = automatic.constraints.empty() ? 0 : automatic.constraints[0].pressure_L2;
                       EXPECT_LE(automatic.errors->H1_semi.value_or(0),
                                 1.05 * reference.errors->H1_semi.value_or(0) + rounding * automatic.norm_H1_semi);
                       EXPECT_LE(automatic.errors->L2.value_or(0), 1.05 * reference.errors->L2.value_or(0) + rounding * automatic.norm_L2);
                       EXPECT_LE(automatic.errors->pressure_L2.value_or(0),
                                 1.05 * reference.errors->pressure_L2.value_or(0) + rounding * pressure);
                     }
                     if (!automatic.certificate->available)
                       return;
                     const auto study = study_epsilon<dim>(problem_of(request), {{automatic.epsilon}}, diagnostics, quiet);
                     EXPECT_TRUE(study.holds.gap.value());
                     EXPECT_LE(study.rows[0].u_error_energy, automatic.certificate->penalty_error_bound * (1 + 1e-6));
                     // The run's own bound also covers the residual and what rounding hides, which it states. What is nothing beside the
                     // error of the mesh need not be sharp.
                     const Certificate &certificate = *automatic.certificate;
                     EXPECT_LE(certificate.penalty_error_bound,
                               2 * study.rows[0].u_error_energy +
                                 2 * std::max(request.method.tolerance * certificate.energy_norm, 1.25 * certificate.algebraic_error) +
                                 certificate.round_off + 1e-4 * automatic.discretisation_indicator);
                   });
}
