#include "unilateral/evaluation/unseen_detail.h"

#include "unilateral/base/byte_archive.h"
#include "unilateral/constraints/quadrature_rule.h"
#include "unilateral/evaluation/value_search.h"
#include "unilateral/mesh/box_around.h"
#include "unilateral/mesh/gauss_rule.h"
#include "unilateral/mesh/subdivided_rule.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <tuple>
#include <utility>

namespace unilateral
{
  using namespace dealii;

  namespace
  {
    constexpr double negligible_share = 0.05;       ///< of the largest value
    constexpr double negligible_share_on_faces = 1; ///< of the boundary, where points are further apart
    constexpr double share_of_range = 0.5;
    /// Of the relative error: a load that is missed may be; and how small a part of the energy norm it always may be.
    constexpr double share_for_loads = 0.3, least_missed = 1e-6;
    /// The cell is left at its sides, where a neighbour may have other values.
    constexpr double margin = 1e-4;

    /// A function that is looked at in cells, or at the faces of a part.
    struct Datum
    {
      FieldFunction                     function;
      std::string                       what;
      std::optional<types::material_id> region;
      std::optional<types::boundary_id> part;
      double                            negligible = negligible_share; ///< of the largest value
      bool                              is_bound = false;
      Side                              side = Side::upper;
      bool                              of_body = false; ///< a bound of u.n
      RuleName                          rule;            ///< of a bound
      std::vector<double>               direction;       ///< of a bound of a body, see UnilateralCondition
    };

    /// What the points of a cell or face show of a function, and what is new beside it.
    template <int dim>
    class Search
    {
    public:
      /// @p scale: of the values, of a bound of u.
      Search(const Problem<dim> &problem, const Datum &datum, const double scale)
        : datum(datum), tolerance(datum.negligible * scale), simplex(problem.space.element.simplex() || dim == 1)
      {
        const ElementName &element = problem.space.element;
        if (datum.part)
        {
          if constexpr (dim > 1)
          {
            if (datum.is_bound)
              weigh_corners<dim - 1>({quadrature_rule<dim - 1>(datum.rule, element).get_points()});
            else // see AdaptedFaceValues
              weigh_corners<dim - 1>({subdivided(problem.face_quadrature(), element.simplex(), 1).get_points()});
          }
          return;
        }
        const bool of_simplices = element.simplex();
        const auto gauss = [&](const unsigned n) { return gauss_rule<dim>(of_simplices, n); };
        // Where the bound of the error looks closer, at loads and near obstacles.
        const auto closer = subdivided(gauss(element.degree + 3), of_simplices, dim == 3 ? 1 : 2).get_points();
        if (datum.what == "load")
          weigh_corners<dim>({gauss(element.degree + 2).get_points(), closer});
        else
          weigh_corners<dim>({gauss(element.degree + 2).get_points()});
      }

      /// Every value is close to that in the middle.
      bool hardly_varies(const std::vector<Point<dim>> &vertices) const
      {
        const auto range = range_on(datum.function, vertices);
        const auto value = value_if_any(datum.function, centre_of(vertices));
        return !range || (value && range->inside(around(Interval::of(*value))));
      }

      /// @p vertices of a cell or face, @p u: its values there, of no matter where the function is no bound.
      std::optional<std::pair<Point<dim>, double>> find(std::vector<Point<dim>> vertices, const Interval &u)
      {
        const Point<dim> centre = centre_of(vertices);
        for (Point<dim> &x : vertices)
          x += margin * (centre - x);
        if (hardly_varies(vertices))
          return {};
        const Interval range = *range_on(datum.function, vertices);
        seen = Interval::none();
        for (const auto &rule : corner_weights)
        {
          seen = hull(seen, values_at(rule, vertices));
          if (seen.empty() || range.inside(known_beside(seen, u)))
            return {};
        }
        return find_value_outside(known_beside(seen, u), datum.function, vertices, simplex);
      }

      /// In the cell in which something was found, of the values that are as far from those at its points.
      double mean_square_unseen(const std::vector<Point<dim>> &vertices) const
      {
        return mean_square_outside(around(seen), datum.function, vertices, simplex);
      }

      Interval seen; ///< by the points of the cell in which something was found

    private:
      static Point<dim> centre_of(const std::vector<Point<dim>> &vertices)
      {
        Point<dim> centre;
        for (const Point<dim> &x : vertices)
          centre += x / double(vertices.size());
        return centre;
      }

      /// With the differences that do not count.
      Interval around(const Interval &seen) const
      {
        const double rounding = 1e-12 * std::max(std::abs(seen.least), std::abs(seen.most));
        const double slack = tolerance + rounding + share_of_range * (seen.most - seen.least);
        return {seen.least - slack, seen.most + slack};
      }

