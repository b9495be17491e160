#include "unilateral/constraints/contact_points.h"

#include "unilateral/constraints/merged_points.h"
#include "unilateral/mesh/subdomain.h"
#include "unilateral/spaces/boundary_normal.h"

#include <deal.II/base/quadrature_lib.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <memory>
#include <set>
#include <utility>

namespace unilateral
{
  using namespace dealii;

  namespace
  {
    /// A point with all the faces that share it.
    template <int dim>
    struct Gathered
    {
      struct Shape
      {
        std::array<types::global_dof_index, dim> dofs;
        double                                   value;
      };
      Point<dim>         x;
      std::vector<Shape> shapes;
      NodeNormals<dim>   normals;
    };

    /// From hanging nodes, which leave, to the nodes of the part that decide where they move.
    template <int dim>
    void hand_over_weights(std::vector<Gathered<dim>> &points, const AffineConstraints<double> &hanging_nodes)
    {
      std::map<types::global_dof_index, std::size_t> at_node;
      for (std::size_t i = 0; i < points.size(); ++i)
        if (points[i].shapes.size() == 1)
          at_node[points[i].shapes[0].dofs[0]] = i;
      const auto hangs = [&](const Gathered<dim> &point)
      {
        if (point.shapes.size() != 1 || !hanging_nodes.is_constrained(point.shapes[0].dofs[0]))
          return false;
        const auto &neighbours = *hanging_nodes.get_constraint_entries(point.shapes[0].dofs[0]);
        return std::all_of(neighbours.begin(), neighbours.end(), [&](const auto &neighbour) { return at_node.count(neighbour.first) > 0; });
      };
      for (const auto &point : points)
        if (hangs(point))
          for (const auto &[dof, share] : *hanging_nodes.get_constraint_entries(point.shapes[0].dofs[0]))
            for (const auto &side : point.normals.sides())
              points[at_node.at(dof)].normals.add(side.normal(), share * side.weight);
      std::erase_if(points, hangs);
    }

    /// What a face adds to a node.
    template <int dim>
    struct FaceAtNode
    {
      Point<dim>     x;
      Tensor<1, dim> normal;
      double         weight = 0;
    };

    /// The rule has a point at every vertex of the face and nowhere else.
    template <int dim_face>
    bool at_vertices(const Quadrature<dim_face> &rule, const bool simplex)
    {
      if (rule.size() != (simplex && dim_face > 1 ? dim_face + 1 : 1u << dim_face) || dim_face == 0)
        return false;
      return std::all_of(rule.get_points().begin(), rule.get_points().end(),
                         [](const Point<dim_face> &x)
                         {
                           for (unsigned d = 0; d < dim_face; ++d)
                             if (std::abs(x[d]) > 1e-12 && std::abs(x[d] - 1) > 1e-12)
                               return false;
                           return true;
                         });
    }

    /// The function that is 1 at a vertex of the reference face and 0 at its others, linear or multilinear.
    template <int dim_face>
    double vertex_function(const Point<dim_face> &vertex, const Point<dim_face> &x, const bool simplex)
    {
      if (!simplex || dim_face == 1)
      {
        double value = 1;
        for (unsigned d = 0; d < dim_face; ++d)
          value *= vertex[d] > 0.5 ? x[d] : 1 - x[d];
        return value;
      }
      double sum = 0, own = -1;
      for (unsigned d = 0; d < dim_face; ++d)
      {
        sum += x[d];
        if (vertex[d] > 0.5)
          own = x[d];
      }
      return own >= 0 ? own : 1 - sum;
    }

    template <int dim_face>
    Quadrature<dim_face> fine_quadrature(const bool simplex, const unsigned degree)
    {
      if constexpr (dim_face == 2)
        if (simplex)
          return QGaussSimplex<2>(4);
      return QGauss<dim_face>(dim_face == 0 ? 1 : degree + 3);
    }
  } // namespace

