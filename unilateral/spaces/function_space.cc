#include "unilateral/spaces/function_space.h"

#include "unilateral/mesh/congruent_cells.h"
#include "unilateral/mesh/refinement_at_cuts.h"
#include "unilateral/mesh/simplex_refinement.h"
#include "unilateral/spaces/cell_mapping.h"
#include "unilateral/spaces/cell_points.h"
#include "unilateral/spaces/hanging_nodes.h"
#include "unilateral/spaces/hermite.h"
#include "unilateral/spaces/hermite_dirichlet_conditions.h"
#include "unilateral/spaces/simplex_element.h"
#include "unilateral/spaces/unknowns_on_cuts.h"

#include <deal.II/fe/fe_dgq.h>
#include <deal.II/fe/fe_q.h>
#include <deal.II/fe/fe_simplex_p.h>
#include <deal.II/fe/fe_system.h>

#include <algorithm>
#include <limits>

namespace unilateral
{
  using namespace dealii;

  namespace
  {
    /// The middles of lines as the manifold has them, where degree 2 can follow it.
    template <int dim>
    std::shared_ptr<CurvedCells<dim>> simplices_on_manifold(const Triangulation<dim> &triangulation)
    {
      PointsByVertices<dim> points;
      for (const auto &cell : triangulation.active_cell_iterators())
        for (const auto l : cell->line_indices())
        {
          const auto            line = cell->line(l);
          std::vector<unsigned> ends = {line->vertex_index(0), line->vertex_index(1)};
          std::sort(ends.begin(), ends.end());
          if (points.count(ends) == 0)
            points[ends] = line->center(/*respect_manifold=*/true);
        }
      return std::make_shared<CurvedCells<dim>>(triangulation, points);
    }
  } // namespace

  template <int dim>
  FunctionSpace<dim>::FunctionSpace(Mesh<dim>             coarse_mesh,
                                    const ElementName    &element,
                                    const unsigned        n_components,
                                    const Quadrature<1>  &points_1d,
                                    const SourceLocation &where,
                                    TimeByPart           &time)
    : element(element), mesh(std::move(coarse_mesh)), points_1d(points_1d), time(time)
  {
    if (hermite() && !is_axis_parallel(*mesh.triangulation))
      throw InputError(where,
                       "element 'hermite' needs rectangles along the axes, all the same way round, and this mesh has others; take "
                       "c0ip2, c0ip3 or c0ip4",
                       MessageName("element-does-not-fit"));
    fe = n_components == 1   ? scalar_element()
         : element.simplex() ? std::make_unique<FESystem<dim>>(*make_simplex_element<dim>(element.degree, /*in_system=*/true), n_components)
                             : std::make_unique<FESystem<dim>>(*scalar_element(), n_components);
    if constexpr (dim > 1)
      if (element.simplex())
        corner_orders = orders_by_shortest_diagonal(*mesh.triangulation);
    on_manifold = mesh.curved && !mesh.curved_cells;
    if constexpr (dim > 1)
      if (on_manifold && element.simplex() && element.degree > 1)
        mesh.curved_cells = simplices_on_manifold(*mesh.triangulation);
    mapping = make_mapping<dim>(element, mesh);
    place_cells(*mapping, mesh);
  }

  template <int dim>
  std::unique_ptr<FiniteElement<dim>> FunctionSpace<dim>::scalar_element() const
  {
    if (element.simplex())
      return make_simplex_element<dim>(element.degree);
    if (hermite())
      return make_hermite_element<dim>();
    if (element.family == ElementName::Family::discontinuous)
      return std::make_unique<FE_DGQArbitraryNodes<dim>>(points_1d);
    return std::make_unique<FE_Q<dim>>(element.degree);
  }

  template <int dim>
  std::unique_ptr<FiniteElement<dim>> FunctionSpace<dim>::node_element() const
  {
    if (hermite())
      return std::make_unique<FE_Q<dim>>(element.degree);
    return scalar_element();
  }

  template <int dim>
  std::unique_ptr<DoFHandler<dim>> FunctionSpace<dim>::nodes() const
  {
    auto result = std::make_unique<DoFHandler<dim>>(*mesh.triangulation);
    result->distribute_dofs(*node_element());
    match_line_nodes(*result);
    return result;
  }

  template <int dim>
  void FunctionSpace<dim>::distribute_dofs(const DirichletData<dim> &data)
  {
    const auto running = time.run("unknowns");
    dof_handler.reinit(*mesh.triangulation);
    dof_handler.distribute_dofs(*fe);
    match_line_nodes(dof_handler);
    shared_unknowns = shared(dof_handler);
    hanging_nodes = constraints_at_hanging_nodes(dof_handler);
    fix_values(data);
  }

  template <int dim>
  void FunctionSpace<dim>::fix_values(const DirichletData<dim> &data)
  {
    dropped_values.clear();
    couplings = {};
    if (!hermite())
      couplings = make_node_couplings(data.conditions, data.periodic, *mapping, dof_handler, hanging_nodes, processes());
    dirichlet = hermite() ? make_hermite_dirichlet_conditions(data.conditions, data.supports, dof_handler, shared_unknowns)
                          : make_dirichlet_conditions(data.conditions, *mapping, dof_handler, data.pins, data.on_axis, hanging_nodes,
                                                      shared_unknowns, &dropped_values, &couplings);
  }

