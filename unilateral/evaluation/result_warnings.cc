#include "unilateral/evaluation/result_warnings.h"

#include "unilateral/base/byte_archive.h"
#include "unilateral/base/point_text.h"
#include "unilateral/constraints/direction_of_contact.h"
#include "unilateral/constraints/quadrature_rule.h"
#include "unilateral/discretisation/points_by_cell.h"
#include "unilateral/evaluation/contact_at_fixed_nodes.h"
#include "unilateral/evaluation/unseen_contact.h"
#include "unilateral/evaluation/unseen_detail.h"
#include "unilateral/mesh/gauss_rule.h"

#include <deal.II/base/quadrature_lib.h>
#include <deal.II/fe/fe_values.h>

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>
#include <numeric>
#include <optional>

namespace unilateral
{
  using namespace dealii;

  namespace
  {
    template <int dim>
    void warn_about_large_strains(const Problem<dim> &problem, const Vector &u, Diagnostics &diagnostics)
    {
      constexpr double      small = 0.5, share = 0.01; // far beyond: benchmarks in round numbers often have a tenth
      const Quadrature<dim> middle = gauss_rule<dim>(problem.space.element.simplex(), 1);
      FEValues<dim>         values(*problem.space.mapping, *problem.space.fe, middle, update_gradients | update_JxW_values);
      std::vector<std::vector<Tensor<1, dim>>> gradient(1, std::vector<Tensor<1, dim>>(problem.form->n_components()));
      double                                   volume = 0, beyond = 0, largest = 0;
      for (const auto &cell : problem.space.dof_handler.active_cell_iterators())
      {
        values.reinit(cell);
        values.get_function_gradients(u, gradient);
        double square = 0;
        for (const auto &of_component : gradient[0])
          square += of_component.norm_square();
        const double size = std::sqrt(square);
        volume += values.JxW(0);
        beyond += size > small ? values.JxW(0) : 0;
        largest = std::max(largest, size);
      }
      volume = problem.space.processes().sum(volume);
      beyond = problem.space.processes().sum(beyond);
      largest = problem.space.processes().max(largest);
      if (beyond > share * volume)
        diagnostics.warning(
          problem.statement.model.where,
          fmt::format("strains or rotations are not small: the gradient of u is up to {:.2g}, and above {} in {:.0f} % of "
                      "the body; the theory is that of small ones, so the result is not what such a body does: check the "
                      "units of young and the loads, or lower the load",
                      largest, small, std::ceil(100 * beyond / volume)),
          MessageName("large-strains"));
    }

    template <int dim>
    void warn_about_fixed_nodes(
      const RunResult &result, const Problem<dim> &problem, const ConstraintSet<dim> &set, const Vector &lambda, Diagnostics &diagnostics)
    {
      if (!set.at_nodes() || problem.form->order() != 1)
        return;
      for (std::size_t b = 0; b < set.blocks.size(); ++b)
      {
        const auto   by_cell = force_at_fixed_nodes(problem, set, b, lambda);
        const double missing = problem.space.processes().sum(std::accumulate(by_cell.begin(), by_cell.end(), 0.));
        const double force = result.constraints[b].total_contact_force;
        if (missing > 0.02 * (force + missing))
          diagnostics.warning(
            problem.conditions[b].where,
            fmt::format("contact ({}) reaches nodes whose values [boundary] fixes, where no pressure can act: about {:.1f} % "
                        "of the contact force, {:.3g}, is borne by the support there; it becomes less as the mesh is refined "
                        "(mesh.refine, [[mesh.local]])",
                        set.blocks[b].on, 100 * missing / (force + missing), missing),
            MessageName("contact-at-fixed-nodes"));
      }
    }

    template <int dim>
    void warn_about_facets(const Problem<dim>        &problem,
                           const ConstraintSet<dim>  &set,
                           const FacetedSurface<dim> &coarse,
                           const Vector              &lambda,
                           Diagnostics               &diagnostics)
    {
      // Of a curved mesh that is shared no process has all facets.
      if (problem.form->n_components() == 1 || (problem.space.mesh.curved && problem.space.subdomain))
        return;
      // Where refinement follows a circle or ball, the facets are the straight cells of the finest mesh.
      std::optional<FacetedSurface<dim>> finest;
      if (problem.space.mesh.curved)
        finest.emplace(problem);
      const bool straight = problem.space.element.degree == 1;
      for (std::size_t b = 0; b < set.blocks.size(); ++b)
      {
        const auto &condition = problem.conditions[b];
        if (!condition.part)
          continue;
        const bool inside = feels_inside_faces(problem, condition.rule);
        if (problem.space.mesh.curved ? !(inside && straight) : !(inside || problem.space.level > 0))
          continue;
        const auto finding = (finest ? *finest : coarse).look_at(problem, set, set.blocks[b], *condition.part, lambda);
        if (!finding || finding->angle < 1e-6 || finding->pressure <= 0.25 * finding->mean)
          continue;
        diagnostics.warning(
          condition.where,
          fmt::format(
            "'{}' is made of flat facets that meet at up to {:.2g} degrees, and contact is felt inside them, up to {:.2g} from the "
            "curved surface they stand for: that alone changes the pressure by about {:.2g}, and its mean is {:.2g}; what is computed "
            "is the contact of the facets: {}",
            condition.on, finding->angle, finding->sagitta, finding->pressure, finding->mean,
            problem.space.mesh.curved
              ? "take an element of degree 2, whose cells follow the curve, or the rule 'trapezoid'"
              : "let Gmsh make finer cells (mesh.size, or a finer file) in place of mesh.refine, and take P1 or Q1, "
                "or the rule 'trapezoid'"),
          MessageName("flat-facets"));
      }
    }

