#include "unilateral/evaluation/goal_error.h"

#include "unilateral/evaluation/contact_at_fixed_nodes.h"
#include "unilateral/evaluation/equilibrium.h"
#include "unilateral/evaluation/error_of_free_boundary.h"
#include "unilateral/evaluation/probes.h"
#include "unilateral/evaluation/reaction_goal.h"
#include "unilateral/evaluation/unresolved_load.h"
#include "unilateral/spaces/point_location.h"

#include <deal.II/base/quadrature_lib.h>
#include <deal.II/fe/fe_values.h>

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <numeric>
#include <optional>
#include <stdexcept>

namespace unilateral
{
  using namespace dealii;

  namespace
  {
    /// Springs in contact are so much stiffer than the cells at them that z keeps its value there to this part.
    constexpr double softness_in_contact = 1e-5;
    constexpr double accuracy_of_adjoint = 1e-4; ///< an estimate needs no more

    const RefinementGoal &goal_of(const ProblemStatement &statement)
    {
      return statement.mesh.adapt->goal;
    }

    /// The cell of the probe, on the one process in whose part it lies.
    template <int dim>
    std::optional<PlaceInMesh<dim>> place_of_probe(const Problem<dim> &problem, const RefinementGoal &goal)
    {
      const auto       place = locate(problem.space, to_point<dim>(problem.statement.output.probes[goal.number]));
      const Processes &processes = problem.space.processes();
      const bool       nearest = place.outside == processes.min(place.outside);
      if (processes.min(double(nearest ? processes.rank() : processes.size())) != processes.rank())
        return {};
      return place;
    }

    /// j with j' v = u_c(x) for the function with coefficients v.
    template <int dim>
    Vector value_at_probe(const Problem<dim> &problem, const Vector &like, const RefinementGoal &goal)
    {
      const auto &fe = *problem.space.fe;
      Vector      j;
      j.reinit(like);
      if (const auto place = place_of_probe(problem, goal))
      {
        FEValues<dim> at_point(*problem.space.mapping, fe, Quadrature<dim>(place->unit), update_values);
        at_point.reinit(place->cell);
        dealii::Vector<double>               local(fe.n_dofs_per_cell());
        std::vector<types::global_dof_index> dofs(fe.n_dofs_per_cell());
        place->cell->get_dof_indices(dofs);
        for (unsigned i = 0; i < dofs.size(); ++i)
          if (fe.system_to_component_index(i).first == goal.component.value_or(0))
            local(i) = at_point.shape_value(i, 0);
        problem.space.dirichlet.distribute_local_to_global(local, dofs, j);
      }
      problem.space.shared().add(j.begin());
      return j;
    }

