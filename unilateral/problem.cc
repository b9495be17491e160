#include "unilateral/problem.h"

#include "unilateral/simplex_element.h"
#include "unilateral/simplex_refinement.h"

#include <deal.II/base/function.h>
#include <deal.II/base/quadrature_lib.h>
#include <deal.II/dofs/dof_renumbering.h>
#include <deal.II/fe/fe_q.h>
#include <deal.II/fe/fe_simplex_p.h>
#include <deal.II/fe/mapping_fe.h>
#include <deal.II/fe/mapping_q.h>
#include <deal.II/lac/la_parallel_vector.h>
#include <deal.II/numerics/solution_transfer.h>
#include <deal.II/numerics/vector_tools_boundary.h>

#include <fmt/format.h>

#include <algorithm>
#include <stdexcept>

namespace unilateral
{
  using namespace dealii;

  namespace
  {
    /// A FieldFunction as deal.II wants it.
    template <int dim>
    class AsDealiiFunction : public Function<dim>
    {
    public:
      explicit AsDealiiFunction(const FieldFunction &field) : field(field) {}
      double value(const Point<dim> &p, const unsigned = 0) const override { return field.value(p); }

    private:
      const FieldFunction &field;
    };

    template <int dim>
    ElementSpec element_on(ElementSpec element)
    {
      if (dim == 1)
        element.family = ElementSpec::Family::Q; // on segments there is no difference
      return element;
    }

    std::optional<types::boundary_id> find(const std::vector<std::string> &names, const std::string &name)
    {
      const auto it = std::find(names.begin(), names.end(), name);
      if (it == names.end())
        return {};
      return static_cast<types::boundary_id>(it - names.begin());
    }

    FieldFunction compile(const std::optional<FieldSpec> &spec, const Case &request)
    {
      return spec ? FieldFunction(*spec, request.parameters) : FieldFunction(0.);
    }

    std::vector<FieldFunction> compile(const std::optional<std::vector<FieldSpec>> &specs, const Case &request)
    {
      std::vector<FieldFunction> functions;
      if (specs)
        for (const auto &spec : *specs)
          functions.emplace_back(spec, request.parameters);
      return functions;
    }
  } // namespace

  template <int dim>
  Problem<dim>::Problem(const Case &request, Diagnostics &diagnostics)
    : request(request), element(element_on<dim>(request.model.element)), mesh(make_mesh<dim>(request.mesh, dim > 1 && element.simplex()))
  {
    if (element.simplex())
    {
      fe = make_simplex_element<dim>(element.degree);
      mapping = std::make_unique<MappingFE<dim>>(FE_SimplexP<dim>(1));
    }
    else
    {
      fe = std::make_unique<FE_Q<dim>>(element.degree);
      mapping = std::make_unique<MappingQ<dim>>(mesh.curved ? element.degree : 1);
    }
    for (const auto &warning : mesh.warnings)
      diagnostics.warning(request.mesh.where, warning);
    read_coefficients(diagnostics);
    read_boundary(diagnostics);
    read_constraints(diagnostics);
    check_probes(diagnostics);
    diagnostics.throw_if_errors();
    check_semicoercive_load(diagnostics);
    diagnostics.throw_if_errors();
    distribute_dofs();
  }

  template <int dim>
  void Problem<dim>::read_coefficients(Diagnostics &diagnostics)
  {
    const auto with_default_stiffness = [&](Coefficients coefficients)
    {
      if (!coefficients.stiffness)
        coefficients.stiffness = {FieldSpec::constant(1)};
      return MembraneCoefficients<dim>{compile(coefficients.stiffness, request), compile(coefficients.velocity, request),
                                       compile(coefficients.reaction, request), compile(coefficients.load, request)};
    };
    region_coefficients.assign(mesh.region_names.size(), with_default_stiffness(request.model.coefficients));
    for (const auto &material : request.materials)
    {
      const auto region = find(mesh.region_names, material.region);
      if (!region)
      {
        diagnostics.error(material.where, fmt::format("the mesh has no region '{}'{}", material.region,
                                                      suggestion_with_list(material.region, mesh.region_names, "regions")));
        continue;
      }
      Coefficients coefficients = request.model.coefficients;
      if (material.coefficients.stiffness)
        coefficients.stiffness = material.coefficients.stiffness;
      if (material.coefficients.velocity)
        coefficients.velocity = material.coefficients.velocity;
      if (material.coefficients.reaction)
        coefficients.reaction = material.coefficients.reaction;
      if (material.coefficients.load)
        coefficients.load = material.coefficients.load;
      region_coefficients[*region] = with_default_stiffness(coefficients);
    }
  }

