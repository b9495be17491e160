#include "unilateral/evaluation/equilibrium.h"

#include "unilateral/discretisation/element_systems.h"
#include "unilateral/discretisation/rigid_body_modes.h"
#include "unilateral/evaluation/held_unknowns.h"
#include "unilateral/evaluation/nodal_forces.h"
#include "unilateral/mesh/reference_face.h"
#include "unilateral/spaces/hermite.h"

#include <Eigen/Core>

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <map>
#include <utility>
#include <vector>

namespace unilateral
{
  using namespace dealii;

  namespace
  {
    /// In parts of the summands of A u: forces as small as this are known to six digits. A body that its supports move as a whole, and that
    /// touches nothing, has only forces of rounding, which balance nothing.
    constexpr double negligible_force = 1e-9;

    /// The unknowns that stop modes which neither contact nor load knows of.
    template <int dim>
    std::vector<types::global_dof_index> pinned_unknowns(const Problem<dim> &problem)
    {
      std::vector<types::global_dof_index> dofs;
      if (!problem.has_pins())
        return dofs;
      for (const auto &node : problem.space.nodal_values())
        for (const auto &pin : problem.pinned_values())
          if (node.component == pin.component && node.x.distance(pin.x) <= 1e-12 * pin.x.norm())
            dofs.push_back(node.dof);
      return dofs;
    }

    /// The largest work on a rigid body mode of forces at unknowns.
    template <int dim>
    double largest_work(const Problem<dim> &problem, const Vector &force)
    {
      double largest = 0;
      for (const Vector &at : interpolate(problem, rigid_body_modes(problem)))
      {
        double work = 0;
        for (std::size_t dof = 0; dof < force.size(); ++dof)
          work += force(dof) * at(dof);
        largest = std::max(largest, std::abs(problem.space.processes().sum(work)));
      }
      return largest;
    }

    /// What platens that something holds bear, and what passes through periodic parts, where the mean strain may be all that acts. Adds the
    /// sizes of the forces at nodes to @p size.
    template <int dim>
    void add_reactions_at_couplings(const Problem<dim>                      &problem,
                                    const Vector                            &missing,
                                    ForceBalance                            &balance,
                                    std::map<unsigned, std::vector<double>> &by_part,
                                    double                                  &size)
    {
      const unsigned n_components = problem.form->n_components();
      for (const auto &platen : problem.space.couplings.rigid_parts)
        for (std::size_t k = 0; k < platen.nodes.size() && platen.restrained; ++k)
          for (unsigned c = 0; c < n_components; ++c)
          {
            const double force = missing(platen.nodes[k].dofs[c]);
            balance.reaction[c] += force;
            size += std::abs(force);
            auto &on_part = by_part[platen.part];
            on_part.resize(n_components, 0.);
            on_part[c] += force;
          }
      for (const auto &image : problem.space.couplings.periodic.images())
        for (unsigned c = 0; c < n_components; ++c)
          size += std::abs(missing(image.node.dofs[c]));
    }

    /// The parts of the boundary where values or slopes are prescribed, without that of the cuts.
    template <int dim>
    struct HeldParts
    {
      static constexpr double none = std::numeric_limits<double>::max();

      HeldParts(const FunctionSpace<dim> &space, const std::vector<PartCondition> &conditions)
        : part(space.dof_handler.n_dofs()), normal(space.dof_handler.n_dofs(), 1.),
          first_place(space.mesh.part_names.size() - (space.subdomain ? 1 : 0), none)
      {
        const auto meaning = space.hermite() ? hermite_cell_dofs<dim>() : std::vector<HermiteCellDof<dim>>();
        part = none;
        for_each_boundary_face(space,
                               [&](const auto &cell, const unsigned face, const auto &dofs)
                               {
                                 const auto &condition = conditions[cell->face(face)->boundary_id()];
                                 if (!condition.value && !condition.slope && !condition.symmetry)
                                   return; // what holds the corners that it shares with others are these
                                 for (unsigned i = 0; i < dofs.size(); ++i)
                                   if (space.dirichlet.is_constrained(dofs[i]) &&
                                       (space.hermite() ? lies_on_face(meaning[i], face)
                                                        : lies_on_face<dim>(cell->reference_cell(), face, space.fe->unit_support_point(i))))
                                   {
                                     part(dofs[i]) = std::min<double>(part(dofs[i]), cell->face(face)->boundary_id());
                                     normal[dofs[i]] = face % 2 == 0 ? -1 : 1;
                                   }
                               });
        space.shared().minimize(part.begin());
        for_each_boundary_face(space,
                               [&](const auto &cell, const unsigned face, const auto &dofs)
                               {
                                 const auto id = cell->face(face)->boundary_id();
                                 if (std::any_of(dofs.begin(), dofs.end(), [&](const auto dof) { return part(dof) == id; }))
                                   first_place[id] = std::min<double>(first_place[id], dim > 1 ? id : 2 * cell->active_cell_index() + face);
                               });
      }