    /// u_c(x) - sum_a phi_a(x) u_c(a) at the probe x, the part of u that the nodes a of its cell do not know:
    ///   sum_a phi_a(x) int_a^x grad u_c . ds,
    /// with the mean of grad u_h of the cells at each node for grad u. (grad u_h itself would give 0.) The means are weighted with the
    /// inverse diameters of the cells, which is linear interpolation between the centres of two. Zero on processes that do not have the
    /// cell @p place.
    template <int dim>
    double error_of_interpolation(const Problem<dim>                    &problem,
                                  const Vector                          &u,
                                  const RefinementGoal                  &goal,
                                  const std::optional<PlaceInMesh<dim>> &place)
    {
      const auto    &fe = *problem.space.fe;
      const unsigned component = goal.component.value_or(0);

      std::vector<unsigned> shapes; // those of the component
      for (unsigned i = 0; i < fe.n_dofs_per_cell(); ++i)
        if (fe.system_to_component_index(i).first == component)
          shapes.push_back(i);
      std::vector<types::global_dof_index> nodes(fe.n_dofs_per_cell()), dofs(fe.n_dofs_per_cell());
      if (place)
        place->cell->get_dof_indices(nodes);

      // Cells of other processes have a part in the means at nodes on cuts.
      const auto         &shared = problem.space.shared();
      const Processes    &processes = problem.space.processes();
      const double        region = processes.max(place ? double(place->cell->material_id()) : 0.);
      std::vector<double> is_node(u.size(), 0.), weights(u.size(), 0.), gradients[dim];
      for (unsigned k = 0; k < shapes.size() && place; ++k)
        is_node[nodes[shapes[k]]] = 1;
      shared.add(is_node.data());
      for (auto &derivative : gradients)
        derivative.assign(u.size(), 0.);
      const Quadrature<dim> at_nodes(fe.get_unit_support_points());
      FEValues<dim>         values(*problem.space.mapping, fe, at_nodes, update_gradients);
      for (const auto &other : problem.space.dof_handler.active_cell_iterators())
      {
        if (other->material_id() != region)
          continue;
        other->get_dof_indices(dofs);
        if (std::none_of(dofs.begin(), dofs.end(), [&](const auto dof) { return is_node[dof] > 0; }))
          continue;
        values.reinit(other);
        for (const unsigned j : shapes)
          if (is_node[dofs[j]] > 0)
          {
            Tensor<1, dim> gradient;
            for (const unsigned k : shapes)
              gradient += u(dofs[k]) / other->diameter() * values.shape_grad(k, j);
            for (unsigned d = 0; d < dim; ++d)
              gradients[d][dofs[j]] += gradient[d];
            weights[dofs[j]] += 1 / other->diameter();
          }
      }
      for (auto &derivative : gradients)
        shared.add(derivative.data());
      shared.add(weights.data());
      if (!place)
        return 0;

      const auto   &cell = place->cell;
      FEValues<dim> at_probe(*problem.space.mapping, fe, Quadrature<dim>(place->unit), update_values);
      at_probe.reinit(cell);
      const QGauss<1> along(fe.degree + 1);
      double          sum = 0;
      for (const unsigned a : shapes)
      {
        const Tensor<1, dim>    path = place->unit - fe.unit_support_point(a);
        std::vector<Point<dim>> points;
        for (const Point<1> &t : along.get_points())
          points.push_back(fe.unit_support_point(a) + t[0] * path);
        FEValues<dim> on_path(*problem.space.mapping, fe, Quadrature<dim>(points), update_values | update_jacobians);
        on_path.reinit(cell);
        for (unsigned q = 0; q < along.size(); ++q)
        {
          const Tensor<1, dim> ds = apply_transformation(on_path.jacobian(q), path);
          for (const unsigned b : shapes)
          {
            double rise = 0;
            for (unsigned d = 0; d < dim; ++d)
              rise += gradients[d][nodes[b]] * ds[d];
            sum += along.weight(q) * at_probe.shape_value(a, 0) * on_path.shape_value(b, q) * rise / weights[nodes[b]];
          }
        }
      }
      return sum;
    }

    /// The values of a function with homogeneous Dirichlet data at hanging nodes and in other dependent unknowns.
    void distribute_homogeneous(const AffineConstraints<double> &dirichlet, Vector &z)
    {
      for (const auto &line : dirichlet.get_lines())
      {
        double value = 0;
        for (const auto &[dof, weight] : line.entries)
          value += weight * z(dof);
        z(line.index) = value;
      }
    }

    /// Which unknowns are in contact, as far as values of u say: those that contact pushes at, and those that follow from them.
    std::vector<bool> in_contact(const Vector &contact_forces, const AffineConstraints<double> &dirichlet)
    {
      std::vector<bool> contact(contact_forces.size());
      for (types::global_dof_index dof = 0; dof < contact.size(); ++dof)
        contact[dof] = contact_forces(dof) != 0;
      for (const auto &line : dirichlet.get_lines())
        contact[line.index] =
          std::all_of(line.entries.begin(), line.entries.end(), [&](const auto &entry) { return contact_forces(entry.first) != 0; });
      return contact;
    }

