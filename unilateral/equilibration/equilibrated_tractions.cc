#include "unilateral/equilibration/equilibrated_tractions.h"

#include "unilateral/algebra/dense_solvers.h"
#include "unilateral/equilibration/contact_gap.h"
#include "unilateral/equilibration/nonnegative_polynomials.h"
#include "unilateral/equilibration/prescribed_directions.h"
#include "unilateral/equilibration/steps_together.h"
#include "unilateral/equilibration/tractions_across_cuts.h"

#include <algorithm>
#include <cmath>
#include <optional>

namespace unilateral
{
  using namespace dealii;

  namespace
  {
    template <int dim>
    Tensor<1, dim> traction_of(const Flux &stress, const Tensor<1, dim> &n)
    {
      // xx, yy, zz, xy, xz, yz
      Tensor<1, dim> t;
      for (unsigned a = 0; a < dim; ++a)
        for (unsigned b = 0; b < dim; ++b)
          t[a] += stress[a == b ? a : a + b + 2] * n[b];
      return t;
    }
  } // namespace

  template <int dim>
  EquilibratedTractions<dim>::EquilibratedTractions(const Problem<dim>              &problem,
                                                    const Elasticity<dim>           &elasticity,
                                                    const Vector                    &u,
                                                    const std::vector<Vector>       &pressures,
                                                    const RecoveredFlux<dim>        &flux,
                                                    const FeasibleDisplacement<dim> &displacement,
                                                    const BodyCells<dim>            &cells)
    : tractions(*problem.space.mesh.triangulation, cells.degree), degree(cells.degree), problem(problem), elasticity(elasticity),
      flux(flux), processes(problem.space.processes()), cuts(problem)
  {
    for (unsigned f = 0; f < tractions.n_faces; ++f)
    {
      const auto rule = on_reference_cell<dim>(tractions.simplex, f, tractions.rule);
      nodes_at_faces.emplace_back(flux.nodes->get_fe(), rule);
      element_at_faces.emplace_back(displacement.scalar(), rule);
    }
    for (const auto &cell : problem.space.dof_handler.active_cell_iterators())
      motions.push_back({cell->center(), cell->diameter()});
    find_open_directions();
    step_together(reason, processes,
                  [&]
                  {
                    if (!cuts.conform())
                      reason = "cells of different processes do not conform";
                    take_over_stress(u);
                    add_pressures(u, pressures, displacement);
                    collect_imbalance(cells);
                  });
    largest_scale = processes.max(largest_scale);
    leaves_out_pressure = processes.any(leaves_out_pressure);
    if (free.cols() > 0 && reason.empty())
      scale_pressures();
    if (free.cols() > 0 && reason.empty())
      move_against_springs();
    if (reason.empty())
      balance();
  }

  template <int dim>
  void EquilibratedTractions<dim>::find_open_directions()
  {
    Point<dim> least, most;
    for (const auto &face : tractions.faces)
    {
      for (unsigned d = 0; d < dim; ++d)
      {
        least[d] = &face == &tractions.faces[0] ? face.geometry.origin[d] : std::min(least[d], face.geometry.origin[d]);
        most[d] = &face == &tractions.faces[0] ? face.geometry.origin[d] : std::max(most[d], face.geometry.origin[d]);
      }
    }
    for (unsigned d = 0; d < dim; ++d)
    {
      least[d] = processes.min(least[d]);
      most[d] = processes.max(most[d]);
    }
    body = {least + 0.5 * (most - least), least.distance(most)};
    for (auto &face : tractions.faces)
    {
      const auto &owner = tractions.members[face.begin];
      const auto &cell = tractions.cell(owner.cell);
      if (problem.space.is_outside(cell, owner.face))
        face.open = prescribed_directions<dim>(problem.prescribed.conditions[cell->face(owner.face)->boundary_id()], face.geometry.normal);
      else if (!cell->at_boundary(owner.face)) // on cuts: what balance_parts() adds, nothing else
        for (unsigned d = 0; d < dim; ++d)
          face.open.push_back(Point<dim>::unit_vector(d));
    }
    free = StressBalance<dim>::free_modes(tractions, body, processes);
  }