    template <int dim>
    void warn_about_missed_points(
      const RunResult &result, const Problem<dim> &problem, const ConstraintSet<dim> &set, const Vector &lambda, Diagnostics &diagnostics)
    {
      for (std::size_t b = 0; b < set.blocks.size(); ++b)
      {
        const auto &missed = set.missed[b];
        if (!problem.space.processes().any(!missed.empty()))
          continue;
        // A plane has no end: what does not meet it belongs to other sides of the body.
        if (const auto &surface = problem.conditions[b].surface; surface && direction_of_contact<dim>({}, surface.get()))
          continue;
        // Beside: as near as points of the rule are to each other on a face of its cells.
        struct MetPoint
        {
          Point<dim> x;
          double     reach; ///< of a point in contact; 0: missed
        };
        std::vector<MetPoint> points;
        for (const auto &x : missed)
          points.push_back({x, 0});
        std::vector<double> reach(set.size(), 0.);
        for (const RuleOnCell<dim> &rule : rule_on_cells(problem, set, b))
          for (const std::size_t i : rule.points)
            if (i < set.size())
              reach[i] = std::max(reach[i], 1.01 * rule.cell->diameter() / std::max(problem.space.element.degree, 1u));
        for (std::size_t i = set.blocks[b].begin; i < set.blocks[b].end; ++i)
          if (lambda(i) > 0)
            points.push_back({set.points[i].x, reach[i]});
        std::sort(points.begin(), points.end(), [](const MetPoint &a, const MetPoint &b) { return a.x[0] < b.x[0]; });
        std::uint64_t n_beside = 0;
        Point<dim>    where;
        for (std::size_t i = 0; i < points.size(); ++i)
        {
          const auto &[x, reach_here] = points[i];
          if (reach_here == 0)
            continue;
          bool beside = false;
          for (std::size_t k = i + 1; k < points.size() && !beside && points[k].x[0] - x[0] <= reach_here; ++k)
            beside = points[k].reach == 0 && points[k].x.distance(x) <= reach_here;
          for (std::size_t k = i; k-- > 0 && !beside && x[0] - points[k].x[0] <= reach_here;)
            beside = points[k].reach == 0 && points[k].x.distance(x) <= reach_here;
          if (beside && n_beside++ == 0)
            where = x;
        }
        const bool own = n_beside > 0;
        n_beside = problem.space.processes().sum(n_beside);
        if (n_beside == 0)
          continue;
        diagnostics.warning(
          problem.conditions[b].where,
          fmt::format("{} of {} points of '{}' do not meet the obstacle, and {} points in contact lie beside such points{}: "
                      "contact ends there because the obstacle does; check its extent and which way its surface faces",
                      result.constraints[b].n_missed, result.constraints[b].n_points + result.constraints[b].n_missed, set.blocks[b].on,
                      n_beside, own ? ", one at " + point_text(where, 4) : ""),
          MessageName("points-miss-obstacle"));
      }
    }

    template <int dim>
    void warn_about_unseen_details(const RunResult &result, const Processes &processes, Diagnostics &diagnostics)
    {
      for (const UnseenDetail &detail : one_of_each_function(result.unseen_details, processes))
      {
        Point<dim> x;
        for (unsigned d = 0; d < dim; ++d)
          x[d] = detail.x[d];
        diagnostics.warning(detail.where,
                            fmt::format("'{}' is {:.4g} at {}, and the points of the cell there show {}: what is in between is not in the "
                                        "result; refine the mesh there",
                                        detail.what, detail.value, point_text(x, 6),
                                        detail.least == detail.most ? fmt::format("only {:.4g}", detail.least)
                                                                    : fmt::format("{:.4g} to {:.4g}", detail.least, detail.most)),
                            MessageName("detail-unseen"));
      }
    }