    /// In contact u is the bound, and u_h is it at the points of I_G only. Adds to @p by_cell the error that this makes of the goal,
    /// r . (bound - u_h), with the forces r of the adjoint problem's contact. At a node the distance is the mean over its cells in contact.
    template <int dim>
    void add_error_of_bound(const Problem<dim>  &problem,
                            const FieldFunction &bound,
                            const Vector        &u,
                            const Vector        &r,
                            const Vector        &contact_forces,
                            std::vector<double> &by_cell)
    {
      const auto                          &fe = *problem.space.fe;
      const auto                           contact = in_contact(contact_forces, problem.space.dirichlet);
      FEValues<dim>                        values(*problem.space.mapping, fe, problem.cell_quadrature(),
                                                  update_values | update_quadrature_points | update_JxW_values);
      std::vector<types::global_dof_index> dofs(fe.n_dofs_per_cell());
      std::vector<double>                  sizes(r.size(), 0.), distances(dofs.size()), u_at(values.n_quadrature_points);
      const auto                           on_cells_in_contact = [&](const auto &action)
      {
        std::size_t c = 0;
        for (const auto &cell : problem.space.dof_handler.active_cell_iterators())
        {
          cell->get_dof_indices(dofs);
          if (std::all_of(dofs.begin(), dofs.end(), [&](const auto dof) { return contact[dof]; }))
          {
            values.reinit(cell);
            action(c);
          }
          ++c;
        }
      };
      const auto square_of_shape = [&](const unsigned i, const unsigned q)
      { return std::pow(values.shape_value(i, q), 2) * values.JxW(q); };
      on_cells_in_contact(
        [&](std::size_t)
        {
          for (const unsigned q : values.quadrature_point_indices())
            for (unsigned i = 0; i < dofs.size(); ++i)
              sizes[dofs[i]] += square_of_shape(i, q);
        });
      problem.space.shared().add(sizes.data());
      on_cells_in_contact(
        [&](const std::size_t c)
        {
          values.get_function_values(u, u_at);
          for (const unsigned q : values.quadrature_point_indices())
          {
            const double distance = bound.value(values.quadrature_point(q)) - u_at[q];
            for (unsigned i = 0; i < dofs.size(); ++i)
              by_cell[c] += r(dofs[i]) * distance * square_of_shape(i, q) / sizes[dofs[i]];
          }
        });
    }

    /// u_h has the prescribed values at nodes only. Adds to @p by_cell what that makes of the goal, - int dz/dn k (g - u_h) over the
    /// boundary of a membrane with values g, with the flux recovered from z.
    template <int dim>
    void add_error_of_boundary_values(const Problem<dim>       &problem,
                                      const Vector             &u,
                                      const RecoveredFlux<dim> &flux_of_z,
                                      std::vector<double>      &by_cell)
    {
      const auto                          &fe = *problem.space.fe;
      FEFaceValues<dim>                    values(*problem.space.mapping, fe, problem.face_quadrature(),
                                                  update_values | update_quadrature_points | update_JxW_values | update_normal_vectors);
      std::vector<types::global_dof_index> dofs(fe.n_dofs_per_cell());
      std::vector<double>                  u_at(values.n_quadrature_points);
      std::vector<Flux>                    fluxes(dofs.size());
      for (const auto &cell : problem.space.dof_handler.active_cell_iterators())
        for (const auto face : cell->face_indices())
        {
          if (!cell->at_boundary(face) || cell->face(face)->boundary_id() >= problem.prescribed.conditions.size())
            continue;
          const auto &condition = problem.prescribed.conditions[cell->face(face)->boundary_id()];
          if (!condition.value || condition.value->is_constant())
            continue;
          values.reinit(cell, face);
          values.get_function_values(u, u_at);
          cell->get_dof_indices(dofs);
          for (unsigned i = 0; i < dofs.size(); ++i)
            fluxes[i] = flux_of_z.at(dofs[i], cell->material_id());
          for (const unsigned q : values.quadrature_point_indices())
          {
            double normal_flux = 0;
            for (unsigned i = 0; i < dofs.size(); ++i)
              for (unsigned d = 0; d < dim; ++d)
                normal_flux += values.shape_value(i, q) * fluxes[i][d] * values.normal_vector(q)[d];
            by_cell[cell->active_cell_index()] -=
              normal_flux * (condition.value->value(values.quadrature_point(q)) - u_at[q]) * values.JxW(q);
          }
        }
    }