  template <int dim>
  void EquilibratedTractions<dim>::take_over_stress(const Vector &u)
  {
    std::vector<types::global_dof_index> nodes(flux.nodes->get_fe().n_dofs_per_cell()), dofs(problem.space.fe->n_dofs_per_cell());
    std::vector<Tensor<1, dim>>          values(tractions.rule.size());
    for (const auto &cell : problem.space.dof_handler.active_cell_iterators())
    {
      const std::size_t c = cell->active_cell_index();
      Cell(&*problem.space.mesh.triangulation, cell->level(), cell->index(), flux.nodes)->get_dof_indices(nodes);
      cell->get_dof_indices(dofs);
      for (const unsigned f : cell->face_indices())
      {
        if (!tractions.owns(c, f))
          continue;
        const std::size_t           number = tractions.face_of(c, f);
        const auto                 &face = tractions.faces[number];
        const Tensor<1, dim>       &n = face.geometry.normal;
        const bool                  mean = between_regions(cuts, cell, f), outside = problem.space.is_outside(cell, f);
        std::vector<Tensor<1, dim>> nodal;
        for (const auto node : nodes)
          nodal.push_back(traction_of(mean ? flux.mean_at(node) : flux.at(node, cell->material_id()), n));
        for (unsigned q = 0; q < values.size(); ++q)
        {
          Tensor<1, dim> recovered, displacement;
          for (unsigned i = 0; i < nodes.size(); ++i)
            recovered += nodes_at_faces[f].values(q, i) * nodal[i];
          values[q] = recovered;
          if (!outside)
            continue;
          const auto part = cell->face(f)->boundary_id();
          const auto x = face.geometry.at(tractions.rule.point(q));
          const auto springs = elasticity.springs(part, x);
          for (unsigned i = 0; i < dofs.size(); ++i)
          {
            const auto [component, node] = problem.space.fe->system_to_component_index(i);
            displacement[component] += element_at_faces[f].values(q, node) * u(dofs[i]);
          }
          values[q] = elasticity.surface_load(part, x, n);
          for (unsigned d = 0; d < dim; ++d)
            values[q][d] -= springs[d] * displacement[d];
          for (const auto &direction : face.open)
            values[q] += ((recovered - values[q]) * direction) * direction;
        }
        tractions.set(number, values);
      }
    }
  }

  template <int dim>
  std::vector<unsigned> EquilibratedTractions<dim>::nodes_with_points(const Cell &cell, const unsigned f, const bool on_edges) const
  {
    const auto                          &fe = *problem.space.fe;
    const StraightFace<dim>              face(reference_corners<dim>(tractions.simplex), tractions.simplex, f);
    const auto                          &n = tractions.faces[tractions.face_of(cell->active_cell_index(), f)].geometry.normal;
    const auto                          &nodes = fe.base_element(0).get_unit_support_points();
    std::vector<types::global_dof_index> dofs(fe.n_dofs_per_cell());
    std::vector<unsigned>                result;
    cell->get_dof_indices(dofs);
    for (unsigned i = 0; i < nodes.size(); ++i)
    {
      if (std::abs((nodes[i] - face.origin) * face.normal) > 1e-10)
        continue;
      bool moves = false;
      for (unsigned c = 0; c < dim; ++c)
      {
        const auto dof = dofs[fe.component_to_system_index(c, i)];
        moves = moves || (std::abs(n[c]) > 1e-10 &&
                          (!problem.space.dirichlet.is_constrained(dof) || problem.space.hanging_nodes.is_constrained(dof)));
      }
      // On an edge all but one of the coordinates of a point in a triangle are positive.
      const auto xi = face.parameters(nodes[i]);
      unsigned   n_zero = 0;
      double     rest = 1;
      for (unsigned d = 0; d + 1 < dim; ++d)
      {
        n_zero += std::abs(xi[d]) < 1e-10;
        rest -= xi[d];
      }
      n_zero += std::abs(rest) < 1e-10;
      if (moves && (!on_edges || n_zero == dim - 2))
        result.push_back(i);
    }
    return result;
  }

