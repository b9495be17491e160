#include "unilateral/constraints/contact_points.h"

#include "unilateral/constraints/merged_points.h"
#include "unilateral/mesh/gauss_rule.h"
#include "unilateral/spaces/boundary_normal.h"
#include "unilateral/spaces/unknowns_on_cuts.h"

#include <deal.II/base/quadrature_lib.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <map>
#include <memory>
#include <set>
#include <unordered_map>
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

    /// Weights of points on a face: those of the rule with the form's measure, or, where it has its points at the vertices, int l dS, l the
    /// linear function of the vertex.
    template <int dim>
    class PointWeights
    {
    public:
      PointWeights(const Quadrature<dim - 1> &rule,
                   const bool                 simplex,
                   const Mapping<dim>        &mapping,
                   const FiniteElement<dim>  &fe,
                   const BilinearForm<dim>   &form)
        : rule(rule), simplex(simplex), form(form), vertices(at_vertices<dim - 1>(rule, simplex)),
          fine(gauss_rule<dim - 1>(simplex, fe.degree + 3)), fine_values(mapping, fe, fine, flags())
      {
      }

      /// Of FEFaceValues on the faces.
      static UpdateFlags flags() { return update_values | update_quadrature_points | update_JxW_values | update_normal_vectors; }

      template <typename Cell>
      void reinit(const Cell &cell, const unsigned face)
      {
        if (vertices)
          fine_values.reinit(cell, face);
      }

      /// @p values: on the same face.
      double weight(const FEFaceValues<dim> &values, const unsigned q) const
      {
        if (!vertices)
          return values.JxW(q) * form.measure(values.quadrature_point(q));
        double weight = 0;
        for (const unsigned g : fine_values.quadrature_point_indices())
          weight += vertex_function<dim - 1>(rule.point(q), fine.point(g), simplex) * fine_values.JxW(g) *
                    form.measure(fine_values.quadrature_point(g));
        return weight;
      }

    private:
      const Quadrature<dim - 1> &rule;
      const bool                 simplex;
      const BilinearForm<dim>   &form;
      const bool                 vertices;
      const Quadrature<dim - 1>  fine;
      FEFaceValues<dim>          fine_values;
    };

    /// The points of the faces of a part; those that faces share, also faces of other processes, once.
    template <int dim>
    class PointsOfFaces
    {
    public:
      PointsOfFaces(const DoFHandler<dim> &dof_handler, const SharedUnknowns &unknowns_on_cuts)
        : dof_handler(dof_handler), unknowns_on_cuts(unknowns_on_cuts), fe(dof_handler.get_fe()), shared(dof_handler.n_dofs()),
          dofs(fe.n_dofs_per_cell())
      {
      }

      /// The points of @p rule on the faces of a @p part.
      void
      add_faces(const types::boundary_id part, const Mapping<dim> &mapping, const Quadrature<dim - 1> &rule, PointWeights<dim> &weights)
      {
        FEFaceValues<dim> values(mapping, fe, rule, PointWeights<dim>::flags());
        for (const auto &cell : dof_handler.active_cell_iterators())
          for (const auto face : cell->face_indices())
          {
            if (!cell->at_boundary(face) || cell->face(face)->boundary_id() != part)
              continue;
            values.reinit(cell, face);
            weights.reinit(cell, face);
            cell->get_dof_indices(dofs);
            normals_of_faces.emplace_back();
            for (const unsigned q : values.quadrature_point_indices())
              add(values, q, weights.weight(values, q), cell->diameter());
          }
      }

      /// ContactPoint::direction_error of each of @p points.
      std::vector<double> direction_errors(const std::vector<Gathered<dim>> &points) const
      {
        std::unordered_map<types::global_dof_index, const NodeNormals<dim> *> at_node;
        for (const auto &point : points)
          if (point.shapes.size() == 1)
            at_node[point.shapes[0].dofs[0]] = &point.normals;
        std::vector<double> negative(dof_handler.n_dofs(), 0.); // the least is what processes can agree on
        for (const auto &face : normals_of_faces)
        {
          double error = 0;
          for (const auto &[dof, normal] : face)
            if (const auto node = at_node.find(dof); node != at_node.end())
            {
              double distance = std::numeric_limits<double>::max();
              for (const auto &side : node->second->sides())
                distance = std::min(distance, (normal - side.normal()).norm());
              error = std::max(error, distance);
            }
          for (const auto &[dof, normal] : face)
            negative[dof] = std::min(negative[dof], -error);
        }
        unknowns_on_cuts.minimize(negative.data());
        std::vector<double> errors;
        for (const auto &point : points)
          errors.push_back(point.shapes.size() == 1 ? -negative[point.shapes[0].dofs[0]] : 0.);
        return errors;
      }

      /// Points at nodes with what the faces of all processes add there.
      std::vector<Gathered<dim>> take(const AffineConstraints<double> &hanging_nodes)
      {
        if (!unknowns_on_cuts.processes().alone())
        {
          if (hanging_nodes.n_constraints() > 0)
            hand_over_faces(hanging_nodes);
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
        return std::move(gathered);
      }

    private:
      /// What hand_over_weights() does, before other processes are told: what acts at hanging nodes acts at those that move them.
      void hand_over_faces(const AffineConstraints<double> &hanging_nodes)
      {
        std::set<types::global_dof_index> nodes;
        for (const auto &[dof, face] : at_nodes)
          nodes.insert(dof);
        decltype(at_nodes) handed_over;
        for (const auto &entry : at_nodes)
        {
          const auto        dof = entry.first;
          const auto *const neighbours = hanging_nodes.is_constrained(dof) ? hanging_nodes.get_constraint_entries(dof) : nullptr;
          if (!neighbours || !std::all_of(neighbours->begin(), neighbours->end(), [&](const auto &n) { return nodes.count(n.first) > 0; }))
          {
            handed_over.push_back(entry);
            continue;
          }
          for (const auto &[neighbour, share] : *neighbours)
          {
            FaceAtNode<dim> face = entry.second;
            face.x = gathered[shared.find_or_insert({neighbour}, face.x, 0, gathered.size())].x;
            face.weight *= share;
            handed_over.emplace_back(neighbour, face);
          }
        }
        at_nodes = std::move(handed_over);
      }

      void add(const FEFaceValues<dim> &values, const unsigned q, const double weight, const double diameter)
      {
        Gathered<dim> point;
        point.x = values.quadrature_point(q);
        first_dofs.clear();
        for (unsigned k = 0; k < fe.n_dofs_per_cell() / dim; ++k)
          if (const double value = values.shape_value(fe.component_to_system_index(0, k), q); std::abs(value) > 1e-11)
          {
            point.shapes.push_back({{}, value});
            for (unsigned c = 0; c < dim; ++c)
              point.shapes.back().dofs[c] = dofs[fe.component_to_system_index(c, k)];
            first_dofs.push_back(point.shapes.back().dofs[0]);
          }
        if (first_dofs.size() == 1)
          normals_of_faces.back().emplace_back(first_dofs[0], boundary_normal(values, q));
        const std::size_t index = shared.find_or_insert(first_dofs, point.x, 1e-8 * diameter, gathered.size());
        if (index == gathered.size())
          gathered.push_back(point);
        if (unknowns_on_cuts.processes().alone() || first_dofs.size() > 1)
          gathered[index].normals.add(boundary_normal(values, q), weight);
        else
          at_nodes.push_back({first_dofs[0], {point.x, boundary_normal(values, q), weight}});
      }

      const DoFHandler<dim>               &dof_handler;
      const SharedUnknowns                &unknowns_on_cuts;
      const FiniteElement<dim>            &fe;
      std::vector<Gathered<dim>>           gathered;
      SharedPoints<dim>                    shared;
      std::vector<types::global_dof_index> dofs, first_dofs;

      std::vector<std::pair<types::global_dof_index, FaceAtNode<dim>>>             at_nodes; ///< where several processes may have faces
      std::vector<std::vector<std::pair<types::global_dof_index, Tensor<1, dim>>>> normals_of_faces; ///< at points that are nodes
    };

    template <int dim>
    double largest_weight(const std::vector<Gathered<dim>> &gathered, const Processes &processes)
    {
      double largest = 0;
      for (const auto &point : gathered)
        for (const auto &side : point.normals.sides())
          largest = std::max(largest, side.weight);
      return processes.max(largest);
    }

    constexpr double parallel = 1e-12; ///< a surface that faces a direction by less

    /// The sides at a point that face a direction as one: they are stopped in the same direction. If none does, one of the others.
    template <int dim>
    std::vector<typename NodeNormals<dim>::Side> facing(const Gathered<dim> &point, const Tensor<1, dim> &direction)
    {
      typename NodeNormals<dim>::Side all;
      for (const auto &side : point.normals.sides())
        if (direction * side.normal() > parallel)
        {
          all.sum += side.sum;
          all.weight += side.weight;
        }
      return {all.weight > 0 ? all : point.normals.sides().front()};
    }

    /// v(x).direction.
    template <int dim>
    TraceRow row_along(const Gathered<dim> &point, const Tensor<1, dim> &direction)
    {
      TraceRow row;
      for (const auto &shape : point.shapes)
        for (unsigned c = 0; c < dim; ++c)
          if (std::abs(direction[c]) > 1e-12)
          {
            row.dofs.push_back(shape.dofs[c]);
            row.values.push_back(shape.value * direction[c]);
            row.direction.push_back(direction[c]);
          }
      return row;
    }
  } // namespace

  template <int dim>
  std::vector<ContactPoint<dim>> contact_points(const types::boundary_id             part,
                                                const RuleName                      &rule_name,
                                                const std::optional<Tensor<1, dim>> &given,
                                                const std::optional<RoundSurface>   &round,
                                                const ElementName                   &element,
                                                const Mapping<dim>                  &mapping,
                                                const DoFHandler<dim>               &dof_handler,
                                                const AffineConstraints<double>     &hanging_nodes,
                                                const BilinearForm<dim>             &form,
                                                const SharedUnknowns                &unknowns_on_cuts)
  {
    const Quadrature<dim - 1> rule = quadrature_rule<dim - 1>(rule_name, element);
    PointWeights<dim>         weights(rule, element.simplex(), mapping, dof_handler.get_fe(), form);
    PointsOfFaces<dim>        faces(dof_handler, unknowns_on_cuts);
    faces.add_faces(part, mapping, rule, weights);
    std::vector<Gathered<dim>> gathered = faces.take(hanging_nodes);
    if (hanging_nodes.n_constraints() > 0)
      hand_over_weights(gathered, hanging_nodes);

    const std::vector<double>      errors = faces.direction_errors(gathered);
    const double                   negligible_weight = 1e-12 * largest_weight(gathered, unknowns_on_cuts.processes());
    std::vector<ContactPoint<dim>> points;
    for (std::size_t i = 0; i < gathered.size(); ++i)
    {
      const Gathered<dim>                &from = gathered[i];
      const std::optional<Tensor<1, dim>> direction = given || !round ? given : round->normal(from.x);
      for (const auto &side : direction ? facing(from, *direction) : from.normals.sides())
      {
        if (side.weight <= negligible_weight)
          continue;
        ContactPoint<dim> &point = points.emplace_back();
        point.x = from.x;
        point.faces_away = direction && *direction * side.normal() <= parallel;
        point.direction = direction ? *direction : side.normal();
        point.weight = side.weight;
        point.row = row_along(from, point.direction);
        point.at_node = from.shapes.size() == 1 && !hanging_nodes.is_constrained(from.shapes[0].dofs[0]);
        point.owned = !point.at_node || unknowns_on_cuts.owns(from.shapes[0].dofs[0]);
        point.direction_error = given ? 0. : errors[i];
      }
    }
    return points;
  }

#define INSTANTIATE(dim)                                                                                                                   \
  template std::vector<ContactPoint<dim>> contact_points(                                                                                  \
    types::boundary_id, const RuleName &, const std::optional<Tensor<1, dim>> &, const std::optional<RoundSurface> &, const ElementName &, \
    const Mapping<dim> &, const DoFHandler<dim> &, const AffineConstraints<double> &, const BilinearForm<dim> &, const SharedUnknowns &);
  INSTANTIATE(1)
  INSTANTIATE(2)
  INSTANTIATE(3)
#undef INSTANTIATE
} // namespace unilateral
