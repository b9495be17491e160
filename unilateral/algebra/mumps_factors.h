// Factors of a sparse matrix of which each of several processes has a part: MUMPS.
#pragma once

#include "unilateral/algebra/numbers_of_all.h"
#include "unilateral/algebra/vector.h"

#include <deal.II/lac/sparse_matrix.h>

#include <cstdint>
#include <memory>
#include <vector>

namespace unilateral
{
  /// The matrix is the sum of what the processes have; its factors are distributed among them (P. Amestoy, I. Duff, J. Koster, J.-Y.
  /// L'Excellent, SIAM J. Matrix Anal. Appl. 23 (2001)). All operations are collective.
  class MumpsFactors
  {
  public:
    /// Symmetric matrices get Cholesky factors, or L D L' should a pivot not be positive; others L U.
    MumpsFactors(const SharedUnknowns &shared, std::size_t n_dofs, bool symmetric);
    ~MumpsFactors();

    struct Entry
    {
      std::uint64_t row, column; ///< numbers of all processes (NumbersOfAll)
      double        value;
    };

    /// @p own: what this process has of the matrix, with the @p further entries. The pattern is that of the first one in all further calls,
    /// whose order of unknowns serves on. Of symmetric matrices both entries of a pair are given, in @p further not always by one process.
    /// Throws std::runtime_error, on all processes, when the matrix is singular, too large for 32-bit numbers, or when its factors need
    /// more memory than there is.
    void factorise(const dealii::SparseMatrix<double> &own, const std::vector<Entry> &further = {});

    /// x = (sum of the parts)^-1 b, for vectors that have equal values on all processes with an unknown.
    void solve(Vector &x, const Vector &b) const;

    /// After factorise(): it has Cholesky factors.
    bool positive_definite() const;

  private:
    struct Instance; ///< hides MUMPS' header

    void take_pattern(const dealii::SparseMatrix<double> &own, const std::vector<Entry> &further);
    void analyse();
    bool compute();                       ///< false: not positive definite
    void check_memory(double part) const; ///< of what the analysis foretells, 1 or more
    void plan_return_of_solution() const;

    NumbersOfAll              numbers;
    bool                      is_symmetric;
    std::unique_ptr<Instance> instance;
    bool                      is_analysed = false;
    std::vector<int>          rows, columns; ///< of the entries, from 1
    std::vector<double>       values;
    std::vector<int>          numbers_of_owned; ///< from 1

    /// MUMPS leaves each process the solution at some unknowns, which go to their owners.
    struct Return
    {
      std::vector<int>           n_to, n_from;         ///< by rank
      std::vector<int>           start_to, start_from; ///< their sums
      std::vector<std::uint32_t> place_to_send;        ///< in what this process was left with, by rank of the owner
      std::vector<std::uint32_t> unknowns;             ///< which of its own this process gets, in the order in which they come
    };
    mutable Return way_back;
    mutable bool   way_is_known = false;
  };
} // namespace unilateral
