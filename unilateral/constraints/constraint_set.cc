#include "unilateral/constraints/constraint_set.h"

#include "unilateral/base/point_text.h"
#include "unilateral/constraints/contact_points.h"
#include "unilateral/constraints/direction_of_contact.h"
#include "unilateral/constraints/merged_points.h"
#include "unilateral/spaces/cell_points.h"
#include "unilateral/spaces/hermite.h"

#include <deal.II/fe/fe_values.h>

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <optional>

namespace unilateral
{
  using namespace dealii;

  namespace
  {
    /// Shape values below this are round-off: a node of the element sees one shape function only.
    constexpr double negligible_shape_value = 1e-11;

    /// Collects the points of one condition.
    template <int dim>
    class BlockBuilder
    {
    public:
      BlockBuilder(ConstraintSet<dim>              &set,
                   const UnilateralCondition       &condition,
                   const ElementName               &element,
                   const DoFHandler<dim>           &dof_handler,
                   const AffineConstraints<double> &dirichlet,
                   const AffineConstraints<double> &hanging_nodes)
        : set(set), condition(condition), dirichlet(dirichlet), hanging_nodes(hanging_nodes), n_dofs(dof_handler.n_dofs()),
          shared(dof_handler.n_dofs())
      {
        if (element.family == ElementName::Family::hermite)
          for (const auto &dof : hermite_cell_dofs<dim>())
            is_value.push_back(dof.derivative == DerivativeIndex<dim>{});
      }

      /// The points of the rule on a cell or face, @p values evaluated there.
      void add(const FEValuesBase<dim> &values, const std::vector<types::global_dof_index> &cell_dofs, const double diameter)
      {
        for (const unsigned q : values.quadrature_point_indices())
        {
          row.clear();
          for (unsigned k = 0; k < cell_dofs.size(); ++k)
            if (const double value = values.shape_value(k, q); std::abs(value) > negligible_shape_value)
            {
              row.dofs.push_back(cell_dofs[k]);
              row.values.push_back(value);
              if (!is_value.empty())
                row.direction.push_back(is_value[k] ? 1 : 0);
            }
          add_row(values.quadrature_point(q), values.JxW(q), 1e-8 * diameter);
        }
      }

      /// The points of the rule on every cell, where shape functions have the same values on all cells.
      void add_cells(const Mapping<dim> &mapping, const DoFHandler<dim> &dof_handler, const Quadrature<dim> &rule)
      {
        const auto                                           &fe = dof_handler.get_fe();
        std::vector<std::vector<std::pair<unsigned, double>>> shapes(rule.size());
        std::vector<bool>                                     inside(rule.size());
        bool                                                  at_nodes = true;
        for (unsigned q = 0; q < rule.size(); ++q)
        {
          for (unsigned k = 0; k < fe.n_dofs_per_cell(); ++k)
            if (const double value = fe.shape_value(k, rule.point(q)); std::abs(value) > negligible_shape_value)
              shapes[q].emplace_back(k, value);
          at_nodes &= shapes[q].size() == 1;
          inside[q] = fe.reference_cell().contains_point(rule.point(q), -1e-10);
        }
        if (at_nodes)
          set.points.reserve(set.size() + dof_handler.n_dofs());
        CellPoints<dim>                      points(mapping, fe.reference_cell(), rule.get_points());
        CellWeights<dim>                     weights(mapping, dof_handler.get_triangulation(), fe.reference_cell(), rule);
        std::vector<types::global_dof_index> cell_dofs(fe.n_dofs_per_cell());
        for (const auto &cell : dof_handler.active_cell_iterators())
        {
          cell->get_dof_indices(cell_dofs);
          const auto  &x = points.on(cell);
          const auto  &w = weights.on(cell);
          const double tolerance = at_nodes ? 0 : 1e-8 * cell->diameter();
          for (unsigned q = 0; q < rule.size(); ++q)
          {
            row.clear();
            for (const auto &[k, value] : shapes[q])
            {
              row.dofs.push_back(cell_dofs[k]);
              row.values.push_back(value);
            }
            add_row(x[q], w[q], tolerance, inside[q]);
          }
        }
      }

