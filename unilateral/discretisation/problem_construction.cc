// How a Problem comes about and goes on to the next mesh.
#include "unilateral/discretisation/problem.h"

#include "unilateral/constraints/direction_of_contact.h"
#include "unilateral/constraints/quadrature_rule.h"
#include "unilateral/discretisation/data_changes.h"
#include "unilateral/discretisation/free_mode_report.h"
#include "unilateral/discretisation/loose_pieces.h"
#include "unilateral/discretisation/motion_names.h"
#include "unilateral/discretisation/regions_and_parts.h"
#include "unilateral/discretisation/rigid_body_modes.h"
#include "unilateral/forms/make_form.h"
#include "unilateral/functions/make_rigid_surface.h"
#include "unilateral/mesh/box_around.h"
#include "unilateral/mesh/make_mesh.h"
#include "unilateral/mesh/named_parts.h"

#include <fmt/format.h>

#include <algorithm>
#include <stdexcept>
#include <utility>

namespace unilateral
{
  using namespace dealii;

  namespace
  {
    /// The element of V_h: on segments P and Q are the same, and a discontinuous one has the points of the rule.
    template <int dim>
    ElementName element_on(const ProblemStatement &statement)
    {
      ElementName element = statement.model.element;
      if (dim == 1 && element.simplex())
        element.family = ElementName::Family::Q;
      if (element.family == ElementName::Family::discontinuous)
        element.degree = n_points_1d(first_rule(statement, dim), element) - 1;
      return element;
    }

    /// The order that drawings are meshed with: curved cells where the element can follow them, of a higher order where finer cells come
    /// after them that do, see CurvedCells. Q1 keeps straight coarse cells, of which several processes can each refine a part.
    template <int dim>
    unsigned order_of_geometry(const ProblemStatement &statement)
    {
      const ElementName  element = element_on<dim>(statement);
      const RefinedMesh &mesh = statement.mesh;
      const bool refined = mesh.compared_with_finer || mesh.refine > 0 || (element.simplex() && (mesh.n_refinements() > 0 || mesh.adapt));
      if (element.family == ElementName::Family::hermite || (element.degree == 1 && !(refined && element.simplex())))
        return 1;
      return refined ? 4 : 2;
    }

    template <int dim>
    Mesh<dim> coarse_mesh(const ProblemStatement &statement, Diagnostics &diagnostics)
    {
      auto mesh = make_mesh<dim>(statement.mesh, element_on<dim>(statement).simplex(), order_of_geometry<dim>(statement));
      name_parts(mesh, statement.mesh.parts, diagnostics);
      return mesh;
    }

    /// The points that a discontinuous element has in each direction.
    template <int dim>
    Quadrature<1> points_of_discontinuous(const ProblemStatement &statement)
    {
      const ElementName element = element_on<dim>(statement);
      if (element.family == ElementName::Family::discontinuous)
        return quadrature_rule<1>(first_rule(statement, dim), element);
      return Quadrature<1>();
    }
  } // namespace

  template <int dim>
  Problem<dim>::Problem(const ProblemStatement &statement, Diagnostics &diagnostics)
    : Problem(statement, coarse_mesh<dim>(statement, diagnostics), diagnostics)
  {
  }

  template <int dim>
  Problem<dim>::Problem(const ProblemStatement &statement, Mesh<dim> mesh, Diagnostics &diagnostics)
    : Problem(statement, ReceivedPart<dim>{std::move(mesh), nullptr}, diagnostics)
  {
  }