  template <int dim>
  Eigen::VectorXd EquilibratedTractions<dim>::pressure_on(const Cell                &cell,
                                                          const unsigned             f,
                                                          const UnilateralCondition &condition,
                                                          const Eigen::VectorXd     &at_nodes) const
  {
    const bool      on_edges = condition.rule.family == RuleName::Family::edges;
    const auto      known = nodes_with_points(cell, f, on_edges);
    const auto     &element = problem.space.fe->base_element(0);
    const unsigned  n_on_face = tractions.simplex ? OrthonormalPolynomials<dim - 1>::size_of(element.degree)
                                                  : unsigned(std::lround(std::pow(element.degree + 1, dim - 1)));
    Eigen::VectorXd result = Eigen::VectorXd::Zero(tractions.basis.size());
    if (known.size() == n_on_face)
    {
      const Eigen::Map<const Eigen::VectorXd> weights(tractions.rule.get_weights().data(), tractions.rule.size());
      return tractions.tests.transpose() * weights.asDiagonal() * (element_at_faces[f].values * at_nodes);
    }
    if (known.empty())
      return result;
    const StraightFace<dim>     face(reference_corners<dim>(tractions.simplex), tractions.simplex, f);
    std::vector<Point<dim - 1>> points;
    Eigen::VectorXd             values(known.size());
    for (unsigned k = 0; k < known.size(); ++k)
    {
      points.push_back(face.parameters(element.get_unit_support_points()[known[k]]));
      values(k) = at_nodes(known[k]);
    }
    const unsigned n = dim == 2 ? std::min<unsigned>(known.size(), tractions.basis.size()) : known.size() >= dim ? dim : 1;
    result.head(n) = Eigen::MatrixXd(tractions.basis.values_at(points).leftCols(n)).completeOrthogonalDecomposition().solve(values);
    return result;
  }

  template <int dim>
  bool EquilibratedTractions<dim>::costs_too_much(const Cell            &cell,
                                                  const unsigned         f,
                                                  const std::size_t      condition,
                                                  const Eigen::VectorXd &coefficients,
                                                  const Eigen::VectorXd &normal_displacement) const
  {
    const auto &geometry = tractions.faces[tractions.face_of(cell->active_cell_index(), f)].geometry;
    const auto  lame = elasticity.lame_parameters(cell->material_id(), cell->center());
    double      work = 0, energy = 0;
    for (unsigned q = 0; q < tractions.rule.size(); ++q)
    {
      const double rho = tractions.tests.row(q).dot(coefficients), w = tractions.rule.weight(q);
      const auto   gap = contact_gap<dim>(problem.conditions[condition], geometry.at(tractions.rule.point(q)), geometry.normal);
      if (!gap)
        return true;
      work += w * rho * std::max(0., *gap - normal_displacement(q));
      energy += w * rho * rho * cell->diameter() / (lame.lambda + 2 * lame.mu);
    }
    return work > energy;
  }

  template <int dim>
  void EquilibratedTractions<dim>::add_pressures(const Vector                    &u,
                                                 const std::vector<Vector>       &pressures,
                                                 const FeasibleDisplacement<dim> &displacement)
  {
    const NonnegativePolynomials<dim - 1> polynomials(tractions.basis, tractions.simplex, degree);
    for (const auto &cell : problem.space.dof_handler.active_cell_iterators())
      for (const unsigned f : cell->face_indices())
        for (std::size_t b = 0; problem.space.is_outside(cell, f) && b < pressures.size(); ++b)
        {
          if (problem.conditions[b].part != cell->face(f)->boundary_id())
            continue;
          const std::size_t number = tractions.face_of(cell->active_cell_index(), f);
          const auto       &n = tractions.faces[number].geometry.normal;
          Eigen::VectorXd   coefficients = pressure_on(cell, f, problem.conditions[b], displacement.along(pressures[b], cell, n));
          polynomials.limit(coefficients);
          if (coefficients.isZero(0))
            continue;
          if (costs_too_much(cell, f, b, coefficients, element_at_faces[f].values * displacement.along(u, cell, n)))
          {
            leaves_out_pressure = true;
            continue;
          }
          pressure.push_back({number, b, coefficients});
          for (unsigned m = 0; m < coefficients.size(); ++m)
            tractions.add(number, m, -coefficients(m) * n);
        }
  }