      /// A point of an elastic body's surface.
      void add(const ContactPoint<dim> &point, ConstraintBlock &block)
      {
        const std::optional<double> gap = point.faces_away ? std::nullopt : gap_at(point);
        if (!gap && !condition.direction.empty() && point.faces_away)
        {
          ++n_turned_away; // the user knows which points are meant
          return;
        }
        if (!gap)
        {
          block.n_missed += point.owned;
          if (point.owned)
            missed.push_back(point.x);
          return;
        }
        note_range(*gap);
        double value = 0;
        resolve(point.row, dirichlet, row, value);
        if (row.dofs.empty())
        {
          note_range(value);
          const bool hangs =
            std::all_of(point.row.dofs.begin(), point.row.dofs.end(), [&](const auto dof) { return hanging_nodes.is_constrained(dof); });
          if (value > *gap && !hangs)
            suspects.push_back({point.x, value, *gap});
          return;
        }
        if (point.at_node && is_fixed_but_for_the_mesh(point))
          return;
        set.points.push_back({point.x, point.weight, *gap, 1, point.owned});
        set.trace.push_back(point.row);
        set.directions.push_back(point.direction);
        set.at_nodes_only &= point.at_node && row.dofs.size() <= dim; // more at the edge of a rigid part
      }

      const std::vector<Point<dim>> &missed_points() const { return missed; }
      std::size_t                    turned_away() const { return n_turned_away; } ///< points that do not face the given direction

      /// The other points on the cuts between subdomains: nodes get the weights that they have on all processes together, and every process
      /// that has such a node has it as a point. All processes take part, whether they have points or not.
      /// @p begin: of the block.
      void complete_nodes_on_cuts(const SharedUnknowns &unknowns_on_cuts, const std::size_t begin)
      {
        if (unknowns_on_cuts.processes().alone())
          return;
        std::vector<std::pair<types::global_dof_index, PointOnCut>> shares;
        for (std::size_t i = begin; i < set.size(); ++i)
          if (set.trace[i].dofs.size() == 1 && unknowns_on_cuts.shares(set.trace[i].dofs[0]))
          {
            shares.push_back({set.trace[i].dofs[0], {{}, set.points[i].weight, set.trace[i].values[0]}});
            for (unsigned d = 0; d < dim; ++d)
              shares.back().second.x[d] = set.points[i].x[d];
            set.points[i].weight = 0;
          }
        unknowns_on_cuts.share(shares);
        for (const auto &[dof, share] : shares)
        {
          Point<dim> x;
          for (unsigned d = 0; d < dim; ++d)
            x[d] = share.x[d];
          const std::size_t index = shared.find_or_insert({dof}, x, 0, set.size());
          if (index == set.size())
          {
            set.points.push_back(new_point(x, 0));
            row = {};
            row.dofs = {dof};
            row.values = {share.value};
            set.trace.push_back(row);
          }
          set.points[index].weight += share.weight;
          set.points[index].owned = unknowns_on_cuts.owns(dof);
        }
      }

      /// From hanging nodes, whose points are to leave, to the nodes that decide what v is there. @p begin: of the block.
      void hand_over_weights(const std::size_t begin)
      {
        leaves.assign(set.size(), false);
        if (hanging_nodes.n_constraints() == 0)
          return;
        constexpr std::size_t    none = -1;
        std::vector<std::size_t> point_of(n_dofs, none);
        for (std::size_t i = begin; i < set.size(); ++i)
          if (set.trace[i].dofs.size() == 1)
            point_of[set.trace[i].dofs[0]] = i;
        for (std::size_t i = begin; i < set.size(); ++i)
        {
          const auto row = set.trace[i];
          if (row.dofs.size() != 1 || !hanging_nodes.is_constrained(row.dofs[0]))
            continue;
          const auto &neighbours = *hanging_nodes.get_constraint_entries(row.dofs[0]);
          leaves[i] = std::all_of(neighbours.begin(), neighbours.end(),
                                  [&](const auto &neighbour)
                                  { return point_of[neighbour.first] != none || dirichlet.is_constrained(neighbour.first); });
          set.at_nodes_only &= leaves[i];
          for (const auto &[dof, share] : neighbours)
            if (leaves[i] && point_of[dof] != none)
              set.points[point_of[dof]].weight += share * set.points[i].weight;
        }
      }

