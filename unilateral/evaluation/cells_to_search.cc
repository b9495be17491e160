#include "unilateral/evaluation/cells_to_search.h"

#include "unilateral/evaluation/value_search.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <span>

namespace unilateral
{
  using namespace dealii;

  namespace
  {
    constexpr std::size_t most_cells_of_block = 1024;

    /// max_x sum_j |phi_j(x)|, as far as a lattice of points shows it. Of tensor products it is a power of that on a line.
    template <int dim>
    double lebesgue_constant(const FiniteElement<dim> &element)
    {
      if (element.degree == 1)
        return 1;
      constexpr unsigned n = 16;
      constexpr double   between_points = 1.05;
      const bool         on_line = dim == 1 || !element.reference_cell().is_simplex();
      double             largest = 1;
      for (unsigned k = 0; k < std::pow(n + 1, on_line ? 1 : dim); ++k)
      {
        Point<dim> x;
        double     sum_of_x = 0;
        for (unsigned d = 0, rest = k; d < dim; ++d, rest /= n + 1)
        {
          x[d] = double(rest % (n + 1)) / n;
          sum_of_x += x[d];
        }
        if (sum_of_x > 1)
          continue;
        double sum = 0;
        for (unsigned j = 0; j < element.n_dofs_per_cell(); ++j)
          sum += std::abs(element.shape_value(j, x));
        largest = std::max(largest, sum);
      }
      return std::pow(between_points * largest, on_line ? dim : 1);
    }

    template <int dim>
    class BlocksOfCells
    {
    public:
      using Cell = typename DoFHandler<dim>::active_cell_iterator;

      BlocksOfCells(const Problem<dim> &problem, const FieldFunction &s, const Side side, const Vector &u, const double tolerance)
        : problem(problem), s(s), side(side), u(u), tolerance(tolerance), element(*problem.space.fe), lebesgue(lebesgue_constant(element)),
          dofs(element.n_dofs_per_cell())
      {
      }

      std::vector<Cell> not_ruled_out()
      {
        const auto cells = problem.space.dof_handler.active_cell_iterators();
        for (auto cell = cells.begin(); cell != cells.end();)
        {
          block.clear();
          for (; block.size() < most_cells_of_block && cell != cells.end(); ++cell)
            block.push_back(describe(*cell));
          look_at({block.data(), block.size()});
        }
        return std::move(left);
      }

    private:
      struct InBlock
      {
        Cell                    cell;
        std::array<Interval, 3> box{};
        Interval                u; ///< at its nodes
        bool                    has_D = false;
        Interval                D; ///< likewise; empty: s has not a value at each of them
      };

      InBlock describe(const Cell &cell)
      {
        InBlock in_block;
        in_block.cell = cell;
        for (unsigned d = 0; d < dim; ++d)
        {
          in_block.box[d] = Interval::of(cell->vertex(0)[d]);
          for (const unsigned v : cell->vertex_indices())
            in_block.box[d] = hull(in_block.box[d], Interval::of(cell->vertex(v)[d]));
        }
        cell->get_dof_indices(dofs);
        in_block.u = Interval::of(u(dofs[0]));
        for (const auto dof : dofs)
          in_block.u = hull(in_block.u, Interval::of(u(dof)));
        return in_block;
      }

      /// Of the polynomials on a cell that are between these values at the nodes.
      Interval between_nodes(const Interval &at_nodes) const
      {
        const double slack = (lebesgue - 1) / 2 * (at_nodes.most - at_nodes.least);
        return {at_nodes.least - slack, at_nodes.most + slack};
      }

      void find_D(InBlock &in_block)
      {
        in_block.has_D = true;
        in_block.D = Interval::none();
        const Cell &cell = in_block.cell;
        cell->get_dof_indices(dofs);
        const auto &nodes = element.get_unit_support_points();
        for (unsigned i = 0; i < dofs.size(); ++i)
        {
          const auto value = value_if_any(s, straight_place(cell, nodes[i]));
          if (!value)
          {
            in_block.D = Interval::none();
            return;
          }
          in_block.D = hull(in_block.D, Interval::of(side == Side::lower ? *value - u(dofs[i]) : u(dofs[i]) - *value));
        }
      }

      /// By their values alone.
      bool is_away(const Interval &range, const Interval &of_u) const
      {
        return range.empty() || (side == Side::lower ? range.most - of_u.least : of_u.most - range.least) <= tolerance;
      }

      void look_at(const std::span<InBlock> cells)
      {
        auto     box = cells.front().box;
        Interval of_u = Interval::none();
        for (const InBlock &in_block : cells)
        {
          of_u = hull(of_u, between_nodes(in_block.u));
          for (unsigned d = 0; d < dim; ++d)
            box[d] = hull(box[d], in_block.box[d]);
        }
        const auto set = s.range_and_slopes(box).value();
        if (is_away(set.value, of_u))
          return;
        // Across a gap between points where s has a value its slopes say nothing.
        if (!set.value.undefined &&
            std::all_of(cells.begin(), cells.end(), [&](InBlock &in_block) { return is_ruled_out(in_block, set.slopes); }))
          return;
        if (cells.size() == 1)
        {
          left.push_back(cells.front().cell);
          return;
        }
        look_at(cells.first(cells.size() / 2));
        look_at(cells.last(cells.size() - cells.size() / 2));
      }

      bool is_ruled_out(InBlock &in_block, const std::array<Interval, 3> &slopes)
      {
        double missed = 0;
        for (unsigned d = 0; d < dim; ++d)
          missed += (slopes[d].most - slopes[d].least) / 2 * (in_block.box[d].most - in_block.box[d].least);
        missed *= lebesgue;
        if (!(missed <= tolerance)) // also where s jumps
          return false;
        if (!in_block.has_D)
          find_D(in_block);
        return !in_block.D.empty() && between_nodes(in_block.D).most + missed <= tolerance;
      }

      const Problem<dim>                  &problem;
      const FieldFunction                 &s;
      const Side                           side;
      const Vector                        &u;
      const double                         tolerance;
      const FiniteElement<dim>            &element;
      const double                         lebesgue;
      std::vector<types::global_dof_index> dofs;
      std::vector<InBlock>                 block;
      std::vector<Cell>                    left;
    };
  } // namespace

  template <int dim>
  std::vector<typename DoFHandler<dim>::active_cell_iterator>
  cells_to_search(const Problem<dim> &problem, const FieldFunction &s, const Side side, const Vector &u, const double tolerance)
  {
    if (!problem.space.hermite() && !problem.space.mesh.curved && !problem.space.mesh.curved_cells)
      return BlocksOfCells<dim>(problem, s, side, u, tolerance).not_ruled_out();
    std::vector<typename DoFHandler<dim>::active_cell_iterator> all;
    for (const auto &cell : problem.space.dof_handler.active_cell_iterators())
      all.push_back(cell);
    return all;
  }

#define INSTANTIATE(dim)                                                                                                                   \
  template std::vector<typename DoFHandler<dim>::active_cell_iterator> cells_to_search(const Problem<dim> &, const FieldFunction &, Side,  \
                                                                                       const Vector &, double);
  INSTANTIATE(1)
  INSTANTIATE(2)
  INSTANTIATE(3)
#undef INSTANTIATE
} // namespace unilateral