  template <int dim>
  std::vector<ContactPoint<dim>> contact_points(const types::boundary_id             part,
                                                const RuleName                      &rule_name,
                                                const std::optional<Tensor<1, dim>> &given,
                                                const ElementName                   &element,
                                                const Mapping<dim>                  &mapping,
                                                const DoFHandler<dim>               &dof_handler,
                                                const AffineConstraints<double>     &hanging_nodes,
                                                const BilinearForm<dim>             &form,
                                                const SharedUnknowns                &unknowns_on_cuts)
  {
    const auto                &fe = dof_handler.get_fe();
    const bool                 simplex = element.simplex();
    const Quadrature<dim - 1>  rule = quadrature_rule<dim - 1>(rule_name, element);
    const bool                 vertices = at_vertices<dim - 1>(rule, simplex);
    const Quadrature<dim - 1>  fine = fine_quadrature<dim - 1>(simplex, fe.degree);
    const auto                 flags = update_values | update_quadrature_points | update_JxW_values | update_normal_vectors;
    FEFaceValues<dim>          values(mapping, fe, rule, flags), fine_values(mapping, fe, fine, flags);
    const unsigned             n_shapes = fe.n_dofs_per_cell() / dim;
    std::vector<Gathered<dim>> gathered;
    SharedPoints<dim>          shared(dof_handler.n_dofs());

    std::vector<std::pair<types::global_dof_index, FaceAtNode<dim>>> at_nodes; // where several processes may have faces

    std::vector<types::global_dof_index> dofs(fe.n_dofs_per_cell()), first_dofs;
    for (const auto &cell : dof_handler.active_cell_iterators())
      for (const auto face : cell->face_indices())
      {
        if (!cell->at_boundary(face) || cell->face(face)->boundary_id() != part)
          continue;
        values.reinit(cell, face);
        if (vertices)
          fine_values.reinit(cell, face);
        cell->get_dof_indices(dofs);
        for (const unsigned q : values.quadrature_point_indices())
        {
          Gathered<dim> point;
          point.x = values.quadrature_point(q);
          first_dofs.clear();
          for (unsigned k = 0; k < n_shapes; ++k)
            if (const double value = values.shape_value(fe.component_to_system_index(0, k), q); std::abs(value) > 1e-11)
            {
              point.shapes.push_back({{}, value});
              for (unsigned c = 0; c < dim; ++c)
                point.shapes.back().dofs[c] = dofs[fe.component_to_system_index(c, k)];
              first_dofs.push_back(point.shapes.back().dofs[0]);
            }
          double weight = 0;
          if (vertices)
            for (const unsigned g : fine_values.quadrature_point_indices())
              weight += vertex_function<dim - 1>(rule.point(q), fine.point(g), simplex) * fine_values.JxW(g) *
                        form.measure(fine_values.quadrature_point(g));
          else
            weight = values.JxW(q) * form.measure(point.x);
          const std::size_t index = shared.find_or_insert(first_dofs, point.x, 1e-8 * cell->diameter(), gathered.size());
          if (index == gathered.size())
            gathered.push_back(point);
          if (unknowns_on_cuts.processes().alone() || first_dofs.size() > 1)
            gathered[index].normals.add(boundary_normal(values, q), weight);
          else
            at_nodes.push_back({first_dofs[0], {point.x, boundary_normal(values, q), weight}});
        }
      }
    if (!unknowns_on_cuts.processes().alone())
    {
      unknowns_on_cuts.share(at_nodes);
      std::set<types::global_dof_index> first;
      for (const auto &[dof, face] : at_nodes)
        first.insert(dof);
      const auto unknowns = unknowns_of_nodes(dof_handler, first);
      for (const auto &[dof, face] : at_nodes)
      {
        const std::size_t index = shared.find_or_insert({dof}, face.x, 0, gathered.size());
        if (index == gathered.size())
          gathered.push_back({face.x, {{unknowns.at(dof), 1.}}, {}});
        gathered[index].normals.add(face.normal, face.weight);
      }
    }

    if (hanging_nodes.n_constraints() > 0)
      hand_over_weights(gathered, hanging_nodes);

    double largest_weight = 0;
    for (const auto &point : gathered)
      for (const auto &side : point.normals.sides())
        largest_weight = std::max(largest_weight, side.weight);
    largest_weight = unknowns_on_cuts.processes().max(largest_weight);
    std::vector<ContactPoint<dim>> points;
    for (const auto &from : gathered)
      for (const auto &side : from.normals.sides())
      {
        if (side.weight <= 1e-12 * largest_weight || (given && *given * side.normal() <= 0))
          continue;
        ContactPoint<dim> point;
        point.x = from.x;
        point.direction = given ? *given : side.normal();
        point.weight = side.weight;
        point.at_node = from.shapes.size() == 1 && !hanging_nodes.is_constrained(from.shapes[0].dofs[0]);
        point.owned = !point.at_node || unknowns_on_cuts.owns(from.shapes[0].dofs[0]);
        for (const auto &shape : from.shapes)
          for (unsigned c = 0; c < dim; ++c)
            if (std::abs(point.direction[c]) > 1e-12)
            {
              point.row.dofs.push_back(shape.dofs[c]);
              point.row.values.push_back(shape.value * point.direction[c]);
              point.row.direction.push_back(point.direction[c]);
            }
        points.push_back(std::move(point));
      }
    return points;
  }

#define INSTANTIATE(dim)                                                                                                                   \
  template std::vector<ContactPoint<dim>> contact_points(                                                                                  \
    types::boundary_id, const RuleName &, const std::optional<Tensor<1, dim>> &, const ElementName &, const Mapping<dim> &,                \
    const DoFHandler<dim> &, const AffineConstraints<double> &, const BilinearForm<dim> &, const SharedUnknowns &);
  INSTANTIATE(1)
  INSTANTIATE(2)
  INSTANTIATE(3)
#undef INSTANTIATE
} // namespace unilateral
