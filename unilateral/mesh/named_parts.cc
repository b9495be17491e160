#include "unilateral/mesh/named_parts.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <optional>

namespace unilateral
{
  using namespace dealii;

  namespace
  {
    template <int dim>
    std::string text_of(const Point<dim> &p)
    {
      std::vector<double> coordinates(dim);
      for (unsigned d = 0; d < dim; ++d)
        coordinates[d] = p[d];
      return fmt::format("({:.6g})", fmt::join(coordinates, ", "));
    }

    /// All of the face is on the same side as its centre: so are points next to its vertices.
    template <int dim, typename Face>
    bool is_cut(const Face &face, const FieldFunction &where, const bool centre_belongs)
    {
      if constexpr (dim > 1)
      {
        const Point<dim> centre = face->center();
        for (const unsigned v : face->vertex_indices())
        {
          const Point<dim> near_vertex = face->vertex(v) + 0.01 * (centre - face->vertex(v));
          if ((where.value(near_vertex) != 0) != centre_belongs)
            return true;
        }
      }
      return false;
    }

    template <int dim>
    void name_part(Mesh<dim> &mesh, const PartByPlace<FieldFunction> &part, Diagnostics &diagnostics)
    {
      const auto               known = std::find(mesh.part_names.begin(), mesh.part_names.end(), part.name);
      const types::boundary_id id = known - mesh.part_names.begin();
      std::size_t              n_faces = 0, n_cut = 0;
      if (known == mesh.part_names.end())
        mesh.part_names.push_back(part.name);
      std::optional<Point<dim>> first_cut;
      for (const auto &cell : mesh.triangulation->active_cell_iterators())
        for (const unsigned f : cell->face_indices())
        {
          if (!cell->at_boundary(f))
            continue;
          const auto       face = cell->face(f);
          const Point<dim> centre = face->center();
          const bool       belongs = part.where.value(centre) != 0;
          if (is_cut<dim>(face, part.where, belongs))
          {
            ++n_cut;
            if (!first_cut)
              first_cut = centre;
          }
          if (!belongs)
            continue;
          ++n_faces;
          face->set_boundary_id(id);
        }
      if (n_faces == 0)
      {
        diagnostics.error(
          part.where.where(),
          fmt::format("part '{}' has no face: 'where' is zero at the centres of all faces of the boundary of the coarse mesh{}", part.name,
                      n_cut > 0 ? ", though not everywhere on them; divide the mesh where the part begins and ends" : ""),
          MessageName("part-without-faces"));
        return;
      }
      if (first_cut)
        diagnostics.warning(
          part.where.where(),
          fmt::format("part '{}' ends inside {} of the faces of the coarse mesh, one of them at {}: each belongs where its "
                      "centre does; divide the mesh where the part ends",
                      part.name, n_cut, text_of(*first_cut)),
          MessageName("part-cuts-faces"));
    }
  } // namespace

  template <int dim>
  void name_parts(Mesh<dim> &mesh, const std::vector<PartByPlace<FieldFunction>> &parts, Diagnostics &diagnostics)
  {
    for (const auto &part : parts)
      name_part(mesh, part, diagnostics);
  }

#define INSTANTIATE(dim) template void name_parts(Mesh<dim> &, const std::vector<PartByPlace<FieldFunction>> &, Diagnostics &);
  INSTANTIATE(1)
  INSTANTIATE(2)
  INSTANTIATE(3)
#undef INSTANTIATE
} // namespace unilateral
