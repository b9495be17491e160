#include "unilateral/pairing.h"

#include "unilateral/discrete_problem.h"

#include <deal.II/base/quadrature_lib.h>
#include <deal.II/base/utilities.h>
#include <deal.II/fe/fe_values.h>
#include <deal.II/grid/cell_id.h>

#include <Eigen/Dense>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <map>

namespace unilateral
{
  using namespace dealii;

  template <int dim>
  FreeUnknowns::FreeUnknowns(const Problem<dim> &problem) : number(problem.dof_handler.n_dofs(), -1)
  {
    for (types::global_dof_index dof = 0; dof < number.size(); ++dof)
      if (!problem.dirichlet.is_constrained(dof))
        number[dof] = n_free++;
  }

  SparseMatrixd FreeUnknowns::restricted(const dealii::SparseMatrix<double> &matrix) const
  {
    std::vector<Eigen::Triplet<double>> entries;
    for (const auto &entry : matrix)
      if (number[entry.row()] >= 0 && number[entry.column()] >= 0)
        entries.emplace_back(number[entry.row()], number[entry.column()], entry.value());
    SparseMatrixd result(n_free, n_free);
    result.setFromTriplets(entries.begin(), entries.end());
    return result;
  }

  namespace
  {
    using Triplets = std::vector<Eigen::Triplet<double>>;

    SparseMatrixd to_matrix(const int n_rows, const int n_columns, const Triplets &entries)
    {
      SparseMatrixd matrix(n_rows, n_columns);
      matrix.setFromTriplets(entries.begin(), entries.end());
      return matrix;
    }

    template <int dim>
    Quadrature<dim> exact_quadrature(const ElementSpec &element, const unsigned degree)
    {
      if (element.simplex() && dim > 1)
        return QGaussSimplex<dim>(std::min(degree / 2 + 1, 4u));
      return QGauss<dim>(degree / 2 + 1);
    }

    template <int dim>
    SparseMatrixd gram_matrix(const Problem<dim> &problem, const FreeUnknowns &free)
    {
      const auto                          &fe = *problem.fe;
      FEValues<dim>                        values(*problem.mapping, fe, exact_quadrature<dim>(problem.element, 2 * fe.degree),
                                                  update_values | update_gradients | update_JxW_values);
      FullMatrix<double>                   cell_gram(fe.n_dofs_per_cell(), fe.n_dofs_per_cell());
      std::vector<types::global_dof_index> dofs(fe.n_dofs_per_cell());
      Triplets                             entries;
      for (const auto &cell : problem.dof_handler.active_cell_iterators())
      {
        values.reinit(cell);
        cell_gram = 0.;
        add_gram_terms(values, cell_gram);
        cell->get_dof_indices(dofs);
        for (unsigned i = 0; i < dofs.size(); ++i)
          for (unsigned j = 0; j < dofs.size(); ++j)
            if (free[dofs[i]] >= 0 && free[dofs[j]] >= 0)
              entries.emplace_back(free[dofs[i]], free[dofs[j]], cell_gram(i, j));
      }
      return to_matrix(free.n_free, free.n_free, entries);
    }

    /// Column of each point in the zone, -1 outside; the last entry stands for a point that was dropped.
    std::vector<int> number_columns(const std::vector<bool> &zone, int &n_columns)
    {
      std::vector<int> column(zone.size() + 1, -1);
      n_columns = 0;
      for (std::size_t i = 0; i < zone.size(); ++i)
        if (zone[i])
          column[i] = n_columns++;
      return column;
    }

    /// The polynomials on a cell or face that are 1 at one point of a rule and 0 at the others: Q_{n-1} for n points a direction, P_0 or
    /// P_1 for 1 or dim + 1 points on a simplex. Coordinates are those of the reference cell, on a face without the one that it fixes.
    class PointPolynomials
    {
    public:
      using Coordinates = std::vector<double>;

      PointPolynomials(const std::vector<Coordinates> &points, const bool simplex) : simplex(simplex), n(points.size())
      {
        const unsigned d = points[0].size();
        n_1d = simplex ? (n == 1 ? 1 : 2) : std::lround(std::pow(n, 1. / d));
        Eigen::MatrixXd vandermonde(n, n);
        for (unsigned i = 0; i < n; ++i)
          vandermonde.row(i) = powers(points[i]);
        coefficients = vandermonde.inverse();
      }

      /// All n polynomials at a point.
      Eigen::RowVectorXd values(const Coordinates &x) const { return powers(x) * coefficients; }