  template <int dim>
  Problem<dim>::Problem(const ProblemStatement &statement, ReceivedPart<dim> part, Diagnostics &diagnostics)
    : statement(statement), space(std::move(part.mesh),
                                  element_on<dim>(statement),
                                  statement.elastic() ? dim : 1,
                                  points_of_discontinuous<dim>(statement),
                                  statement.model.element_where.line > 0 ? statement.model.element_where : statement.mesh.where,
                                  time_by_part)
  {
    space.subdomain = std::move(part.subdomain);
    for (const auto &warning : space.mesh.warnings)
      diagnostics.warning(statement.mesh.where, warning, MessageName("mesh-repaired"));
    build_form(diagnostics);
    read_constraints(diagnostics);
    find_round_parts(/*on_coarse_mesh=*/true);
    check_probes(diagnostics);
    diagnostics.throw_if_errors();
    space.distribute_dofs(prescribed);
    measure_parts();
    hold_free_modes(&diagnostics);
  }

  template <int dim>
  Problem<dim>::Problem(const ProblemStatement &statement, ReceivedPart<dim> part, const OfWhole &known)
    : statement(statement), space(std::move(part.mesh),
                                  element_on<dim>(statement),
                                  statement.elastic() ? dim : 1,
                                  points_of_discontinuous<dim>(statement),
                                  statement.mesh.where,
                                  time_by_part),
      round_parts(known.round_parts)
  {
    Diagnostics none;
    space.subdomain = std::move(part.subdomain);
    build_form(none);
    read_constraints(none);
    find_round_parts(/*on_coarse_mesh=*/false);
    none.throw_if_errors();
    prescribed.pins = known.pins;
    space.distribute_dofs(prescribed);
    measure_parts();
    hold_free_modes();
  }

  template <int dim>
  typename Problem<dim>::OfWhole Problem<dim>::of_whole() const
  {
    return {round_parts, prescribed.pins};
  }

  /// By the rule that integrates the loads, so that resultants are met exactly.
  template <int dim>
  void Problem<dim>::measure_parts()
  {
    if (form->needs_surface_moments())
      form->set_surface_moments(surface_moments<dim>(
        *space.mapping, space.dof_handler, face_quadrature(), space.mesh.part_names.size(),
        [this](const Point<dim> &x) { return form->measure(x); }, space.processes()));
  }

  template <int dim>
  void Problem<dim>::build_form(Diagnostics &diagnostics)
  {
    const auto regions = coefficients_by_region(statement, space.mesh.region_names, diagnostics);
    prescribed = {conditions_by_part(statement, space.mesh.part_names, diagnostics),
                  statement.supports,
                  axisymmetric(),
                  {},
                  periodic_pairs(statement, space.mesh.part_names, diagnostics)};
    if (space.subdomain) // what was cut is no boundary
      prescribed.conditions.back() = {};
    check_couplings(statement, diagnostics);
    form = make_form<dim>(statement.model, statement.own_form, regions, space.mesh.region_names, prescribed.conditions, diagnostics);
    const auto [lower, upper] = box_around(*space.mesh.triangulation, space.processes());
    const double diameter = lower.distance(upper);
    if (!(diameter > 1e-50 && diameter < 1e50))
      diagnostics.error(statement.mesh.where,
                        fmt::format("the mesh is {:.3g} long: its volumes and their products leave the range of double "
                                    "precision; choose another unit of length",
                                    diameter),
                        MessageName("unit-of-length"));
    form->unit_of_length = norm_unit(diameter, form->order());
    if (axisymmetric())
      for (const auto &vertex : space.mesh.triangulation->get_vertices())
        if (vertex[0] < -1e-12 * vertex.norm())
        {
          diagnostics.error(statement.mesh.where,
                            "an axisymmetric body has x >= 0, the distance from the axis; the mesh has points with x < 0",
                            MessageName("kind-does-not-fit"));
          break;
        }
  }

