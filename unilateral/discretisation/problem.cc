#include "unilateral/discretisation/problem.h"
#include "unilateral/mesh/make_mesh.h"

#include "unilateral/forms/beam.h"
#include "unilateral/spaces/cell_points.h"
#include "unilateral/spaces/interpolation_to_refined_cells.h"
#include "unilateral/mesh/congruent_cells.h"
#include "unilateral/forms/elasticity.h"
#include "unilateral/discretisation/regions_and_parts.h"
#include "unilateral/discretisation/rigid_body_modes.h"
#include "unilateral/spaces/hanging_nodes.h"
#include "unilateral/spaces/hermite.h"
#include "unilateral/spaces/hermite_dirichlet_conditions.h"
#include "unilateral/forms/membrane.h"
#include "unilateral/forms/plate.h"
#include "unilateral/forms/projection.h"
#include "unilateral/functions/make_rigid_surface.h"
#include "unilateral/spaces/simplex_element.h"
#include "unilateral/mesh/simplex_refinement.h"

#include <deal.II/base/bounding_box.h>
#include <deal.II/base/quadrature_lib.h>
#include <deal.II/dofs/dof_renumbering.h>
#include <deal.II/fe/fe_dgq.h>
#include <deal.II/fe/fe_q.h>
#include <deal.II/fe/fe_simplex_p.h>
#include <deal.II/fe/fe_system.h>
#include <deal.II/fe/mapping_fe.h>
#include <deal.II/fe/mapping_q.h>
#include <deal.II/fe/mapping_q_cache.h>
#include <deal.II/lac/la_parallel_vector.h>

#include <fmt/format.h>

#include <algorithm>
#include <stdexcept>

namespace unilateral
{
  using namespace dealii;

  namespace
  {
    /// The rule of the first constraint, as far as the case names one that exists.
    RuleName first_rule(const ProblemStatement &statement)
    {
      const std::string name = statement.constraints.empty() ? "" : statement.constraints[0].quadrature;
      return parse_rule(name).value_or(default_rule(statement.model.element, statement.dimension));
    }

    template <int dim>
    ElementName element_on(const ProblemStatement &statement)
    {
      ElementName element = statement.model.element;
      if (dim == 1 && element.simplex())
        element.family = ElementName::Family::Q; // on segments there is no difference
      if (element.family == ElementName::Family::discontinuous)
        element.degree = n_points_1d(first_rule(statement), element) - 1;
      return element;
    }

    /// Where curved cells lie is asked of the geometry once for each mesh: it takes longer than whatever is done with a cell.
    template <int dim>
    void place_cells(Mapping<dim> &mapping, const Triangulation<dim> &triangulation)
    {
      if (auto *const cache = dynamic_cast<MappingQCache<dim> *>(&mapping))
        cache->initialize(MappingQ<dim>(cache->get_degree()), triangulation);
    }
  } // namespace

  template <int dim>
  Problem<dim>::Problem(const ProblemStatement &statement, Diagnostics &diagnostics)
    : statement(statement), element(element_on<dim>(statement)), mesh(make_mesh<dim>(statement.mesh, dim > 1 && element.simplex()))
  {
    const bool vector_valued = statement.model.kind == ModelChoices::Kind::elasticity;
    fe = vector_valued ? std::make_unique<FESystem<dim>>(*scalar_element(), dim) : scalar_element();
    if (element.simplex())
      mapping = std::make_unique<MappingFE<dim>>(FE_SimplexP<dim>(1));
    else if (hermite())
    {
      if (!is_axis_parallel(*mesh.triangulation))
        throw InputError(statement.model.element_where.line > 0 ? statement.model.element_where : statement.mesh.where,
                         "element 'hermite' needs rectangles along the axes, all the same way round, and this mesh has others; take c0ip2, "
                         "c0ip3 or c0ip4");
      mapping = std::make_unique<MappingQ<dim>>(1);
    }
    else
    {
      const unsigned degree = mesh.curved ? std::max(element.degree, 1u) : 1;
      if (degree == 1)
        mapping = std::make_unique<MappingQ<dim>>(1);
      else
        mapping = std::make_unique<MappingQCache<dim>>(degree);
    }
    place_cells(*mapping, *mesh.triangulation);
    for (const auto &warning : mesh.warnings)
      diagnostics.warning(statement.mesh.where, warning);
    make_form(diagnostics);
    read_constraints(diagnostics);
    check_probes(diagnostics);
    diagnostics.throw_if_errors();
    distribute_dofs();
    hold_free_motions(&diagnostics);
  }