    double norm_of(const std::vector<double> &squares, const Processes &processes)
    {
      return std::sqrt(processes.sum(std::accumulate(squares.begin(), squares.end(), 0.)));
    }

    /// u + scale z
    Vector combined(const Vector &u, const double scale, const Vector &z)
    {
      Vector sum(u);
      sum.add(scale, z);
      return sum;
    }
  } // namespace

  namespace
  {
    /// "0 (left), 1 (right)"
    std::string numbered(const std::vector<std::string> &names)
    {
      std::string text;
      for (std::size_t k = 0; k < names.size(); ++k)
        text += fmt::format("{}{} ({})", k > 0 ? ", " : "", k, names[k]);
      return text;
    }
  } // namespace

  template <int dim>
  void check_goal(const Problem<dim> &problem)
  {
    const auto &adapt = problem.statement.mesh.adapt;
    if (!adapt || !adapt->goal.is_a_number())
      return;
    const RefinementGoal &goal = adapt->goal;
    const auto            refuse = [&](const std::string &why) { throw InputError(adapt->where, why, MessageName("goal-unavailable")); };
    if (problem.form->order() == 0)
      refuse("a projection has no goal but \"energy\": it is exact point by point");
    if (!problem.form->symmetric())
      refuse(fmt::format("the error of '{}' cannot be estimated with a velocity; use goal = \"energy\"", goal.name));
    const unsigned n_components = problem.form->n_components();
    if (goal.kind == RefinementGoal::Kind::reaction)
    {
      if (n_components == 1)
        refuse(fmt::format("'{}': the error of a reaction can be estimated for elastic bodies; use goal = \"energy\"", goal.name));
      const auto parts = parts_with_reactions(problem);
      if (goal.number >= parts.size() || *goal.component >= n_components)
        refuse(fmt::format("the goal '{}' does not exist; parts that hold the body are{} {}, components 0 to {}", goal.name,
                           parts.empty() ? " none" : "", numbered(parts), n_components - 1));
    }
    if (goal.kind != RefinementGoal::Kind::probe)
      return;
    const std::size_t n_probes = problem.statement.output.probes.size();
    if (goal.number >= n_probes)
      refuse(n_probes == 0
               ? fmt::format("the goal '{}' needs a probe; for example probes = [[0.5, 0.5]] under [output]", goal.name)
               : fmt::format("the goal '{}' is a probe that does not exist; they are numbered from 0 to {}", goal.name, n_probes - 1));
    if (n_components > 1 && (!goal.component || *goal.component >= n_components))
      refuse(
        fmt::format("the goal must say which component of u is meant: solution.probes.{}.value.0 to .{}", goal.number, n_components - 1));
    if (n_components == 1 && goal.component)
      refuse(fmt::format("u has one component: write solution.probes.{}.value", goal.number));
  }

  namespace
  {
    /// z, the solution of the adjoint problem on the contact set, and what holds it there.
    struct Adjoint
    {
      Vector z, Bz;
      Vector pull; ///< by constraint point: stiffness of the spring in contact, over its weight
      double g;    ///< (B z)_i in contact
      bool   available = false;
    };