  template <int dim>
  SharedUnknowns FunctionSpace<dim>::shared(const DoFHandler<dim> &nodes) const
  {
    if constexpr (dim > 1)
      if (subdomain)
        return unknowns_on_cuts(*subdomain, nodes, lines_cut_by_refinement);
    return {};
  }

  template <int dim>
  std::uint64_t FunctionSpace<dim>::n_cells() const
  {
    return processes().sum(std::uint64_t(mesh.triangulation->n_active_cells()));
  }

  template <int dim>
  std::uint64_t FunctionSpace<dim>::n_unknowns() const
  {
    return processes().sum(std::uint64_t(dof_handler.n_dofs() - shared_unknowns.n_not_owned()));
  }

  template <int dim>
  std::vector<bool> FunctionSpace<dim>::values_among_unknowns() const
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
  std::vector<typename FunctionSpace<dim>::NodalValue> FunctionSpace<dim>::nodal_values() const
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
  std::vector<bool> FunctionSpace<dim>::cells_at(const FieldFunction &place) const
  {
    std::vector<bool> chosen(mesh.triangulation->n_active_cells(), false);
    for (const auto &cell : mesh.triangulation->active_cell_iterators())
    {
      bool refines = place.value(cell->center()) != 0;
      for (const unsigned v : cell->vertex_indices())
        refines = refines || place.value(cell->vertex(v)) != 0;
      chosen[cell->active_cell_index()] = refines;
    }
    if (!processes().any(std::find(chosen.begin(), chosen.end(), true) != chosen.end()))
      throw InputError(place.where(), "no cell has its centre or a corner where this is true: there is nothing to refine",
                       MessageName("point-outside"));
    return chosen;
  }

  /// Flags the cells that are refined because other processes refine theirs.
  template <int dim>
  void FunctionSpace<dim>::flag_beyond_cuts()
  {
    if constexpr (dim > 1)
      if (subdomain)
      {
        DoFHandler<dim> quadratic(*mesh.triangulation);
        quadratic.distribute_dofs(FE_Q<dim>(2));
        flag_alike_at_cuts(*mesh.triangulation, quadratic, shared(quadratic));
      }
  }

  /// The @p chosen simplices, and those that are cut because other processes cut theirs.
  template <int dim>
  RefinedSimplices<dim> FunctionSpace<dim>::refined_in_places(const std::vector<bool> &chosen) const
  {
    if constexpr (dim == 1)
      return {}; // segments are no simplices here
    else
    {
      if (!subdomain)
        return refine_simplices(*mesh.triangulation, chosen);
      DoFHandler<dim> quadratic(*mesh.triangulation);
      quadratic.distribute_dofs(*make_simplex_element<dim>(2));
      const SharedUnknowns of_quadratic = shared(quadratic);
      return refine_simplices(*mesh.triangulation, chosen,
                              [&](std::vector<bool> &lines) { return mark_alike_at_cuts(lines, quadratic, of_quadratic); });
    }
  }

  template <int dim>
  void FunctionSpace<dim>::refine(const DirichletData<dim>      &data,
                                  Functions                     &functions,
                                  const bool                     smoothly,
                                  const std::vector<bool> *const chosen)
  {
    const auto refine_hypercubes = [&]
    {
      const auto refining = time.run("mesh");
      if (chosen && refines_in_places())
      {
        for (const auto &cell : mesh.triangulation->active_cell_iterators())
          if ((*chosen)[cell->active_cell_index()])
            cell->set_refine_flag();
        flag_beyond_cuts();
        mesh.triangulation->execute_coarsening_and_refinement();
      }
      else
        mesh.triangulation->refine_global(1);
      if (mesh.curved_cells)
        mesh.curved_cells->follow_refinement(*mesh.triangulation, processes().any(mesh.triangulation->has_hanging_nodes()));
      place_cells(*mapping, mesh);
    };
    ++level;
    if constexpr (dim > 1)
      if (element.simplex())
      {
        const InterpolationToChildren<dim> carried(dof_handler, functions);
        const auto                         refining = [&]
        {
          const auto running = time.run("mesh");
          return chosen ? refined_in_places(*chosen) : refine_simplices(*mesh.triangulation, corner_orders);
        };
        auto refined = refining();
        dof_handler.clear();
        mesh.triangulation = std::move(refined.triangulation);
        lines_cut_by_refinement.push_back(std::move(refined.cut_lines));
        corner_orders = std::move(refined.corner_orders);
        if (mesh.curved_cells && on_manifold)
          *mesh.curved_cells = std::move(*simplices_on_manifold(*mesh.triangulation));
        else if (mesh.curved_cells)
          mesh.curved_cells->follow_refinement(*mesh.triangulation, refined.children);
        distribute_dofs(data);
        carried.interpolate(refined.children, dof_handler, functions);
        return;
      }
    if (hermite())
    {
      const HermiteOnFinerMesh<dim> carried(dof_handler, functions);
      refine_hypercubes();
      distribute_dofs(data);
      carried.interpolate(dof_handler, functions);
      return;
    }
    auto carried = std::move(carried_to_part);
    if (!carried)
      carried = std::make_unique<InterpolationToRefinedCells<dim>>(dof_handler, functions, smoothly);
    refine_hypercubes();
    distribute_dofs(data);
    carried->interpolate(dof_handler, functions);
  }

  template <int dim>
  std::pair<double, double> FunctionSpace<dim>::cell_sizes() const
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

  template class FunctionSpace<1>;
  template class FunctionSpace<2>;
  template class FunctionSpace<3>;
} // namespace unilateral