      /// After hand_over_weights() and complete_nodes_on_cuts(). Returns what is wrong with the rule then, or "".
      std::string remove_hanging_nodes(const std::size_t begin)
      {
        if (hanging_nodes.n_constraints() == 0)
          return "";
        leaves.resize(set.size(), false);
        set.remove(leaves);
        for (std::size_t i = begin; i < set.size(); ++i)
          if (set.points[i].weight <= 0)
            return fmt::format("the rule {} has no positive weight at {}, next to hanging nodes; take gauss(n)", condition.rule.name(),
                               point_text(set.points[i].x));
        return "";
      }

      /// Where the Dirichlet data violate the bound by more than round-off: that of the data, which is small against their range
      /// over all points, and that of the coordinates, which a steep bound magnifies. "": nowhere.
      std::string violation_at_fixed_points() const
      {
        const double      round_off = 1e-9 * (largest - smallest) + 1e-14 * std::max(std::abs(smallest), std::abs(largest));
        const FixedPoint *worst = nullptr;
        for (const FixedPoint &point : suspects)
          if (violation(point) > round_off && (!worst || violation(point) > violation(*worst)) &&
              violation(point) > round_off + change_nearby(point))
            worst = &point;
        if (!worst)
          return "";
        return set.directions.empty() && !condition.surface
                 ? fmt::format("the boundary value {:.6g} at {} violates the {} obstacle {:.6g} there: no function satisfies both",
                               worst->value, point_text(worst->x), condition.side == Side::upper ? "upper" : "lower", worst->bound)
                 : fmt::format("the displacement that [boundary] prescribes at {} moves the body by {:.6g} towards the obstacle, "
                               "where the gap is {:.6g}: no displacement satisfies both",
                               point_text(worst->x), worst->value, worst->bound);
      }

    private:
      /// A share of the weight of a node.
      struct PointOnCut
      {
        std::array<double, dim> x;
        double                  weight, value;
      };

      /// A point with its weight; its trace is `row`. It may be one that another cell has brought, unless it lies @p inside its cell.
      void add_row(const Point<dim> &x, const double weight, const double tolerance, const bool inside = false)
      {
        for (unsigned d = 0; d < dim; ++d)
          extent = std::max(extent, std::abs(x[d]));
        if (std::all_of(row.dofs.begin(), row.dofs.end(), [&](const auto dof) { return is_fixed(dof); }))
        {
          // At a node the data are compared as given; elsewhere their interpolant could overshoot a bound that they respect.
          // A hanging node that depends on fixed ones is no point: what it has is interpolated.
          if (row.dofs.size() == 1 && !hanging_nodes.is_constrained(row.dofs[0]))
            note_fixed_point(x);
          return;
        }
        const std::size_t index = inside ? set.size() : shared.find_or_insert(row.dofs, x, tolerance, set.size());
        if (index < set.size())
        {
          set.points[index].weight += weight;
          return;
        }
        set.points.push_back(new_point(x, weight));
        set.trace.push_back(row);
        set.at_nodes_only &= row.dofs.size() == 1;
        note_range(set.points.back().bound);
      }

      ConstraintPoint<dim> new_point(const Point<dim> &x, const double weight) const
      {
        return {x, weight, condition.bound.value(x), static_cast<signed char>(condition.side == Side::upper ? 1 : -1), true};
      }

      /// Not by other unknowns, as at hanging nodes and on periodic parts.
      bool is_fixed(const types::global_dof_index dof) const
      {
        return dirichlet.is_constrained(dof) && dirichlet.get_constraint_entries(dof)->empty();
      }

      /// A point where Dirichlet data fix u.
      struct FixedPoint
      {
        Point<dim> x;
        double     value, bound;
      };

      /// What [boundary] leaves free at the node is nearly orthogonal to the direction of contact, as far as the mesh knows that: along the
      /// surface. A curved part has such nodes where its rim is held across, u_x = 0 at the ends of a half ring; the normal of their faces,
      /// half a face's turn off, would make a wedge of them that bears any load.
      bool is_fixed_but_for_the_mesh(const ContactPoint<dim> &point) const
      {
        constexpr double factor = 3, largest = 0.5; // the error of the direction is itself known to its size only
        double           square = 0;
        for (const double value : row.values) // of `point.row`, resolved
          square += value * value;
        return std::sqrt(square) <= std::min(factor * point.direction_error, largest);
      }