    /// a(v, z) + sum_i w_i pull_i (B z - g)_i (B v)_i = J(v) with J = 0 and g = 1 for the contact force, J = 0, g = 0 and z = -1 at the
    /// support for a reaction, else J the value at the probe and g = 0.
    template <int dim>
    Adjoint solve_adjoint(const Problem<dim>       &problem,
                          DiscreteProblem          &discrete,
                          const ConstraintSet<dim> &K_h,
                          const Vector             &lambda,
                          const RefinementGoal     &goal)
    {
      const bool force = goal.kind == RefinementGoal::Kind::contact_force, reaction = goal.kind == RefinementGoal::Kind::reaction;
      Adjoint    adjoint;
      adjoint.g = force ? 1. : 0.;
      Vector d, rhs;
      bool   any_contact = false;
      discrete.initialize_point_vector(d);
      discrete.initialize_point_vector(adjoint.pull);
      discrete.initialize_point_vector(adjoint.Bz);
      discrete.initialize_dof_vector(rhs);
      discrete.initialize_dof_vector(adjoint.z);
      for (std::size_t i = 0; i < K_h.points.size(); ++i)
        if (lambda(i) > 0)
        {
          any_contact = true;
          adjoint.pull(i) = 1 / (softness_in_contact * discrete.compliance()(i));
          d(i) = discrete.weights()(i) * adjoint.pull(i);
        }
      Vector w, Bw(adjoint.pull); // z is the solution of the system minus w
      if (reaction)
      {
        w = motion_of_support(problem, goal.number, *goal.component);
        const auto traces = K_h.values_of(w);
        for (std::size_t i = 0; i < traces.size(); ++i)
          Bw(i) = K_h.points[i].sign * traces[i];
        Vector pulled(Bw);
        pulled.scale(adjoint.pull);
        discrete.apply_trace_transpose(rhs, pulled);
        rhs += stiffness_times(problem, K_h, w);
      }
      else if (force)
        discrete.apply_trace_transpose(rhs, adjoint.pull);
      else
        rhs = value_at_probe(problem, rhs, goal);
      if (force && !problem.space.processes().any(any_contact))
        return adjoint; // without contact nothing says where the force depends on the mesh
      try
      {
        adjoint.available = discrete.solve_tangent(d, rhs, {.relative = accuracy_of_adjoint}, adjoint.z).converged;
      }
      catch (const std::runtime_error &)
      {
        return adjoint; // the contact set does not hold the body
      }
      distribute_homogeneous(problem.space.dirichlet, adjoint.z);
      discrete.apply_trace(adjoint.Bz, adjoint.z);
      if (reaction)
      {
        adjoint.z -= w;
        adjoint.Bz -= Bw;
      }
      return adjoint;
    }

    /// Some nodes of the probe's cell are fixed and the others in contact: z_h vanishes there, which says nothing of what u does between.
    template <int dim>
    bool
    is_held_at_all_nodes(const Problem<dim> &problem, const DiscreteProblem &discrete, const Vector &lambda, const RefinementGoal &goal)
    {
      Vector contact_forces;
      discrete.initialize_dof_vector(contact_forces);
      discrete.apply_trace_transpose(contact_forces, lambda);
      const Processes &processes = problem.space.processes();
      const Vector     shapes = value_at_probe(problem, contact_forces, goal);
      if (!processes.any(shapes.l2_norm() > 0))
        return false; // u is prescribed there
      bool is_free = false, is_fixed = false;
      for (types::global_dof_index dof = 0; dof < shapes.size(); ++dof)
        is_free = is_free || (shapes(dof) != 0 && contact_forces(dof) == 0);
      if (const auto place = place_of_probe(problem, goal))
      {
        std::vector<types::global_dof_index> dofs(problem.space.fe->n_dofs_per_cell());
        place->cell->get_dof_indices(dofs);
        is_fixed = std::any_of(dofs.begin(), dofs.end(), [&](const auto dof) { return problem.space.dirichlet.is_constrained(dof); });
      }
      return !processes.any(is_free) && processes.any(is_fixed);
    }

    /// By cell: the squares of the estimated errors of u and z, and a(u - u_h, z - z_h) by polarisation.
    struct EnergyOfErrors
    {
      std::vector<double> of_u, of_z, mixed;
    };