  template <int dim>
  void Problem<dim>::read_constraints(Diagnostics &diagnostics)
  {
    for (const auto &spec : statement.constraints)
    {
      UnilateralCondition condition;
      condition.on = spec.on;
      condition.where = spec.where;
      if (!spec.on.empty())
      {
        condition.part = find_name(space.mesh.part_names, spec.on);
        if (!condition.part)
        {
          diagnostics.error(
            spec.on_where,
            fmt::format("the boundary has no part '{}'{}", spec.on, suggestion_with_list(spec.on, space.mesh.part_names, "parts")),
            MessageName("unknown-part"));
          continue;
        }
      }
      condition.rule = spec.quadrature.value_or(default_rule(space.element, condition.part ? dim - 1 : dim));
      // A case was checked when it was read, but a study of rules changes the rule after that.
      try
      {
        if (condition.part)
          quadrature_rule<dim - 1>(condition.rule, space.element);
        else
          quadrature_rule<dim>(condition.rule, space.element);
      }
      catch (const std::invalid_argument &reason)
      {
        diagnostics.error(spec.quadrature ? spec.quadrature_where : spec.where, reason.what(), MessageName("rule-does-not-fit"));
        continue;
      }
      if (spec.gap || spec.surface)
      {
        read_surface(spec, condition, diagnostics);
        conditions.push_back(condition);
      }
      for (const auto side : {Side::lower, Side::upper})
        if (const auto &bound = side == Side::lower ? spec.lower : spec.upper)
        {
          condition.side = side;
          condition.bound = *bound;
          conditions.push_back(condition);
        }
    }
  }

  template <int dim>
  void Problem<dim>::read_surface(const UnilateralBound &spec, UnilateralCondition &condition, Diagnostics &diagnostics) const
  {
    condition.side = Side::upper;
    if (!spec.direction.empty())
    {
      double length = 0;
      for (const double d : spec.direction)
        length += d * d;
      for (const double d : spec.direction)
        condition.direction.push_back(d / std::sqrt(length));
    }
    try
    {
      if (spec.surface)
        condition.surface = make_rigid_surface(*spec.surface);
      else
        condition.bound = *spec.gap;
    }
    catch (const InputError &e)
    {
      diagnostics.add_errors(e.diagnostics);
    }
  }

  template <int dim>
  void Problem<dim>::check_probes(Diagnostics &diagnostics) const
  {
    // The box around the mesh is all that is certain before a curved boundary has been refined.
    const auto [lower, upper] = box_around(*space.mesh.triangulation, space.processes());
    for (std::size_t k = 0; k < statement.output.probes.size(); ++k)
      for (unsigned d = 0; d < dim; ++d)
      {
        const double x = statement.output.probes[k][d], slack = (space.mesh.curved ? 0.3 : 1e-9) * (upper[d] - lower[d]);
        if (x < lower[d] - slack || x > upper[d] + slack)
        {
          diagnostics.error(
            statement.output.probes_where[k],
            fmt::format("the probe lies outside the mesh, which spans {:.6g} to {:.6g} in {}", lower[d], upper[d], "xyz"[d]),
            MessageName("point-outside"));
          break;
        }
      }
  }

  /// Vertices that refinement adds may lie on the chords of a curved part: what it stands for its first mesh shows.
  template <int dim>
  void Problem<dim>::find_round_parts(const bool on_coarse_mesh)
  {
    for (auto &condition : conditions)
    {
      if (!condition.part || form->n_components() == 1 || direction_of_contact<dim>(condition.direction, condition.surface.get()))
        continue;
      if (on_coarse_mesh && !round_parts.count(*condition.part))
        round_parts[*condition.part] =
          round_surface_of(gather_facets(facets_of_part(*space.mesh.triangulation, *condition.part), space.processes()),
                           condition.surface ? condition.surface->axis_direction() : std::nullopt, space.mesh.curved);
      if (const auto known = round_parts.find(*condition.part); known != round_parts.end())
        condition.round = known->second;
    }
  }

  /// The points of a rule need not reach as far as the part that may touch; vertices do.
  template <int dim>
  bool Problem<dim>::vertices_hold(const Eigen::MatrixXd &free) const
  {
    auto at_vertices = conditions;
    for (auto &condition : at_vertices)
      if (space.element.family != ElementName::Family::discontinuous)
        condition.rule = {RuleName::Family::trapezoid};
    try
    {
      return judge_free_modes(*this, make_constraint_set(at_vertices), free).error.empty();
    }
    catch (const InputError &) // a bound that boundary data violate there
    {
      return false;
    }
  }

