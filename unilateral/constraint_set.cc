#include "unilateral/constraint_set.h"

#include <deal.II/fe/fe_values.h>

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <unordered_map>

namespace unilateral
{
  using namespace dealii;

  namespace
  {
    /// Shape values below this are round-off: a node of the element sees one shape function only.
    constexpr double negligible_shape_value = 1e-11;

    template <int dim>
    std::string to_text(const Point<dim> &p)
    {
      std::string text = "(";
      for (unsigned d = 0; d < dim; ++d)
        text += fmt::format("{}{:.6g}", d ? ", " : "", p[d]);
      return text + ")";
    }

    /// Finds points that cells share. Two points are one when the same shape functions live there and they coincide in space: that
    /// holds for every continuous element, and keeps apart the two sides of a slit.
    template <int dim>
    class SharedPoints
    {
    public:
      explicit SharedPoints(std::size_t n_dofs) : by_single_dof(n_dofs, none) {}

      static constexpr std::size_t none = static_cast<std::size_t>(-1);

      /// Index of the point known under (@p dofs, @p x), or registers @p fresh there and returns it.
      std::size_t
      find_or_insert(const std::vector<types::global_dof_index> &dofs, const Point<dim> &x, const double tolerance, const std::size_t fresh)
      {
        if (dofs.size() == 1)
        {
          std::size_t &index = by_single_dof[dofs[0]];
          return index == none ? (index = fresh) : index;
        }
        auto sorted = dofs;
        std::sort(sorted.begin(), sorted.end());
        auto &bucket = by_dofs[sorted];
        for (const auto &[y, index] : bucket)
          if (x.distance(y) < tolerance)
            return index;
        bucket.emplace_back(x, fresh);
        return fresh;
      }

    private:
      struct Hash
      {
        std::size_t operator()(const std::vector<types::global_dof_index> &dofs) const
        {
          std::size_t hash = 1469598103934665603ull;
          for (const auto dof : dofs)
            hash = (hash ^ dof) * 1099511628211ull;
          return hash;
        }
      };
      std::vector<std::size_t>                                                                                        by_single_dof;
      std::unordered_map<std::vector<types::global_dof_index>, std::vector<std::pair<Point<dim>, std::size_t>>, Hash> by_dofs;
    };

    /// Collects the points of one condition.
    template <int dim>
    class BlockBuilder
    {
    public:
      BlockBuilder(ConstraintSet<dim>              &set,
                   const UnilateralCondition       &condition,
                   const DoFHandler<dim>           &dof_handler,
                   const AffineConstraints<double> &dirichlet)
        : set(set), condition(condition), dirichlet(dirichlet), shared(dof_handler.n_dofs())
      {
      }

      /// The points of the rule on a cell or face, @p values evaluated there.
      void add(const FEValuesBase<dim> &values, const std::vector<types::global_dof_index> &cell_dofs, const double diameter)
      {
        for (const unsigned q : values.quadrature_point_indices())
        {
          row.dofs.clear();
          row.values.clear();
          for (unsigned k = 0; k < cell_dofs.size(); ++k)
            if (const double value = values.shape_value(k, q); std::abs(value) > negligible_shape_value)
            {
              row.dofs.push_back(cell_dofs[k]);
              row.values.push_back(value);
            }
          const Point<dim> &x = values.quadrature_point(q);
          for (unsigned d = 0; d < dim; ++d)
            extent = std::max(extent, std::abs(x[d]));
          if (std::all_of(row.dofs.begin(), row.dofs.end(), [&](const auto dof) { return dirichlet.is_constrained(dof); }))
          {
            // At a node the data are compared as given; elsewhere their interpolant could overshoot a bound that they respect.
            if (row.dofs.size() == 1)
              note_fixed_point(x);
            continue;
          }
          const std::size_t index = shared.find_or_insert(row.dofs, x, 1e-8 * diameter, set.size());
          if (index < set.size())
          {
            set.weights[index] += values.JxW(q);
            continue;
          }
          set.points.push_back(x);
          set.weights.push_back(values.JxW(q));
          set.trace.push_back(row);
          set.bound.push_back(condition.bound.value(x));
          note_range(set.bound.back());
          set.sign.push_back(condition.side == Side::upper ? 1 : -1);
        }
      }

      /// Throws where the Dirichlet data violate the bound by more than round-off: that of the data, which is small against their range
      /// over all points, and that of the coordinates, which a steep bound magnifies.
      void check_fixed_points() const
      {
        const double      round_off = 1e-9 * (largest - smallest) + 1e-14 * std::max(std::abs(smallest), std::abs(largest));
        const FixedPoint *worst = nullptr;
        for (const FixedPoint &point : suspects)
          if (violation(point) > round_off && (!worst || violation(point) > violation(*worst)) &&
              violation(point) > round_off + change_nearby(point))
            worst = &point;
        if (worst)
          throw InputError(condition.where,
                           fmt::format("the boundary value {:.6g} at {} violates the {} obstacle {:.6g} there: no function satisfies both",
                                       worst->value, to_text(worst->x), condition.side == Side::upper ? "upper" : "lower", worst->bound));
      }

