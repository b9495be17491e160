#include "unilateral/equilibration/feasible_state.h"

#include "unilateral/equilibration/jumps.h"
#include "unilateral/equilibration/steps_together.h"
#include "unilateral/mesh/gauss_rule.h"
#include "unilateral/mesh/subdivided_rule.h"

#include <deal.II/base/quadrature_lib.h>
#include <deal.II/grid/reference_cell.h>

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

namespace unilateral
{
  using namespace dealii;

  namespace
  {
    /// Points on a face of the reference cell.
    template <int dim>
    Quadrature<dim> on_reference_face(const bool simplex, const unsigned face, const unsigned n)
    {
      if constexpr (dim == 1)
        return Quadrature<1>(std::vector<Point<1>>{Point<1>(double(face))});
      else
      {
        const ReferenceCell     cell = simplex ? ReferenceCells::get_simplex<dim>() : ReferenceCells::get_hypercube<dim>();
        std::vector<Point<dim>> corners;
        for (unsigned v = 0; v < dim; ++v)
        {
          const unsigned vertex = cell.face_to_cell_vertices(face, v, 1);
          if (!simplex)
            corners.push_back(GeometryInfo<dim>::unit_cell_vertex(vertex));
          else
            corners.push_back(vertex == 0 ? Point<dim>() : Point<dim>(Point<dim>::unit_vector(vertex - 1)));
        }
        const Quadrature<dim - 1> rule = gauss_rule<dim - 1>(simplex, simplex && dim == 3 ? 4 : n);
        std::vector<Point<dim>>   points;
        for (const Point<dim - 1> &p : rule.get_points())
        {
          Point<dim> x = corners[0];
          for (unsigned k = 0; k + 1 < dim; ++k)
            x += p[k] * (corners[k + 1] - corners[0]);
          points.push_back(x);
        }
        return Quadrature<dim>(points);
      }
    }

    template <int dim>
    Quadrature<dim> fine_rule(const ElementName &element)
    {
      const bool simplex = element.simplex();
      return subdivided(gauss_rule<dim>(simplex, simplex ? 4 : element.degree + 1), simplex, 1);
    }

    /// A function of V_h at a point of a cell.
    template <int dim>
    double value_of(const Vector &v, const std::vector<types::global_dof_index> &dofs, const Eigen::MatrixXd &table, const unsigned q)
    {
      double value = 0;
      for (unsigned i = 0; i < dofs.size(); ++i)
        value += table(q, i) * v(dofs[i]);
      return value;
    }
  } // namespace

  template <int dim>
  FeasibleState<dim>::FeasibleState(const Problem<dim> &problem, const Vector &u, const std::vector<Vector> &pressures)
    : problem(problem), u(u), fine(*problem.space.fe, fine_rule<dim>(problem.space.element)), moved(u),
      lifted(problem.space.mesh.part_names.size(), false), size(problem.space.processes().max(u.linfty_norm()))
  {
    for (std::size_t b = 0; b < pressures.size(); ++b)
      bounds.push_back(
        {&problem.conditions[b], pressures[b], {}, {}, std::vector<float>(problem.space.mesh.triangulation->n_active_cells(), -1)});
    for (unsigned f = 0; f < problem.space.mesh.triangulation->begin_active()->n_faces(); ++f)
    {
      const bool simplex = problem.space.element.simplex();
      faces.emplace_back(*problem.space.fe, on_reference_face<dim>(simplex, f, 2));
      at_boundary.emplace_back(*problem.space.fe, on_reference_face<dim>(simplex, f, problem.space.element.degree + 3));
    }
    // A process where something has no value goes on, since others wait for it.
    const auto try_to = [&](const auto &act)
    {
      if (const std::string thrown = reason_from(act); !thrown.empty())
        reason = thrown;
    };
    try_to([&] { interpolate_bounds(); });
    VertexMoves moves_of_vertices = vertices_held();
    try_to([&] { find_moves(moves_of_vertices); });
    move_off_boundary_bounds(moves_of_vertices);
    try_to([&] { look_at_boundary_values(); });
    agree_on_lifted_parts();
  }

  template <int dim>
  void FeasibleState<dim>::interpolate_bounds()
  {
    std::vector<Point<dim>>              points;
    std::vector<types::global_dof_index> dofs;
    for (const auto &node : problem.space.nodal_values())
    {
      points.push_back(node.x);
      dofs.push_back(node.dof);
    }
    std::vector<double> values;
    for (Bound &bound : bounds)
    {
      if (bound.condition->part)
        continue;
      bound.condition->bound.values(points, values);
      bound.interpolant.reinit(u);
      bound.contact.reinit(u);
      for (std::size_t k = 0; k < dofs.size(); ++k)
      {
        bound.interpolant(dofs[k]) = values[k];
        bound.contact(dofs[k]) = bound.pressure(dofs[k]) > 0 ? 1 : 0;
      }
      problem.space.hanging_nodes.distribute(bound.interpolant);
      problem.space.hanging_nodes.distribute(bound.contact);
    }
  }

