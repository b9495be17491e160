#include "unilateral/studies/inf_sup_study.h"

#include "unilateral/base/processes.h"
#include "unilateral/output/json.h"
#include "unilateral/output/results.h"
#include "unilateral/solve.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace unilateral
{
  using Json = nlohmann::ordered_json;

  namespace
  {
    /// The statement with its first constraint alone, and one side of it: both sides see the same points.
    ProblemStatement first_constraint_of(const ProblemStatement &statement)
    {
      ProblemStatement first = statement;
      first.constraints.resize(1);
      first.check_motions = false; // the others may hold the body
      if (first.constraints[0].lower && first.constraints[0].upper)
        first.constraints[0].upper.reset();
      return first;
    }

    /// Which points of the first constraint carry pressure in the solved problem, by either side.
    template <int dim>
    std::vector<bool> contact_zone(const ProblemStatement &statement, const unsigned level, const std::size_t n_points, Progress &progress)
    {
      ProblemStatement on_level = statement;
      on_level.mesh.refine = level;
      on_level.mesh.local.clear();
      on_level.mesh.adapt.reset();
      class Quiet : public Progress
      {
      public:
        explicit Quiet(const Progress &outer) : outer(outer) {}
        bool stop_requested() const override { return outer.stop_requested(); }

      private:
        const Progress &outer;
      } quiet(progress);
      Diagnostics       nobody;
      const auto        solution = solve<dim>(on_level, nobody, quiet);
      std::vector<bool> zone(n_points, false);
      if (!solution.result.converged)
        return zone;
      const bool both_sides = statement.constraints[0].lower && statement.constraints[0].upper;
      for (std::size_t b = 0; b < (both_sides ? 2u : 1u); ++b)
      {
        const auto &block = solution.constraint_set.blocks[b];
        for (std::size_t i = block.begin; i < block.end; ++i)
          if (solution.contact_pressure(i) > 0)
            zone[i - block.begin] = true;
      }
      return zone;
    }

    bool any(const std::vector<bool> &flags)
    {
      return std::find(flags.begin(), flags.end(), true) != flags.end();
    }
  } // namespace

  template <int dim>
  VtuGrid mode_grid(const Problem<dim>        &problem,
                    const ConstraintSet<dim>  &constraint_set,
                    const std::vector<bool>   &zone,
                    const std::vector<double> &mode)
  {
    std::vector<double> q(constraint_set.size() + 1, 0.); // the last one stands for dropped points
    for (std::size_t i = 0, k = 0; i < zone.size(); ++i)
      if (zone[i])
        q[i] = mode[k++] / std::sqrt(constraint_set.points[i].weight);
    const auto as_array = [](const dealii::Point<dim> &x)
    {
      std::array<double, 3> result{};
      for (unsigned d = 0; d < dim; ++d)
        result[d] = x[d];
      return result;
    };
    VtuGrid             grid;
    std::vector<double> values;
    const auto          add_cell = [&](const auto &entity, const double value)
    {
      // deal.II numbers the vertices of quadrilaterals and hexahedra lexicographically, VTK around.
      const unsigned        n = entity->n_vertices();
      std::vector<unsigned> order;
      for (unsigned v = 0; v < n; ++v)
        order.push_back(v);
      const bool quad = entity->reference_cell() == dealii::ReferenceCells::Quadrilateral;
      const bool hexahedron = entity->reference_cell() == dealii::ReferenceCells::Hexahedron;
      if (quad || hexahedron)
        std::swap(order[2], order[3]);
      if (hexahedron)
        std::swap(order[6], order[7]);
      for (const unsigned v : order)
      {
        grid.connectivity.push_back(grid.points.size());
        grid.points.push_back(as_array(entity->vertex(v)));
      }
      grid.offsets.push_back(grid.connectivity.size());
      grid.cell_types.push_back(n == 1                                                            ? 1
                                : n == 2                                                          ? 3
                                : n == 3                                                          ? 5
                                : quad                                                            ? 9
                                : entity->reference_cell() == dealii::ReferenceCells::Tetrahedron ? 10
                                                                                                  : 12);
      values.push_back(value);
    };
    for (const auto &[cell, face, locations, points] : rule_on_cells(problem, constraint_set, 0))
    {
      double sum = 0;
      for (const std::size_t i : points)
        sum += q[i];
      if (!face)
        add_cell(cell, sum / points.size());
      else if constexpr (dim > 1)
        add_cell(cell->face(*face), sum / points.size());
    }
    for (std::size_t i = 0; i < constraint_set.size(); ++i)
    {
      grid.connectivity.push_back(grid.points.size());
      grid.points.push_back(as_array(constraint_set.points[i].x));
      grid.offsets.push_back(grid.connectivity.size());
      grid.cell_types.push_back(1);
      values.push_back(q[i]);
    }
    grid.cell_arrays.push_back({"lowest_mode", values});
    return grid;
  }

  namespace
  {
    /// The problem on one level of the study, and the points of its rule.
    template <int dim>
    struct InfSupLevel
    {
      const Problem<dim>       &problem;
      const ConstraintSet<dim> &constraint_set;
      unsigned                  level;
      std::size_t               n_free;
    };

    struct ConstantsOfLevel
    {
      InfSupStudy::Row  row;
      std::vector<bool> deciding_zone; ///< the zone that was asked for, else all points
    };

    /// Throws std::length_error when the level is too large.
    template <int dim>
    InfSup
    constants_of_zone(const InfSupLevel<dim> &on, const std::vector<bool> &zone, const PairingKind kind, const InfSupStudyOptions &options)
    {
      const bool exact_pairing = on.constraint_set.blocks[0].exact_pairing;
      // Where (14) holds the two products are one; the dual norm needs the polynomial then, since more than V_h sees it.
      const PairingKind      kind_of_dual = exact_pairing && has_polynomials(on.problem, on.constraint_set) ? PairingKind::by_L2 : kind;
      const Pairing          pairing = make_pairing(on.problem, on.constraint_set, zone, kind);
      std::optional<Pairing> dual;
      if (options.with_dual_norm && n_dual_unknowns(on.problem) <= options.limits.dual)
        dual = make_dual_pairing(on.problem, on.constraint_set, zone, kind_of_dual);
      return inf_sup(pairing, dual ? &*dual : nullptr, options.limits);
    }

    /// Which points lie where @p lies_in_zone is not 0.
    template <int dim>
    std::vector<bool> points_in_zone(const FieldFunction &lies_in_zone, const ConstraintSet<dim> &constraint_set)
    {
      std::vector<bool> zone(constraint_set.size());
      for (std::size_t i = 0; i < zone.size(); ++i)
        zone[i] = lies_in_zone.value(constraint_set.points[i].x) != 0;
      return zone;
    }

    /// Throws std::length_error when the level is too large.
    template <int dim>
    ConstantsOfLevel
    constants_of_level(const InfSupLevel<dim> &on, const ProblemStatement &statement, const InfSupStudyOptions &options, Progress &progress)
    {
      const auto       &set = on.constraint_set;
      ConstantsOfLevel  result{{}, std::vector<bool>(set.size(), true)};
      InfSupStudy::Row &row = result.row;
      row.level = on.level;
      row.h = on.problem.space.cell_sizes().second;
      if (on.n_free + set.size() > options.limits.sparse)
        throw std::length_error(
          fmt::format("{} free unknowns and {} points are more than the {} that are tried", on.n_free, set.size(), options.limits.sparse));
      row.all = constants_of_zone(on, result.deciding_zone, PairingKind::by_rule, options);
      if (!set.blocks[0].exact_pairing && has_polynomials(on.problem, set))
        row.by_L2 = constants_of_zone(on, result.deciding_zone, PairingKind::by_L2, options);
      if (options.with_contact)
        if (const auto zone = contact_zone<dim>(statement, on.level, set.size(), progress); any(zone))
          row.contact = constants_of_zone(on, zone, PairingKind::by_rule, options);
      if (options.zone)
        if (const auto zone = points_in_zone(*options.zone, set); any(zone))
        {
          row.zone = constants_of_zone(on, zone, PairingKind::by_rule, options);
          result.deciding_zone = zone;
        }
      return result;
    }

    /// Throws InputError when no level within the limits has a point in the zone. Meshes and points cost next to nothing beside the
    /// constants.
    template <int dim>
    void check_zone(const ProblemStatement &first_constraint, const InfSupStudyOptions &options)
    {
      Diagnostics         nobody;
      Problem<dim>        problem(first_constraint, nobody);
      std::vector<Vector> nothing_to_carry;
      for (unsigned level = 0; level < options.n_levels; ++level)
      {
        if (level > 0)
          problem.refine(nothing_to_carry);
        const auto set = problem.make_constraint_set();
        if (any(points_in_zone(*options.zone, set)))
          return;
        if (problem.space.dof_handler.n_dofs() + set.size() > options.limits.sparse)
          break;
      }
      throw InputError(options.zone->where(), fmt::format("no point of the rule lies where {}", options.zone_name),
                       MessageName("point-outside"));
    }

    /// @p at_nodes: the points of every level are nodes.
    template <int dim>
    void add_verdicts(InfSupStudy &study, const Problem<dim> &problem, const InfSupStudyOptions &options, const bool at_nodes)
    {
      const bool        on_boundary = problem.conditions[0].part.has_value();
      const std::string stable_rule = default_rule(problem.space.element, on_boundary ? dim - 1 : dim).name();
      const auto        judge = [&](const auto &constants_of_row) -> std::optional<StabilityVerdict>
      {
        std::vector<InfSup> judged;
        for (const auto &row : study.rows)
          if (const InfSup *constants = constants_of_row(row); constants && constants->rank > 0 && constants->n_points >= 3)
            judged.push_back(*constants);
        if (judged.size() < 2)
          return {};
        return judge_stability(judged, on_boundary ? problem.form->order() - 0.5 : problem.form->order(),
                               stable_rule == study.quadrature ? "" : stable_rule, at_nodes);
      };
      const auto pointer = [](const std::optional<InfSup> &constants) { return constants ? &*constants : nullptr; };
      study.verdict = judge([&](const auto &row) { return !options.zone ? &row.all : pointer(row.zone); });
      study.contact_verdict = judge([&](const auto &row) { return pointer(row.contact); });
    }
  } // namespace

  template <int dim>
  InfSupStudy
  study_inf_sup(const ProblemStatement &statement, const InfSupStudyOptions &options, Diagnostics &diagnostics, Progress &progress)
  {
    if (statement.constraints.empty())
      throw InputError(statement.model.where, "the case has no [constraint]: there is no pairing to look at",
                       MessageName("nothing-to-study"));
    if (statement.constraints.size() > 1)
      diagnostics.warning(statement.constraints[1].where, "inf-sup constants are those of the first [[constraint]]; this one is left out",
                          MessageName("first-constraint-only"));
    ProblemStatement first_constraint = first_constraint_of(statement);
    first_constraint.mesh.refine = options.n_levels; // a coarse level without points is no mistake
    first_constraint.mesh.local.clear();             // rates are those of meshes that are halved as a whole
    first_constraint.mesh.adapt.reset();
    Problem<dim> problem(first_constraint, diagnostics);
    if (options.zone)
      check_zone<dim>(first_constraint, options);
    InfSupStudy study;
    study.element = statement.model.element.name();
    study.zone = options.zone_name;
    std::vector<Vector> nothing_to_carry;
    bool                at_nodes = true;
    for (unsigned level = 0; level < options.n_levels; ++level)
    {
      if (progress.stop_requested())
        throw Interrupted();
      if (level > 0)
        problem.refine(nothing_to_carry);
      const std::size_t n_free = problem.space.dof_handler.n_dofs() - problem.space.dirichlet.n_constraints();
      progress.phase("inf-sup", fmt::format("level {} of {} at most, {} unknowns", level + 1, options.n_levels, n_free));
      const auto  constraint_set = problem.make_constraint_set();
      const auto &block = constraint_set.blocks[0];
      study.quadrature = block.rule.name();
      study.on = block.on;
      study.exact_pairing = block.exact_pairing;
      if (constraint_set.size() == 0 || n_free == 0)
        continue;
      at_nodes = at_nodes && constraint_set.at_nodes();
      try
      {
        auto [row, deciding_zone] =
          constants_of_level(InfSupLevel<dim>{problem, constraint_set, level, n_free}, statement, options, progress);
        study.lowest_mode = mode_grid(problem, constraint_set, deciding_zone, (row.zone ? *row.zone : row.all).lowest_mode);
        study.rows.push_back(std::move(row));
      }
      catch (const std::length_error &too_large)
      {
        study.stopped = fmt::format("level {}: {}", level, too_large.what());
        if (study.rows.empty())
          throw InputError(statement.mesh.where, study.stopped + "; give a coarser mesh", MessageName("mesh-too-large"));
        break;
      }
    }
    add_verdicts(study, problem, options, at_nodes);
    return study;
  }

  namespace
  {
    Json row_json(const InfSupStudy::Row &row, const InfSup &constants)
    {
      Json json = {{"level", row.level}, {"h", row.h}};
      json["n_dofs"] = constants.n_dofs;
      json["n_points"] = constants.n_points;
      json["rank"] = constants.rank;
      json["nullity"] = constants.nullity;
      json["C_h"] = constants.C_h;
      json["C_h_nonzero"] = constants.C_h_nonzero;
      json["beta_h"] = or_null(constants.beta_h);
      json["beta_h_nonzero"] = or_null(constants.beta_h_nonzero);
      json["method"] = constants.dense ? "dense singular values" : "sparse QR and ARPACK";
      return json;
    }

    /// Rates between neighbouring levels, the last two at the end.
    Json rates_json(const std::vector<const InfSup *> &levels, const std::vector<double> &h)
    {
      Json       json = {{"C_h_nonzero", Json::array()}, {"beta_h_nonzero", Json::array()}};
      const auto rate = [&](const double coarse, const double fine, const std::size_t k)
      { return coarse > 0 && fine > 0 ? Json(std::log(coarse / fine) / std::log(h[k - 1] / h[k])) : Json(nullptr); };
      for (std::size_t k = 1; k < levels.size(); ++k)
      {
        json["C_h_nonzero"].push_back(rate(levels[k - 1]->C_h_nonzero, levels[k]->C_h_nonzero, k));
        const auto &a = levels[k - 1]->beta_h_nonzero, &b = levels[k]->beta_h_nonzero;
        json["beta_h_nonzero"].push_back(a && b ? rate(*a, *b, k) : Json(nullptr));
      }
      return json;
    }

    /// The zones that a row may have: name, label in the files, constants.
    struct ZoneColumn
    {
      const char *name;
      const InfSup *(*constants)(const InfSupStudy::Row &);
    };
    constexpr ZoneColumn zones[] = {
      {"all", [](const InfSupStudy::Row &row) -> const InfSup * { return &row.all; }},
      {"L2", [](const InfSupStudy::Row &row) -> const InfSup * { return row.by_L2 ? &*row.by_L2 : nullptr; }},
      {"contact", [](const InfSupStudy::Row &row) -> const InfSup * { return row.contact ? &*row.contact : nullptr; }},
      {"zone", [](const InfSupStudy::Row &row) -> const InfSup * { return row.zone ? &*row.zone : nullptr; }}};
  } // namespace

  Json to_json(const InfSupStudy &study, const CaseSource &source)
  {
    Json json;
    json["schema_version"] = 1;
    json["program"] = program_json(Processes::all().size());
    json["case"] = to_json(source);
    json.update(constants_json(study));
    return json;
  }

  Json constants_json(const InfSupStudy &study)
  {
    Json json;
    json["element"] = study.element;
    json["quadrature"] = study.quadrature;
    json["on"] = study.on;
    json["exact_pairing"] = study.exact_pairing;
    json["dual_norm"] =
      "supremum over a space on the mesh refined once, of degree 8 in 1-D and p + 1 otherwise; q is the polynomial on each "
      "cell where (14) holds with a Gauss rule, a sum of point masses else";
    json["rates"] = nullptr;
    for (const ZoneColumn &zone : zones)
    {
      std::vector<const InfSup *> levels;
      std::vector<double>         h;
      Json                        rows = Json::array();
      for (const auto &row : study.rows)
        if (const InfSup *const constants = zone.constants(row))
        {
          rows.push_back(row_json(row, *constants));
          levels.push_back(constants);
          h.push_back(row.h);
        }
      const std::string prefix = zone.name == std::string("all") ? "" : zone.name + std::string("_");
      if (zone.name == std::string("zone") && !study.zone.empty())
        json["zone"] = study.zone;
      if (rows.empty() && !prefix.empty() && (zone.name != std::string("zone") || study.zone.empty()))
        continue;
      json[prefix + "rows"] = rows;
      json[prefix + "rates"] = rates_json(levels, h);
    }
    const auto verdict = [&](const std::string &prefix, const std::optional<StabilityVerdict> &verdict)
    {
      json[prefix + "verdict"] = verdict ? Json(to_string(verdict->stability)) : Json(nullptr);
      if (verdict)
        json[prefix + "advice"] = verdict->advice;
    };
    verdict("", study.verdict);
    if (study.contact_verdict)
      verdict("contact_", study.contact_verdict);
    if (!study.stopped.empty())
      json["stopped"] = study.stopped;
    return json;
  }

  std::string to_csv(const InfSupStudy &study)
  {
    std::string text = "zone,level,h,n_dofs,n_points,rank,nullity,C_h,C_h_nonzero,beta_h,beta_h_nonzero\n";
    const auto  optional = [](const std::optional<double> &value) { return value ? fmt::format("{:.12g}", *value) : std::string(); };
    for (const ZoneColumn &zone : zones)
      for (const auto &row : study.rows)
        if (const InfSup *const c = zone.constants(row))
          text += fmt::format("{},{},{:.12g},{},{},{},{},{:.12g},{:.12g},{},{}\n", zone.name, row.level, row.h, c->n_dofs, c->n_points,
                              c->rank, c->nullity, c->C_h, c->C_h_nonzero, optional(c->beta_h), optional(c->beta_h_nonzero));
    return text;
  }

#define INSTANTIATE(dim)                                                                                                                   \
  template InfSupStudy study_inf_sup<dim>(const ProblemStatement &, const InfSupStudyOptions &, Diagnostics &, Progress &);                \
  template VtuGrid     mode_grid(const Problem<dim> &, const ConstraintSet<dim> &, const std::vector<bool> &, const std::vector<double> &);
  INSTANTIATE(1)
  INSTANTIATE(2)
  INSTANTIATE(3)
#undef INSTANTIATE
} // namespace unilateral