      /// Of a bound, all values on its own side of u belong to it; and where it is away from u at all points, however much it varies there,
      /// those that reach u do not.
      Interval known_beside(const Interval &seen, const Interval &u) const
      {
        const Interval near = around(seen);
        if (!datum.is_bound)
          return near;
        if (datum.side == Side::lower)
          return {-Interval::infinity, seen.most < u.least ? u.most + tolerance : std::max(near.most, u.most + tolerance)};
        return {seen.least > u.most ? u.least - tolerance : std::min(near.least, u.least - tolerance), Interval::infinity};
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

      /// At the points of a rule, and at the corners. Of the load of cells what is at the corners alone is in no integral.
      Interval values_at(const std::vector<double> &weights, const std::vector<Point<dim>> &vertices) const
      {
        std::vector<Point<dim>> points;
        if (datum.what != "load")
          points = vertices;
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
            if (const auto value = value_if_any(datum.function, x))
              values.push_back(*value);
        }
        Interval seen = Interval::none();
        for (const double value : values)
          seen = hull(seen, Interval::of(value));
        return seen;
      }

      const Datum                     &datum;
      const double                     tolerance;
      const bool                       simplex;
      std::vector<std::vector<double>> corner_weights; ///< by rule: points x corners
    };

    /// What can be searched: not the same everywhere, and known to interval arithmetic.
    class Data
    {
    public:
      void add(const FieldFunction &function, Datum datum)
      {
        if (function.is_constant() || !function.range({}))
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
      const auto &parts = problem.space.mesh.part_names;
      for (types::boundary_id part = 0; part < parts.size(); ++part)
        if (problem.form->has_face_terms(part)) // not those of cuts
          for (const FieldFunction &function : problem.form->face_functions(part))
          {
            Datum datum;
            datum.what = "data on " + parts[part];
            datum.part = part;
            datum.negligible = negligible_share_on_faces;
            data.add(function, datum);
          }
      for (const UnilateralCondition &condition : problem.conditions)
      {
        if (condition.surface || !condition.part) // see crossed_bounds()
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

    /// The largest value; of the components of a vector the same for all.
    template <int dim>
    double scale_of(const Problem<dim> &problem, const std::vector<Datum> &data, const Datum &datum, const Vector &u)
    {
      double     largest = 0;
      const auto take = [&](const FieldFunction &function, const Point<dim> &x)
      { largest = std::max(largest, std::abs(value_if_any(function, x).value_or(0))); };
      if (datum.is_bound)
        largest = u.linfty_norm();
      else if (datum.part)
      {
        for (const auto &cell : problem.space.mesh.triangulation->active_cell_iterators())
          for (const auto f : cell->face_indices())
            if (cell->at_boundary(f) && cell->face(f)->boundary_id() == *datum.part)
              take(datum.function, cell->face(f)->center());
      }
      else
        for (const Datum &other : data)
          for (const auto &cell : problem.space.mesh.triangulation->active_cell_iterators())
            if (other.what == datum.what && cell->material_id() == *other.region)
              take(other.function, cell->center());
      return problem.space.processes().max(largest);
    }

    template <int dim>
    UnseenDetail detail(const Datum &datum, const std::pair<Point<dim>, double> &found, const Interval &seen, const std::size_t cell)
    {
      UnseenDetail result{datum.what, datum.function.where(), {}, found.second, seen.least, seen.most, cell};
      for (unsigned d = 0; d < dim; ++d)
        result.x[d] = found.first[d];
      return result;
    }

    /// Calls action(cell, found, search) where something is found in a cell; those that have come from a cell where the function
    /// hardly varies are left out.
    template <int dim, typename Action>
    void search_cells(const Problem<dim> &problem, const Datum &datum, const double scale, const Action &action)
    {
      Search<dim> search(problem, datum, scale);
      const auto  look_into = [&](const auto &self, const typename Triangulation<dim>::cell_iterator &cell) -> void
      {
        if (!cell->is_active())
        {
          if (search.hardly_varies(vertices_of<dim>(cell)))
            return;
          for (unsigned child = 0; child < cell->n_children(); ++child)
            self(self, cell->child(child));
          return;
        }
        if (datum.region && cell->material_id() != *datum.region)
          return;
        if (const auto found = search.find(vertices_of<dim>(cell), Interval()))
          action(cell, *found, search);
      };
      for (const auto &cell : problem.space.mesh.triangulation->cell_iterators_on_level(0))
        look_into(look_into, cell);
    }

    /// Of a load its extent counts, too: a jump cuts off a corner of a cell that no point shows. A load f_K that is missed in cells K, and
    /// that makes up for itself there, is a part of at most sum (h_K / diameter)^2 |f_K|^2 / |f|^2 of the square of the energy norm, where
    /// the load works as it can at most.
    template <int dim>
    void search_for_loads(
      const Problem<dim> &problem, const Datum &datum, const double scale, const double relative_error, UnseenDetails &result)
    {
      const Processes &processes = problem.space.processes();
      const auto [lower, upper] = box_around(*problem.space.mesh.triangulation, processes);
      const double                                 diameter = lower.distance(upper);
      std::vector<std::pair<double, UnseenDetail>> found_in_cells; // |f_K|^2 (h_K / diameter)^2
      double                                       missed = 0, whole = 0;
      search_cells(problem, datum, scale,
                   [&](const auto &cell, const auto &found, const Search<dim> &search)
                   {
                     const double share =
                       search.mean_square_unseen(vertices_of<dim>(cell)) * cell->measure() * std::pow(cell->diameter() / diameter, 2);
                     missed += share;
                     found_in_cells.emplace_back(share, detail(datum, found, search.seen, cell->active_cell_index()));
                   });
      for (const auto &cell : problem.space.mesh.triangulation->active_cell_iterators())
        if (cell->material_id() == *datum.region)
          whole += std::pow(value_if_any(datum.function, cell->center()).value_or(0), 2) * cell->measure();
      missed = processes.sum(missed);
      whole = processes.sum(whole);
      if (missed <= std::pow(std::max(share_for_loads * relative_error, least_missed), 2) * whole)
        return;
      constexpr double worth_refining = 0.01;
      for (auto &[share, unseen] : found_in_cells)
        if (share >= worth_refining * missed)
        {
          result.missed_loads.push_back({unseen.cell, whole > 0 ? std::min(1., share / whole) : 1});
          result.details.push_back(std::move(unseen));
        }
    }

    template <int dim>
    void
    search_faces(const Problem<dim> &problem, const Datum &datum, const double scale, const Vector &u, std::vector<UnseenDetail> &details)
    {
      Search<dim> search(problem, datum, scale);
      for (const auto &cell : problem.space.dof_handler.active_cell_iterators())
        for (const auto f : cell->face_indices())
          if (cell->at_boundary(f) && cell->face(f)->boundary_id() == *datum.part)
            if (const auto found =
                  search.find(vertices_of<dim>(cell->face(f)), datum.is_bound ? values_on_face<dim>(cell, f, u, datum) : Interval()))
              details.push_back(detail(datum, *found, search.seen, cell->active_cell_index()));
    }
  } // namespace

  template <int dim>
  UnseenDetails unseen_details(const Problem<dim> &problem, const Vector &u, const double relative_error)
  {
    UnseenDetails result;
    if (problem.form->order() != 1 || problem.space.mesh.curved || problem.space.mesh.curved_cells)
      return result;
    const auto data = data_of(problem);
    for (const Datum &datum : data)
    {
      const double scale = scale_of(problem, data, datum, u);
      if (!datum.part)
      {
        if (datum.what == "load")
          search_for_loads(problem, datum, scale, relative_error, result);
        else
          search_cells(problem, datum, scale,
                       [&](const auto &cell, const auto &found, const Search<dim> &search)
                       { result.details.push_back(detail(datum, found, search.seen, cell->active_cell_index())); });
      }
      else if (dim > 1)
        search_faces(problem, datum, scale, u, result.details);
    }
    return result;
  }

  template <int dim>
  double add_missed_loads(const Problem<dim> &problem, const UnseenDetails &unseen, const double norm, std::vector<double> &cell_squares)
  {
    double sum = 0;
    for (const auto &load : unseen.missed_loads)
    {
      const double square = norm * norm * load.relative_square;
      cell_squares[load.cell] += square;
      sum += square;
    }
    return std::sqrt(problem.space.processes().sum(sum));
  }

  std::vector<UnseenDetail> one_of_each_function(const std::vector<UnseenDetail> &own, const Processes &processes)
  {
    const auto transfer = [](auto &archive, auto &detail)
    {
      archive(detail.what);
      archive(detail.where.file);
      archive(detail.where.line);
      archive(detail.where.column);
      for (unsigned d = 0; d < 3; ++d)
        archive(detail.x[d]);
      archive(detail.value);
      archive(detail.least);
      archive(detail.most);
    };
    const auto first_of_each = [](const std::vector<UnseenDetail> &details)
    {
      std::set<std::tuple<std::string, unsigned, unsigned>> known;
      std::vector<UnseenDetail>                             firsts;
      for (const UnseenDetail &detail : details)
        if (known.emplace(detail.what, detail.where.line, detail.where.column).second)
          firsts.push_back(detail);
      return firsts;
    };
    ByteWriter writer;
    for (const UnseenDetail &detail : first_of_each(own))
      transfer(writer, detail);
    const std::vector<char>   bytes = processes.gather(writer.bytes);
    std::vector<UnseenDetail> all;
    for (ByteReader reader(bytes); !reader.at_end();)
      transfer(reader, all.emplace_back());
    return first_of_each(all);
  }

#define INSTANTIATE(dim)                                                                                                                   \
  template UnseenDetails unseen_details(const Problem<dim> &, const Vector &, double);                                                     \
  template double        add_missed_loads(const Problem<dim> &, const UnseenDetails &, double, std::vector<double> &);
  INSTANTIATE(1)
  INSTANTIATE(2)
  INSTANTIATE(3)
#undef INSTANTIATE
} // namespace unilateral
