#include "unilateral/multigrid/block_transfer.h"

#include <type_traits>

namespace unilateral
{
  namespace
  {
    template <unsigned n>
    using Constant = std::integral_constant<unsigned, n>;

    /// Calls @p action with both sizes as constants of compilation, where they are what bodies and membranes have.
    template <typename Action>
    void with_sizes(const unsigned b, const unsigned k, const Action &action)
    {
      if (b == 3 && k == 6)
        action(Constant<3>(), Constant<6>());
      else if (b == 6 && k == 6)
        action(Constant<6>(), Constant<6>());
      else if (b == 2 && k == 3)
        action(Constant<2>(), Constant<3>());
      else if (b == 3 && k == 3)
        action(Constant<3>(), Constant<3>());
      else if (b == 1 && k == 1)
        action(Constant<1>(), Constant<1>());
      else
        action(b, k);
    }
  } // namespace

  void add_restriction(const TransferOfBlocks &P, const unsigned b, const unsigned k, const float *const fine, float *const coarse)
  {
    with_sizes(b, k,
               [&](const auto b, const auto k)
               {
                 const float *block = P.blocks;
                 for (std::size_t node = 0; node < P.n_nodes; ++node)
                   for (std::size_t at = P.row_start[node]; at < P.row_start[node + 1]; ++at)
                   {
                     float *const y = coarse + std::size_t(P.columns[at]) * k;
                     for (unsigned i = 0; i < b; ++i, block += k)
                       for (unsigned j = 0; j < k; ++j)
                         y[j] += block[j] * fine[node * b + i];
                   }
               });
  }

  void add_prolongation(
    const TransferOfBlocks &P, const unsigned b, const unsigned k, const float *const coarse, const float factor, float *const fine)
  {
    with_sizes(b, k,
               [&](const auto b, const auto k)
               {
                 const float *block = P.blocks;
                 for (std::size_t node = 0; node < P.n_nodes; ++node)
                   for (std::size_t at = P.row_start[node]; at < P.row_start[node + 1]; ++at)
                   {
                     const float *const x = coarse + std::size_t(P.columns[at]) * k;
                     for (unsigned i = 0; i < b; ++i, block += k)
                     {
                       float sum = 0;
                       for (unsigned j = 0; j < k; ++j)
                         sum += block[j] * x[j];
                       fine[node * b + i] += factor * sum;
                     }
                   }
               });
  }

  void add_product(const double *const M, const double *const Q, const unsigned b, const unsigned k, double *const C)
  {
    with_sizes(b, k,
               [&](const auto b, const auto k)
               {
                 for (unsigned i = 0; i < b; ++i)
                   for (unsigned j = 0; j < b; ++j)
                     for (unsigned l = 0; l < k; ++l)
                       C[i * k + l] += M[i * b + j] * Q[j * k + l];
               });
  }

  void add_transposed_product(const double *const P, const double *const M, const unsigned b, const unsigned k, double *const C)
  {
    with_sizes(b, k,
               [&](const auto b, const auto k)
               {
                 for (unsigned i = 0; i < b; ++i)
                   for (unsigned r = 0; r < k; ++r)
                     for (unsigned s = 0; s < k; ++s)
                       C[r * k + s] += P[i * k + r] * M[i * k + s];
               });
  }
} // namespace unilateral