    private:
      /// A point where Dirichlet data fix u.
      struct FixedPoint
      {
        Point<dim> x;
        double     value, bound;
      };

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
      const AffineConstraints<double> &dirichlet;
      SharedPoints<dim>                shared;
      TraceRow                         row;
      double                           smallest = std::numeric_limits<double>::max(), largest = std::numeric_limits<double>::lowest();
      double                           extent = 0; ///< of the coordinates
      std::vector<FixedPoint>          suspects;   ///< those that violate the bound, by round-off or truly
    };

    /// A lower bound above an upper one at the same point leaves K_h empty.
    template <int dim>
    void check_crossing(const ConstraintSet<dim> &set, const std::vector<UnilateralCondition> &conditions)
    {
      for (std::size_t a = 0; a + 1 < conditions.size(); ++a)
      {
        const auto &low = set.blocks[a], &up = set.blocks[a + 1];
        if (low.side != Side::lower || up.side != Side::upper || low.on != up.on || low.rule.name() != up.rule.name())
          continue;
        for (std::size_t i = 0; i < low.end - low.begin; ++i)
        {
          const double lower = set.bound[low.begin + i], upper = set.bound[up.begin + i];
          if (lower > upper + 1e-12 * (std::abs(lower) + std::abs(upper)))
            throw InputError(conditions[a].where, fmt::format("the lower obstacle {:.6g} lies above the upper one {:.6g} at {}", lower,
                                                              upper, to_text(set.points[low.begin + i])));
        }
      }
    }
  } // namespace

  template <int dim>
  bool ConstraintSet<dim>::at_nodes() const
  {
    return std::all_of(trace.begin(), trace.end(), [](const TraceRow &row) { return row.dofs.size() == 1; });
  }

  template <int dim>
  ConstraintSet<dim> make_constraint_set(const std::vector<UnilateralCondition> &conditions,
                                         const ElementSpec                      &element,
                                         const Mapping<dim>                     &mapping,
                                         const DoFHandler<dim>                  &dof_handler,
                                         const AffineConstraints<double>        &dirichlet)
  {
    const auto                          &fe = dof_handler.get_fe();
    ConstraintSet<dim>                   set;
    std::vector<types::global_dof_index> cell_dofs(fe.n_dofs_per_cell());
    for (const auto &condition : conditions)
    {
      ConstraintBlock block;
      block.on = condition.part ? condition.on : "domain";
      block.side = condition.side;
      block.rule = condition.rule;
      block.begin = set.size();
      BlockBuilder<dim> builder(set, condition, dof_handler, dirichlet);
      if (!condition.part)
      {
        block.exact_pairing = exact_pairing<dim>(condition.rule, element);
        FEValues<dim> values(mapping, fe, quadrature_rule<dim>(condition.rule, element),
                             update_values | update_quadrature_points | update_JxW_values);
        for (const auto &cell : dof_handler.active_cell_iterators())
        {
          values.reinit(cell);
          cell->get_dof_indices(cell_dofs);
          builder.add(values, cell_dofs, cell->diameter());
        }
      }
      else
      {
        block.exact_pairing = exact_pairing<dim - 1>(condition.rule, element);
        FEFaceValues<dim> values(mapping, fe, quadrature_rule<dim - 1>(condition.rule, element),
                                 update_values | update_quadrature_points | update_JxW_values);
        for (const auto &cell : dof_handler.active_cell_iterators())
          for (const auto face : cell->face_indices())
            if (cell->face(face)->at_boundary() && cell->face(face)->boundary_id() == *condition.part)
            {
              values.reinit(cell, face);
              cell->get_dof_indices(cell_dofs);
              builder.add(values, cell_dofs, cell->diameter());
            }
      }
      builder.check_fixed_points();
      block.end = set.size();
      set.blocks.push_back(block);
    }
    check_crossing(set, conditions);
    return set;
  }

#define INSTANTIATE(dim)                                                                                                                   \
  template struct ConstraintSet<dim>;                                                                                                      \
  template ConstraintSet<dim> make_constraint_set(const std::vector<UnilateralCondition> &, const ElementSpec &, const Mapping<dim> &,     \
                                                  const DoFHandler<dim> &, const AffineConstraints<double> &);
  INSTANTIATE(1)
  INSTANTIATE(2)
  INSTANTIATE(3)
#undef INSTANTIATE
} // namespace unilateral
