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
          const auto              face = cell->face(f);
          std::vector<Point<dim>> corners;
          for (const unsigned v : face->vertex_indices())
            corners.push_back(face->vertex(v));
          const auto [belongs, cut] = place_of_face(corners, part.where);
          if (cut)
          {
            ++n_cut;
            if (!first_cut)
              first_cut = face->center();
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
  PlaceOfFace place_of_face(const std::vector<Point<dim>> &corners, const FieldFunction &where)
  {
    Point<dim> centre;
    for (const auto &corner : corners)
      centre += corner / double(corners.size());
    PlaceOfFace place{where.value(centre) != 0};
    if (dim > 1)
      for (const auto &corner : corners)
        place.cut = place.cut || (where.value(corner + 0.01 * (centre - corner)) != 0) != place.belongs;
    return place;
  }

  template <int dim>
  void name_parts(Mesh<dim> &mesh, const PartsByPlace &parts, Diagnostics &diagnostics)
  {
    for (const auto &part : parts)
      name_part(mesh, part, diagnostics);
  }

#define INSTANTIATE(dim)                                                                                                                   \
  template PlaceOfFace place_of_face(const std::vector<Point<dim>> &, const FieldFunction &);                                              \
  template void        name_parts(Mesh<dim> &, const PartsByPlace &, Diagnostics &);
  INSTANTIATE(1)
  INSTANTIATE(2)
  INSTANTIATE(3)
#undef INSTANTIATE
} // namespace unilateral