  template <int dim>
  void Problem<dim>::hold_free_modes(Diagnostics *const diagnostics)
  {
    null_space.clear();
    not_held.clear();
    const auto pins_before = std::exchange(prescribed.pins, {});
    if (!pins_before.empty())
      space.distribute_dofs(prescribed);
    unsupported = combined_modes(*this, unsupported_modes(*this));
    auto free = free_modes(*this);
    if (statement.check_motions && diagnostics)
    {
      check_loose_pieces(*this, *diagnostics);
      if (const auto motion = motion_held_by_weak_springs(*this))
        diagnostics->warning(
          statement.model.where,
          fmt::format("springs hold a {} with {:.1e} of the stiffness of the body, which rounding may hide; take stiffer "
                      "ones, or hold the motion by [boundary]",
                      motion->first, motion->second),
          MessageName("hardly-held"));
    }
    if (free.cols() == 0 || !statement.check_motions)
      return;
    const auto report = judge_free_modes(*this, make_constraint_set(), free);
    if (!report.error.empty() && vertices_hold(free))
    {
      not_held = fmt::format("contact at the points of the rule '{}' does not hold the {} on this mesh: the load presses it beyond them; "
                             "take finer cells, or quadrature = \"trapezoid\", the vertices",
                             conditions.front().rule.name(), statement.elastic() ? "body" : "solution");
      if (space.level >= statement.mesh.n_refinements() && !statement.mesh.adapt)
        throw InputError(statement.model.where, not_held, MessageName("rigid-motion-free"));
      null_space = combined_modes(*this, free);
      return;
    }
    if (!report.error.empty())
      throw InputError(statement.model.where, report.error, MessageName("rigid-motion-free"));
    if (!report.warning.empty() && diagnostics)
      diagnostics->warning(statement.model.where, report.warning, MessageName("hardly-held"));
    if (report.indifferent.cols() > 0 && space.hermite())
      throw InputError(statement.model.where,
                       "contact leaves a motion free that the load does not drive either: hold it by [boundary] or a "
                       "[[support]]",
                       MessageName("rigid-motion-free"));
    if (report.indifferent.cols() > 0)
    {
      const auto hold_by = [&](std::vector<Pin<dim>> pins)
      {
        prescribed.pins = std::move(pins);
        space.distribute_dofs(prescribed);
        return free_modes(*this);
      };
      // As long as they serve they stay, and u does not move with the mesh or the number of processes.
      const Eigen::Index n_others = free.cols() - report.indifferent.cols();
      const bool         as_many = Eigen::Index(pins_before.size()) == report.indifferent.cols();
      if (Eigen::MatrixXd others = as_many ? hold_by(pins_before) : free; others.cols() == n_others)
        free = std::move(others);
      else
        free = hold_by(pins_against(*this, report.indifferent));
      names_of_pinned = motion_names(report.indifferent, rigid_body_modes(*this));
      unsupported = combined_modes(*this, unsupported_modes(*this));
    }
    null_space = combined_modes(*this, free);
  }

  namespace
  {
    /// Do the conditions fix the same unknowns, in terms of the same others, be it at other values?
    bool fix_the_same(const AffineConstraints<double> &a, const AffineConstraints<double> &b)
    {
      const auto lines_a = a.get_lines(), lines_b = b.get_lines();
      return std::equal(lines_a.begin(), lines_a.end(), lines_b.begin(), lines_b.end(),
                        [](const auto &x, const auto &y) { return x.index == y.index && x.entries == y.entries; });
    }
  } // namespace