    template <int dim>
    EnergyOfErrors energy_of_errors(
      const Problem<dim> &problem, const Vector &u, const RecoveredFlux<dim> &flux, const Vector &z, const RecoveredFlux<dim> &flux_of_z)
    {
      EnergyOfErrors      energy;
      std::vector<double> of_sum, of_difference;
      discretisation_indicator(problem, u, flux, &energy.of_u);
      discretisation_indicator(problem, z, flux_of_z, &energy.of_z);
      const double norm_u = norm_of(energy.of_u, problem.space.processes()), norm_z = norm_of(energy.of_z, problem.space.processes());
      const double scale = norm_z > 0 ? norm_u / norm_z : 1.;
      const Vector sum = combined(u, scale, z), difference = combined(u, -scale, z);
      discretisation_indicator(problem, sum, RecoveredFlux<dim>(problem, sum), &of_sum);
      discretisation_indicator(problem, difference, RecoveredFlux<dim>(problem, difference), &of_difference);
      energy.mixed.resize(energy.of_u.size(), 0.);
      for (std::size_t c = 0; c < energy.mixed.size() && scale > 0; ++c)
        energy.mixed[c] = (of_sum[c] - of_difference[c]) / (4 * scale);
      return energy;
    }

    /// What bounds and prescribed values, which u_h has at points only, make of the goal: for membranes, by cell.
    template <int dim>
    std::vector<double> error_of_data(const Problem<dim>       &problem,
                                      const DiscreteProblem    &discrete,
                                      const ConstraintSet<dim> &K_h,
                                      const Vector             &u,
                                      const Vector             &lambda,
                                      const Adjoint            &adjoint,
                                      const RecoveredFlux<dim> &flux_of_z)
    {
      std::vector<double> by_cell(problem.space.mesh.triangulation->n_active_cells(), 0.);
      if (problem.form->n_components() != 1 || problem.form->order() != 1)
        return by_cell;
      for (std::size_t b = 0; b < K_h.blocks.size(); ++b)
      {
        if (problem.conditions[b].part)
          continue;
        Vector r, forces, reaction, pressure;
        discrete.initialize_dof_vector(r);
        discrete.initialize_dof_vector(forces);
        discrete.initialize_point_vector(reaction);
        discrete.initialize_point_vector(pressure);
        for (std::size_t i = K_h.blocks[b].begin; i < K_h.blocks[b].end; ++i)
        {
          pressure(i) = lambda(i);
          reaction(i) = adjoint.pull(i) * (adjoint.Bz(i) - adjoint.g);
        }
        discrete.apply_trace_transpose(r, reaction);
        discrete.apply_trace_transpose(forces, pressure);
        add_error_of_bound(problem, problem.conditions[b].bound, u, r, forces, by_cell);
      }
      add_error_of_boundary_values(problem, u, flux_of_z, by_cell);
      return by_cell;
    }
  } // namespace

