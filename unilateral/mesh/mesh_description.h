// A mesh as a plain value: what make_mesh() builds.
#pragma once

#include "unilateral/base/diagnostics.h"

#include <optional>
#include <string>
#include <vector>

namespace unilateral
{
  /// The coarse mesh: exactly one source.
  struct MeshDescription
  {
    enum class Source
    {
      none,
      box,
      ball,
      shell,
      file
    };
    Source                source = Source::none;
    std::vector<double>   box_lower, box_upper;   ///< corners, `dim` numbers each
    std::vector<unsigned> cells;                  ///< box: per direction (one number in the file means all directions)
    std::vector<double>   center;                 ///< ball, shell
    double                radius = 1;             ///< ball
    double                inner = 0.5, outer = 1; ///< shell
    std::string           file;                   ///< absolute path: .msh (2.2, 4.1), .geo, .step
    double                size = 0;               ///< target cell size for .geo and .step; 0: what the file says or Gmsh chooses

    SourceLocation where;        ///< of the source key
    SourceLocation number_where; ///< of what makes the cells so many: refine, else cells, else the source
  };

  /// The coarse mesh and how it is refined: `refine` times as a whole, then in places.
  template <typename Function>
  struct RefinedMeshOf : MeshDescription
  {
    unsigned refine = 0; ///< uniform refinements after the coarse mesh

    /// Then cells are halved in each direction that have their centre or a corner where a function is not zero; and that so many times.
    struct Local
    {
      Function where;
      unsigned times = 1;
    };
    std::vector<Local> local;

    /// Of both kinds.
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
} // namespace unilateral
