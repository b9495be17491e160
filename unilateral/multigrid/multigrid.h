// Geometric multigrid for A + B' D B: the preconditioner of a linearised inequality.
#pragma once

#include "unilateral/multigrid/coarse_operators.h"
#include "unilateral/multigrid/level_hierarchy.h"
#include "unilateral/multigrid/multigrid_level.h"
#include "unilateral/multigrid/tangent_penalty.h"

#include <Eigen/CholmodSupport>
#include <Eigen/SparseCore>

#include <cstdint>
#include <memory>
#include <vector>

namespace unilateral
{
  /// A V-cycle in single precision, with Chebyshev-Jacobi smoothing and coarse operators that know the active set.
  ///
  /// Where B' D B has only a diagonal entry for an unknown, and that is stiff against A, the unknown is truncated: coarse corrections do
  /// not reach it; where it holds the components of a node in a direction, they do not in that direction (R. Kornhuber, Numer. Math. 69
  /// (1994); C. Graeser, O. Sander, 2019). All coarse operators are the Galerkin products of what is finer, A_H = sum_c P_c' A_c P_c cell
  /// by cell; where nothing below a cell is truncated or penalised, that is its own A_K, so that only the cells along the free boundary (or
  /// in contact, where the penalty is soft or couples unknowns) take work and memory.
  ///
  /// Processes that have a part of the mesh each exchange the unknowns on their cuts with every product, restriction and diagonal; where
  /// the hierarchy is cut they bring their right-hand sides together and all do the coarser levels, which is less than to divide them.
  class Multigrid
  {
  public:
    struct Parameters
    {
      unsigned    smoother_degree = 2;     ///< of the Chebyshev polynomial, before and after the coarse correction
      double      smoothing_range = 6;     ///< the smoother treats eigenvalues from the largest down to this part of it
      double      truncation = 1;          ///< an unknown is truncated where d_i exceeds this multiple of a_ii
      std::size_t largest_coarse = 200000; ///< unknowns of level 0, which is factorised

      /// For a form with this BilinearForm::volume_to_shape_stiffness(): errors without divergence have eigenvalues that are so much
      /// smaller, and coarse functions do not reach them. Polynomials of higher degree do: measured best with nu from 0.3 to 0.499.
      static Parameters for_volume_to_shape_stiffness(double ratio);
    };

    Multigrid(std::shared_ptr<const LevelHierarchy> hierarchy, const Parameters &parameters);

    /// B' D B, see TangentPenalty.
    void set_penalty(const std::vector<double>             &diagonal,
                     const std::vector<DenseBlock>         &node_blocks,
                     std::vector<TangentPenalty::CellBlock> cell_blocks);

    /// z = P^-1 r, a V-cycle; symmetric and positive definite.
    void vmult(double *z, const double *r);

    /// y += factor B' D B x.
    void add_penalty(double *y, const double *x, double factor = 1) const { penalty.add(y, x, factor); }

    /// Applications of the finest operator by the V-cycles so far.
    std::size_t n_fine_applications() const { return fine_applications; }

    std::size_t memory() const;

  private:
    class CellEigenvalues;

    void prepare_smoother(unsigned level);
    void add_penalty_to_finest(CellEigenvalues &eigenvalues);
    void invert_diagonal(MultigridLevel &level, bool finest);
    void factorise_coarsest();
    void count_application(const MultigridLevel &level) { fine_applications += &level == &levels.back(); }
    void smooth(MultigridLevel &level, bool from_zero);
    void cycle(unsigned level);
    void solve_on_whole(const LevelHierarchy::Cut &cut); ///< where the own part ends and all of a group have the whole

    std::shared_ptr<const LevelHierarchy> hierarchy;
    Parameters                            parameters;
    std::vector<MultigridLevel>           levels;
    TangentPenalty                        penalty;
    CoarseOperators                       coarse_operators;
    /// The matrix of level 0.
    Eigen::CholmodDecomposition<Eigen::SparseMatrix<double>> coarsest;
    std::size_t                                              fine_applications = 0;
  };
} // namespace unilateral