  template <int dim>
  void Problem<dim>::read_boundary(Diagnostics &diagnostics)
  {
    part_conditions.resize(mesh.part_names.size());
    const auto apply = [&](BoundaryCondition &condition, const BoundarySpec &spec)
    {
      condition.value.reset();
      if (spec.value)
        condition.value = FieldFunction(*spec.value, request.parameters);
      condition.flux = compile(spec.flux, request);
      condition.spring = compile(spec.spring, request);
      condition.where = spec.where;
    };
    for (const auto &spec : request.boundary)
      if (spec.part == "all")
        for (auto &condition : part_conditions)
          apply(condition, spec);
    for (const auto &spec : request.boundary)
      if (spec.part != "all")
      {
        if (const auto part = find(mesh.part_names, spec.part))
          apply(part_conditions[*part], spec);
        else
          diagnostics.error(spec.where, fmt::format("the boundary has no part '{}'{}", spec.part,
                                                    suggestion_with_list(spec.part, mesh.part_names, "parts")));
      }
  }

  template <int dim>
  void Problem<dim>::read_constraints(Diagnostics &diagnostics)
  {
    for (const auto &spec : request.constraints)
    {
      UnilateralCondition condition;
      condition.on = spec.on;
      condition.where = spec.where;
      if (!spec.on.empty())
      {
        condition.part = find(mesh.part_names, spec.on);
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
      for (const auto side : {Side::lower, Side::upper})
        if (const auto &bound = side == Side::lower ? spec.lower : spec.upper)
        {
          condition.side = side;
          condition.bound = FieldFunction(*bound, request.parameters);
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
    for (std::size_t k = 0; k < request.output.probes.size(); ++k)
      for (unsigned d = 0; d < dim; ++d)
      {
        const double x = request.output.probes[k][d], slack = (mesh.curved ? 0.3 : 1e-9) * (upper[d] - lower[d]);
        if (x < lower[d] - slack || x > upper[d] + slack)
        {
          diagnostics.error(
            request.output.probes_where[k],
            fmt::format("the probe lies outside the mesh, which spans {:.6g} to {:.6g} in {}", lower[d], upper[d], "xyz"[d]));
          break;
        }
      }
  }

  template <int dim>
  bool Problem<dim>::symmetric() const
  {
    return std::all_of(region_coefficients.begin(), region_coefficients.end(), [](const auto &c) { return c.symmetric(); });
  }

  template <int dim>
  bool Problem<dim>::semicoercive() const
  {
    return std::all_of(part_conditions.begin(), part_conditions.end(), [](const auto &c) { return !c.value && c.spring.is_zero(); }) &&
           std::all_of(region_coefficients.begin(), region_coefficients.end(), [](const auto &c) { return c.reaction.is_zero(); });
  }

  template <int dim>
  void Problem<dim>::check_semicoercive_load(Diagnostics &diagnostics) const
  {
    if (!semicoercive())
      return;
    double        load = 0, magnitude = 0;
    FEValues<dim> values(*mapping, *fe, cell_quadrature(), update_quadrature_points | update_JxW_values);
    const auto    add = [&](const double part)
    {
      load += part;
      magnitude += std::abs(part);
    };
    FEFaceValues<dim> face_values(*mapping, *fe, face_quadrature(), update_quadrature_points | update_JxW_values);
    for (const auto &cell : mesh.triangulation->active_cell_iterators())
    {
      values.reinit(cell);
      for (const unsigned q : values.quadrature_point_indices())
        add(region_coefficients[cell->material_id()].load.value(values.quadrature_point(q)) * values.JxW(q));
      for (const auto face : cell->face_indices())
        if (cell->face(face)->at_boundary())
        {
          face_values.reinit(cell, face);
          for (const unsigned q : face_values.quadrature_point_indices())
            add(part_conditions[cell->face(face)->boundary_id()].flux.value(face_values.quadrature_point(q)) * face_values.JxW(q));
        }
    }
    const auto has = [&](const Side side)
    { return std::any_of(conditions.begin(), conditions.end(), [&](const auto &condition) { return condition.side == side; }); };
    const std::string free = "the solution is free to move as a whole: no boundary value, spring or reaction holds it";
    if (std::abs(load) <= 1e-10 * magnitude || magnitude == 0)
      diagnostics.error(request.model.where, free + ", and the load has no resultant that presses it against an obstacle; give a "
                                                    "[boundary] value, a spring, a reaction or a load");
    else if (load > 0 && !has(Side::upper))
      diagnostics.error(request.model.where,
                        free + fmt::format(", and the total load {:.6g} moves it upward, where there is no obstacle", load));
    else if (load < 0 && !has(Side::lower))
      diagnostics.error(request.model.where,
                        free + fmt::format(", and the total load {:.6g} moves it downward, where there is no obstacle", load));
  }

  template <int dim>
  Quadrature<dim> Problem<dim>::cell_quadrature() const
  {
    if (element.simplex())
      return QGaussSimplex<dim>(std::min(element.degree + 2, 4u));
    return QGauss<dim>(element.degree + 2);
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
    dof_handler.reinit(*mesh.triangulation);
    dof_handler.distribute_dofs(*fe);
    match_line_nodes(dof_handler);

    // Named parts come after `all`, so that the more particular statement holds where they meet.
    std::map<types::global_dof_index, double> values;
    for (const bool named : {false, true})
      for (types::boundary_id part = 0; part < part_conditions.size(); ++part)
        if (const auto &condition = part_conditions[part]; condition.value)
        {
          const bool is_named = std::any_of(request.boundary.begin(), request.boundary.end(),
                                            [&](const auto &spec) { return spec.part == mesh.part_names[part]; });
          if (is_named == named)
            VectorTools::interpolate_boundary_values(*mapping, dof_handler, part, AsDealiiFunction<dim>(*condition.value), values);
        }
    dirichlet.clear();
    for (const auto &[dof, value] : values)
    {
      dirichlet.add_line(dof);
      dirichlet.set_inhomogeneity(dof, value);
    }
    dirichlet.close();
  }

  template <int dim>
  void Problem<dim>::refine(std::vector<LinearAlgebra::distributed::Vector<double>> &functions)
  {
    using VectorType = LinearAlgebra::distributed::Vector<double>;
    ++level;
    if constexpr (dim > 1)
      if (element.simplex())
      {
        const InterpolationToChildren<dim> carried(dof_handler, functions);
        auto                               refined = refine_simplices(*mesh.triangulation);
        dof_handler.clear();
        mesh.triangulation = std::move(refined.triangulation);
        distribute_dofs();
        carried.interpolate(refined.children, dof_handler, functions);
        return;
      }
    SolutionTransfer<dim, VectorType> transfer(dof_handler);
    mesh.triangulation->set_all_refine_flags();
    mesh.triangulation->prepare_coarsening_and_refinement();
    transfer.prepare_for_pure_refinement();
    mesh.triangulation->execute_coarsening_and_refinement();
    distribute_dofs();
    for (auto &function : functions)
    {
      VectorType refined(dof_handler.n_dofs());
      transfer.refine_interpolate(function, refined);
      function.swap(refined);
    }
  }

  template <int dim>
  ConstraintSet<dim> Problem<dim>::make_constraint_set() const
  {
    auto set = unilateral::make_constraint_set(conditions, element, *mapping, dof_handler, dirichlet);
    for (std::size_t b = 0; b < set.blocks.size(); ++b)
      if (set.blocks[b].begin == set.blocks[b].end && level == request.mesh.refine)
        throw InputError(conditions[b].where, "no point is left where this constraint could act: every point of the rule lies where the "
                                              "values are fixed by [boundary]; refine the mesh or free a part");
    return set;
  }

  template <int dim>
  std::pair<double, double> Problem<dim>::cell_sizes() const
  {
    double smallest = std::numeric_limits<double>::max(), largest = 0;
    for (const auto &cell : mesh.triangulation->active_cell_iterators())
    {
      const double diameter = cell->diameter();
      smallest = std::min(smallest, diameter);
      largest = std::max(largest, diameter);
    }
    return {smallest, largest};
  }

  template <int dim>
  void warn_about_fine_rasters(const Problem<dim> &problem, Diagnostics &diagnostics)
  {
    const double h = problem.cell_sizes().second / std::sqrt(double(dim)) / problem.element.degree;
    const auto   look_at = [&](const FieldFunction &function)
    {
      if (const double spacing = function.sample_spacing(); spacing > 0 && 3 * spacing < h)
        diagnostics.warning(function.where(), fmt::format("its samples lie {:.3g} apart, the nodes of the finest mesh {:.3g}: detail in "
                                                          "between is not seen; refine the mesh or smooth the data",
                                                          spacing, h));
    };
    for (const auto &condition : problem.conditions)
      look_at(condition.bound);
    for (const auto &cell : problem.dof_handler.active_cell_iterators())
    {
      look_at(problem.coefficients(cell).load);
      break;
    }
  }

#define INSTANTIATE(dim)                                                                                                                   \
  template class Problem<dim>;                                                                                                             \
  template void warn_about_fine_rasters(const Problem<dim> &, Diagnostics &);
  INSTANTIATE(1)
  INSTANTIATE(2)
  INSTANTIATE(3)
#undef INSTANTIATE
} // namespace unilateral
