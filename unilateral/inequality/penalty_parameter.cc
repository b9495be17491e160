#include "unilateral/inequality/penalty_parameter.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

namespace unilateral
{
  double asked_penalty_error(const Method &method, const Certificate &certificate)
  {
    return method.penalty_tolerance ? *method.penalty_tolerance * certificate.energy_norm : std::numeric_limits<double>::infinity();
  }

  PenaltyParameter::PenaltyParameter(const Method &method, const bool on_boundary, const Parameters &parameters)
    : method(method), parameters(parameters), factor(on_boundary ? parameters.largest_on_boundary : parameters.largest_factor)
  {
    if (method.formulation == Method::Formulation::mixed)
      explanation = "mixed method: the multiplier is found without a penalty";
    else if (method.epsilon)
    {
      value = *method.epsilon;
      explanation = "given in the case";
    }
  }

  void PenaltyParameter::start_level(const DiscreteProblem &problem)
  {
    trials = 0;
    if (!search())
      return;
    std::vector<double> compliance;
    for (std::size_t i = 0; i < problem.compliance().size(); ++i)
      if (problem.owns_point(i))
        compliance.push_back(problem.compliance()(i));
    if (const auto n = problem.processes().sum(std::uint64_t(compliance.size())); n > 0)
      tau = problem.processes().nth_smallest(compliance, n / 2);
    set_factor(factor);
  }

  void PenaltyParameter::set_factor(const double new_factor)
  {
    factor = std::max(new_factor, parameters.smallest_factor);
    value = factor * tau;
  }

  bool PenaltyParameter::accept(const Certificate &certificate, const double indicator)
  {
    if (!search())
      return true;
    ++trials;
    if (!certificate.available)
    {
      explanation =
        fmt::format("{:.0e} of the local compliance {:.3g} of the mesh, without a certificate", parameters.uncertified_factor, tau);
      if (factor <= parameters.uncertified_factor)
        return true;
      set_factor(parameters.uncertified_factor);
      return false;
    }
    const double error = certificate.penalty_error_bound;
    const double asked = asked_penalty_error(method, certificate);
    // Where the solution lies in V_h (indicator about 0) the solver's own tolerance is all that can be asked.
    const double solver_error = method.tolerance * certificate.energy_norm;
    const double allowed = std::max(std::min(parameters.fraction * indicator, asked), solver_error);
    explanation = fmt::format("{:.1e} of the local compliance {:.3g} of the mesh; the penalty's certified error ", factor, tau);
    if (error == 0)
      explanation += "is zero";
    else if (indicator > solver_error || certificate.energy_norm == 0)
      explanation += fmt::format("{:.1e} is {:.1g} of the discretisation error, about {:.1e}", error,
                                 indicator > 0 ? error / indicator : std::numeric_limits<double>::infinity(), indicator);
    else
      explanation +=
        fmt::format("{:.1e} is {:.1g} of the energy norm (of u less its prescribed values), and the discretisation error is nothing", error,
                    error / certificate.energy_norm);
    if (error <= allowed || factor <= parameters.smallest_factor || trials >= parameters.max_trials)
      return true;
    // The error falls like eps^(3/4) at first and like eps in the end.
    set_factor(factor * std::max(1e-3, 0.7 * std::pow(allowed / error, 4. / 3)));
    return false;
  }
} // namespace unilateral
