#include "unilateral/mesh/nodes_of_refinement.h"

#include <deal.II/grid/tria_accessor.h>
#include <deal.II/grid/tria_iterator.h>

namespace unilateral
{
  using namespace dealii;

  template <int dim>
  std::size_t n_new_nodes(Triangulation<dim> &triangulation, const std::vector<bool> &chosen, const unsigned degree)
  {
    for (const auto &cell : triangulation.active_cell_iterators())
      if (chosen[cell->active_cell_index()])
        cell->set_refine_flag();
    triangulation.prepare_coarsening_and_refinement();

    // A line or face keeps its own nodes as long as a cell that is not refined further has it, beside those of its children: then these
    // hang.
    std::vector<bool> line_stays, face_stays; // of a line the lines are not numbered
    if constexpr (dim > 1)
      line_stays.resize(triangulation.n_raw_lines(), false);
    if constexpr (dim == 3)
      face_stays.resize(triangulation.n_raw_faces(), false);
    const auto keep_lines = [&](const auto &object)
    {
      for (unsigned l = 0; l < object->n_lines(); ++l)
        line_stays[object->line(l)->index()] = true;
    };
    for (const auto &cell : triangulation.active_cell_iterators())
    {
      const bool refined = cell->refine_flag_set();
      if constexpr (dim > 1)
      {
        if (!refined)
          keep_lines(cell);
        for (unsigned l = 0; l < cell->n_lines() && refined; ++l)
          for (unsigned child = 0; child < cell->line(l)->n_children(); ++child)
            line_stays[cell->line(l)->child_index(child)] = true;
      }
      if constexpr (dim == 3)
        for (const unsigned f : cell->face_indices())
        {
          if (!refined)
            face_stays[cell->face(f)->index()] = true;
          for (unsigned child = 0; child < cell->face(f)->n_children() && refined; ++child)
          {
            face_stays[cell->face(f)->child_index(child)] = true;
            keep_lines(cell->face(f)->child(child));
          }
        }
    }

    // Inside a line, face or cell lie (2 p - 1)^n nodes after it is cut in n directions, and (p - 1)^n before.
    const std::ptrdiff_t before = degree - 1, after = 2 * degree - 1;
    std::vector<bool>    line_counted(line_stays.size(), false), face_counted(face_stays.size(), false);
    std::ptrdiff_t       n = 0;
    for (const auto &cell : triangulation.active_cell_iterators())
    {
      if (!cell->refine_flag_set())
        continue;
      n += dim == 1 ? after - before : dim == 2 ? after * after - before * before : after * after * after - before * before * before;
      if constexpr (dim > 1)
        for (unsigned l = 0; l < cell->n_lines(); ++l)
        {
          const auto line = cell->line(l);
          if (line_counted[line->index()])
            continue;
          line_counted[line->index()] = true;
          n += (line->has_children() ? 0 : after) - (line_stays[line->index()] ? 0 : before);
        }
      if constexpr (dim == 3)
        for (const unsigned f : cell->face_indices())
        {
          const auto face = cell->face(f);
          if (face_counted[face->index()])
            continue;
          face_counted[face->index()] = true;
          n += (face->has_children() ? 0 : after * after) - (face_stays[face->index()] ? 0 : before * before);
        }
    }
    for (const auto &cell : triangulation.active_cell_iterators())
      cell->clear_refine_flag();
    return std::size_t(n);
  }

  template std::size_t n_new_nodes(Triangulation<1> &, const std::vector<bool> &, unsigned);
  template std::size_t n_new_nodes(Triangulation<2> &, const std::vector<bool> &, unsigned);
  template std::size_t n_new_nodes(Triangulation<3> &, const std::vector<bool> &, unsigned);
} // namespace unilateral