    template <int dim>
    void warn_about_unseen_contact(
      const Problem<dim> &problem, const ConstraintSet<dim> &set, const Vector &u, const Vector &lambda, Diagnostics &diagnostics)
    {
      const auto all = unseen_contact(problem, set, u, lambda);
      for (std::size_t b = 0; b < set.blocks.size(); ++b)
      {
        const UnseenContact *deepest = nullptr;
        std::uint64_t        n = 0;
        for (const UnseenContact &unseen : all)
          if (unseen.condition == b)
          {
            ++n;
            if (!deepest || unseen.depth > deepest->depth)
              deepest = &unseen;
          }
        const double depth = problem.space.processes().max(deepest ? deepest->depth : 0.);
        n = problem.space.processes().sum(n);
        if (n == 0)
          continue;
        Point<dim> where;
        for (unsigned d = 0; d < dim && deepest; ++d)
          where[d] = deepest->x[d];
        diagnostics.warning(
          problem.conditions[b].where,
          fmt::format("'{}' is up to {:.2g} inside the obstacle between the points of the rule {}, on {} face{}{}, and "
                      "none of these points nearby is in contact: this contact is not in the result; refine the mesh there",
                      set.blocks[b].on, depth, set.blocks[b].rule.name(), n, n > 1 ? "s" : "",
                      deepest ? ", at " + point_text(where, 4) : ""),
          MessageName("unseen-contact"));
      }
    }

    template <int dim, typename Archive>
    void archive(Archive &bytes, DroppedValue<dim> &value)
    {
      bytes(value.x);
      bytes(value.part);
      bytes(value.kept_part);
      bytes(value.difference);
    }

    /// Those of all processes: each node is that of one.
    template <int dim>
    std::vector<DroppedValue<dim>> all_dropped_values(const FunctionSpace<dim> &space)
    {
      ByteWriter writer;
      for (DroppedValue<dim> value : space.dropped_values)
        archive(writer, value);
      const std::vector<char>        bytes = space.processes().gather(writer.bytes);
      ByteReader                     reader(bytes);
      std::vector<DroppedValue<dim>> all;
      while (!reader.at_end())
        archive(reader, all.emplace_back());
      return all;
    }

    template <int dim>
    void warn_about_dropped_values(const Problem<dim> &problem, Diagnostics &diagnostics)
    {
      const auto                                       all = all_dropped_values(problem.space);
      std::vector<std::pair<std::string, std::string>> said;
      for (const auto &dropped : all)
      {
        const std::pair<std::string, std::string> pair(dropped.part, dropped.kept_part);
        if (std::find(said.begin(), said.end(), pair) != said.end())
          continue;
        said.push_back(pair);
        const auto     n = std::count_if(all.begin(), all.end(),
                                         [&](const auto &other) { return other.part == dropped.part && other.kept_part == dropped.kept_part; });
        SourceLocation where = problem.statement.model.where;
        for (const auto &condition : problem.statement.boundary)
          if (condition.part == dropped.part)
            where = condition.where;
        diagnostics.warning(where,
                            fmt::format("'{}' and '{}' meet at {} and demand values that differ by {:.3g}{}: that of '{}' counts; give "
                                        "both the same value there, or a transition from one to the other",
                                        dropped.part, dropped.kept_part, point_text(dropped.x, 4), dropped.difference,
                                        n > 1 ? fmt::format(", and at {} more", n - 1) : "", dropped.kept_part),
                            MessageName("contradicting-values"));
      }
    }
  } // namespace

  template <int dim>
  void warn_about_result(const RunResult           &result,
                         const Problem<dim>        &problem,
                         const ConstraintSet<dim>  &set,
                         const FacetedSurface<dim> &coarse,
                         const Vector              &u,
                         const Vector              &lambda,
                         Diagnostics               &diagnostics)
  {
    const auto running = problem.time_by_part.run("warnings");
    warn_about_dropped_values(problem, diagnostics);
    if (problem.statement.elastic())
      warn_about_large_strains(problem, u, diagnostics);
    warn_about_unseen_contact(problem, set, u, lambda, diagnostics);
    warn_about_unseen_details<dim>(result, problem.space.processes(), diagnostics);
    warn_about_missed_points(result, problem, set, lambda, diagnostics);
    warn_about_fixed_nodes(result, problem, set, lambda, diagnostics);
    warn_about_facets(problem, set, coarse, lambda, diagnostics);
    if (result.estimate && result.estimate->load_unresolved)
      diagnostics.warning(problem.statement.model.where,
                          "the load varies within cells by more than their points of integration can follow, and part of it may be missed; "
                          "refine the mesh where it varies",
                          MessageName("detail-unseen"));
    if (result.unresolved_stiffness > 0.5 * result.discretisation_indicator)
      diagnostics.warning(problem.statement.model.where,
                          "the stiffness jumps or varies within cells by more than their points of integration can follow, and most of the "
                          "estimated error comes from there; let sides of cells follow the jumps, or refine the mesh there",
                          MessageName("detail-unseen"));
    for (std::size_t k = 0; k < result.functionals.size(); ++k)
      if (!std::isfinite(result.functionals[k].value))
        diagnostics.warning(problem.statement.functionals[k].where,
                            fmt::format("functional '{}' has no finite value: its integrand is not finite at some point of integration",
                                        result.functionals[k].name),
                            MessageName("functional-without-value"));
  }

#define INSTANTIATE(dim)                                                                                                                   \
  template void warn_about_result(const RunResult &, const Problem<dim> &, const ConstraintSet<dim> &, const FacetedSurface<dim> &,        \
                                  const Vector &, const Vector &, Diagnostics &);
  INSTANTIATE(1)
  INSTANTIATE(2)
  INSTANTIATE(3)
#undef INSTANTIATE
} // namespace unilateral