  template <int dim>
  bool EquilibratedTractions<dim>::load_varies(const Cell &cell) const
  {
    return !elasticity.load_uniform_in(cell->material_id());
  }

  template <int dim>
  void EquilibratedTractions<dim>::collect_imbalance(const BodyCells<dim> &cells)
  {
    constexpr unsigned          n_modes = RigidMotions<dim>::n;
    std::vector<Tensor<1, dim>> values;
    imbalance.assign(motions.size() * n_modes, 0.);
    for (const auto &cell : problem.space.dof_handler.active_cell_iterators())
    {
      const std::size_t c = cell->active_cell_index();
      const auto        lame = elasticity.lame_parameters(cell->material_id(), cell->center());
      stiffness.push_back(lame.lambda + 2 * lame.mu);
      double     scale = 0;
      const auto add = [&](const Point<dim> &x, const Tensor<1, dim> &force)
      {
        const auto modes = motions[c].at(x);
        for (unsigned k = 0; k < n_modes; ++k)
          imbalance[c * n_modes + k] -= force * modes[k];
        scale += force.norm();
      };
      const auto on_cell = cells.on(cell, load_varies(cell));
      elasticity.load_densities(cell->material_id(), on_cell.at.x, values);
      for (unsigned q = 0; q < values.size(); ++q)
        if (values[q].norm() > 0)
          add(on_cell.at.x[q], on_cell.rule->element.weights[q] * on_cell.det * values[q]);
      for (const unsigned f : cell->face_indices())
      {
        const bool              owner = tractions.owns(c, f);
        const StraightFace<dim> geometry = owner ? tractions.faces[tractions.face_of(c, f)].geometry : StraightFace<dim>(cell, f);
        tractions.at_points(c, f, geometry, values);
        for (unsigned q = 0; q < values.size(); ++q)
          add(geometry.at(tractions.rule.point(q)), tractions.rule.weight(q) * geometry.dS * values[q]);
      }
      largest_scale = std::max(largest_scale, scale);
    }
  }

  template <int dim>
  std::vector<Tensor<1, dim>> EquilibratedTractions<dim>::free_modes_at(const Point<dim> &x) const
  {
    return modes_at(x, free);
  }

  template <int dim>
  std::vector<Tensor<1, dim>> EquilibratedTractions<dim>::modes_at(const Point<dim> &x, const Eigen::MatrixXd &which) const
  {
    const auto                  modes = body.at(x);
    std::vector<Tensor<1, dim>> result(which.cols());
    for (unsigned l = 0; l < result.size(); ++l)
      for (unsigned k = 0; k < modes.size(); ++k)
        result[l] += which(k, l) * modes[k];
    return result;
  }

  template <int dim>
  Eigen::VectorXd EquilibratedTractions<dim>::missing_force(const Eigen::MatrixXd &which) const
  {
    constexpr unsigned n_modes = RigidMotions<dim>::n;
    Eigen::VectorXd    missing = Eigen::VectorXd::Zero(which.cols());
    for (std::size_t c = 0; c < motions.size(); ++c)
    {
      // A motion of the body has the translation and the rotation of the cell at its centre.
      const auto at_centre = modes_at(motions[c].centre, which);
      for (unsigned l = 0; l < missing.size(); ++l)
        for (unsigned k = 0; k < n_modes; ++k)
          missing(l) += imbalance[c * n_modes + k] * (k < dim ? at_centre[l][k] : which(k, l) * motions[c].size / body.size);
    }
    return missing;
  }

  template <int dim>
  Eigen::VectorXd EquilibratedTractions<dim>::missing_force() const
  {
    Eigen::VectorXd missing = missing_force(free);
    processes.sum(missing.data(), missing.size());
    return missing;
  }

