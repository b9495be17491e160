#include "unilateral/evaluation/unseen_detail.h"

#include "unilateral/constraints/quadrature_rule.h"
#include "unilateral/mesh/gauss_rule.h"
#include "unilateral/mesh/subdivided_rule.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <map>
#include <optional>
#include <string>

namespace unilateral
{
  using namespace dealii;

  namespace
  {
    constexpr double negligible_share = 0.05; ///< of the largest value
    /// Of a load its integral counts, and what lies between the points is a small part of a cell, as the corner that a jump cuts off.
    constexpr double negligible_share_of_load = 5;
    constexpr double share_of_range = 0.5;
    /// The cell is left at its sides, where a neighbour may have other values.
    constexpr double margin = 1e-4;

    /// A function that is looked at in cells, or at the faces of a part.
    struct Datum
    {
      FieldFunction                     function;
      std::string                       what;
      std::optional<types::material_id> region;
      std::optional<types::boundary_id> part;
      bool                              is_bound = false;
      Side                              side = Side::upper;
      bool                              of_body = false; ///< a bound of u.n
      RuleName                          rule;            ///< of a bound
      std::vector<double>               direction;       ///< of a bound of a body, see UnilateralCondition
    };

    using Box = std::array<Interval, 3>;

    template <int dim>
    Box box_of(const std::vector<Point<dim>> &vertices)
    {
      Box box{};
      for (unsigned d = 0; d < dim; ++d)
      {
        box[d] = Interval::of(vertices[0][d]);
        for (const Point<dim> &x : vertices)
          box[d] = hull(box[d], Interval::of(x[d]));
      }
      return box;
    }

    template <int dim>
    Point<dim> centre_of(const std::vector<Point<dim>> &vertices)
    {
      Point<dim> centre;
      for (const Point<dim> &x : vertices)
        centre += x / double(vertices.size());
      return centre;
    }

    /// Halves of a segment, triangle or tetrahedron: at the middle of its longest edge.
    template <int dim>
    std::array<std::vector<Point<dim>>, 2> halves_of_simplex(const std::vector<Point<dim>> &vertices)
    {
      unsigned a = 0, b = 1;
      for (unsigned i = 0; i < vertices.size(); ++i)
        for (unsigned j = i + 1; j < vertices.size(); ++j)
          if (vertices[i].distance_square(vertices[j]) > vertices[a].distance_square(vertices[b]))
          {
            a = i;
            b = j;
          }
      const Point<dim>                       middle = centre_of<dim>({vertices[a], vertices[b]});
      std::array<std::vector<Point<dim>>, 2> halves = {vertices, vertices};
      halves[0][b] = middle;
      halves[1][a] = middle;
      return halves;
    }

    /// Of a quadrilateral or hexahedron, vertices in lexicographic order: across its longest direction.
    template <int dim>
    std::array<std::vector<Point<dim>>, 2> halves_of_hypercube(const std::vector<Point<dim>> &vertices)
    {
      unsigned direction = 0;
      double   longest = -1;
      for (unsigned d = 0; 1u << d < vertices.size(); ++d)
        if (const double length = vertices[0].distance_square(vertices[1u << d]); length > longest)
        {
          longest = length;
          direction = d;
        }
      std::array<std::vector<Point<dim>>, 2> halves = {vertices, vertices};
      for (unsigned v = 0; v < vertices.size(); ++v)
      {
        const unsigned lower = v & ~(1u << direction), upper = v | 1u << direction;
        halves[v & 1u << direction ? 0 : 1][v] = centre_of<dim>({vertices[lower], vertices[upper]});
      }
      return halves;
    }

    template <int dim>
    class Search
    {
    public:
      Search(const Problem<dim> &problem, const Datum &datum, const double scale)
        : datum(datum), tolerance((datum.what == "load" ? negligible_share_of_load : negligible_share) * scale),
          simplex(problem.space.element.simplex() || dim == 1)
      {
        const ElementName &element = problem.space.element;
        if (datum.is_bound && datum.part)
        {
          if constexpr (dim > 1)
            weigh_corners<dim - 1>({quadrature_rule<dim - 1>(datum.rule, element).get_points()});
        }
        else if (datum.is_bound)
          weigh_corners<dim>({quadrature_rule<dim>(datum.rule, element).get_points()});
        else if (datum.what == "load") // the bound of the error looks at more
          weigh_corners<dim>(
            {gauss_rule<dim>(element.simplex(), element.degree + 2).get_points(),
             subdivided(gauss_rule<dim>(element.simplex(), element.degree + 3), element.simplex(), dim == 3 ? 1 : 2).get_points()});
        else
          weigh_corners<dim>({gauss_rule<dim>(element.simplex(), element.degree + 2).get_points()});
      }

