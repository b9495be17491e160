// Meshes given as cells: a few vertices on a small grid and cells between any of them. What is accepted has cells of positive volume with
// names that exist, and can be refined.
#include "fuzzed_bytes.h"

#include "unilateral/mesh/mesh_of_cells.h"

#include <algorithm>

namespace
{
  using namespace unilateral;

  /// Bytes in turn, zeros at the end.
  class Source
  {
  public:
    Source(const std::uint8_t *bytes, const std::size_t size) : bytes(bytes), size(size) {}
    unsigned below(const unsigned n) { return at < size ? bytes[at++] % n : 0; }
    bool     empty() const { return at >= size; }

  private:
    const std::uint8_t *bytes;
    std::size_t         size, at = 0;
  };

  template <int dim>
  CellList list_of(Source &source, const CellKind kind, const unsigned n_corners, const unsigned n_corners_of_face)
  {
    CellList list;
    list.kind = kind;
    list.region_names = {"a", "b"};
    list.part_names = {"p", "q", "boundary"};
    // Some coordinates lie far off or very near to each other.
    constexpr double coordinates[] = {0, 1, 2, 3, 0.5, -1, 1e-9, 1e9};
    list.vertices.resize(dim + 1 + source.below(12));
    for (auto &vertex : list.vertices)
    {
      vertex = {0, 0, 0};
      for (unsigned d = 0; d < dim; ++d)
        vertex[d] = coordinates[source.below(8)];
    }
    while (!source.empty() && list.cells.size() < 12)
    {
      list.cell_region.push_back(source.below(2));
      list.cells.emplace_back(n_corners);
      for (unsigned &vertex : list.cells.back())
        vertex = source.below(list.vertices.size());
      if (source.below(4) == 1)
      {
        list.face_part.push_back(source.below(3));
        list.faces.emplace_back(list.cells.back().begin(), list.cells.back().begin() + n_corners_of_face);
      }
    }
    return list;
  }

  template <int dim>
  void mesh_or_refused(const CellList &list)
  {
    try
    {
      Mesh<dim> mesh = mesh_of_cells<dim>(list, {"fuzz.toml", 1, 1});
      for (const auto &cell : mesh.triangulation->active_cell_iterators())
      {
        fuzzed::require(cell->measure() > 0 && cell->material_id() < mesh.region_names.size());
        for (const auto &face : cell->face_iterators())
          fuzzed::require(!face->at_boundary() || face->boundary_id() < mesh.part_names.size());
      }
      mesh.triangulation->refine_global(1);
    }
    catch (const InputError &e)
    {
      fuzzed::require(!e.diagnostics.empty());
    }
  }
} // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t *bytes, const std::size_t size)
{
  Source source(bytes, size);
  switch (source.below(5))
  {
  case 0:
    mesh_or_refused<1>(list_of<1>(source, CellKind::segment, 2, 1));
    break;
  case 1:
    mesh_or_refused<2>(list_of<2>(source, CellKind::triangle, 3, 2));
    break;
  case 2:
    mesh_or_refused<2>(list_of<2>(source, CellKind::quadrilateral, 4, 2));
    break;
  case 3:
    mesh_or_refused<3>(list_of<3>(source, CellKind::tetrahedron, 4, 3));
    break;
  case 4:
    mesh_or_refused<3>(list_of<3>(source, CellKind::hexahedron, 8, 4));
    break;
  }
  return 0;
}