  template <int dim>
  void EquilibratedTractions<dim>::scale_pressures()
  {
    const unsigned  n_free = free.cols();
    const auto     &rule = tractions.rule;
    Eigen::MatrixXd effect = Eigen::MatrixXd::Zero(n_free, n_free), slopes(n_free, pressure.size());
    for (std::size_t p = 0; p < pressure.size(); ++p)
    {
      const auto &[number, condition, coefficients] = pressure[p];
      const auto &geometry = tractions.faces[number].geometry;
      Point<dim>  middle;
      double      area = 0;
      for (unsigned q = 0; q < rule.size(); ++q)
      {
        middle += rule.weight(q) * geometry.at(rule.point(q));
        area += rule.weight(q);
      }
      const auto at_middle = free_modes_at(middle / area);
      for (unsigned l = 0; l < n_free; ++l)
        slopes(l, p) = at_middle[l] * geometry.normal;
      const Eigen::VectorXd rho = tractions.tests * coefficients;
      for (unsigned q = 0; q < rule.size(); ++q)
      {
        const auto modes = free_modes_at(geometry.at(rule.point(q)));
        for (unsigned l = 0; l < n_free; ++l)
          for (unsigned k = 0; k < n_free; ++k)
            effect(l, k) -= rule.weight(q) * geometry.dS * rho(q) * (modes[l] * geometry.normal) * slopes(k, p);
      }
    }
    processes.sum(effect.data(), effect.size());
    Eigen::CompleteOrthogonalDecomposition<Eigen::MatrixXd> solver;
    solver.setThreshold(1e-9);
    solver.compute(effect);
    const Eigen::VectorXd factors = slopes.transpose() * solver.solve(missing_force());
    if (processes.any(!(factors.array() > -1).all()))
    {
      reason = "the contact pressure cannot be brought into balance with the load";
      return;
    }
    for (std::size_t p = 0; p < pressure.size(); ++p)
    {
      Eigen::RowVectorXd inward(dim);
      for (unsigned d = 0; d < dim; ++d)
        inward(d) = -tractions.faces[pressure[p].face].geometry.normal[d];
      add_at_boundary(pressure[p].face, factors(p) * pressure[p].coefficients * inward);
      pressure[p].coefficients *= 1 + factors(p);
    }
  }

  template <int dim>
  void EquilibratedTractions<dim>::add_at_boundary(const std::size_t number, const Eigen::MatrixXd &coefficients)
  {
    const auto &face = tractions.faces[number];
    const auto &owner = tractions.members[face.begin];
    const auto  as_tensor = [](const auto &row)
    {
      Tensor<1, dim> result;
      for (unsigned d = 0; d < dim; ++d)
        result[d] = row(d);
      return result;
    };
    for (unsigned m = 0; m < tractions.basis.size(); ++m)
      tractions.add(number, m, as_tensor(coefficients.row(m)));
    const Eigen::MatrixXd added = tractions.tests * coefficients;
    for (unsigned q = 0; q < tractions.rule.size(); ++q)
    {
      const Tensor<1, dim> force = tractions.rule.weight(q) * face.geometry.dS * as_tensor(added.row(q));
      const auto           modes = motions[owner.cell].at(face.geometry.at(tractions.rule.point(q)));
      for (unsigned k = 0; k < modes.size(); ++k)
        imbalance[owner.cell * modes.size() + k] -= force * modes[k];
    }
  }