  template <int dim>
  typename FeasibleState<dim>::VertexMoves FeasibleState<dim>::vertices_held() const
  {
    const auto &triangulation = *problem.space.mesh.triangulation;
    VertexMoves result{std::vector<bool>(triangulation.n_vertices(), false), std::vector<double>(triangulation.n_vertices(), 0.),
                       std::vector<double>(triangulation.n_vertices(), 0.)};
    for (const auto &cell : triangulation.active_cell_iterators())
      for (const unsigned f : cell->face_indices())
        if (cell->at_boundary(f) && problem.prescribed.conditions[cell->face(f)->boundary_id()].value)
          for (const unsigned v : cell->face(f)->vertex_indices())
            result.held[cell->face(f)->vertex_index(v)] = true;
    std::vector<double> held(result.held.begin(), result.held.end());
    take_largest_at_vertices(held);
    std::transform(held.begin(), held.end(), result.held.begin(), [](const double is) { return is > 0; });
    return result;
  }

  /// Values of vertices, none negative, become the largest of all processes that have the vertex.
  template <int dim>
  void FeasibleState<dim>::take_largest_at_vertices(std::vector<double> &values) const
  {
    if (problem.space.processes().alone())
      return;
    Vector     negative(u.size());
    const auto for_each_vertex = [&](const auto &act)
    {
      for (const auto &cell : problem.space.dof_handler.active_cell_iterators())
        for (const unsigned v : cell->vertex_indices())
          act(values[cell->vertex_index(v)], negative(cell->vertex_dof_index(v, 0)));
    };
    for_each_vertex([](const double value, double &at_node) { at_node = -value; });
    problem.space.shared().minimize(negative.begin());
    for_each_vertex([](double &value, const double at_node) { value = -at_node; });
  }

  template <int dim>
  void FeasibleState<dim>::find_moves(VertexMoves &of_vertices)
  {
    auto &[held, up, down] = of_vertices;
    std::vector<types::global_dof_index> dofs(problem.space.fe->n_dofs_per_cell());
    std::vector<double>                  values;
    for (const Bound &bound : bounds)
    {
      if (!bound.condition->part)
        continue;
      const bool   lower = bound.condition->side == Side::lower;
      const double sign = lower ? 1 : -1;
      for (const auto &cell : problem.space.dof_handler.active_cell_iterators())
        for (const unsigned f : cell->face_indices())
        {
          if (!cell->at_boundary(f) || cell->face(f)->boundary_id() != *bound.condition->part)
            continue;
          const TabulatedElement<dim> &table = at_boundary[f];
          const auto                   at = StraightCell<dim>(cell).at(table);
          cell->get_dof_indices(dofs);
          bound.condition->bound.values(at.x, values);
          double needed = 0;
          for (unsigned q = 0; q < table.size(); ++q)
          {
            const double violation = sign * (values[q] - value_of<dim>(u, dofs, table.values, q));
            if (violation <= 1e-13 * size)
              continue;
            double share = 0; // of a move of the vertices that are free to move; those of the cell that are not on the face are zero here
            for (const unsigned v : cell->vertex_indices())
              share += held[cell->vertex_index(v)] ? 0. : table.vertex_values(q, v);
            if (share < 1e-3)
              reason =
                fmt::format("u crosses its bound between the points on '{}', next to where its values are prescribed", bound.condition->on);
            else
              needed = std::max(needed, violation / share);
          }
          for (const unsigned v : cell->face(f)->vertex_indices())
            if (const auto vertex = cell->face(f)->vertex_index(v); !held[vertex])
            {
              auto &move = (lower ? up : down)[vertex];
              move = std::max(move, needed);
            }
        }
    }
  }

  /// By vertex; a multilinear function of these values does not add new violations, as shape functions of higher degree would.
  template <int dim>
  void FeasibleState<dim>::move_off_boundary_bounds(VertexMoves &of_vertices)
  {
    auto &[held, up, down] = of_vertices;
    take_largest_at_vertices(up);
    take_largest_at_vertices(down);
    const auto any = [](const std::vector<double> &by) { return std::any_of(by.begin(), by.end(), [](const double x) { return x > 0; }); };
    moves = problem.space.processes().any(any(up) || any(down));
    if (!moves)
      return;
    for (std::size_t vertex = 0; vertex < up.size(); ++vertex)
      if (up[vertex] > 0 && down[vertex] > 0)
        reason = "u crosses a lower and an upper bound on the boundary";
    const TabulatedElement<dim>          nodes(*problem.space.fe, Quadrature<dim>(problem.space.fe->get_unit_support_points()));
    std::vector<types::global_dof_index> dofs(problem.space.fe->n_dofs_per_cell());
    for (const auto &cell : problem.space.dof_handler.active_cell_iterators())
    {
      cell->get_dof_indices(dofs);
      for (unsigned i = 0; i < dofs.size(); ++i)
      {
        double move = 0;
        for (const unsigned v : cell->vertex_indices())
          move += nodes.vertex_values(i, v) * (up[cell->vertex_index(v)] - down[cell->vertex_index(v)]);
        moved(dofs[i]) = u(dofs[i]) + move;
      }
    }
    problem.space.hanging_nodes.distribute(moved);
  }

