#include "unilateral/evaluation/contact_between_nodes.h"

#include "unilateral/discretisation/points_by_cell.h"

#include <algorithm>
#include <cmath>

namespace unilateral
{
  namespace
  {
    /// The points of a block in contact, and their forces.
    template <int dim>
    struct ForcesAtNodes
    {
      const ConstraintSet<dim> &set;
      const Vector             &lambda;

      bool   is_active(const std::size_t i) const { return i < set.size() && lambda(i) > 0; }
      double force(const std::size_t i) const { return lambda(i) * set.points[i].weight; }
    };

    /// Of beams: h^2 (F_1 F_2)^2/(F_1 + F_2)^2 h/3 at the ends of contact.
    template <int dim>
    void add_ends_of_contact(const std::vector<RuleOnCell<dim>> &rules, const ForcesAtNodes<dim> &at, std::vector<double> &squares)
    {
      // By point: ends of cells without contact on the other side, and the force at the other ends of all of its cells.
      std::vector<unsigned> n_free_beside(at.set.size() + 1, 0);
      std::vector<double>   force_beside(at.set.size() + 1, 0.);
      for (const auto &rule : rules)
        if (rule.points.size() == 2)
          for (const unsigned end : {0u, 1u})
          {
            const std::size_t other = rule.points[1 - end];
            n_free_beside[rule.points[end]] += !at.is_active(other);
            force_beside[rule.points[end]] += at.is_active(other) ? at.force(other) : 0;
          }
      for (const auto &rule : rules)
      {
        if (rule.points.size() != 2 || !at.is_active(rule.points[0]) || !at.is_active(rule.points[1]) ||
            n_free_beside[rule.points[0]] + n_free_beside[rule.points[1]] == 0)
          continue;
        // Inside contact a node bears what the next one does, too, which is distributed.
        const auto concentrated = [&](const unsigned end)
        {
          const std::size_t i = rule.points[end];
          const double      next = n_free_beside[i] > 0 ? 0 : force_beside[i] - at.force(rule.points[1 - end]);
          return at.force(i) - next;
        };
        // A negative one bends the beam back where the edge of contact lies outside of the nodes in contact.
        const double a = concentrated(0), b = concentrated(1), h = rule.cell->diameter(), least = std::min(a, b);
        if (a + b > 0)
          squares[rule.cell->active_cell_index()] += std::pow(h * (least > 0 ? a * b / (a + b) : least), 2) * h / 3;
      }
    }

    /// Of plates: F^2 h^2/90 in cells where contact ends, F their share of the forces at their points in contact.
    template <int dim>
    void add_edges_of_contact(const Problem<dim>                 &problem,
                              const std::vector<RuleOnCell<dim>> &rules,
                              const ForcesAtNodes<dim>           &at,
                              std::vector<double>                &squares)
    {
      const auto ends_in = [&](const RuleOnCell<dim> &rule)
      {
        const auto n = std::count_if(rule.points.begin(), rule.points.end(), [&](const std::size_t i) { return at.is_active(i); });
        return n > 0 && n < std::ptrdiff_t(rule.points.size());
      };
      std::vector<double> n_cells(at.set.size(), 0.); // by point: those where contact ends
      for (const auto &rule : rules)
        if (ends_in(rule))
          for (const std::size_t i : rule.points)
            if (at.is_active(i))
              n_cells[i] += 1;
      add_at_cuts(problem, at.set, n_cells);
      for (const auto &rule : rules)
      {
        if (!ends_in(rule))
          continue;
        double force = 0;
        for (const std::size_t i : rule.points)
          if (at.is_active(i))
            force += at.force(i) / n_cells[i];
        squares[rule.cell->active_cell_index()] += force * force * rule.cell->measure() / 90;
      }
    }
  } // namespace

  template <int dim>
  double add_contact_between_nodes(const Problem<dim>       &problem,
                                   const ConstraintSet<dim> &constraint_set,
                                   const Vector             &lambda,
                                   std::vector<double>      &cell_squares)
  {
    if (dim == 3 || problem.form->order() < 2 || !constraint_set.at_nodes())
      return 0;
    std::vector<double>      squares(cell_squares.size(), 0.); // for a rigidity of 1
    const ForcesAtNodes<dim> at{constraint_set, lambda};
    for (std::size_t b = 0; b < constraint_set.blocks.size(); ++b)
    {
      const auto rules = rule_on_cells(problem, constraint_set, b);
      dim == 1 ? add_ends_of_contact(rules, at, squares) : add_edges_of_contact(problem, rules, at, squares);
    }
    double total = 0;
    Flux   unit{};
    unit[0] = 1;
    for (const auto &cell : problem.space.dof_handler.active_cell_iterators())
      if (double &square = squares[cell->active_cell_index()]; square > 0)
      {
        square *= problem.form->flux_energy(unit, cell->material_id(), cell->center());
        cell_squares[cell->active_cell_index()] += square;
        total += square;
      }
    return std::sqrt(problem.space.processes().sum(total));
  }

#define INSTANTIATE(dim)                                                                                                                   \
  template double add_contact_between_nodes(const Problem<dim> &, const ConstraintSet<dim> &, const Vector &, std::vector<double> &);
  INSTANTIATE(1)
  INSTANTIATE(2)
  INSTANTIATE(3)
#undef INSTANTIATE
} // namespace unilateral