  template <int dim>
  std::unique_ptr<FiniteElement<dim>> Problem<dim>::scalar_element() const
  {
    if (element.simplex())
      return make_simplex_element<dim>(element.degree);
    if (hermite())
      return make_hermite_element<dim>();
    if (element.family == ElementName::Family::discontinuous)
      return std::make_unique<FE_DGQArbitraryNodes<dim>>(Quadrature<1>(quadrature_rule<1>(first_rule(statement), element)));
    return std::make_unique<FE_Q<dim>>(element.degree);
  }

  template <int dim>
  std::unique_ptr<FiniteElement<dim>> Problem<dim>::node_element() const
  {
    if (hermite())
      return std::make_unique<FE_Q<dim>>(element.degree);
    return scalar_element();
  }

  template <int dim>
  std::unique_ptr<DoFHandler<dim>> Problem<dim>::nodes() const
  {
    auto result = std::make_unique<DoFHandler<dim>>(*mesh.triangulation);
    result->distribute_dofs(*node_element());
    match_line_nodes(*result);
    return result;
  }

  template <int dim>
  void Problem<dim>::make_form(Diagnostics &diagnostics)
  {
    const auto regions = coefficients_by_region(statement, mesh.region_names, diagnostics);
    part_conditions = conditions_by_part(statement, mesh.part_names, diagnostics);
    if (statement.model.kind == ModelChoices::Kind::elasticity)
      form = std::make_unique<Elasticity<dim>>(statement.model, regions, mesh.region_names, part_conditions, diagnostics);
    else if (statement.bending())
    {
      if constexpr (dim == 1)
        form = std::make_unique<Beam>(regions, part_conditions);
      else if constexpr (dim == 2)
        form = std::make_unique<Plate>(regions, part_conditions, !hermite());
    }
    else if (statement.model.kind == ModelChoices::Kind::projection)
      form = std::make_unique<Projection<dim>>(regions);
    else
      form = std::make_unique<Membrane<dim>>(regions, part_conditions);
    const auto   corners = BoundingBox<dim>(mesh.triangulation->get_vertices()).get_boundary_points();
    const double diameter = corners.first.distance(corners.second);
    if (!(diameter > 1e-50 && diameter < 1e50))
      diagnostics.error(statement.mesh.where, fmt::format("the mesh is {:.3g} long: its volumes and their products leave the range of double "
                                                        "precision; choose another unit of length",
                                                        diameter));
    form->unit_of_length = norm_unit(diameter, form->order());
    if (axisymmetric())
      for (const auto &vertex : mesh.triangulation->get_vertices())
        if (vertex[0] < -1e-12 * vertex.norm())
        {
          diagnostics.error(statement.mesh.where,
                            "an axisymmetric body has x >= 0, the distance from the axis; the mesh has points with x < 0");
          break;
        }
  }