  template <int dim>
  void EquilibratedTractions<dim>::move_against_springs()
  {
    const auto     &rule = tractions.rule;
    Eigen::MatrixXd resistance = Eigen::MatrixXd::Zero(free.cols(), free.cols());
    struct SpringFace
    {
      std::size_t                 face;
      std::vector<Tensor<1, dim>> stiffness; ///< at the points of the rule, along the axes
    };
    std::vector<SpringFace> spring_faces;
    for (std::size_t f = 0; f < tractions.faces.size(); ++f)
    {
      const auto &face = tractions.faces[f];
      const auto &owner = tractions.members[face.begin];
      const auto &cell = tractions.cell(owner.cell);
      if (!problem.space.is_outside(cell, owner.face) || face.open.size() == dim)
        continue;
      SpringFace springs{f, {}};
      bool       some = false;
      for (unsigned q = 0; q < rule.size(); ++q)
      {
        const Point<dim> x = face.geometry.at(rule.point(q));
        springs.stiffness.push_back(elasticity.springs(cell->face(owner.face)->boundary_id(), x));
        some = some || springs.stiffness[q].norm() > 0;
        const auto modes = free_modes_at(x);
        for (unsigned l = 0; l < modes.size(); ++l)
          for (unsigned k = 0; k < modes.size(); ++k)
            for (unsigned d = 0; d < dim; ++d)
              resistance(l, k) += rule.weight(q) * face.geometry.dS * springs.stiffness[q][d] * modes[l][d] * modes[k][d];
      }
      if (some)
        spring_faces.push_back(std::move(springs));
    }
    if (!processes.any(!spring_faces.empty()))
      return;
    processes.sum(resistance.data(), resistance.size());
    Eigen::CompleteOrthogonalDecomposition<Eigen::MatrixXd> solver;
    solver.setThreshold(1e-12);
    solver.compute(resistance);
    shift = -solver.solve(missing_force());

    const Eigen::Map<const Eigen::VectorXd> weights(rule.get_weights().data(), rule.size());
    for (const auto &[number, stiffness] : spring_faces)
    {
      const auto     &face = tractions.faces[number];
      Eigen::MatrixXd more(rule.size(), dim);
      for (unsigned q = 0; q < rule.size(); ++q)
      {
        const Tensor<1, dim> moved = spring_shift(face.geometry.at(rule.point(q)));
        Tensor<1, dim>       traction;
        for (unsigned d = 0; d < dim; ++d)
          traction[d] = -stiffness[q][d] * moved[d];
        for (const auto &direction : face.open)
          traction -= (traction * direction) * direction;
        for (unsigned d = 0; d < dim; ++d)
          more(q, d) = traction[d];
      }
      add_at_boundary(number, tractions.tests.transpose() * weights.asDiagonal() * more);
    }
  }

  template <int dim>
  Tensor<1, dim> EquilibratedTractions<dim>::spring_shift(const Point<dim> &x) const
  {
    Tensor<1, dim> result;
    if (shift.size() == 0)
      return result;
    const auto modes = free_modes_at(x);
    for (unsigned l = 0; l < modes.size(); ++l)
      result += shift(l) * modes[l];
    return result;
  }

  template <int dim>
  void EquilibratedTractions<dim>::balance_fails()
  {
    reason = "the forces between cells could not be balanced";
    if (leaves_out_pressure && free.cols() > 0)
      reason = "contact at single points bears the body, which no pressure on faces does in its place";
  }

  template <int dim>
  void EquilibratedTractions<dim>::balance_parts(const StressBalance<dim> &within)
  {
    constexpr unsigned             n_modes = RigidMotions<dim>::n;
    const TractionsAcrossCuts<dim> across(cuts, tractions, within, motions, body, processes);
    for (const auto &[face, coefficients] : across.solve(imbalance, missing_force(Eigen::MatrixXd::Identity(n_modes, n_modes))))
      add_at_boundary(face, coefficients);
  }

  template <int dim>
  void EquilibratedTractions<dim>::balance()
  {
    std::optional<StressBalance<dim>> within;
    step_together(reason, processes,
                  [&]
                  {
                    try
                    {
                      const auto free_in_part = processes.alone() ? free : StressBalance<dim>::free_modes(tractions, body, Processes());
                      within.emplace(tractions, motions, stiffness, free_in_part, body);
                    }
                    catch (const std::runtime_error &)
                    {
                      balance_fails();
                    }
                  });
    if (!reason.empty())
      return;
    if (!processes.alone())
      balance_parts(*within);
    step_together(reason, processes,
                  [&]
                  {
                    within->solve(tractions, imbalance);
                    for (const double rest : imbalance)
                      if (!(std::abs(rest) <= 1e-9 * largest_scale))
                        balance_fails();
                  });
  }

  template class EquilibratedTractions<2>;
  template class EquilibratedTractions<3>;
} // namespace unilateral