    private:
      Eigen::RowVectorXd powers(const Coordinates &x) const
      {
        Eigen::RowVectorXd result(n);
        if (simplex)
        {
          result(0) = 1;
          for (unsigned d = 1; d < n; ++d)
            result(d) = x[d - 1] - 0.5;
          return result;
        }
        for (unsigned i = 0; i < n; ++i)
        {
          result(i) = 1;
          for (unsigned d = 0, index = i; d < x.size(); ++d, index /= n_1d)
            result(i) *= std::pow(x[d] - 0.5, index % n_1d);
        }
        return result;
      }

      bool            simplex;
      unsigned        n, n_1d;
      Eigen::MatrixXd coefficients;
    };

    /// The coordinate that a face of the reference cell fixes, and its value; none on the slanted face of a simplex.
    template <int dim, typename Cell>
    std::optional<std::pair<unsigned, double>> fixed_coordinate(const Cell &cell, const unsigned face)
    {
      const auto reference = cell->reference_cell();
      for (unsigned d = 0; d < dim; ++d)
      {
        double low = 1, high = 0;
        for (const unsigned v : reference.face_reference_cell(face).vertex_indices())
        {
          const double x = reference.template vertex<dim>(reference.face_to_cell_vertices(face, v, 1))[d];
          low = std::min(low, x);
          high = std::max(high, x);
        }
        if (high - low < 1e-12)
          return std::pair(d, low);
      }
      return {};
    }

    template <int dim, typename Cell>
    bool lies_on_face(const Cell &cell, const unsigned face, const Point<dim> &x)
    {
      if (const auto fixed = fixed_coordinate<dim>(cell, face))
        return std::abs(x[fixed->first] - fixed->second) < 1e-6;
      double sum = 0;
      for (unsigned d = 0; d < dim; ++d)
        sum += x[d];
      return std::abs(sum - 1) < 1e-6;
    }

    /// V_h, or a richer space on a finer mesh, seen from the cells of the problem.
    template <int dim>
    struct SpaceOverCells
    {
      const Problem<dim>                                                      &space;
      std::vector<std::vector<typename DoFHandler<dim>::active_cell_iterator>> cells; ///< of the space, by active cell of the problem
    };

    template <int dim>
    SpaceOverCells<dim> on_own_cells(const Problem<dim> &problem)
    {
      SpaceOverCells<dim> space{problem, {}};
      for (const auto &cell : problem.dof_handler.active_cell_iterators())
        space.cells.push_back({cell});
      return space;
    }

    /// @p fine is one refinement finer than @p coarse, both from one coarse mesh.
    template <int dim>
    SpaceOverCells<dim> on_children(const Problem<dim> &coarse, const Problem<dim> &fine)
    {
      SpaceOverCells<dim> space{fine, {}};
      const std::size_t   n_cells = coarse.mesh.triangulation->n_active_cells();
      space.cells.resize(n_cells);
      if (dim > 1 && coarse.element.simplex()) // cut cell by cell, see refine_simplices()
      {
        for (const auto &cell : fine.dof_handler.active_cell_iterators())
          space.cells[cell->active_cell_index() / (1u << dim)].push_back(cell);
        return space;
      }
      std::map<CellId, unsigned> index;
      for (const auto &cell : coarse.mesh.triangulation->active_cell_iterators())
        index[cell->id()] = cell->active_cell_index();
      for (const auto &cell : fine.dof_handler.active_cell_iterators())
        space.cells[index.at(cell->parent()->id())].push_back(cell);
      return space;
    }

    /// How far a point in reference coordinates lies outside the cell.
    template <int dim>
    double distance_outside(const Point<dim> &x, const bool simplex)
    {
      double outside = 0, sum = 0;
      for (unsigned d = 0; d < dim; ++d)
      {
        outside = std::max({outside, -x[d], simplex ? 0. : x[d] - 1});
        sum += x[d];
      }
      return simplex ? std::max(outside, sum - 1) : outside;
    }

    /// sqrt(w_i) v(x_i), v in V_h: rows of B.
    template <int dim>
    SparseMatrixd trace_functionals(const ConstraintSet<dim> &set, const std::vector<bool> &zone, const FreeUnknowns &free)
    {
      int                    n_columns = 0;
      const std::vector<int> column = number_columns(zone, n_columns);
      Triplets               entries;
      for (std::size_t i = 0; i < set.size(); ++i)
        if (column[i] >= 0)
          for (std::size_t k = 0; k < set.trace[i].dofs.size(); ++k)
            if (const int row = free[set.trace[i].dofs[k]]; row >= 0)
              entries.emplace_back(row, column[i], std::sqrt(set.weights[i]) * set.trace[i].values[k]);
      return to_matrix(free.n_free, n_columns, entries);
    }