      /// All values on the box are near that in its middle, or a bound leaves room.
      bool is_plain(const std::vector<Point<dim>> &vertices, const Interval &u) const
      {
        const auto range = datum.function.range(box_of<dim>(vertices));
        const auto value = value_at(centre_of<dim>(vertices));
        return !range || (value && range->inside(band(Interval::of(*value), u)));
      }

      /// @p vertices of a cell or face, @p u: its values there.
      std::optional<std::pair<Point<dim>, double>> find(std::vector<Point<dim>> vertices, const Interval &u)
      {
        const Point<dim> centre = centre_of<dim>(vertices);
        for (Point<dim> &x : vertices)
          x += margin * (centre - x);
        if (is_plain(vertices, u))
          return {};
        const Interval range = *datum.function.range(box_of<dim>(vertices));
        for (const auto &rule : corner_weights)
        {
          seen = values_at(rule, vertices);
          if (seen.empty() || range.inside(band(seen, u)))
            return {};
        }
        n_left = most_steps;
        found.reset();
        look_at(vertices, band(seen, u), 0);
        return found;
      }

      Interval seen; ///< by the points of the cell in which something was found

    private:
      static constexpr unsigned most_steps = 400, most_halvings = dim == 3 ? 15 : 8 * dim;

      /// None where the function has no value, as at a pole: nobody else may ask for one there.
      std::optional<double> value_at(const Point<dim> &x) const
      {
        try
        {
          return datum.function.value(x);
        }
        catch (const InputError &)
        {
          return {};
        }
      }

      /// Values that are nothing new beside those that were @p seen.
      Interval band(const Interval &seen, const Interval &u) const
      {
        const double rounding = 1e-12 * std::max(std::abs(seen.least), std::abs(seen.most));
        const double slack = tolerance + rounding + share_of_range * (seen.most - seen.least);
        Interval     band = {seen.least - slack, seen.most + slack};
        // Of a bound only what u is beyond is new; where the points show that it is away from u, how much it varies is no matter.
        if (datum.is_bound && !u.empty() && datum.side == Side::lower)
          band = {-Interval::infinity, seen.most < u.least ? u.most + tolerance : std::max(band.most, u.most + tolerance)};
        else if (datum.is_bound && !u.empty())
          band = {seen.least > u.most ? u.least - tolerance : std::min(band.least, u.least - tolerance), Interval::infinity};
        return band;
      }

      /// Of the points of rules on a reference cell or face.
      template <int n>
      void weigh_corners(const std::vector<std::vector<Point<n>>> &rules)
      {
        const auto cell = simplex ? ReferenceCells::get_simplex<n>() : ReferenceCells::get_hypercube<n>();
        for (const auto &points : rules)
        {
          auto &weights = corner_weights.emplace_back();
          for (const Point<n> &x : points)
            for (const unsigned v : cell.vertex_indices())
              weights.push_back(cell.d_linear_shape_function(x, v));
        }
      }

      /// At the corners and the points of a rule.
      Interval values_at(const std::vector<double> &weights, const std::vector<Point<dim>> &vertices) const
      {
        std::vector<Point<dim>> points = vertices;
        for (std::size_t k = 0; k < weights.size();)
        {
          Point<dim> x;
          for (const Point<dim> &vertex : vertices)
            x += weights[k++] * vertex;
          points.push_back(x);
        }
        std::vector<double> values;
        try
        {
          datum.function.values(points, values);
        }
        catch (const InputError &) // a pole: one by one
        {
          values.clear();
          for (const Point<dim> &x : points)
            if (const auto value = value_at(x))
              values.push_back(*value);
        }
        Interval seen = Interval::none();
        for (const double value : values)
          seen = hull(seen, Interval::of(value));
        return seen;
      }

      void look_at(const std::vector<Point<dim>> &part, const Interval &known, const unsigned n_halvings)
      {
        if (found || n_left == 0)
          return;
        --n_left;
        if (datum.function.range(box_of<dim>(part))->inside(known))
          return;
        const Point<dim> centre = centre_of<dim>(part);
        if (const auto value = value_at(centre); value && !known.contains(*value))
        {
          found = {centre, *value};
          return;
        }
        if (n_halvings == most_halvings)
          return;
        const bool by_corners = simplex || part.size() == 3;
        for (const auto &half : by_corners ? halves_of_simplex<dim>(part) : halves_of_hypercube<dim>(part))
          look_at(half, known, n_halvings + 1);
      }

