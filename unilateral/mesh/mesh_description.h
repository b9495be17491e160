// A mesh as a plain value: what make_mesh() builds.
#pragma once

#include "unilateral/base/diagnostics.h"
#include "unilateral/functions/field_function.h"
#include "unilateral/mesh/refinement_goal.h"

#include <cstddef>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace unilateral
{
  struct CellList;       // cell_list.h
  struct CellsReadAhead; // cells_read_ahead.h
  struct FormerMesh;     // former_mesh.h

  /// The coarse mesh: exactly one source.
  struct MeshDescription
  {
    enum class Source
    {
      none,
      box,
      ball,
      shell,
      file,
      cells
    };
    Source                source = Source::none;
    std::vector<double>   box_lower, box_upper;   ///< corners, `dim` numbers each
    std::vector<unsigned> cells;                  ///< box: per direction (one number in the file means all directions)
    std::vector<double>   center;                 ///< ball, shell
    double                radius = 1;             ///< ball
    double                inner = 0.5, outer = 1; ///< shell
    std::string           file;                   ///< absolute path: .msh (2.2, 4.1), .geo, .step
    double                size = 0;               ///< target cell size for .geo and .step; 0: what the file says or Gmsh chooses

    std::shared_ptr<const CellList> cell_list;  ///< cells: as a program has them in memory
    std::shared_ptr<CellsReadAhead> read_ahead; ///< file: its cells, where they came along with its names

    SourceLocation where;        ///< of the source key
    SourceLocation number_where; ///< of what makes the cells so many: refine, else cells, else the source
  };

  /// A segment, rectangle or brick from @p lower to @p upper of @p cells cells in each direction; parts left, right, bottom, top, front,
  /// back.
  inline MeshDescription box(std::vector<double> lower, std::vector<double> upper, std::vector<unsigned> cells)
  {
    MeshDescription mesh;
    mesh.source = MeshDescription::Source::box;
    mesh.box_lower = std::move(lower);
    mesh.box_upper = std::move(upper);
    mesh.cells = std::move(cells);
    return mesh;
  }

  /// The disk or ball around @p center; its boundary is the part `surface`.
  inline MeshDescription ball(std::vector<double> center, const double radius)
  {
    MeshDescription mesh;
    mesh.source = MeshDescription::Source::ball;
    mesh.center = std::move(center);
    mesh.radius = radius;
    return mesh;
  }

  /// What lies between two circles or spheres around @p center; parts inner and outer.
  inline MeshDescription shell(std::vector<double> center, const double inner, const double outer)
  {
    MeshDescription mesh;
    mesh.source = MeshDescription::Source::shell;
    mesh.center = std::move(center);
    mesh.inner = inner;
    mesh.outer = outer;
    return mesh;
  }

  /// The mesh in a file of Gmsh (.msh, .geo) or STEP, absolute @p path; @p size of the cells where the file has none.
  inline MeshDescription mesh_file(std::string path, const double size = 0)
  {
    MeshDescription mesh;
    mesh.source = MeshDescription::Source::file;
    mesh.file = std::move(path);
    mesh.size = size;
    return mesh;
  }

  /// A mesh that the program has in memory, see cell_list.h.
  inline MeshDescription mesh_of(std::shared_ptr<const CellList> cells)
  {
    MeshDescription mesh;
    mesh.source = MeshDescription::Source::cells;
    mesh.cell_list = std::move(cells);
    return mesh;
  }

  /// A part of the boundary of the coarse mesh: the faces that have their centre where a function is not zero.
  template <typename Function>
  struct PartByPlace
  {
    std::string name;
    Function    where;
  };

  /// Refinement by the estimated error, until it is small enough.
  struct AdaptiveRefinement
  {
    double         tolerance = 0.01;         ///< of the error, relative to the energy norm of u or the size of the goal
    std::size_t    max_unknowns = 1'000'000; ///< no refinement beyond this
    RefinementGoal goal = {};
    SourceLocation where = {};

    /// Of a run that is resumed: refined like this mesh before anything is estimated.
    std::shared_ptr<const FormerMesh> former = nullptr;
  };

  /// The coarse mesh, with parts of its boundary, and how it is refined: `refine` times as a whole, then in places, then by the error.
  template <typename Function>
  struct RefinedMeshOf : MeshDescription
  {
    unsigned refine = 0;                  ///< uniform refinements after the coarse mesh
    bool     compared_with_finer = false; ///< a drawing is meshed as if it were to be refined, even if `refine` is 0

    /// Then cells are halved in each direction that have their centre or a corner where a function is not zero; and that so many times.
    struct Local
    {
      Function where;
      unsigned times = 1;
    };
    std::vector<Local> local;

    std::optional<AdaptiveRefinement> adapt;

    std::vector<PartByPlace<Function>> parts; ///< in addition to those that the mesh has

    /// As a whole and in places.
    unsigned n_refinements() const
    {
      unsigned n = refine;
      for (const Local &refinement : local)
        n += refinement.times;
      return n;
    }

    /// What refinement number @p level, from 0, does: nullptr: it is uniform, as are those beyond the last.
    const Function *place_of_refinement(const unsigned level) const
    {
      unsigned end = refine;
      for (const Local &refinement : local)
        if (level >= end && level < (end += refinement.times))
          return &refinement.where;
      return nullptr;
    }
  };

  using RefinedMesh = RefinedMeshOf<FieldFunction>;

  /// @p mesh, refined @p times times as a whole.
  inline RefinedMesh refined(MeshDescription mesh, const unsigned times)
  {
    return {std::move(mesh), times, false, {}, {}, {}};
  }
} // namespace unilateral