    /// The same on a space over the children of the cells. A point that several cells share has the same value from each.
    template <int dim>
    SparseMatrixd point_functionals(const Problem<dim>        &problem,
                                    const ConstraintSet<dim>  &set,
                                    const std::vector<bool>   &zone,
                                    const SpaceOverCells<dim> &space,
                                    const FreeUnknowns        &free)
    {
      int                                  n_columns = 0;
      const std::vector<int>               column = number_columns(zone, n_columns);
      const bool                           simplex = dim > 1 && problem.element.simplex();
      Triplets                             entries;
      std::vector<bool>                    done(set.size() + 1, false);
      std::vector<types::global_dof_index> dofs(space.space.fe->n_dofs_per_cell());
      for (std::size_t block = 0; block < set.blocks.size(); ++block)
        for (const auto &[cell, face, locations, points] : rule_on_cells(problem, set, block))
          for (const std::size_t i : points)
          {
            if (column[i] < 0 || done[i])
              continue;
            done[i] = true;
            double                                         least = std::numeric_limits<double>::max();
            Point<dim>                                     x;
            typename DoFHandler<dim>::active_cell_iterator owner;
            for (const auto &child : space.cells[cell->active_cell_index()])
            {
              const Point<dim> candidate = space.space.mapping->transform_real_to_unit_cell(child, set.points[i]);
              if (const double outside = distance_outside(candidate, simplex); outside < least)
              {
                least = outside;
                x = candidate;
                owner = child;
              }
            }
            owner->get_dof_indices(dofs);
            for (unsigned k = 0; k < dofs.size(); ++k)
              if (const int row = free[dofs[k]]; row >= 0)
                if (const double value = space.space.fe->shape_value(k, x); std::abs(value) > 1e-13)
                  entries.emplace_back(row, column[i], std::sqrt(set.weights[i]) * value);
          }
      return to_matrix(free.n_free, n_columns, entries);
    }

    /// The L2 product with the polynomials that are 1/sqrt(w_i) at one point of a cell and 0 at its others.
    template <int dim>
    SparseMatrixd polynomial_functionals(const Problem<dim>        &problem,
                                         const ConstraintSet<dim>  &set,
                                         const std::vector<bool>   &zone,
                                         const SpaceOverCells<dim> &space,
                                         const FreeUnknowns        &free)
    {
      int                                  n_columns = 0;
      const std::vector<int>               column = number_columns(zone, n_columns);
      const bool                           simplex = dim > 1 && problem.element.simplex();
      const auto                          &fe = *space.space.fe;
      const auto                           flags = update_values | update_quadrature_points | update_JxW_values;
      Triplets                             entries;
      std::vector<types::global_dof_index> dofs(fe.n_dofs_per_cell());
      for (std::size_t block = 0; block < set.blocks.size(); ++block)
      {
        const auto    &part = problem.conditions[block].part;
        const unsigned rule_degree = std::max(2u * problem.conditions[block].rule.n, 2u) - 1;
        FEValues<dim>  values(*space.space.mapping, fe, exact_quadrature<dim>(space.space.element, fe.degree + rule_degree), flags);
        std::vector<PointPolynomials::Coordinates> nodes;
        const auto                                 coordinates = [&](const auto &cell, const auto &face, const Point<dim> &x)
        {
          const Point<dim>              unit = problem.mapping->transform_real_to_unit_cell(cell, x);
          PointPolynomials::Coordinates result(unit.begin_raw(), unit.end_raw());
          if (face)
          {
            const auto fixed = fixed_coordinate<dim>(cell, *face);
            result.erase(result.begin() + (fixed ? fixed->first : dim - 1));
          }
          return result;
        };
        const auto add = [&](const auto &cell, const auto &face, const auto &points, const PointPolynomials &polynomials, const auto &child,
                             const FEValuesBase<dim> &on_child)
        {
          child->get_dof_indices(dofs);
          for (const unsigned q : on_child.quadrature_point_indices())
          {
            const Eigen::RowVectorXd p = polynomials.values(coordinates(cell, face, on_child.quadrature_point(q)));
            for (unsigned g = 0; g < points.size(); ++g)
              if (column[points[g]] >= 0)
                for (unsigned k = 0; k < dofs.size(); ++k)
                  if (const int row = free[dofs[k]]; row >= 0)
                    if (const double value = on_child.shape_value(k, q); value != 0)
                      entries.emplace_back(row, column[points[g]], p(g) / std::sqrt(set.weights[points[g]]) * on_child.JxW(q) * value);
          }
        };
        for (const auto &[cell, face, locations, points] : rule_on_cells(problem, set, block))
        {
          if (std::none_of(points.begin(), points.end(), [&](const auto i) { return column[i] >= 0; }))
            continue;
          nodes.clear();
          for (const Point<dim> &x : locations)
            nodes.push_back(coordinates(cell, face, x));
          const PointPolynomials polynomials(nodes, simplex && nodes[0].size() > 1);
          for (const auto &child : space.cells[cell->active_cell_index()])
            if (!face)
            {
              values.reinit(child);
              add(cell, face, points, polynomials, child, values);
            }
            else if constexpr (dim > 1)
            {
              FEFaceValues<dim> face_values(*space.space.mapping, fe,
                                            exact_quadrature<dim - 1>(space.space.element, fe.degree + rule_degree), flags);
              for (const auto f : child->face_indices())
                if (child->face(f)->at_boundary() && child->face(f)->boundary_id() == *part)
                {
                  face_values.reinit(child, f);
                  // A cell can have two faces on the part: only the children of this one.
                  bool own = true;
                  for (const unsigned q : face_values.quadrature_point_indices())
                    own &=
                      lies_on_face<dim>(cell, *face, problem.mapping->transform_real_to_unit_cell(cell, face_values.quadrature_point(q)));
                  if (own)
                    add(cell, face, points, polynomials, child, face_values);
                }
            }
        }
      }
      return to_matrix(free.n_free, n_columns, entries);
    }
  } // namespace