      const Datum                                 &datum;
      const double                                 tolerance;
      const bool                                   simplex;
      std::vector<std::vector<double>>             corner_weights; ///< by rule: points x corners
      unsigned                                     n_left = 0;
      std::optional<std::pair<Point<dim>, double>> found;
    };

    /// What can be searched: not the same everywhere, and known to interval arithmetic.
    class Data
    {
    public:
      void add(const FieldFunction &function, Datum datum)
      {
        if (function.is_constant() || !function.range(Box{}))
          return;
        datum.function = function;
        all.push_back(std::move(datum));
      }
      void add(const std::optional<FieldFunction> &function, const Datum &datum)
      {
        if (function)
          add(*function, datum);
      }
      template <typename Function>
      void add(const std::optional<std::vector<Function>> &functions, const Datum &datum)
      {
        if (functions)
          for (const auto &function : *functions)
            add(function, datum);
      }

      std::vector<Datum> all;
    };

    template <int dim>
    std::vector<Datum> data_of(const Problem<dim> &problem)
    {
      Data        data;
      const auto &statement = problem.statement;
      const auto &names = problem.space.mesh.region_names;
      for (types::material_id region = 0; region < names.size(); ++region)
      {
        Coefficients c = statement.model.coefficients;
        for (const Material &material : statement.materials)
          if (material.region == names[region])
          {
            const auto take = [](auto &into, const auto &from)
            {
              if (from)
                into = from;
            };
            take(c.stiffness, material.coefficients.stiffness);
            take(c.reaction, material.coefficients.reaction);
            take(c.young, material.coefficients.young);
            take(c.poisson, material.coefficients.poisson);
            take(c.load, material.coefficients.load);
          }
        const auto of = [region](const char *const what)
        {
          Datum datum;
          datum.what = what;
          datum.region = region;
          return datum;
        };
        data.add(c.stiffness, of("stiffness"));
        data.add(c.reaction, of("reaction"));
        data.add(c.young, of("young"));
        data.add(c.poisson, of("poisson"));
        data.add(c.load, of("load"));
      }
      for (const UnilateralCondition &condition : problem.conditions)
      {
        if (condition.surface)
          continue;
        Datum datum;
        datum.what = problem.form->n_components() > 1 ? "gap" : "bound";
        datum.part = condition.part;
        datum.is_bound = true;
        datum.side = condition.side;
        datum.rule = condition.rule;
        datum.direction = condition.direction;
        datum.of_body = problem.form->n_components() > 1;
        data.add(condition.bound, datum);
      }
      return data.all;
    }

    template <int dim>
    Interval values_on(const typename DoFHandler<dim>::active_cell_iterator &cell, const Vector &u)
    {
      std::vector<types::global_dof_index> dofs(cell->get_fe().n_dofs_per_cell());
      cell->get_dof_indices(dofs);
      Interval values = Interval::of(u(dofs[0]));
      for (const auto dof : dofs)
        values = hull(values, Interval::of(u(dof)));
      return values;
    }

    /// The direction in which a face is bounded: the given one, or its outward normal.
    template <int dim>
    Tensor<1, dim> direction_at(const typename DoFHandler<dim>::active_cell_iterator &cell, const unsigned f, const Datum &datum)
    {
      Tensor<1, dim> n;
      if (!datum.direction.empty())
      {
        for (unsigned d = 0; d < dim; ++d)
          n[d] = datum.direction[d];
        return n;
      }
      const auto face = cell->face(f);
      if constexpr (dim == 2)
        n = cross_product_2d(face->vertex(1) - face->vertex(0));
      else if constexpr (dim == 3)
        n = cross_product_3d(face->vertex(1) - face->vertex(0), face->vertex(2) - face->vertex(0));
      return n * ((face->center() - cell->center()) * n > 0 ? 1. : -1.) / n.norm();
    }

    /// u, or u.n of a body, at the nodes of a face.
    template <int dim>
    Interval
    values_on_face(const typename DoFHandler<dim>::active_cell_iterator &cell, const unsigned f, const Vector &u, const Datum &datum)
    {
      const auto                          &fe = cell->get_fe();
      std::vector<types::global_dof_index> dofs(fe.n_dofs_per_cell());
      cell->get_dof_indices(dofs);
      const Tensor<1, dim>       n = direction_at<dim>(cell, f, datum);
      std::map<unsigned, double> at_node;
      for (unsigned i = 0; i < dofs.size(); ++i)
        if (fe.has_support_on_face(i, f))
        {
          const auto [component, node] = fe.system_to_component_index(i);
          at_node[node] += u(dofs[i]) * (datum.of_body ? n[component] : 1.);
        }
      Interval values = Interval::none();
      for (const auto &[node, value] : at_node)
        values = hull(values, Interval::of(value));
      return values;
    }