  template <int dim>
  GoalError goal_error(const Problem<dim>       &problem,
                       DiscreteProblem          &discrete,
                       const ConstraintSet<dim> &K_h,
                       const Vector             &u,
                       const Vector             &lambda,
                       const RecoveredFlux<dim> &flux,
                       const double              penalty_error_bound)
  {
    const RefinementGoal &goal = goal_of(problem.statement);
    const bool            force = goal.kind == RefinementGoal::Kind::contact_force, probe = goal.kind == RefinementGoal::Kind::probe;
    GoalError             result;
    Estimate::Goal       &estimate = result.estimate;
    estimate.quantity = goal.name;
    estimate.error = std::numeric_limits<double>::infinity();
    const Processes &processes = problem.space.processes();
    for (std::size_t i = 0; force && i < K_h.points.size(); ++i)
      estimate.value += K_h.owns(i) ? discrete.weights()(i) * std::max(lambda(i), 0.) : 0.;
    estimate.value = processes.sum(estimate.value);
    if (goal.kind == RefinementGoal::Kind::reaction)
    {
      const ForceBalance balance = force_balance(problem, K_h, u, lambda);
      estimate.value = balance.reactions[goal.number].force[*goal.component];
      double largest = 0;
      for (const auto *const force : {&balance.load, &balance.contact, &balance.springs, &balance.reaction})
        for (const double component : *force)
          largest = std::max(largest, std::abs(component));
      if (std::abs(estimate.value) < 1e-6 * largest) // zero, by equilibrium or symmetry
        estimate.size = largest;
    }
    if (probe)
      estimate.value = probe_values(problem, u, flux)[goal.number].value[goal.component.value_or(0)];

    const Adjoint adjoint = solve_adjoint(problem, discrete, K_h, lambda, goal);
    if (!adjoint.available)
    {
      estimate.why_no_error = "there is no contact that holds the body";
      return result;
    }
    if (probe && is_held_at_all_nodes(problem, discrete, lambda, goal))
    {
      estimate.why_no_error = "supports and contact fix u at all nodes of its cell";
      return result;
    }

    const RecoveredFlux<dim> flux_of_z(problem, adjoint.z);
    const EnergyOfErrors     energy = energy_of_errors(problem, u, flux, adjoint.z, flux_of_z);
    std::vector<double>      of_data = error_of_data(problem, discrete, K_h, u, lambda, adjoint, flux_of_z);
    if (probe && problem.form->order() == 1)
    {
      const auto   place = place_of_probe(problem, goal);
      const double error = error_of_interpolation(problem, u, goal, place);
      if (place)
        of_data[place->cell->active_cell_index()] += error;
    }
    if (force && K_h.at_nodes())
      for (std::size_t b = 0; b < K_h.blocks.size(); ++b)
      {
        const auto borne_by_support = force_at_fixed_nodes(problem, K_h, b, lambda);
        std::transform(of_data.begin(), of_data.end(), borne_by_support.begin(), of_data.begin(), std::plus<>());
      }
    const std::vector<double> of_free_boundary = error_of_free_boundary(problem, discrete, K_h, lambda, adjoint.Bz, adjoint.g);

    // The sum of these is an error by itself; what the finer rule leaves of each is as likely of one sign as of the other.
    const std::vector<double> of_load = work_of_unresolved_load(problem, u, adjoint.z);
    const double              sum_of_load = processes.sum(std::accumulate(of_load.begin(), of_load.end(), 0.));
    const double rest_of_load = std::sqrt(processes.sum(std::inner_product(of_load.begin(), of_load.end(), of_load.begin(), 0.)));

    double error = 0;
    for (std::size_t c = 0; c < energy.of_u.size(); ++c)
    {
      const double contribution = energy.mixed[c] + of_data[c];
      estimate.correction += contribution;
      error += std::abs(contribution) + of_free_boundary[c];
      result.cell_squares.push_back(std::sqrt(std::max(energy.of_u[c], 0.) * std::max(energy.of_z[c], 0.)) + std::abs(of_data[c]) +
                                    std::abs(of_load[c]) + of_free_boundary[c]);
    }
    estimate.correction = processes.sum(estimate.correction) + sum_of_load;
    estimate.error = penalty_error_bound * energy_norm(problem, adjoint.z) + processes.sum(error) + std::abs(sum_of_load) + rest_of_load;
    return result;
  }

#define INSTANTIATE(dim)                                                                                                                   \
  template void      check_goal(const Problem<dim> &);                                                                                     \
  template GoalError goal_error(const Problem<dim> &, DiscreteProblem &, const ConstraintSet<dim> &, const Vector &, const Vector &,       \
                                const RecoveredFlux<dim> &, double);
  INSTANTIATE(1)
  INSTANTIATE(2)
  INSTANTIATE(3)
#undef INSTANTIATE
} // namespace unilateral
