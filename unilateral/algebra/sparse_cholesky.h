// Sparse Cholesky factorisation: CHOLMOD's supernodes, in an order by METIS or AMD.
#pragma once

#include <deal.II/lac/sparse_matrix.h>

#include <Eigen/Core>

#include <cstddef>
#include <memory>
#include <stdexcept>
#include <utility>
#include <vector>

namespace unilateral
{
  /// A pivot is not positive.
  class NotPositiveDefinite : public std::runtime_error
  {
    using std::runtime_error::runtime_error;
  };

  /// P T P' = L L' of a symmetric positive definite matrix T. The order P is found once, for all matrices with the same pattern. Solves of
  /// one object share memory: one at a time.
  class SparseCholesky
  {
  public:
    enum class Order
    {
      nested_dissection, ///< METIS: the least work for meshes in space and for large ones
      minimum_degree     ///< AMD: several times quicker to find, and for a factorisation in the plane that is used once
    };

    /// Orders the unknowns of @p matrix, whose values do not matter apart from rows and columns that are zero outside the diagonal: they
    /// stay so. The unknowns @p last are eliminated last, in this order. Throws std::runtime_error when the memory does not suffice.
    explicit SparseCholesky(const dealii::SparseMatrix<double>                 &matrix,
                            const std::vector<dealii::types::global_dof_index> &last = {},
                            Order                                               order = Order::nested_dissection);
    ~SparseCholesky();

    /// What the factorisation will take: numbers in memory, and multiplications and additions.
    double predicted_entries() const;
    double predicted_operations() const;

    using Additions = std::vector<std::pair<dealii::types::global_dof_index, double>>;

    /// Of @p matrix with something added to its diagonal. Throws NotPositiveDefinite, or std::runtime_error when the
    /// memory does not suffice.
    void factorise(const dealii::SparseMatrix<double> &matrix, const Additions &to_diagonal = {});

    /// z = L^-1 P b and x = P' L'^-1 z: x = T^-1 b is one after the other. n numbers each; both may be the same. The unknowns that come
    /// last are the last of z.
    void forward(const double *b, double *z) const;
    void backward(const double *z, double *x) const;

    /// The block of L of the unknowns that come last: L_22 L_22' is the Schur complement that the elimination of the others leaves.
    Eigen::MatrixXd last_block() const;

  private:
    struct Cholmod; ///< hides its header

    void analyse(const dealii::SparseMatrix<double> &matrix);

    const Order                                        order;
    std::unique_ptr<Cholmod>                           data;
    const std::vector<dealii::types::global_dof_index> last;
  };
} // namespace unilateral