  template <int dim>
  std::vector<RuleOnCell<dim>> rule_on_cells(const Problem<dim> &problem, const ConstraintSet<dim> &set, const std::size_t block)
  {
    const auto &[begin, end] = std::pair(set.blocks[block].begin, set.blocks[block].end);
    const auto  &fe = *problem.fe;
    const double spacing = 1e-3 * problem.cell_sizes().first;

    // Points by the box of a fine grid in which they lie.
    using Box = std::array<long, dim>;
    std::map<Box, std::vector<std::size_t>> boxes;
    const auto                              box_of = [&](const Point<dim> &x)
    {
      Box box;
      for (unsigned d = 0; d < dim; ++d)
        box[d] = std::lround(x[d] / spacing);
      return box;
    };
    for (std::size_t i = begin; i < end; ++i)
      boxes[box_of(set.points[i])].push_back(i);
    std::vector<types::global_dof_index> dofs(fe.n_dofs_per_cell());
    // The point of the block at x that belongs to the cell: the two sides of a slit have points of their own.
    const auto find = [&](const Point<dim> &x) -> std::size_t
    {
      const Box home = box_of(x);
      for (unsigned neighbour = 0; neighbour < Utilities::pow(3u, dim); ++neighbour)
      {
        Box box = home;
        for (unsigned d = 0, rest = neighbour; d < dim; ++d, rest /= 3)
          box[d] += long(rest % 3) - 1;
        if (const auto it = boxes.find(box); it != boxes.end())
          for (const std::size_t i : it->second)
            if (x.distance(set.points[i]) < 1e-2 * spacing && std::find(dofs.begin(), dofs.end(), set.trace[i].dofs[0]) != dofs.end())
              return i;
      }
      return set.size();
    };

    std::vector<RuleOnCell<dim>> rules;
    const auto                   add = [&](const auto &cell, const std::optional<unsigned> face, const std::vector<Point<dim>> &locations)
    {
      cell->get_dof_indices(dofs);
      RuleOnCell<dim> rule{cell, face, locations, {}};
      for (const Point<dim> &x : locations)
        rule.points.push_back(find(x));
      rules.push_back(std::move(rule));
    };
    const auto &condition = problem.conditions[block];
    if (!condition.part)
    {
      FEValues<dim> values(*problem.mapping, fe, quadrature_rule<dim>(condition.rule, problem.element), update_quadrature_points);
      for (const auto &cell : problem.dof_handler.active_cell_iterators())
      {
        values.reinit(cell);
        add(cell, {}, values.get_quadrature_points());
      }
      return rules;
    }
    FEFaceValues<dim> values(*problem.mapping, fe, quadrature_rule<dim - 1>(condition.rule, problem.element), update_quadrature_points);
    for (const auto &cell : problem.dof_handler.active_cell_iterators())
      for (const auto face : cell->face_indices())
        if (cell->face(face)->at_boundary() && cell->face(face)->boundary_id() == *condition.part)
        {
          values.reinit(cell, face);
          add(cell, face, values.get_quadrature_points());
        }
    return rules;
  }