  template <int dim>
  typename Problem<dim>::Unchanged Problem<dim>::restate(const ProblemStatement &other, Diagnostics &diagnostics)
  {
    Unchanged unchanged{same_form(statement, other), false};
    statement = other;
    auto pins = std::move(prescribed.pins);
    conditions.clear();
    build_form(diagnostics);
    read_constraints(diagnostics);
    find_round_parts(/*on_coarse_mesh=*/false);
    diagnostics.throw_if_errors();
    prescribed.pins = std::move(pins);
    const AffineConstraints<double> before = std::move(space.dirichlet);
    space.fix_values(prescribed);
    measure_parts();
    const bool fixes_the_same = !space.processes().any(!fix_the_same(before, space.dirichlet));
    if (semicoercive() || has_pins() || !unchanged.matrix || !fixes_the_same)
      hold_free_modes(&diagnostics);
    unchanged.fixed = !space.processes().any(!fix_the_same(before, space.dirichlet));
    return unchanged;
  }

  template <int dim>
  void Problem<dim>::refine(typename FunctionSpace<dim>::Functions &functions, const bool smoothly, const std::vector<bool> *const chosen)
  {
    const auto        running = time_by_part.run("guess");
    std::vector<bool> in_place;
    if (!chosen)
      in_place = cells_of_next_refinement();
    space.refine(prescribed, functions, smoothly, chosen ? chosen : in_place.empty() ? nullptr : &in_place);
    measure_parts();
    // What contact feels of a mode depends on the mesh: the normals of a coarse ball resist its rotation, those of a fine one do not.
    if (semicoercive() || has_pins())
      hold_free_modes();
  }

  template <int dim>
  std::vector<bool> Problem<dim>::cells_of_next_refinement() const
  {
    const FieldFunction *const place = statement.mesh.place_of_refinement(space.level);
    return place ? space.cells_at(*place) : std::vector<bool>();
  }

  template <int dim>
  void Problem<dim>::keep_own_part(const Processes                        &processes,
                                   Division                                division,
                                   const unsigned                          n_alike,
                                   typename FunctionSpace<dim>::Functions &functions,
                                   const bool                              refined_next)
  {
    space.keep_own_part(prescribed, processes, std::move(division), n_alike, functions, refined_next);
    measure_parts();
  }

  template <int dim>
  bool
  Problem<dim>::divide_anew(const std::vector<double> &weights, typename FunctionSpace<dim>::Functions &functions, std::vector<bool> &marks)
  {
    if (!space.divide_anew(prescribed, weights, functions, marks))
      return false;
    measure_parts();
    return true;
  }

#define INSTANTIATE(dim)                                                                                                                   \
  template Problem<dim>::Problem(const ProblemStatement &, Diagnostics &);                                                                 \
  template Problem<dim>::Problem(const ProblemStatement &, Mesh<dim>, Diagnostics &);                                                      \
  template Problem<dim>::Problem(const ProblemStatement &, ReceivedPart<dim>, Diagnostics &);                                              \
  template Problem<dim>::Problem(const ProblemStatement &, ReceivedPart<dim>, const OfWhole &);                                            \
  template typename Problem<dim>::OfWhole   Problem<dim>::of_whole() const;                                                                \
  template typename Problem<dim>::Unchanged Problem<dim>::restate(const ProblemStatement &, Diagnostics &);                                \
  template void                             Problem<dim>::refine(FunctionSpace<dim>::Functions &, bool, const std::vector<bool> *);        \
  template std::vector<bool>                Problem<dim>::cells_of_next_refinement() const;                                                \
  template void Problem<dim>::keep_own_part(const Processes &, Division, unsigned, FunctionSpace<dim>::Functions &, bool);                 \
  template bool Problem<dim>::divide_anew(const std::vector<double> &, FunctionSpace<dim>::Functions &, std::vector<bool> &);
  INSTANTIATE(1)
  INSTANTIATE(2)
  INSTANTIATE(3)
#undef INSTANTIATE
} // namespace unilateral