      std::optional<double> gap_at(const ContactPoint<dim> &point) const
      {
        if (!condition.surface)
          return condition.bound.value(point.x);
        std::array<double, 3> x{}, direction{};
        for (unsigned d = 0; d < dim; ++d)
        {
          x[d] = point.x[d];
          direction[d] = point.direction[d];
        }
        return condition.surface->distance(x, direction);
      }

      double violation(const FixedPoint &point) const
      {
        return condition.side == Side::upper ? point.value - point.bound : point.bound - point.value;
      }

      void note_range(const double value)
      {
        smallest = std::min(smallest, value);
        largest = std::max(largest, value);
      }

      void note_fixed_point(const Point<dim> &x)
      {
        double value = 0;
        for (std::size_t k = 0; k < row.dofs.size(); ++k)
          value += row.values[k] * dirichlet.get_inhomogeneity(row.dofs[k]);
        const FixedPoint point{x, value, condition.bound.value(x)};
        note_range(point.value);
        note_range(point.bound);
        if (violation(point) > 0)
          suspects.push_back(point);
      }

      /// How much the bound changes when coordinates move by what they are known to: nodes on a curved boundary lie a few last digits off.
      /// A jump at the point, which moves closer do not make smaller, is none of their doing.
      double change_nearby(const FixedPoint &point) const
      {
        if (condition.surface)
          return 0;
        double     largest_change = 0;
        const auto change = [&](const unsigned d, const double move)
        {
          Point<dim> x = point.x;
          x[d] += move;
          return std::abs(condition.bound.value(x) - point.bound);
        };
        for (unsigned d = 0; d < dim; ++d)
          for (const double move : {-1e-13 * extent, 1e-13 * extent})
            try
            {
              if (const double far = change(d, move); change(d, 0.01 * move) <= 0.5 * far)
                largest_change = std::max(largest_change, far);
            }
            catch (const InputError &)
            {
            } // the bound ends here
        return largest_change;
      }

      ConstraintSet<dim>              &set;
      const UnilateralCondition       &condition;
      const AffineConstraints<double> &dirichlet, &hanging_nodes;
      const std::size_t                n_dofs;
      SharedPoints<dim>                shared;
      TraceRow                         row;
      std::vector<bool>                is_value; ///< Hermite elements: which unknowns of a cell are no derivatives
      std::vector<bool>                leaves;   ///< by point: its weight has been handed over
      double                           smallest = std::numeric_limits<double>::max(), largest = std::numeric_limits<double>::lowest();
      double                           extent = 0; ///< of the coordinates
      std::vector<Point<dim>>          missed;     ///< contact points that never meet the surface
      std::size_t                      n_turned_away = 0;
      std::vector<FixedPoint>          suspects; ///< those that violate the bound, by round-off or truly
    };

    /// What one process or more find wrong, the same on all of them; "": nothing.
    std::string mistake_of_all(const Processes &processes, const std::string &own)
    {
      if (!processes.any(!own.empty()))
        return "";
      std::vector<char> text(own.begin(), own.end());
      if (!text.empty())
        text.push_back('\0');
      const std::vector<char> of_all = processes.gather(text);
      return of_all.data(); // that of the first
    }

    bool lies_above(const double lower, const double upper)
    {
      return lower > upper + 1e-12 * (std::abs(lower) + std::abs(upper));
    }

