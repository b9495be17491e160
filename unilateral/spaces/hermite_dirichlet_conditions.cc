#include "unilateral/spaces/hermite_dirichlet_conditions.h"

#include "unilateral/spaces/hermite.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <optional>

namespace unilateral
{
  using namespace dealii;

  namespace
  {
    /// d^alpha of a function along an edge, alpha = 0 or one first derivative.
    template <int dim>
    double derivative(const FieldFunction &function, const DerivativeIndex<dim> &alpha, const Point<dim> &x)
    {
      for (unsigned d = 0; d < dim; ++d)
        if (alpha[d] > 0)
          return function.gradient(x)[d];
      return function.value(x);
    }

    /// The values that unknowns have; of several the one with the smallest rank.
    class PrescribedUnknowns
    {
    public:
      void prescribe(const types::global_dof_index dof, const double value, const int rank)
      {
        const auto [it, is_new] = prescribed.emplace(dof, Value{value, rank});
        if (!is_new && rank < it->second.rank)
          it->second = {value, rank};
      }

      /// The value of @p dof, if it has one.
      std::optional<double> value_of(const types::global_dof_index dof) const
      {
        const auto it = prescribed.find(dof);
        return it == prescribed.end() ? std::nullopt : std::optional<double>(it->second.value);
      }

      /// A process may have a vertex of the boundary and none of the faces there.
      void take_those_of_others(const SharedUnknowns &shared)
      {
        std::vector<std::pair<unsigned, Value>> values;
        for (const auto &[dof, value] : prescribed)
          if (shared.shares(dof))
            values.emplace_back(dof, value);
        shared.share(values);
        for (const auto &[dof, value] : values)
          prescribe(dof, value.value, value.rank);
      }

      AffineConstraints<double> lines() const
      {
        AffineConstraints<double> result;
        for (const auto &[dof, entry] : prescribed)
        {
          result.add_line(dof);
          result.set_inhomogeneity(dof, entry.value);
        }
        result.close();
        return result;
      }

    private:
      struct Value
      {
        double value;
        int    rank;
      };
      std::map<types::global_dof_index, Value> prescribed;
    };

    template <int dim>
    void
    prescribe_on_boundary(const std::vector<PartCondition> &conditions, const DoFHandler<dim> &dof_handler, PrescribedUnknowns &unknowns)
    {
      const auto                           meaning = hermite_cell_dofs<dim>();
      std::vector<types::global_dof_index> dofs(dof_handler.get_fe().n_dofs_per_cell());
      for (const auto &cell : dof_handler.active_cell_iterators())
        for (const auto face : cell->face_indices())
        {
          if (!cell->face(face)->at_boundary())
            continue;
          const auto  part = cell->face(face)->boundary_id();
          const auto &condition = conditions[part];
          const bool  slope_given = condition.slope || condition.symmetry;
          if (!condition.value && !slope_given)
            continue;
          const FieldFunction value = condition.value.value_or(0.), slope = condition.slope.value_or(0.);
          const int           rank = int((condition.named ? 0 : conditions.size()) + (conditions.size() - part));
          const unsigned      normal = face / 2;
          const double        sign = dim > 1 && face % 2 == 0 ? -1 : 1;
          cell->get_dof_indices(dofs);
          for (unsigned i = 0; i < dofs.size(); ++i)
          {
            if (!lies_on_face(meaning[i], face))
              continue;
            auto             along = meaning[i].derivative;
            const Point<dim> x = cell->vertex(meaning[i].vertex);
            if (along[normal] == 0 && condition.value)
              unknowns.prescribe(dofs[i], derivative<dim>(value, along, x), rank);
            else if (along[normal] == 1 && slope_given)
            {
              along[normal] = 0;
              unknowns.prescribe(dofs[i], sign * derivative<dim>(slope, along, x), rank);
            }
          }
        }
    }

    /// Throws InputError where a support contradicts the boundary or another one.
    template <int dim>
    void prescribe_at_supports(const std::vector<InnerSupport> &supports, const DoFHandler<dim> &dof_handler, PrescribedUnknowns &unknowns)
    {
      if (supports.empty())
        return;
      constexpr int before_all = -1;
      const auto    nodes = hermite_nodes(dof_handler);
      const auto prescribe = [&](const InnerSupport &support, const types::global_dof_index dof, const char *const what, const double value)
      {
        if (const auto other = unknowns.value_of(dof);
            other && std::abs(*other - value) > 1e-9 * std::max(std::abs(*other), std::abs(value)) + 1e-15)
          throw InputError(
            support.where,
            fmt::format("the support at {} prescribes the {} {:.6g}, and [boundary] or another support {:.6g}: no function has both",
                        support.at[0], what, value, *other),
            MessageName("contradiction"));
        unknowns.prescribe(dof, value, before_all);
      };
      for (const auto &support : supports)
      {
        bool found = false;
        for (types::global_dof_index dof = 0; dof < nodes.size(); ++dof)
        {
          double distance = 0;
          for (unsigned d = 0; d < dim; ++d)
            distance = std::max(distance, std::abs(nodes[dof].location[d] - support.at[d]));
          if (distance > 1e-9 * (1 + std::abs(support.at[0])))
            continue;
          found = true;
          if (nodes[dof].derivative == DerivativeIndex<dim>{} && support.value)
            prescribe(support, dof, "value", support.value->value(nodes[dof].location));
          if (dim == 1 && nodes[dof].derivative[0] == 1 && support.slope)
            prescribe(support, dof, "slope", support.slope->value(nodes[dof].location));
        }
        if (!found)
          throw InputError(support.where,
                           fmt::format("a support must lie at a node of the coarse mesh, {} is none; choose [mesh] cells "
                                       "so that it is",
                                       support.at[0]),
                           MessageName("point-outside"));
      }
    }
  } // namespace

  template <int dim>
  AffineConstraints<double> make_hermite_dirichlet_conditions(const std::vector<PartCondition> &conditions,
                                                              const std::vector<InnerSupport>  &supports,
                                                              const DoFHandler<dim>            &dof_handler,
                                                              const SharedUnknowns             &shared)
  {
    PrescribedUnknowns unknowns;
    prescribe_on_boundary(conditions, dof_handler, unknowns);
    if (!shared.processes().alone())
      unknowns.take_those_of_others(shared);
    prescribe_at_supports(supports, dof_handler, unknowns);
    return unknowns.lines();
  }

  template AffineConstraints<double> make_hermite_dirichlet_conditions(const std::vector<PartCondition> &,
                                                                       const std::vector<InnerSupport> &,
                                                                       const DoFHandler<1> &,
                                                                       const SharedUnknowns &);
  template AffineConstraints<double> make_hermite_dirichlet_conditions(const std::vector<PartCondition> &,
                                                                       const std::vector<InnerSupport> &,
                                                                       const DoFHandler<2> &,
                                                                       const SharedUnknowns &);
  template AffineConstraints<double> make_hermite_dirichlet_conditions(const std::vector<PartCondition> &,
                                                                       const std::vector<InnerSupport> &,
                                                                       const DoFHandler<3> &,
                                                                       const SharedUnknowns &);
} // namespace unilateral
