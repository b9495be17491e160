#include "unilateral/stability/multiplier_pairing.h"

#include "unilateral/discretisation/element_systems.h"
#include "unilateral/inequality/discrete_problem.h"
#include "unilateral/mesh/gauss_rule.h"
#include "unilateral/mesh/reference_face.h"
#include "unilateral/spaces/point_location.h"

#include <deal.II/base/quadrature_lib.h>
#include <deal.II/fe/fe_values.h>
#include <deal.II/grid/cell_id.h>
#include <deal.II/lac/sparse_matrix.h>

#include <Eigen/Dense>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <map>
#include <unordered_map>

namespace unilateral
{
  using namespace dealii;

  template <int dim>
  FreeUnknowns::FreeUnknowns(const Problem<dim> &problem) : number(problem.space.dof_handler.n_dofs(), -1)
  {
    for (types::global_dof_index dof = 0; dof < number.size(); ++dof)
      if (!problem.space.dirichlet.is_constrained(dof))
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
    Quadrature<dim> exact_quadrature(const ElementName &element, const unsigned degree)
    {
      return gauss_rule<dim>(element.simplex(), degree / 2 + 1);
    }

    template <int dim>
    SparseMatrixd gram_matrix(const Problem<dim> &problem, const FreeUnknowns &free)
    {
      SparsityPattern sparsity;
      make_coupling_pattern(problem, sparsity);
      dealii::SparseMatrix<double> gram(sparsity);
      for_each_local_gram<dim>(problem, exact_quadrature<dim>(problem.space.element, 2 * problem.space.fe->degree),
                               [&](const LocalSystem &local)
                               { problem.space.dirichlet.distribute_local_to_global(local.matrix, local.dofs, gram); });
      return free.restricted(gram);
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

    /// V_h, or a richer space on a finer mesh, seen from the cells of the problem.
    template <int dim>
    struct SpaceOverCells
    {
      const FunctionSpace<dim>                                                &space;
      std::vector<std::vector<typename DoFHandler<dim>::active_cell_iterator>> cells; ///< of the space, by active cell of the problem
    };

    template <int dim>
    SpaceOverCells<dim> on_own_cells(const Problem<dim> &problem)
    {
      SpaceOverCells<dim> space{problem.space, {}};
      for (const auto &cell : problem.space.dof_handler.active_cell_iterators())
        space.cells.push_back({cell});
      return space;
    }

    /// @p fine is one refinement finer than @p coarse, both from one coarse mesh.
    template <int dim>
    SpaceOverCells<dim> on_children(const Problem<dim> &coarse, const Problem<dim> &fine)
    {
      SpaceOverCells<dim> space{fine.space, {}};
      const std::size_t   n_cells = coarse.space.mesh.triangulation->n_active_cells();
      space.cells.resize(n_cells);
      if (coarse.space.element.simplex()) // cut cell by cell, see refine_simplices()
      {
        for (const auto &cell : fine.space.dof_handler.active_cell_iterators())
          space.cells[cell->active_cell_index() / (1u << dim)].push_back(cell);
        return space;
      }
      std::map<CellId, unsigned> index;
      for (const auto &cell : coarse.space.mesh.triangulation->active_cell_iterators())
        index[cell->id()] = cell->active_cell_index();
      for (const auto &cell : fine.space.dof_handler.active_cell_iterators())
        space.cells[index.at(cell->parent()->id())].push_back(cell);
      return space;
    }

    /// @p fine is the same box with @p n_pieces times as many cells a direction.
    template <int dim>
    SpaceOverCells<dim> on_pieces(const Problem<dim> &coarse, const Problem<dim> &fine, const unsigned n_pieces)
    {
      const auto                               &spec = fine.statement.mesh;
      SpaceOverCells<dim>                       space{fine.space, {}};
      std::map<std::array<long, dim>, unsigned> index;
      const auto                                place = [&](const Point<dim> &center)
      {
        std::array<long, dim> cell;
        for (unsigned d = 0; d < dim; ++d)
          cell[d] =
            std::lround(std::floor((center[d] - spec.box_lower[d]) / (spec.box_upper[d] - spec.box_lower[d]) * spec.cells[d] / n_pieces));
        return cell;
      };
      for (const auto &cell : coarse.space.mesh.triangulation->active_cell_iterators())
        index[place(cell->center())] = cell->active_cell_index();
      space.cells.resize(index.size());
      for (const auto &cell : fine.space.dof_handler.active_cell_iterators())
        space.cells[index.at(place(cell->center()))].push_back(cell);
      return space;
    }

    /// Column by column what a functional does to the unknowns of V_h, the prescribed ones replaced by what they depend on.
    class Functionals
    {
    public:
      Functionals(const FreeUnknowns &free, const AffineConstraints<double> &supports) : free(free), supports(supports) {}

      void add(const types::global_dof_index dof, const int column, const double value)
      {
        if (free[dof] >= 0)
          entries.emplace_back(free[dof], column, value);
        else if (supports.is_constrained(dof))
          for (const auto &[other, factor] : *supports.get_constraint_entries(dof))
            entries.emplace_back(free[other], column, factor * value);
      }

      SparseMatrixd matrix(const int n_columns) const { return to_matrix(free.n_free, n_columns, entries); }

    private:
      const FreeUnknowns              &free;
      const AffineConstraints<double> &supports;
      Triplets                         entries;
    };

    /// sqrt(w_i) v(x_i), v in V_h: rows of B.
    template <int dim>
    SparseMatrixd
    trace_functionals(const Problem<dim> &problem, const ConstraintSet<dim> &set, const std::vector<bool> &zone, const FreeUnknowns &free)
    {
      int                    n_columns = 0;
      const std::vector<int> column = number_columns(zone, n_columns);
      Functionals            functionals(free, problem.space.dirichlet);
      for (std::size_t i = 0; i < set.size(); ++i)
        if (column[i] >= 0)
          for (std::size_t k = 0; k < set.trace[i].dofs.size(); ++k)
            functionals.add(set.trace[i].dofs[k], column[i], std::sqrt(set.points[i].weight) * set.trace[i].values[k]);
      return functionals.matrix(n_columns);
    }

    /// The component of the direction in which a function of a space is felt at point i: 1 when it is scalar.
    template <int dim>
    double felt(const ConstraintSet<dim> &set, const std::size_t i, const FiniteElement<dim> &fe, const unsigned k)
    {
      return set.directions.empty() ? 1 : set.directions[i][fe.system_to_component_index(k).first];
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
      const bool                           simplex = problem.space.element.simplex();
      Functionals                          functionals(free, space.space.dirichlet);
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
              const Point<dim> candidate = unit_point<dim>(space.space, child, set.points[i].x);
              if (const double outside = distance_outside(candidate, simplex); outside < least)
              {
                least = outside;
                x = candidate;
                owner = child;
              }
            }
            owner->get_dof_indices(dofs);
            FEValues<dim> at_point(*space.space.mapping, *space.space.fe, Quadrature<dim>(x), update_values);
            at_point.reinit(owner);
            for (unsigned k = 0; k < dofs.size(); ++k)
              if (const double value = at_point.shape_value(k, 0) * felt(set, i, *space.space.fe, k); std::abs(value) > 1e-13)
                functionals.add(dofs[k], column[i], std::sqrt(set.points[i].weight) * value);
          }
      return functionals.matrix(n_columns);
    }