    /// Bounds of different conditions that meet at a node, as those of a part and of the domain do.
    template <int dim>
    void check_crossing_at_nodes(const ConstraintSet<dim>               &set,
                                 const std::vector<UnilateralCondition> &conditions,
                                 const std::size_t                       n_dofs,
                                 const Processes                        &processes)
    {
      if (!set.directions.empty() || conditions.size() < 2)
        return;
      constexpr std::size_t    none = std::numeric_limits<std::size_t>::max();
      std::vector<std::size_t> highest(n_dofs, none); // by unknown: the point with the highest lower bound
      const auto               for_points = [&](const Side side, const auto &act)
      {
        for (std::size_t b = 0; b < set.blocks.size(); ++b)
          for (std::size_t i = set.blocks[b].begin; i < set.blocks[b].end && set.blocks[b].side == side; ++i)
            if (const auto row = set.trace[i]; row.dofs.size() == 1 && row.values[0] == 1)
              act(b, i, highest[row.dofs[0]]);
      };
      for_points(Side::lower,
                 [&](const std::size_t, const std::size_t i, std::size_t &at_node)
                 {
                   if (at_node == none || set.points[i].bound > set.points[at_node].bound)
                     at_node = i;
                 });
      std::string              own;
      std::vector<std::size_t> block; // of it
      for_points(Side::upper,
                 [&](const std::size_t b, const std::size_t i, const std::size_t at_node)
                 {
                   if (!own.empty() || at_node == none || !lies_above(set.points[at_node].bound, set.points[i].bound))
                     return;
                   own = fmt::format("this upper obstacle is {:.6g} at {}, below a lower one, which is {:.6g} there", set.points[i].bound,
                                     point_text(set.points[i].x), set.points[at_node].bound);
                   block = {b};
                 });
      if (const std::string mistake = mistake_of_all(processes, own); !mistake.empty())
        throw InputError(conditions[processes.gather(block).front()].where, mistake, MessageName("bounds-cross"));
    }

    /// A lower bound above an upper one at the same point leaves K_h empty.
    template <int dim>
    void check_crossing(const ConstraintSet<dim> &set, const std::vector<UnilateralCondition> &conditions, const Processes &processes)
    {
      for (std::size_t a = 0; a + 1 < conditions.size(); ++a)
      {
        const auto &low = set.blocks[a], &up = set.blocks[a + 1];
        if (low.side != Side::lower || up.side != Side::upper || low.on != up.on || low.rule.name() != up.rule.name())
          continue;
        std::string own;
        for (std::size_t i = 0; i < low.end - low.begin && own.empty(); ++i)
        {
          const double lower = set.points[low.begin + i].bound, upper = set.points[up.begin + i].bound;
          if (lies_above(lower, upper))
            own = fmt::format("the lower obstacle {:.6g} lies above the upper one {:.6g} at {}", lower, upper,
                              point_text(set.points[low.begin + i].x));
        }
        if (const std::string mistake = mistake_of_all(processes, own); !mistake.empty())
          throw InputError(conditions[a].where, mistake, MessageName("bounds-cross"));
      }
    }
  } // namespace

  template <int dim>
  void ConstraintSet<dim>::remove(const std::vector<bool> &leaves)
  {
    std::size_t n = 0;
    TraceRows   rows;
    for (std::size_t i = 0; i < size(); ++i)
      if (!leaves[i])
      {
        if (!directions.empty())
          directions[n] = directions[i];
        points[n++] = points[i];
        rows.push_back(trace[i]);
      }
    trace = std::move(rows);
    points.resize(n);
    if (!directions.empty())
      directions.resize(n);
  }

