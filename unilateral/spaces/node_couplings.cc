#include "unilateral/spaces/node_couplings.h"

#include "unilateral/mesh/gauss_rule.h"
#include "unilateral/spaces/surface_moments.h"

#include <deal.II/base/quadrature_lib.h>
#include <deal.II/fe/fe.h>

#include <fmt/format.h>

#include <algorithm>
#include <map>

namespace unilateral
{
  using namespace dealii;

  namespace
  {
    /// Two platens with a common node would be one.
    template <int dim>
    void check_rigid_parts(const std::vector<RigidPart<dim>> &platens,
                           const PeriodicNodes<dim>          &periodic,
                           const std::vector<PartCondition>  &conditions)
    {
      std::map<types::global_dof_index, types::boundary_id> part_of;
      for (const auto &platen : platens)
        for (const auto &node : platen.nodes)
          if (const auto [entry, is_new] = part_of.try_emplace(node.dofs[0], platen.part); !is_new)
            throw InputError(conditions[platen.part].where,
                             fmt::format("the rigid parts '{}' and '{}' meet: they would move as one; make them one part, by a [[part]] "
                                         "or in the mesh",
                                         conditions[entry->second].part, conditions[platen.part].part),
                             MessageName("contradiction"));
      for (const auto &image : periodic.images())
      {
        const auto one = part_of.find(image.node.dofs[0]), other = part_of.find(image.original.dofs[0]);
        if (one == other || (one != part_of.end() && other != part_of.end() && one->second == other->second))
          continue;
        const auto part = one != part_of.end() ? one->second : other->second;
        throw InputError(conditions[part].where,
                         fmt::format("the rigid part '{}' meets one of two periodic parts and not the other", conditions[part].part),
                         MessageName("contradiction"));
      }
    }
  } // namespace

  template <int dim>
  NodeCouplings<dim> make_node_couplings(const std::vector<PartCondition> &conditions,
                                         const std::vector<PeriodicPair>  &pairs,
                                         const Mapping<dim>               &mapping,
                                         const DoFHandler<dim>            &dof_handler,
                                         const AffineConstraints<double>  &hanging_nodes,
                                         const Processes                  &processes)
  {
    NodeCouplings<dim> couplings;
    if (!pairs.empty())
      couplings.periodic = PeriodicNodes<dim>(pairs, mapping, dof_handler, hanging_nodes, /*is_part=*/!processes.alone());
    if (std::none_of(conditions.begin(), conditions.end(), [](const auto &condition) { return condition.rigid; }))
      return couplings;
    const auto &fe = dof_handler.get_fe();
    const auto  moments = surface_moments<dim>(
      mapping, dof_handler, gauss_rule<dim - 1>(fe.reference_cell().is_simplex(), fe.degree + 2), conditions.size(),
      [](const Point<dim> &) { return 1.; }, processes);
    for (types::boundary_id part = 0; part < conditions.size(); ++part)
      if (conditions[part].rigid)
        couplings.rigid_parts.push_back(
          make_rigid_part<dim>(part, conditions[part], moments[part].centroid, mapping, dof_handler, hanging_nodes));
    check_rigid_parts(couplings.rigid_parts, couplings.periodic, conditions);
    return couplings;
  }

#define INSTANTIATE(dim)                                                                                                                   \
  template NodeCouplings<dim> make_node_couplings(const std::vector<PartCondition> &, const std::vector<PeriodicPair> &,                   \
                                                  const Mapping<dim> &, const DoFHandler<dim> &, const AffineConstraints<double> &,        \
                                                  const Processes &);
  INSTANTIATE(1)
  INSTANTIATE(2)
  INSTANTIATE(3)
#undef INSTANTIATE
} // namespace unilateral