  template <int dim>
  std::vector<bool> each_point_once(const ConstraintSet<dim> &set, std::vector<bool> flags)
  {
    for (std::size_t b = 1; b < set.blocks.size(); ++b)
    {
      const auto &first = set.blocks[b - 1], &second = set.blocks[b];
      if (first.side == second.side || first.on != second.on || first.rule.name() != second.rule.name())
        continue;
      for (std::size_t i = second.begin; i < second.end; ++i)
        if (flags[first.begin + (i - second.begin)])
          flags[i] = false;
    }
    return flags;
  }

  template <int dim>
  bool has_polynomials(const Problem<dim> &problem, const ConstraintSet<dim> &set)
  {
    const auto    &condition = problem.conditions[0];
    const unsigned dim_of_rule = condition.part ? dim - 1 : dim;
    if (set.blocks.size() != 1 || dim_of_rule == 0)
      return false;
    if (condition.rule.family != RuleName::Family::gauss && condition.rule.family != RuleName::Family::midpoint)
      return false;
    if (!problem.element.simplex() || dim_of_rule == 1)
      return true;
    const std::size_t n = condition.part ? quadrature_rule<dim - 1>(condition.rule, problem.element).size()
                                         : quadrature_rule<dim>(condition.rule, problem.element).size();
    return n == 1 || n == dim_of_rule + 1;
  }

  template <int dim>
  Pairing make_pairing(const Problem<dim> &problem, const ConstraintSet<dim> &set, const std::vector<bool> &zone, const PairingKind kind)
  {
    const FreeUnknowns free(problem);
    return {gram_matrix(problem, free), kind == PairingKind::by_rule
                                          ? trace_functionals(set, zone, free)
                                          : polynomial_functionals(problem, set, zone, on_own_cells(problem), free)};
  }

  namespace
  {
    template <int dim>
    unsigned dual_degree(const Problem<dim> &problem)
    {
      return dim == 1 ? 8 : std::min(problem.element.degree + 1, problem.element.simplex() ? 3u : 8u);
    }
  } // namespace

  template <int dim>
  std::size_t n_dual_unknowns(const Problem<dim> &problem)
  {
    return problem.dof_handler.n_dofs() * std::pow(2. * dual_degree(problem) / problem.element.degree, dim);
  }

  template <int dim>
  Pairing
  make_dual_pairing(const Problem<dim> &problem, const ConstraintSet<dim> &set, const std::vector<bool> &zone, const PairingKind kind)
  {
    Case request = problem.request;
    request.model.element.degree = dual_degree(problem);
    // Mesh and Dirichlet parts count; the rest must only raise no objection.
    request.constraints.clear();
    request.output.probes.clear();
    request.model.coefficients.reaction = FieldSpec::constant(1);
    Diagnostics         nobody;
    Problem<dim>        rich(request, nobody);
    std::vector<Vector> nothing_to_carry;
    for (unsigned level = 0; level <= problem.level; ++level)
      rich.refine(nothing_to_carry);
    const FreeUnknowns free(rich);
    const auto         space = on_children(problem, rich);
    return {gram_matrix(rich, free), kind == PairingKind::by_rule ? point_functionals(problem, set, zone, space, free)
                                                                  : polynomial_functionals(problem, set, zone, space, free)};
  }

#define INSTANTIATE(dim)                                                                                                                   \
  template FreeUnknowns::FreeUnknowns(const Problem<dim> &);                                                                               \
  template std::vector<RuleOnCell<dim>> rule_on_cells(const Problem<dim> &, const ConstraintSet<dim> &, std::size_t);                      \
  template std::size_t                  n_dual_unknowns(const Problem<dim> &);                                                             \
  template std::vector<bool>            each_point_once(const ConstraintSet<dim> &, std::vector<bool>);                                    \
  template bool                         has_polynomials(const Problem<dim> &, const ConstraintSet<dim> &);                                 \
  template Pairing make_pairing(const Problem<dim> &, const ConstraintSet<dim> &, const std::vector<bool> &, PairingKind);                 \
  template Pairing make_dual_pairing(const Problem<dim> &, const ConstraintSet<dim> &, const std::vector<bool> &, PairingKind);
  INSTANTIATE(1)
  INSTANTIATE(2)
  INSTANTIATE(3)
#undef INSTANTIATE
} // namespace unilateral