  template <int dim>
  void FeasibleState<dim>::agree_on_lifted_parts()
  {
    std::vector<double> lifts(lifted.begin(), lifted.end());
    problem.space.processes().max(lifts.data(), lifts.size());
    std::transform(lifts.begin(), lifts.end(), lifted.begin(), [](const double is) { return is > 0; });
    if (dim == 3 && std::any_of(lifted.begin(), lifted.end(), [](const bool is) { return is; }))
      reason = "the prescribed boundary values are no functions of the finite elements, which only segments and plane meshes can bridge";
  }

  template <int dim>
  void FeasibleState<dim>::look_at_boundary_values()
  {
    std::vector<types::global_dof_index> dofs(problem.space.fe->n_dofs_per_cell());
    std::vector<double>                  values;
    for (const auto &cell : problem.space.dof_handler.active_cell_iterators())
      for (const unsigned f : cell->face_indices())
      {
        if (!cell->at_boundary(f))
          continue;
        const auto  part = cell->face(f)->boundary_id();
        const auto &condition = problem.prescribed.conditions[part];
        if (!condition.value || condition.value->is_constant() || lifted[part])
          continue;
        const TabulatedElement<dim> &table = at_boundary[f];
        const auto                   at = StraightCell<dim>(cell).at(table);
        cell->get_dof_indices(dofs);
        condition.value->values(at.x, values);
        for (unsigned q = 0; q < table.size(); ++q)
          if (std::abs(values[q] - value_of<dim>(u, dofs, table.values, q)) > 1e-12 * size)
            lifted[part] = true;
      }
  }

  template <int dim>
  bool FeasibleState<dim>::bound_jumps(const Cell                                 &cell,
                                       const StraightCell<dim>                    &straight,
                                       const typename StraightCell<dim>::AtPoints &at,
                                       const AtPoints                             &state) const
  {
    const auto may_jump = [&](const std::size_t b)
    {
      const UnilateralCondition &condition = *bounds[b].condition;
      return !condition.part && !condition.bound.is_constant() &&
             std::any_of(state.distance[b].begin(), state.distance[b].end(), [&](const double d) { return d <= 1e-12 * size; });
    };
    bool any = false;
    for (std::size_t b = 0; b < bounds.size(); ++b)
      any = any || may_jump(b);
    if (!any)
      return false;

    std::vector<Point<dim>>              places(at.x);
    std::vector<std::array<unsigned, 2>> pairs; // of places
    for (unsigned q = 1; q < at.x.size(); ++q)
      pairs.push_back({q - 1, q});
    // Across each face, from a point just inside to one just outside.
    for (const unsigned f : cell->face_indices())
    {
      if (cell->at_boundary(f))
        continue;
      for (const Point<dim> &x : straight.at(faces[f]).x)
      {
        const Tensor<1, dim> outwards = 1e-3 * (x - cell->center());
        const unsigned       n = places.size();
        places.insert(places.end(), {x - outwards, x + outwards});
        pairs.push_back({n, n + 1});
      }
    }
    std::vector<double>         values;
    std::vector<Tensor<1, dim>> gradients;
    for (std::size_t b = 0; b < bounds.size(); ++b)
    {
      if (!may_jump(b))
        continue;
      const UnilateralCondition &condition = *bounds[b].condition;
      condition.bound.values_and_gradients(places, values, gradients);
      for (const auto &[left, right] : pairs)
      {
        const double slope = std::max(gradients[left].norm(), gradients[right].norm());
        if (jumps_between<dim>([&](const Point<dim> &x) { return condition.bound.value(x); }, {places[left], values[left]},
                               {places[right], values[right]}, slope, size))
          return true;
      }
    }
    return false;
  }

  template <int dim>
  bool FeasibleState<dim>::at_free_boundary(const Cell &cell) const
  {
    std::vector<types::global_dof_index> dofs(problem.space.fe->n_dofs_per_cell());
    cell->get_dof_indices(dofs);
    return std::any_of(bounds.begin(), bounds.end(),
                       [&](const Bound &bound)
                       {
                         const auto in_contact =
                           std::count_if(dofs.begin(), dofs.end(), [&](const auto dof) { return bound.pressure(dof) > 0; });
                         return !bound.condition->part && in_contact > 0 && in_contact < std::ptrdiff_t(dofs.size());
                       });
  }

  template class FeasibleState<1>;
  template class FeasibleState<2>;
  template class FeasibleState<3>;
} // namespace unilateral