    template <int dim, typename Object>
    std::vector<Point<dim>> vertices_of(const Object &object)
    {
      std::vector<Point<dim>> vertices;
      for (const unsigned v : object->vertex_indices())
        vertices.push_back(object->vertex(v));
      return vertices;
    }

    /// The largest value; of the components of a vector the same for all.
    template <int dim>
    double scale_of(const Problem<dim> &problem, const std::vector<Datum> &data, const Datum &datum, const Vector &u)
    {
      double largest = 0;
      if (datum.is_bound)
        largest = u.linfty_norm();
      else
        for (const Datum &other : data)
          for (const auto &cell : problem.space.mesh.triangulation->active_cell_iterators())
            if (other.what == datum.what && cell->material_id() == *other.region)
              try
              {
                largest = std::max(largest, std::abs(other.function.value(cell->center())));
              }
              catch (const InputError &) // a pole
              {
              }
      return problem.space.processes().max(largest);
    }

    /// In cells, whole subtrees of which are passed over where the function is plain.
    template <int dim>
    void
    search_cells(const Problem<dim> &problem, const Datum &datum, const double scale, const Vector &u, std::vector<UnseenDetail> &details)
    {
      Search<dim> search(problem, datum, scale);
      const auto  nothing_known = Interval::none();
      const auto  look_into = [&](const auto &self, const typename Triangulation<dim>::cell_iterator &cell) -> void
      {
        if (!cell->is_active())
        {
          if (search.is_plain(vertices_of<dim>(cell), nothing_known))
            return;
          for (unsigned child = 0; child < cell->n_children(); ++child)
            self(self, cell->child(child));
          return;
        }
        if (datum.region && cell->material_id() != *datum.region)
          return;
        const typename DoFHandler<dim>::active_cell_iterator with_unknowns(&*problem.space.mesh.triangulation, cell->level(), cell->index(),
                                                                           &problem.space.dof_handler);
        const auto found = search.find(vertices_of<dim>(cell), datum.is_bound ? values_on<dim>(with_unknowns, u) : nothing_known);
        if (found)
          details.push_back(
            {datum.what, datum.function.where(), {}, found->second, search.seen.least, search.seen.most, cell->active_cell_index()});
        for (unsigned d = 0; d < dim && found; ++d)
          details.back().x[d] = found->first[d];
      };
      for (const auto &cell : problem.space.mesh.triangulation->cell_iterators_on_level(0))
        look_into(look_into, cell);
    }

    template <int dim>
    void
    search_faces(const Problem<dim> &problem, const Datum &datum, const double scale, const Vector &u, std::vector<UnseenDetail> &details)
    {
      Search<dim> search(problem, datum, scale);
      for (const auto &cell : problem.space.dof_handler.active_cell_iterators())
        for (const auto f : cell->face_indices())
          if (cell->at_boundary(f) && cell->face(f)->boundary_id() == *datum.part)
            if (const auto found = search.find(vertices_of<dim>(cell->face(f)), values_on_face<dim>(cell, f, u, datum)))
            {
              details.push_back(
                {datum.what, datum.function.where(), {}, found->second, search.seen.least, search.seen.most, cell->active_cell_index()});
              for (unsigned d = 0; d < dim; ++d)
                details.back().x[d] = found->first[d];
            }
    }
  } // namespace

  template <int dim>
  std::vector<UnseenDetail> unseen_details(const Problem<dim> &problem, const Vector &u)
  {
    std::vector<UnseenDetail> details;
    if (problem.form->order() != 1 || problem.space.mesh.curved || problem.space.mesh.curved_cells)
      return details;
    const auto data = data_of(problem);
    for (const Datum &datum : data)
    {
      const double scale = scale_of(problem, data, datum, u);
      if (!datum.part)
        search_cells(problem, datum, scale, u, details);
      else if (dim > 1)
        search_faces(problem, datum, scale, u, details);
    }
    return details;
  }

#define INSTANTIATE(dim) template std::vector<UnseenDetail> unseen_details(const Problem<dim> &, const Vector &);
  INSTANTIATE(1)
  INSTANTIATE(2)
  INSTANTIATE(3)
#undef INSTANTIATE
} // namespace unilateral