  template <int dim>
  bool Problem<dim>::axisymmetric() const
  {
    return statement.model.kind == ModelChoices::Kind::elasticity && dim == 2 && statement.model.assumption == ModelChoices::Assumption::axisymmetric;
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
        condition.part = find_name(mesh.part_names, spec.on);
        if (!condition.part)
        {
          diagnostics.error(spec.on_where, fmt::format("the boundary has no part '{}'{}", spec.on,
                                                       suggestion_with_list(spec.on, mesh.part_names, "parts")));
          continue;
        }
      }
      condition.rule = default_rule(element, condition.part ? dim - 1 : dim);
      if (!spec.quadrature.empty())
        condition.rule = parse_rule(spec.quadrature).value_or(condition.rule);
      // check_case() has seen what the user wrote; a study of rules changes the case after that.
      try
      {
        if (condition.part)
          quadrature_rule<dim - 1>(condition.rule, element);
        else
          quadrature_rule<dim>(condition.rule, element);
      }
      catch (const std::invalid_argument &reason)
      {
        diagnostics.error(spec.quadrature.empty() ? spec.where : spec.quadrature_where, reason.what());
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
  void Problem<dim>::check_probes(Diagnostics &diagnostics) const
  {
    // The box around the mesh is all that is certain before a curved boundary has been refined.
    Point<dim> lower = mesh.triangulation->get_vertices()[0], upper = lower;
    for (const auto &vertex : mesh.triangulation->get_vertices())
      for (unsigned d = 0; d < dim; ++d)
      {
        lower[d] = std::min(lower[d], vertex[d]);
        upper[d] = std::max(upper[d], vertex[d]);
      }
    for (std::size_t k = 0; k < statement.output.probes.size(); ++k)
      for (unsigned d = 0; d < dim; ++d)
      {
        const double x = statement.output.probes[k][d], slack = (mesh.curved ? 0.3 : 1e-9) * (upper[d] - lower[d]);
        if (x < lower[d] - slack || x > upper[d] + slack)
        {
          diagnostics.error(
            statement.output.probes_where[k],
            fmt::format("the probe lies outside the mesh, which spans {:.6g} to {:.6g} in {}", lower[d], upper[d], "xyz"[d]));
          break;
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
      for (const Diagnostic &diagnostic : e.diagnostics)
        diagnostics.error(diagnostic.where, diagnostic.message);
    }
  }

  template <int dim>
  void Problem<dim>::hold_free_motions(Diagnostics *const diagnostics)
  {
    kernel.clear();
    if (!pins.empty())
    {
      pins.clear();
      distribute_dofs();
    }
    unsupported = combined_motions(*this, unsupported_motions(*this));
    auto free = free_motions(*this);
    if (free.cols() == 0)
      return;
    const auto report = judge_free_motions(*this, make_constraint_set(), free);
    if (!report.error.empty())
      throw InputError(statement.model.where, report.error);
    if (!report.warning.empty() && diagnostics)
      diagnostics->warning(statement.model.where, report.warning);
    if (report.indifferent.cols() > 0 && hermite())
      throw InputError(statement.model.where, "contact leaves a motion free that the load does not drive either: hold it by [boundary] or a "
                                            "[[support]]");
    if (report.indifferent.cols() > 0)
    {
      pins = pins_against(*this, report.indifferent);
      names_of_pinned.clear();
      for (const auto &motion : combined_motions(*this, report.indifferent))
        names_of_pinned.push_back(motion.name);
      distribute_dofs();
      free = free_motions(*this);
      unsupported = combined_motions(*this, unsupported_motions(*this));
    }
    kernel = combined_motions(*this, free);
  }

  template <int dim>
  Quadrature<dim> Problem<dim>::cell_quadrature() const
  {
    // A projection integrates by I_G where its points are the nodes: the problem is then one of single points.
    if (form->order() == 0)
      if (const RuleName rule = first_rule(statement);
          element.family == ElementName::Family::discontinuous || rule.family == RuleName::Family::nodal)
        return quadrature_rule<dim>(rule, element);
    if (element.simplex())
      return QGaussSimplex<dim>(std::min(element.degree + 2, 4u));
    // A body's matrices in 3-D are dear, and their coefficients nearly always constant.
    return QGauss<dim>(element.degree + (dim == 3 && form->n_components() > 1 ? 1 : 2));
  }

  template <int dim>
  Quadrature<dim - 1> Problem<dim>::face_quadrature() const
  {
    if constexpr (dim == 3)
      if (element.simplex())
        return QGaussSimplex<2>(std::min(element.degree + 2, 4u));
    return QGauss<dim - 1>(dim == 1 ? 1 : element.degree + 2);
  }

  template <int dim>
  void Problem<dim>::distribute_dofs()
  {
    const auto running = part_times.run("unknowns");
    dof_handler.reinit(*mesh.triangulation);
    dof_handler.distribute_dofs(*fe);
    match_line_nodes(dof_handler);
    shared_unknowns = shared(dof_handler);
    hanging_nodes = constraints_at_hanging_nodes(dof_handler);
    dropped_values.clear();
    dirichlet = hermite() ? make_hermite_dirichlet_conditions(part_conditions, statement.supports, dof_handler)
                          : make_dirichlet_conditions(part_conditions, *mapping, dof_handler, pins, axisymmetric(), hanging_nodes,
                                          shared_unknowns, &dropped_values);
  }

  template <int dim>
  SharedUnknowns Problem<dim>::shared(const DoFHandler<dim> &nodes) const
  {
    if constexpr (dim > 1)
      if (subdomain)
        return unknowns_on_cuts(*subdomain, nodes);
    return {};
  }

  template <int dim>
  std::uint64_t Problem<dim>::n_cells() const
  {
    return processes().sum(std::uint64_t(mesh.triangulation->n_active_cells()));
  }

  template <int dim>
  std::uint64_t Problem<dim>::n_unknowns() const
  {
    return processes().sum(std::uint64_t(dof_handler.n_dofs() - shared_unknowns.n_not_owned()));
  }

  template <int dim>
  void Problem<dim>::keep_own_part(const Processes &processes, const std::vector<LinearAlgebra::distributed::Vector<double>> &functions)
  {
    if constexpr (dim > 1)
    {
      carried_to_part = std::make_unique<InterpolationToRefinedCells<dim>>(dof_handler, functions, /*smoothly=*/true);
      dof_handler.clear();
      subdomain = cut_out_subdomain(mesh, level, processes);
      carried_to_part->keep_cells(subdomain->own_cells);
      part_conditions.resize(mesh.part_names.size());
      place_cells(*mapping, *mesh.triangulation);
      distribute_dofs();
    }
  }

  template <int dim>
  std::vector<bool> Problem<dim>::values_among_unknowns() const
  {
    std::vector<bool> is_value(dof_handler.n_dofs(), true);
    if (hermite())
    {
      const auto nodes = hermite_nodes(dof_handler);
      for (types::global_dof_index dof = 0; dof < nodes.size(); ++dof)
        is_value[dof] = nodes[dof].derivative == DerivativeIndex<dim>{};
    }
    return is_value;
  }

  template <int dim>
  std::vector<typename Problem<dim>::NodalValue> Problem<dim>::nodal_values() const
  {
    std::vector<NodalValue> values;
    if (hermite())
    {
      const auto nodes = hermite_nodes(dof_handler);
      for (types::global_dof_index dof = 0; dof < nodes.size(); ++dof)
        if (nodes[dof].derivative == DerivativeIndex<dim>{})
          values.push_back({dof, nodes[dof].location, 0});
      return values;
    }
    CellPoints<dim>                      points(*mapping, fe->reference_cell(), fe->get_unit_support_points());
    std::vector<types::global_dof_index> dofs(fe->n_dofs_per_cell());
    std::vector<bool>                    seen(dof_handler.n_dofs(), false);
    for (const auto &cell : dof_handler.active_cell_iterators())
    {
      cell->get_dof_indices(dofs);
      const auto &x = points.on(cell);
      for (unsigned i = 0; i < dofs.size(); ++i)
        if (!seen[dofs[i]])
        {
          seen[dofs[i]] = true;
          values.push_back({dofs[i], x[i], fe->system_to_component_index(i).first});
        }
    }
    return values;
  }

  template <int dim>
  double Problem<dim>::growth_in_places() const
  {
    const auto                &triangulation = *mesh.triangulation;
    const unsigned             n = std::ceil(std::pow(2000. / triangulation.n_active_cells(), 1. / dim));
    const QIterated<dim>       points(QMidpoint<1>(), n);
    std::vector<FieldFunction> places;
    for (unsigned k = std::max(statement.mesh.refine, level); k < statement.mesh.n_refinements(); ++k)
      places.push_back(*statement.mesh.place_of_refinement(k));
    if (places.empty())
      return 1;
    double sum = 0;
    for (const auto &cell : triangulation.active_cell_iterators())
      for (const auto &x : points.get_points())
      {
        const Point<dim> p = cell->intermediate_point(x);
        double           n_cells = 1;
        for (const FieldFunction &chosen : places)
          n_cells *= chosen.value(p) != 0 ? GeometryInfo<dim>::max_children_per_cell : 1;
        sum += n_cells;
      }
    return sum / points.size() / triangulation.n_active_cells();
  }

  template <int dim>
  void Problem<dim>::refine_in_place(const FieldFunction &chosen)
  {
    bool any = false;
    for (const auto &cell : mesh.triangulation->active_cell_iterators())
    {
      bool refines = chosen.value(cell->center()) != 0;
      for (const unsigned v : cell->vertex_indices())
        refines = refines || chosen.value(cell->vertex(v)) != 0;
      any |= refines;
      if (refines)
        cell->set_refine_flag();
    }
    if (!any)
      throw InputError(chosen.where(), "no cell has its centre or a corner where this is true: there is nothing to refine");
    mesh.triangulation->execute_coarsening_and_refinement();
  }

  template <int dim>
  void Problem<dim>::refine(std::vector<LinearAlgebra::distributed::Vector<double>> &functions, const bool smoothly)
  {
    const auto        running = part_times.run("guess");
    const auto *const place = statement.mesh.place_of_refinement(level);
    const auto        refine_hypercubes = [&]
    {
      const auto refining = part_times.run("mesh");
      if (place)
        refine_in_place(*place);
      else
        mesh.triangulation->refine_global(1);
      place_cells(*mapping, *mesh.triangulation);
    };
    ++level;
    if constexpr (dim > 1)
      if (element.simplex())
      {
        const InterpolationToChildren<dim> carried(dof_handler, functions);
        const auto                         refining = [&]
        {
          const auto running = part_times.run("mesh");
          return refine_simplices(*mesh.triangulation);
        };
        auto refined = refining();
        dof_handler.clear();
        mesh.triangulation = std::move(refined.triangulation);
        distribute_dofs();
        carried.interpolate(refined.children, dof_handler, functions);
        if (semicoercive() || !pins.empty())
          hold_free_motions();
        return;
      }
    if (hermite())
    {
      const HermiteOnFinerMesh<dim> carried(dof_handler, functions);
      refine_hypercubes();
      distribute_dofs();
      carried.interpolate(dof_handler, functions);
      if (semicoercive())
        hold_free_motions();
      return;
    }
    auto carried = std::move(carried_to_part);
    if (!carried)
      carried = std::make_unique<InterpolationToRefinedCells<dim>>(dof_handler, functions, smoothly);
    refine_hypercubes();
    distribute_dofs();
    carried->interpolate(dof_handler, functions);
    // What contact feels of a motion depends on the mesh: the normals of a coarse ball resist its rotation, those of a fine one do not.
    if (semicoercive() || !pins.empty())
      hold_free_motions();
  }

  template <int dim>
  ConstraintSet<dim> Problem<dim>::make_constraint_set() const
  {
    const auto running = part_times.run("constraints");
    auto       set =
      unilateral::make_constraint_set(conditions, element, *mapping, dof_handler, dirichlet, hanging_nodes, *form, shared_unknowns);
    for (std::size_t b = 0; b < set.blocks.size(); ++b)
      if (level == statement.mesh.n_refinements() && !processes().any(set.blocks[b].begin < set.blocks[b].end))
        throw NoPoints(conditions[b].where, "no point is left where this constraint could act: every point of the rule lies where the "
                                            "values are fixed by [boundary]; refine the mesh or free a part");
    return set;
  }

  template <int dim>
  std::pair<double, double> Problem<dim>::cell_sizes() const
  {
    double          smallest = std::numeric_limits<double>::max(), largest = 0;
    CellShapes<dim> shapes(*mesh.triangulation, *mapping);
    unsigned        n_seen = 0;
    for (const auto &cell : mesh.triangulation->active_cell_iterators())
    {
      const unsigned shape = shapes(cell);
      if (shape < n_seen)
        continue;
      n_seen += shape != shapes.none;
      const double diameter = cell->diameter();
      smallest = std::min(smallest, diameter);
      largest = std::max(largest, diameter);
    }
    return {processes().min(smallest), processes().max(largest)};
  }

  template <int dim>
  void warn_about_fine_rasters(const Problem<dim> &problem, Diagnostics &diagnostics)
  {
    const auto look_at = [&](const std::pair<double, SourceLocation> &samples)
    {
      const auto &[spacing, where] = samples;
      if (spacing <= 0)
        return;
      const double h = problem.cell_sizes().second / std::sqrt(double(dim)) / std::max(problem.element.degree, 1u);
      if (3 * spacing < h)
        diagnostics.warning(where, fmt::format("its samples lie {:.3g} apart, the nodes of the finest mesh {:.3g}: detail in "
                                               "between is not seen; refine the mesh or smooth the data",
                                               spacing, h));
    };
    for (const auto &condition : problem.conditions)
      look_at({condition.bound.sample_spacing(), condition.bound.where()});
    look_at(problem.form->load_samples());
  }

#define INSTANTIATE(dim)                                                                                                                   \
  template class Problem<dim>;                                                                                                             \
  template void warn_about_fine_rasters(const Problem<dim> &, Diagnostics &);
  INSTANTIATE(1)
  INSTANTIATE(2)
  INSTANTIATE(3)
#undef INSTANTIATE
} // namespace unilateral
