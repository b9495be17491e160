#include "unilateral/stability/theorem3_bound.h"

#include "unilateral/discretisation/assembled.h"
#include "unilateral/stability/form_constants.h"
#include "unilateral/stability/inf_sup.h"

#include <fmt/format.h>

#include <cmath>
#include <stdexcept>

namespace unilateral
{
  namespace
  {
    /// Unknowns and points up to which the constants cost less than the solve's own overheads.
    constexpr std::size_t largest_in_passing = 4000;
  } // namespace

  template <int dim>
  void add_theorem3_bound(Certificate &certificate, const Problem<dim> &problem, const ConstraintSet<dim> &set, const double epsilon)
  {
    const auto         running = problem.time_by_part.run("theorem 3");
    const FreeUnknowns free(problem);
    const std::size_t  size = free.n_free + set.size();
    if (!certificate.available)
      certificate.theorem3_reason = certificate.reason;
    else if (problem.space.subdomain)
      certificate.theorem3_reason =
        fmt::format("{} unknowns: C_h is computed in a run up to {}, by 'infsup' beyond", problem.space.n_unknowns(), largest_in_passing);
    else if (size > largest_in_passing)
      certificate.theorem3_reason =
        fmt::format("{} unknowns and points: C_h is computed in a run up to {}, by 'infsup' beyond", size, largest_in_passing);
    else if (set.size() == 0 || free.n_free == 0 || epsilon == 0)
      certificate.theorem3_bound = 0.;
    else
      try
      {
        const Pairing pairing = make_pairing(problem, set, each_point_once(set, std::vector<bool>(set.size(), true)), PairingKind::by_rule);
        const double  C_h = inf_sup(pairing).C_h;
        const auto    discrete = assemble(problem, set, {.solver = Method::Solver::direct}, /*with_gram=*/false);
        const FormConstants form = form_constants(free.restricted(discrete->stiffness_matrix()), pairing.gram, discrete->symmetric());
        if (C_h == 0)
          certificate.theorem3_reason = "C_h = 0: some pressures do not act on V_h";
        else if (!(form.m > 0))
          certificate.theorem3_reason = "a is not coercive";
        else
        {
          const double norm_p = 2 * certificate.lbb_free_bound / std::sqrt(epsilon);
          certificate.theorem3_bound = form.M / form.m * norm_p * epsilon / C_h;
        }
      }
      catch (const std::runtime_error &failure)
      {
        certificate.theorem3_reason = failure.what();
      }
  }

#define INSTANTIATE(dim) template void add_theorem3_bound(Certificate &, const Problem<dim> &, const ConstraintSet<dim> &, double);
  INSTANTIATE(1)
  INSTANTIATE(2)
  INSTANTIATE(3)
#undef INSTANTIATE
} // namespace unilateral