      Vector              part;        ///< the one with the lowest number that an unknown lies on, or none
      std::vector<double> normal;      ///< -1 or 1: the direction of the outer normal, of beams
      std::vector<double> first_place; ///< of each part: its number, on beams where cells first meet it; none: nothing is held there

    private:
      template <typename Visit>
      void for_each_boundary_face(const FunctionSpace<dim> &space, const Visit &visit) const
      {
        std::vector<types::global_dof_index> dofs(space.fe->n_dofs_per_cell());
        for (const auto &cell : space.dof_handler.active_cell_iterators())
          for (const auto face : cell->face_indices())
            if (cell->at_boundary(face) && cell->face(face)->boundary_id() < first_place.size())
            {
              cell->get_dof_indices(dofs);
              visit(cell, face, dofs);
            }
      }
    };
  } // namespace

  template <int dim>
  double energy(const Problem<dim> &problem, const Vector &u)
  {
    double sum = 0;
    for_each_local_force<dim>(problem, u,
                              [&](const LocalForces &local)
                              {
                                sum += 0.5 * local.u.dot(local.Au);
                                if (local.load)
                                  sum -= local.u.dot(Eigen::Map<const Eigen::VectorXd>(local.load->begin(), local.load->size()));
                              });
    return problem.space.processes().sum(sum);
  }

  template <int dim>
  ForceBalance force_balance(const Problem<dim> &problem, const ConstraintSet<dim> &constraint_set, const Vector &u, const Vector &lambda)
  {
    const unsigned          n_components = problem.form->n_components();
    const HeldUnknowns<dim> held(problem);
    const auto             &component = held.component;

    ForceBalance balance;
    for (auto *force : {&balance.load, &balance.springs, &balance.contact, &balance.reaction})
      force->assign(n_components, 0.);
    const auto forces = forces_at_unknowns(problem, constraint_set, u, lambda);
    double     sizes[5] = {0, 0, 0, 0, 0}; // of the forces at nodes, which may cancel, and of what has no meaning beside rounding
    for (std::size_t dof = 0; dof < u.size(); ++dof)
    {
      balance.load[component[dof]] += forces.load(dof);
      balance.springs[component[dof]] += forces.springs(dof);
      balance.contact[component[dof]] += forces.contact(dof);
      sizes[0] += std::abs(forces.load(dof));
      sizes[1] += std::abs(forces.springs(dof));
      sizes[2] += std::abs(forces.contact(dof));
    }

    Vector unbalanced(forces.missing);
    hand_over_at_ties(problem, unbalanced);
    std::map<unsigned, std::vector<double>> by_part;
    add_reactions_at_couplings(problem, forces.missing, balance, by_part, sizes[3]);

    for (std::size_t dof = 0; dof < u.size(); ++dof)
      if (held.is_held[dof])
      {
        balance.reaction[component[dof]] += unbalanced(dof);
        sizes[3] += std::abs(unbalanced(dof));
        const auto part = held.part_of.find(dof);
        if (part == held.part_of.end())
          continue; // the axis, or a side condition, where no force acts
        auto &force = by_part[part->second];
        force.resize(n_components, 0.);
        force[component[dof]] += unbalanced(dof);
      }
    const auto &processes = problem.space.processes();
    for (auto *force : {&balance.load, &balance.springs, &balance.contact, &balance.reaction})
      processes.sum(force->data(), n_components);
    sizes[4] = negligible_force * forces.summands.l1_norm();
    processes.sum(sizes, 5);
    for (unsigned part = 0; part < problem.space.mesh.part_names.size() && !processes.alone(); ++part)
      if (processes.any(by_part.count(part) > 0))
      {
        auto &force = by_part[part];
        force.resize(n_components, 0.);
        processes.sum(force.data(), n_components);
      }
    for (const auto &[part, force] : by_part)
      balance.reactions.push_back({problem.space.mesh.part_names[part], force});

    if (problem.axisymmetric()) // radial forces cancel around the circle
      for (auto *force : {&balance.load, &balance.springs, &balance.contact, &balance.reaction})
        (*force)[0] = 0;
    Vector at_pins(u.size());
    for (const auto dof : pinned_unknowns(problem))
      at_pins(dof) = unbalanced(dof); // what passes between periodic partners is none of its doing
    for (std::size_t dof = 0; dof < u.size(); ++dof)
      if (held.is_held[dof])
        unbalanced(dof) = 0;
    if (const double largest = *std::max_element(sizes, sizes + 5); largest > 0)
    {
      balance.residual = largest_work(problem, unbalanced) / largest;
      balance.side_conditions = largest_work(problem, at_pins) / largest;
    }
    balance.side_conditions_on = problem.pinned_modes();
    return balance;
  }

