// Sparse symmetric matrices whose blocks have no structure.
#pragma once

#include <deal.II/lac/dynamic_sparsity_pattern.h>
#include <deal.II/lac/sparse_matrix.h>

#include <random>

namespace unilateral
{
  /// Positive definite; every node is coupled with its neighbours and with some that are far from it, some with none, as unknowns are that
  /// Dirichlet conditions fix.
  class RandomSymmetricMatrix
  {
  public:
    RandomSymmetricMatrix(const unsigned n_nodes, const unsigned block_size)
    {
      const unsigned                 n = n_nodes * block_size;
      dealii::DynamicSparsityPattern entries(n, n);
      const auto                     coupled = [&](const unsigned i, const unsigned j)
      {
        const unsigned I = i / block_size, J = j / block_size;
        const unsigned distance = I < J ? J - I : I - J;
        return i == j || (I % 5 != 3 && J % 5 != 3 && (distance <= 1 || I * J % 7 == 0));
      };
      for (unsigned i = 0; i < n; ++i)
        for (unsigned j = 0; j < n; ++j)
          if (coupled(i, j))
            entries.add(i, j);
      pattern.copy_from(entries);
      matrix.reinit(pattern);
      std::mt19937                           generator(7);
      std::uniform_real_distribution<double> number(-1, 1);
      for (unsigned i = 0; i < n; ++i)
      {
        for (unsigned j = 0; j < i; ++j)
          if (coupled(i, j))
          {
            const double value = number(generator);
            matrix.set(i, j, value);
            matrix.set(j, i, value);
          }
        matrix.set(i, i, n + number(generator));
      }
    }

    dealii::SparsityPattern      pattern;
    dealii::SparseMatrix<double> matrix;
  };
} // namespace unilateral
