#include "unilateral/algebra/updated_cholesky.h"

#include "unilateral/base/sort_unique.h"

#include <algorithm>
#include <cmath>

// Of the BLAS that CHOLMOD uses as well: B := A^-1 B and C := A'A of column-major matrices.
extern "C"
{
  void dtrsm_(const char   *side,
              const char   *triangle,
              const char   *transposed,
              const char   *unit,
              const int    *m,
              const int    *n,
              const double *alpha,
              const double *A,
              const int    *rows_of_A,
              double       *B,
              const int    *rows_of_B);
  void dsyrk_(const char   *triangle,
              const char   *transposed,
              const int    *n,
              const int    *k,
              const double *alpha,
              const double *A,
              const int    *rows_of_A,
              const double *beta,
              double       *C,
              const int    *rows_of_C);
}

namespace unilateral
{
  using namespace dealii;

  namespace
  {
    /// As many unknowns as there are modes, so that springs there stop each of them: greedy, the largest entry outside the span of the
    /// modes that are stopped already. A spring is as stiff as the diagonal.
    SparseCholesky::Additions springs_against(const std::vector<Vector> &modes, const SparseMatrix<double> &A)
    {
      SparseCholesky::Additions springs;
      const std::size_t         n = A.m(), n_modes = modes.size();
      Eigen::MatrixXd           rest(n_modes, n);
      for (std::size_t k = 0; k < n_modes; ++k)
        for (std::size_t j = 0; j < n; ++j)
          rest(k, j) = modes[k](j);
      for (std::size_t k = 0; k < n_modes; ++k)
      {
        Eigen::Index j = 0;
        if (!(rest.colwise().squaredNorm().maxCoeff(&j) > 0))
          break;
        const Eigen::VectorXd direction = rest.col(j).normalized();
        rest -= direction * (direction.transpose() * rest).eval();
        springs.emplace_back(j, A.diag_element(j));
      }
      return springs;
    }

    std::vector<types::global_dof_index> unknowns_of(const SparseRows &B, const SparseCholesky::Additions &springs)
    {
      std::vector<types::global_dof_index> result(B.columns.begin(), B.columns.end());
      for (const auto &[unknown, stiffness] : springs)
        result.push_back(unknown);
      sort_unique(result);
      return result;
    }
  } // namespace

  UpdatedCholesky::UpdatedCholesky(const SparseMatrix<double> &A, const SparseRows &B, const std::vector<Vector> &modes)
    : A(A), B(B), springs(springs_against(modes, A)), last(unknowns_of(B, springs)), cholesky(A, last)
  {
  }

  double UpdatedCholesky::predicted_entries() const
  {
    const double n_columns = double(B.size() + springs.size());
    return cholesky.predicted_entries() + (last.size() + n_columns) * n_columns + double(last.size()) * last.size();
  }

  double UpdatedCholesky::predicted_operations() const
  {
    const double n_columns = double(B.size() + springs.size()), n_last = last.size();
    return cholesky.predicted_operations() + n_last * n_last * n_columns + n_last * n_columns * n_columns;
  }

  void UpdatedCholesky::factorise()
  {
    cholesky.factorise(A, springs);
    const int  n_last = last.size(), n_rows = B.size(), n_columns = n_rows + springs.size();
    const auto place = [&](const types::global_dof_index j) { return std::lower_bound(last.begin(), last.end(), j) - last.begin(); };
    Y.setZero(n_last, n_columns);
    for (int i = 0; i < n_rows; ++i)
      for (std::size_t k = B.row_start[i]; k < B.row_start[i + 1]; ++k)
        Y(place(B.columns[k]), i) += B.values[k];
    for (std::size_t k = 0; k < springs.size(); ++k)
      Y(place(springs[k].first), n_rows + k) = std::sqrt(springs[k].second);
    G.setZero(n_columns, n_columns);
    if (n_last == 0 || n_columns == 0)
      return;
    const Eigen::MatrixXd L = cholesky.last_block();
    const double          one = 1, zero = 0;
    dtrsm_("L", "L", "N", "N", &n_last, &n_columns, &one, L.data(), &n_last, Y.data(), &n_last);
    dsyrk_("L", "T", &n_columns, &n_last, &one, Y.data(), &n_last, &zero, G.data(), &n_columns);
    G.triangularView<Eigen::StrictlyUpper>() = G.transpose();
  }

  void UpdatedCholesky::set_diagonal(const Vector &d)
  {
    const std::size_t n_rows = B.size();
    chosen.clear();
    for (std::size_t i = 0; i < n_rows; ++i)
      if (d(i) != 0)
        chosen.push_back(i);
    for (std::size_t k = 0; k < springs.size(); ++k)
      chosen.push_back(n_rows + k);
    Y_chosen = Y(Eigen::all, chosen);
    Eigen::MatrixXd matrix = G(chosen, chosen);
    for (std::size_t k = 0; k < chosen.size(); ++k)
      matrix(k, k) += chosen[k] < n_rows ? 1 / d(chosen[k]) : -1.;
    if (!chosen.empty())
      small.compute(matrix);
  }

  void UpdatedCholesky::solve(Vector &x, const Vector &b) const
  {
    cholesky.forward(b.begin(), x.begin());
    if (!chosen.empty())
    {
      Eigen::Map<Eigen::VectorXd> tail(x.begin() + x.size() - last.size(), last.size());
      tail -= Y_chosen * small.solve(Y_chosen.transpose() * tail);
    }
    cholesky.backward(x.begin(), x.begin());
  }
} // namespace unilateral