  template <int dim>
  std::vector<SupportReaction>
  support_reactions(const Problem<dim> &problem, const ConstraintSet<dim> &constraint_set, const Vector &u, const Vector &lambda)
  {
    const auto                  &space = problem.space;
    const Vector                 missing = forces_at_unknowns(problem, constraint_set, u, lambda).missing;
    const HeldParts<dim>         held(space, problem.prescribed.conditions);
    const unsigned               n_parts = held.first_place.size();
    const auto                   nodes = space.hermite() ? hermite_nodes(space.dof_handler) : std::vector<HermiteNode<dim>>();
    std::vector<SupportReaction> on_parts, inside;
    for (unsigned part = 0; part < n_parts; ++part)
      on_parts.push_back({space.mesh.part_names[part], 0, 0});
    for (types::global_dof_index dof = 0; dof < u.size(); ++dof)
    {
      if (!space.dirichlet.is_constrained(dof))
        continue;
      SupportReaction *reaction = nullptr;
      if (held.part(dof) < held.none)
        reaction = &on_parts[unsigned(held.part(dof))];
      else if (space.hermite())
      {
        const std::string name = fmt::format("x = {:.6g}", nodes[dof].location[0]);
        auto              it = std::find_if(inside.begin(), inside.end(), [&](const SupportReaction &other) { return other.on == name; });
        reaction = &*(it == inside.end() ? inside.insert(it, {name, 0, 0}) : it);
      }
      if (!reaction)
        continue;
      const bool is_value = !space.hermite() || nodes[dof].derivative == DerivativeIndex<dim>{};
      if (is_value)
        reaction->force += missing(dof);
      else if (dim == 1)
        reaction->moment += held.normal[dof] * missing(dof);
    }

    // In the order of the mesh's parts; those of beams from left to right.
    std::vector<std::pair<double, SupportReaction>> in_order;
    for (unsigned part = 0; part < n_parts; ++part)
      if (const double first = space.processes().min(held.first_place[part]); first < held.none)
      {
        on_parts[part].force = space.processes().sum(on_parts[part].force);
        in_order.emplace_back(first, on_parts[part]);
      }
    std::stable_sort(in_order.begin(), in_order.end(), [](const auto &a, const auto &b) { return a.first < b.first; });
    std::vector<SupportReaction> reactions;
    for (const auto &[first, reaction] : in_order)
      reactions.push_back(reaction);
    reactions.insert(reactions.end(), inside.begin(), inside.end());
    return reactions;
  }

  template <int dim>
  ContactForce
  contact_force(const Problem<dim> &problem, const ConstraintSet<dim> &constraint_set, const ConstraintBlock &block, const Vector &lambda)
  {
    const bool   axisymmetric = problem.axisymmetric();
    ContactForce result;
    result.force.assign(dim, 0.);
    result.moment.assign(axisymmetric || dim == 1 ? 0 : dim == 2 ? 1 : 3, 0.);
    for (std::size_t i = block.begin; i < block.end; ++i)
    {
      if (!constraint_set.owns(i))
        continue;
      const Point<dim>    &x = constraint_set.points[i].x;
      const Tensor<1, dim> F = -constraint_set.points[i].weight * lambda(i) * constraint_set.directions[i];
      for (unsigned c = 0; c < dim; ++c)
        result.force[c] += F[c];
      if (result.moment.size() == 1)
        result.moment[0] += x[0] * F[1 % dim] - x[1 % dim] * F[0];
      else if (result.moment.size() == 3)
        for (unsigned c = 0; c < 3; ++c)
          result.moment[c] += x[(c + 1) % dim] * F[(c + 2) % dim] - x[(c + 2) % dim] * F[(c + 1) % dim];
    }
    problem.space.processes().sum(result.force.data(), result.force.size());
    problem.space.processes().sum(result.moment.data(), result.moment.size());
    if (axisymmetric)
      result.force[0] = 0;
    return result;
  }

#define INSTANTIATE(dim)                                                                                                                   \
  template std::vector<SupportReaction> support_reactions(const Problem<dim> &, const ConstraintSet<dim> &, const Vector &,                \
                                                          const Vector &);                                                                 \
  template double                       energy(const Problem<dim> &, const Vector &);                                                      \
  template ForceBalance                 force_balance(const Problem<dim> &, const ConstraintSet<dim> &, const Vector &, const Vector &);   \
  template ContactForce contact_force(const Problem<dim> &, const ConstraintSet<dim> &, const ConstraintBlock &, const Vector &);
  INSTANTIATE(1)
  INSTANTIATE(2)
  INSTANTIATE(3)
#undef INSTANTIATE
} // namespace unilateral