    /// Of the faces of a cell that lie on a part the one that points are nearest to: a cell can have two, and on a curved boundary the
    /// faces of its children lie on neither.
    template <int dim>
    unsigned nearest_face_of_part(const FunctionSpace<dim>                             &space,
                                  const typename DoFHandler<dim>::active_cell_iterator &cell,
                                  const types::boundary_id                              part,
                                  const std::vector<Point<dim>>                        &points)
    {
      std::vector<Point<dim>> unit;
      for (const Point<dim> &x : points)
        unit.push_back(unit_point<dim>(space, cell, x));
      unsigned nearest = numbers::invalid_unsigned_int;
      double   least = std::numeric_limits<double>::max();
      for (const auto face : cell->face_indices())
      {
        if (!cell->at_boundary(face) || cell->face(face)->boundary_id() != part)
          continue;
        double distance = 0;
        for (const Point<dim> &x : unit)
          distance = std::max(distance, distance_from_face<dim>(cell->reference_cell(), face, x));
        if (distance < least)
        {
          least = distance;
          nearest = face;
        }
      }
      return nearest;
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
      const bool                           simplex = problem.space.element.simplex();
      const auto                          &fe = *space.space.fe;
      const auto                           flags = update_values | update_quadrature_points | update_JxW_values;
      Functionals                          functionals(free, space.space.dirichlet);
      std::vector<types::global_dof_index> dofs(fe.n_dofs_per_cell());
      for (std::size_t block = 0; block < set.blocks.size(); ++block)
      {
        const auto    &part = problem.conditions[block].part;
        const unsigned rule_degree = std::max(2u * problem.conditions[block].rule.n, 2u) - 1;
        FEValues<dim>  values(*space.space.mapping, fe, exact_quadrature<dim>(space.space.element, fe.degree + rule_degree), flags);
        std::vector<PointPolynomials::Coordinates> nodes;
        const auto                                 coordinates = [&](const auto &cell, const auto &face, const Point<dim> &x)
        {
          const Point<dim>              unit = unit_point<dim>(problem.space, cell, x);
          PointPolynomials::Coordinates result(unit.begin_raw(), unit.end_raw());
          if (face)
          {
            const auto fixed = fixed_coordinate<dim>(cell->reference_cell(), *face);
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
                  if (const double value = on_child.shape_value(k, q) * felt(set, points[g], fe, k); value != 0)
                    functionals.add(dofs[k], column[points[g]],
                                    p(g) / std::sqrt(set.points[points[g]].weight) * on_child.JxW(q) *
                                      problem.form->measure(on_child.quadrature_point(q)) * value);
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
                  if (nearest_face_of_part(problem.space, cell, *part, face_values.get_quadrature_points()) == *face)
                    add(cell, face, points, polynomials, child, face_values);
                }
            }
        }
      }
      return functionals.matrix(n_columns);
    }
  } // namespace

  template <int dim>
  std::vector<bool> each_point_once(const ConstraintSet<dim> &set, std::vector<bool> flags)
  {
    const auto same = [&](const std::size_t i, const std::size_t j)
    {
      const TraceRowView a = set.trace[i], b = set.trace[j];
      if (!std::ranges::equal(a.dofs, b.dofs))
        return false;
      for (std::size_t k = 0; k < a.values.size(); ++k)
        if (std::abs(a.values[k] - b.values[k]) > 1e-9)
          return false;
      return true;
    };
    std::unordered_multimap<types::global_dof_index, std::size_t> seen; // by the first unknown of the row
    for (std::size_t i = 0; i < set.size(); ++i)
    {
      if (!flags[i])
        continue;
      const auto [first, last] = seen.equal_range(set.trace[i].dofs[0]);
      if (std::any_of(first, last, [&](const auto &entry) { return same(i, entry.second); }))
        flags[i] = false;
      else
        seen.emplace(set.trace[i].dofs[0], i);
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
    if (!problem.space.element.simplex() || dim_of_rule == 1)
      return true;
    const std::size_t n = condition.part ? quadrature_rule<dim - 1>(condition.rule, problem.space.element).size()
                                         : quadrature_rule<dim>(condition.rule, problem.space.element).size();
    return n == 1 || n == dim_of_rule + 1;
  }

  template <int dim>
  Pairing make_pairing(const Problem<dim> &problem, const ConstraintSet<dim> &set, const std::vector<bool> &zone, const PairingKind kind)
  {
    const FreeUnknowns free(problem);
    return {gram_matrix(problem, free), kind == PairingKind::by_rule
                                          ? trace_functionals(problem, set, zone, free)
                                          : polynomial_functionals(problem, set, zone, on_own_cells(problem), free)};
  }

  namespace
  {
    template <int dim>
    unsigned dual_degree(const Problem<dim> &problem)
    {
      const auto family = problem.space.element.family;
      if (family == ElementName::Family::hermite)
        return 3; // there is one Hermite element: only the mesh is finer
      if (family == ElementName::Family::c0ip)
        return std::min(problem.space.element.degree + 1, problem.space.element.simplex() ? 3u : 4u);
      return dim == 1 ? 8 : std::min(problem.space.element.degree + 1, problem.space.element.simplex() ? 3u : 8u);
    }
  } // namespace

  template <int dim>
  std::size_t n_dual_unknowns(const Problem<dim> &problem)
  {
    return problem.space.dof_handler.n_dofs() *
           std::pow((problem.space.hermite() ? 3. : 2.) * dual_degree(problem) / std::max(problem.space.element.degree, 1u), dim);
  }

  template <int dim>
  Pairing
  make_dual_pairing(const Problem<dim> &problem, const ConstraintSet<dim> &set, const std::vector<bool> &zone, const PairingKind kind)
  {
    ProblemStatement statement = problem.statement;
    statement.model.element.degree = dual_degree(problem);
    if (problem.space.element.family == ElementName::Family::discontinuous)
      statement.model.element.family = ElementName::Family::Q;
    // Mesh and Dirichlet parts count; the rest must only raise no objection.
    statement.constraints.clear();
    statement.point_loads.clear();
    statement.output.probes.clear();
    statement.model.coefficients.reaction = FieldFunction(1.);
    if (statement.boundary.empty())
      statement.boundary.emplace_back().part = "all";
    for (auto &condition : statement.boundary)
      condition.springs = {FieldFunction(1.)};
    // Hermite elements have no higher degree: their cells are cut in three a direction, in fifteen for the integrals over a beam.
    const bool     cut = problem.space.hermite() && statement.mesh.source == MeshDescription::Source::box;
    const unsigned n_pieces = dim == 1 && kind == PairingKind::by_L2 ? 15 : 3;
    if (cut)
      for (unsigned &cells : statement.mesh.cells)
        cells *= n_pieces << problem.space.level;
    Diagnostics         nobody;
    Problem<dim>        rich(statement, nobody);
    std::vector<Vector> nothing_to_carry;
    for (unsigned level = 0; level <= problem.space.level && !cut; ++level)
      rich.refine(nothing_to_carry);
    const FreeUnknowns free(rich);
    const auto         space = cut ? on_pieces(problem, rich, n_pieces) : on_children(problem, rich);
    return {gram_matrix(rich, free), kind == PairingKind::by_rule ? point_functionals(problem, set, zone, space, free)
                                                                  : polynomial_functionals(problem, set, zone, space, free)};
  }

#define INSTANTIATE(dim)                                                                                                                   \
  template FreeUnknowns::FreeUnknowns(const Problem<dim> &);                                                                               \
  template std::size_t       n_dual_unknowns(const Problem<dim> &);                                                                        \
  template std::vector<bool> each_point_once(const ConstraintSet<dim> &, std::vector<bool>);                                               \
  template bool              has_polynomials(const Problem<dim> &, const ConstraintSet<dim> &);                                            \
  template Pairing           make_pairing(const Problem<dim> &, const ConstraintSet<dim> &, const std::vector<bool> &, PairingKind);       \
  template Pairing           make_dual_pairing(const Problem<dim> &, const ConstraintSet<dim> &, const std::vector<bool> &, PairingKind);
  INSTANTIATE(1)
  INSTANTIATE(2)
  INSTANTIATE(3)
#undef INSTANTIATE
} // namespace unilateral
