// Contact that couples the components of u at nodes: a part of the penalty, of the truncation and of the smoother.
#pragma once

#include "unilateral/multigrid/level_hierarchy.h"

#include <cstdint>
#include <vector>

namespace unilateral
{
  /// The penalty P of a node holds its components in some directions: coarse corrections do not reach it in those that are stiff, and the
  /// smoother inverts P + diag(A) there.
  class NodePenalty
  {
  public:
    struct Node
    {
      std::vector<std::uint32_t> dofs;
      std::vector<double>        penalty;      ///< P, dofs.size()^2 numbers like the others
      std::vector<double>        factor;       ///< P = G G': by G, rounding stays in the directions that are held
      std::vector<double>        free;         ///< the projection on the directions that are not truncated
      std::vector<double>        soft;         ///< P in those directions
      std::vector<float>         inverse;      ///< of P + diag(A)
      bool                       owned = true; ///< by this process
    };

    /// @p truncation: directions are truncated where P is stiffer than this multiple of A.
    void set(const std::vector<DenseBlock> &blocks, const CellOperator &op, const SharedUnknowns &shared, double truncation);

    /// For the V-cycle. @p cells: those of the finest level that have an unknown of a node; @p positions: of its unknowns.
    void prepare_smoother(const CellOperator &op, const std::vector<std::uint32_t> &cells, const std::vector<std::uint32_t> &positions);

    /// How the functions of the next coarser level, with unknowns at @p coarse_positions, lie in those at the nodes.
    void connect(const LevelHierarchy &hierarchy, const std::vector<std::uint32_t> &coarse_positions);

    bool                     empty() const { return nodes.empty(); }
    const std::vector<Node> &all() const { return nodes; }

    /// The node of an unknown; negative: none.
    std::int32_t of_dof(const std::uint32_t dof) const { return node_of_dof.empty() ? -1 : node_of_dof[dof]; }

    void add(double *y, const double *x, double factor) const; ///< y += factor P x

    /// Keeps b - A x at the nodes for what follows. @p terms: what blocks outside the cells add to A x; @p x: none is zero.
    void keep_residual(const float *b, const float *x, const float *terms);

    /// x += gain (P + diag(A))^-1 residual, and the same for @p step, if any.
    void smooth(float *x, float *step, float gain) const;

    /// Transfers in the directions that are free.
    void restrict_residual(float *coarse_b) const; ///< from the nodes that are owned
    void prolongate(float *x, const float *coarse_x) const;

  private:
    /// Rows of a cell matrix at nodes.
    struct CellRows
    {
      std::uint32_t              cell;
      std::vector<std::uint32_t> positions;     ///< of all unknowns of the cell
      std::vector<std::uint32_t> entry, number; ///< of each row: of the residual, in the cell
      std::vector<float>         matrix;        ///< row by row
    };
    /// The coarse functions at an unknown.
    struct CoarseRow
    {
      std::vector<std::uint32_t> positions;
      std::vector<float>         values;
    };

    std::uint32_t entry_of(std::uint32_t node, std::uint32_t dof) const; ///< of the following vectors

    std::vector<Node>          nodes;
    std::vector<std::int32_t>  node_of_dof; ///< empty without nodes
    std::vector<std::uint32_t> first_entry; ///< of each node in the following
    std::vector<std::uint32_t> position;
    std::vector<unsigned char> fixed; ///< by Dirichlet data
    std::vector<float>         residual;
    std::vector<CellRows>      rows;
    std::vector<CoarseRow>     coarse_rows;
  };
} // namespace unilateral
