// A part of a mesh in plain numbers, and the mesh and the surroundings that it becomes.
#pragma once

#include "unilateral/base/processes.h"
#include "unilateral/mesh/mesh.h"
#include "unilateral/mesh/subdomain.h"

#include <array>
#include <cstdint>
#include <memory>
#include <string>
#include <vector>

namespace unilateral
{
  /// In place of the number of a part of the boundary: the face lies on a cut.
  inline constexpr dealii::types::boundary_id on_cut = dealii::numbers::internal_face_boundary_id;

  /// The cells that a process has of a mesh; vertices and cells by their numbers in the whole.
  template <int dim>
  struct PartDescription
  {
    std::vector<std::string>                part_names, region_names, warnings;
    bool                                    approximates_curves = false, simplex = false, curved = false, has_curved_cells = false;
    std::array<double, dim>                 some_point{};
    std::vector<std::uint32_t>              vertices; ///< ascending
    std::vector<std::array<double, dim>>    points;   ///< of these
    std::vector<std::uint32_t>              cells;    ///< own ones
    unsigned                                vertices_per_cell = 0, faces_per_cell = 0;
    std::vector<std::uint32_t>              corners;          ///< [own cell][vertex]
    std::vector<dealii::types::boundary_id> boundaries;       ///< [own cell][face]; `on_cut` where it is none of the whole
    std::vector<dealii::types::material_id> regions;          ///< [own cell]
    std::vector<std::uint32_t>              n_cells_at;       ///< [vertex]
    std::vector<std::uint32_t>              cells_at, owners; ///< all cells around the vertices, own ones among them, and their processes
    std::vector<std::vector<std::uint32_t>> curved_at;        ///< vertices around nodes of curved cells
    std::vector<std::array<double, dim>>    curved_points;    ///< these nodes
  };

  /// The same as cut_out_subdomain() leaves, but that the process does not know the mesh as a whole.
  template <int dim>
  struct ReceivedPart
  {
    Mesh<dim>                       mesh;
    std::unique_ptr<Subdomain<dim>> subdomain;
  };

  template <int dim>
  ReceivedPart<dim> make_part(PartDescription<dim> description, const Processes &processes);

  template <int dim>
  std::array<double, dim> array_of(const dealii::Point<dim> &x)
  {
    std::array<double, dim> result;
    for (unsigned d = 0; d < dim; ++d)
      result[d] = x[d];
    return result;
  }

  template <int dim>
  dealii::Point<dim> point_at(const std::array<double, dim> &coordinates)
  {
    dealii::Point<dim> x;
    for (unsigned d = 0; d < dim; ++d)
      x[d] = coordinates[d];
    return x;
  }
} // namespace unilateral
