#include "unilateral/equilibration/jumping_values.h"

#include "unilateral/equilibration/jumping_gaps.h"
#include "unilateral/equilibration/jumps.h"
#include "unilateral/equilibration/straight_face.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <map>
#include <utility>
#include <vector>

namespace unilateral
{
  using namespace dealii;

  namespace
  {
    /// What is prescribed, by component.
    std::vector<std::pair<unsigned, const FieldFunction *>> functions_of(const PartCondition &condition)
    {
      std::vector<std::pair<unsigned, const FieldFunction *>> functions;
      if (condition.value)
        functions.emplace_back(0, &*condition.value);
      for (unsigned c = 0; c < condition.components.size() && !condition.rigid; ++c)
        if (condition.components[c])
          functions.emplace_back(c, &*condition.components[c]);
      return functions;
    }

    template <int dim>
    bool jumps_along_rows(const FieldFunction &function, const StraightFace<dim> &face, const bool simplex, const double size)
    {
      std::vector<double>         values;
      std::vector<Tensor<1, dim>> gradients;
      for (const auto &row : equidistant_rows<dim>(simplex))
      {
        std::vector<Point<dim>> points;
        for (const auto &parameters : row)
          points.push_back(face.at(parameters));
        function.values_and_gradients(points, values, gradients);
        for (std::size_t k = 1; k < points.size(); ++k)
          if (jumps_between<dim>([&](const Point<dim> &x) { return function.value(x); }, {points[k - 1], values[k - 1]},
                                 {points[k], values[k]}, std::max(gradients[k - 1].norm(), gradients[k].norm()), size))
            return true;
      }
      return false;
    }
  } // namespace

  template <int dim>
  bool prescribed_values_jump(const Problem<dim> &problem)
  {
    struct AtVertex
    {
      double value, change; ///< at a point just inside a face, and by what the slope explains up to the vertex
    };
    std::map<std::pair<unsigned, unsigned>, std::vector<AtVertex>> at_vertices; // by vertex and component
    const bool                                                     simplex = problem.space.element.simplex();
    double                                                         size = 0;
    std::vector<double>                                            values;
    std::vector<Tensor<1, dim>>                                    gradients;

    using Act = std::function<void(const typename Triangulation<dim>::active_cell_iterator &, unsigned, unsigned, const FieldFunction &)>;
    const auto for_each_prescribed = [&](const Act &act)
    {
      for (const auto &cell : problem.space.mesh.triangulation->active_cell_iterators())
        for (const unsigned f : cell->face_indices())
          if (cell->at_boundary(f))
            for (const auto &entry : functions_of(problem.prescribed.conditions[cell->face(f)->boundary_id()]))
              act(cell, f, entry.first, *entry.second);
    };
    for_each_prescribed(
      [&](const auto &cell, const unsigned f, const unsigned component, const FieldFunction &function)
      {
        const Point<dim>        center = cell->face(f)->center();
        std::vector<Point<dim>> points;
        for (const unsigned v : cell->face(f)->vertex_indices())
          points.push_back(cell->face(f)->vertex(v) + 1e-6 * (center - cell->face(f)->vertex(v)));
        function.values_and_gradients(points, values, gradients);
        for (const unsigned v : cell->face(f)->vertex_indices())
        {
          size = std::max(size, std::abs(values[v]));
          at_vertices[{cell->face(f)->vertex_index(v), component}].push_back(
            {values[v], gradients[v].norm() * points[v].distance(cell->face(f)->vertex(v))});
        }
      });
    for (const auto &entry : at_vertices)
      for (const AtVertex &other : entry.second)
        if (const AtVertex &first = entry.second[0]; std::abs(other.value - first.value) > 2 * (other.change + first.change) + 1e-5 * size)
          return true;

    bool jumps = false;
    for_each_prescribed(
      [&](const auto &cell, const unsigned f, const unsigned, const FieldFunction &function)
      {
        if (!jumps && !function.is_constant())
          jumps = jumps_along_rows<dim>(function, StraightFace<dim>(cell, f), simplex, size);
      });
    return jumps;
  }

  template bool prescribed_values_jump(const Problem<2> &);
  template bool prescribed_values_jump(const Problem<3> &);
} // namespace unilateral