  template <int dim>
  ConstraintSet<dim> make_constraint_set(const std::vector<UnilateralCondition> &conditions,
                                         const ElementName                      &element,
                                         const Mapping<dim>                     &mapping,
                                         const DoFHandler<dim>                  &dof_handler,
                                         const AffineConstraints<double>        &dirichlet,
                                         const AffineConstraints<double>        &hanging_nodes,
                                         const BilinearForm<dim>                &form,
                                         const SharedUnknowns                   &shared)
  {
    const auto                          &fe = dof_handler.get_fe();
    const Processes                     &processes = shared.processes();
    ConstraintSet<dim>                   set;
    std::vector<types::global_dof_index> cell_dofs(fe.n_dofs_per_cell());
    for (const auto &condition : conditions)
    {
      ConstraintBlock block;
      block.on = condition.part ? condition.on : "domain";
      block.side = condition.side;
      block.rule = condition.rule;
      block.begin = set.size();
      BlockBuilder<dim> builder(set, condition, element, dof_handler, dirichlet, hanging_nodes);
      if (condition.part && form.n_components() > 1)
      {
        block.exact_pairing = exact_pairing<dim - 1>(condition.rule, element);
        const std::optional<Tensor<1, dim>> direction = direction_of_contact<dim>(condition.direction, condition.surface.get());
        for (const auto &point : contact_points(*condition.part, condition.rule, direction, condition.round, element, mapping, dof_handler,
                                                hanging_nodes, form, shared))
          builder.add(point, block);
        if (!processes.any(set.size() > block.begin) && processes.any(builder.turned_away() > 0) && !processes.any(block.n_missed > 0))
          throw InputError(condition.where,
                           fmt::format("no face of '{}' faces the given direction [{}]: contact stops motion along it; turn it round, "
                                       "or take the part that faces it",
                                       condition.on, fmt::join(condition.direction, ", ")),
                           MessageName("nothing-meets-obstacle"));
        if (!processes.any(set.size() > block.begin) && processes.any(block.n_missed > 0))
          throw InputError(condition.where,
                           fmt::format("no point of '{}' meets the obstacle along {}: check where the obstacle lies and "
                                       "which way its surface faces",
                                       condition.on,
                                       !condition.direction.empty() ? "the given direction"
                                       : direction                  ? "the normal of the plane"
                                                                    : "its outward normal"),
                           MessageName("nothing-meets-obstacle"));
      }
      else if (!condition.part)
      {
        block.exact_pairing = exact_pairing<dim>(condition.rule, element);
        const Quadrature<dim> rule = quadrature_rule<dim>(condition.rule, element);
        if (element.family == ElementName::Family::hermite) // whose shape functions scale with the cell
        {
          FEValues<dim> values(mapping, fe, rule, update_values | update_quadrature_points | update_JxW_values);
          for (const auto &cell : dof_handler.active_cell_iterators())
          {
            values.reinit(cell);
            cell->get_dof_indices(cell_dofs);
            builder.add(values, cell_dofs, cell->diameter());
          }
        }
        else
          builder.add_cells(mapping, dof_handler, rule);
        builder.hand_over_weights(block.begin);
        builder.complete_nodes_on_cuts(shared, block.begin);
        if (const std::string mistake = mistake_of_all(processes, builder.remove_hanging_nodes(block.begin)); !mistake.empty())
          throw InputError(condition.where, mistake, MessageName("rule-does-not-fit"));
      }
      else
      {
        block.exact_pairing = exact_pairing<dim - 1>(condition.rule, element);
        FEFaceValues<dim> values(mapping, fe, quadrature_rule<dim - 1>(condition.rule, element),
                                 update_values | update_quadrature_points | update_JxW_values);
        for (const auto &cell : dof_handler.active_cell_iterators())
          for (const auto face : cell->face_indices())
            if (cell->at_boundary(face) && cell->face(face)->boundary_id() == *condition.part)
            {
              values.reinit(cell, face);
              cell->get_dof_indices(cell_dofs);
              builder.add(values, cell_dofs, cell->diameter());
            }
        builder.hand_over_weights(block.begin);
        builder.complete_nodes_on_cuts(shared, block.begin);
        if (const std::string mistake = mistake_of_all(processes, builder.remove_hanging_nodes(block.begin)); !mistake.empty())
          throw InputError(condition.where, mistake, MessageName("rule-does-not-fit"));
      }
      if (const std::string mistake = mistake_of_all(processes, builder.violation_at_fixed_points()); !mistake.empty())
        throw InputError(condition.where, mistake, MessageName("data-violates-bound"));
      block.end = set.size();
      set.blocks.push_back(block);
      set.missed.push_back(builder.missed_points());
    }
    check_crossing(set, conditions, processes);
    check_crossing_at_nodes(set, conditions, dof_handler.n_dofs(), processes);
    set.at_nodes_only = !processes.any(!set.at_nodes_only);
    return set;
  }

#define INSTANTIATE(dim)                                                                                                                   \
  template struct ConstraintSet<dim>;                                                                                                      \
  template ConstraintSet<dim> make_constraint_set(const std::vector<UnilateralCondition> &, const ElementName &, const Mapping<dim> &,     \
                                                  const DoFHandler<dim> &, const AffineConstraints<double> &,                              \
                                                  const AffineConstraints<double> &, const BilinearForm<dim> &, const SharedUnknowns &);
  INSTANTIATE(1)
  INSTANTIATE(2)
  INSTANTIATE(3)
#undef INSTANTIATE
} // namespace unilateral
