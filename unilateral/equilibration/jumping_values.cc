#include "unilateral/equilibration/jumping_values.h"

#include "unilateral/equilibration/jumps.h"

#include <algorithm>
#include <cmath>
#include <vector>

namespace unilateral
{
  using namespace dealii;

  namespace
  {
    /// What is prescribed and not the same everywhere.
    std::vector<const FieldFunction *> varying_values(const PartCondition &condition)
    {
      std::vector<const FieldFunction *> functions;
      if (condition.value)
        functions.push_back(&*condition.value);
      for (const auto &component : condition.components)
        if (component && !condition.rigid)
          functions.push_back(&*component);
      functions.erase(std::remove_if(functions.begin(), functions.end(), [](const auto *function) { return function->is_constant(); }),
                      functions.end());
      return functions;
    }
  } // namespace

  template <int dim>
  bool prescribed_values_jump(const Problem<dim> &problem)
  {
    if (!problem.space.dropped_values.empty())
      return true;
    std::vector<std::vector<const FieldFunction *>> functions; // by boundary_id
    for (const PartCondition &condition : problem.prescribed.conditions)
      functions.push_back(varying_values(condition));

    const auto for_each_value = [&](const auto &act)
    {
      for (const auto &cell : problem.space.mesh.triangulation->active_cell_iterators())
        for (const unsigned f : cell->face_indices())
          if (cell->at_boundary(f))
            for (const FieldFunction *const function : functions[cell->face(f)->boundary_id()])
              if (act(*function, cell, f))
                return true;
      return false;
    };
    double size = 0; // of the values
    for_each_value(
      [&](const FieldFunction &function, const auto &cell, const unsigned f)
      {
        for (const unsigned v : cell->face(f)->vertex_indices())
          size = std::max(size, std::abs(function.value(cell->face(f)->vertex(v))));
        return false;
      });
    return for_each_value(
      [&](const FieldFunction &function, const auto &cell, const unsigned f)
      {
        return jumps_on_face<dim>(
          StraightFace<dim>(cell, f), problem.space.element.simplex(), [&](const Point<dim> &x) { return function.value(x); },
          [&](const ValueAt<dim> &at) { return function.gradient(at.x).norm(); }, size);
      });
  }

  template bool prescribed_values_jump(const Problem<2> &);
  template bool prescribed_values_jump(const Problem<3> &);
} // namespace unilateral
