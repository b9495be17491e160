#include "unilateral/mesh/make_mesh.h"

#include "unilateral/mesh/gmsh_file.h"
#include "unilateral/mesh/mesh_generators.h"
#include "unilateral/mesh/mesh_of_cells.h"

#include <fmt/format.h>

#include <algorithm>

namespace unilateral
{
  namespace
  {
    /// @p numbers as a point, or InputError naming what they are.
    template <int dim>
    dealii::Point<dim> to_point(const std::vector<double> &numbers, const std::string &what, const SourceLocation &where)
    {
      if (numbers.size() != dim)
        throw InputError(where, fmt::format("{} has {} coordinates, but the mesh is {}-D", what, numbers.size(), dim),
                         MessageName("wrong-length"));
      dealii::Point<dim> p;
      for (unsigned int d = 0; d < dim; ++d)
      {
        if (!std::isfinite(numbers[d]))
          throw InputError(where, fmt::format("{} must be finite numbers", what), MessageName("wrong-type"));
        p[d] = numbers[d];
      }
      return p;
    }

    template <int dim>
    Mesh<dim> box(const MeshDescription &spec, const bool simplex)
    {
      const auto lower = to_point<dim>(spec.box_lower, "the lower corner of the box", spec.where);
      const auto upper = to_point<dim>(spec.box_upper, "the upper corner of the box", spec.where);
      for (unsigned int d = 0; d < dim; ++d)
        if (!(lower[d] < upper[d]))
          throw InputError(spec.where,
                           fmt::format("the box has no extent in {}: {} to {}; give the corner with the smaller coordinates first",
                                       "xyz"[d], lower[d], upper[d]),
                           MessageName("out-of-range"));

      std::vector<unsigned int> cells(spec.cells);
      if (cells.empty())
        cells.assign(dim, 1);
      else if (cells.size() == 1)
        cells.assign(dim, cells.front());
      if (cells.size() != dim)
        throw InputError(spec.where,
                         fmt::format("'cells' has {} numbers, but the box is {}-D; give one number, or one a direction", cells.size(), dim),
                         MessageName("wrong-length"));
      for (const auto n : cells)
        if (n == 0)
          throw InputError(spec.where, "'cells' must be at least 1 in each direction", MessageName("out-of-range"));
      return box_mesh<dim>(lower, upper, cells, simplex);
    }

    template <int dim>
    Mesh<dim> ball(const MeshDescription &spec, const bool simplex)
    {
      const auto center = to_point<dim>(spec.center, "the centre of the ball", spec.where);
      if (!(spec.radius > 0) || !std::isfinite(spec.radius))
        throw InputError(spec.where, fmt::format("the radius of the ball is {}; it must be > 0", spec.radius), MessageName("out-of-range"));
      return ball_mesh<dim>(center, spec.radius, simplex);
    }

    template <int dim>
    Mesh<dim> shell(const MeshDescription &spec, const bool simplex)
    {
      const auto center = to_point<dim>(spec.center, "the centre of the shell", spec.where);
      if (!(spec.inner > 0) || !(spec.inner < spec.outer) || !std::isfinite(spec.outer))
        throw InputError(
          spec.where,
          fmt::format("the radii of the shell are inner = {}, outer = {}; they must satisfy 0 < inner < outer", spec.inner, spec.outer),
          MessageName("out-of-range"));
      if constexpr (dim == 1)
        throw InputError(spec.where, "a shell is 2-D or 3-D; use 'box' for an interval", MessageName("kind-does-not-fit"));
      else
        return shell_mesh<dim>(center, spec.inner, spec.outer, simplex);
    }
  } // namespace

  template <int dim>
  Mesh<dim> make_mesh(const MeshDescription &spec, const bool simplex, const unsigned order)
  {
    switch (spec.source)
    {
    case MeshDescription::Source::none:
      break;
    case MeshDescription::Source::box:
      return box<dim>(spec, simplex);
    case MeshDescription::Source::ball:
      return ball<dim>(spec, simplex);
    case MeshDescription::Source::shell:
      return shell<dim>(spec, simplex);
    case MeshDescription::Source::file:
      return mesh_of_cells<dim>(read_gmsh_file(spec, simplex, order), spec.where);
    case MeshDescription::Source::cells:
      if (dim > 1)
        check_kind_of_cells(spec.cell_list->kind, simplex, spec.where);
      return mesh_of_cells<dim>(*spec.cell_list, spec.where);
    }
    throw InputError(spec.where, "no mesh; add [mesh] with one of box, ball, shell, file", MessageName("missing-key"));
  }

  template Mesh<1> make_mesh<1>(const MeshDescription &, bool, unsigned);
  template Mesh<2> make_mesh<2>(const MeshDescription &, bool, unsigned);
  template Mesh<3> make_mesh<3>(const MeshDescription &, bool, unsigned);
} // namespace unilateral
