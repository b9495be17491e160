// Which faces of the parts of a mesh lie on cuts, and which on the boundary: found out among processes of which none has the whole.
#pragma once

#include "unilateral/base/processes.h"

#include <array>
#include <cstdint>
#include <vector>

namespace unilateral
{
  /// A face by the ids of its vertices, ascending; the largest number in place of those that it does not have.
  using FaceByIds = std::array<std::uint32_t, 4>;

  /// A face of one cell of the part.
  struct FaceOfPart
  {
    FaceByIds     vertices;
    std::uint32_t piece; ///< of the part, that the cell belongs to; pieces are cells that hold together by their faces
    std::int32_t  side;  ///< of the face, as its vertices are ordered, that the cell lies on: 1 or -1; 0: not looked at
  };

  /// A face with a name in the file.
  struct NamedFace
  {
    FaceByIds     vertices;
    std::uint32_t name;
    std::uint64_t number; ///< in the file: of several names the first one counts
  };

  inline constexpr std::uint32_t no_name = 0xffffffff;

  struct FacesBetweenParts
  {
    struct Face
    {
      bool          on_cut = false;
      std::uint32_t name = no_name; ///< of one on the boundary
    };
    std::vector<Face> faces;                ///< as they were given
    bool              fit = true;           ///< here: no face has more than two cells, or two of them on one side
    bool              hold_together = true; ///< all cells of all parts by their faces
  };

  /// Each face is looked at by the process that its first vertex says. @p n_pieces: of the own part. Collective.
  FacesBetweenParts find_faces_between_parts(const std::vector<FaceOfPart> &own,
                                             const std::vector<NamedFace>  &named,
                                             unsigned                       n_pieces,
                                             const Processes               &processes);
} // namespace unilateral
