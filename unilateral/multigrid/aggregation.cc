#include "unilateral/multigrid/aggregation.h"

#include "unilateral/multigrid/block_transfer.h"

#include <Eigen/Dense>

#include <algorithm>
#include <cmath>
#include <map>
#include <random>
#include <utility>

namespace unilateral
{
  using namespace dealii;
  using types::global_dof_index;

  namespace
  {
    using Matrix = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;

    constexpr double nothing_new = 1e-8; ///< part of a mode that is left on an aggregate when others have been taken out of it

    /// The places of columns in a row that is being added up.
    class Places
    {
    public:
      explicit Places(const std::size_t n) : place(n, -1) {}

      /// Where @p column is among @p columns; it becomes the last of them if it is none.
      std::size_t operator()(const std::uint32_t column, std::vector<std::uint32_t> &columns)
      {
        if (place[column] < 0)
        {
          place[column] = columns.size();
          columns.push_back(column);
        }
        return place[column];
      }

      void forget(const std::vector<std::uint32_t> &columns)
      {
        for (const std::uint32_t column : columns)
          place[column] = -1;
      }

    private:
      std::vector<std::int32_t> place;
    };

    /// The rows of A at one node after the other.
    class RowsAtNodes
    {
    public:
      RowsAtNodes(const SparseMatrix<double> &A, const unsigned block_size) : A(A), b(block_size), place(A.m() / block_size) {}

      void go_to(const std::uint32_t node)
      {
        columns.clear();
        blocks.clear();
        for (unsigned i = 0; i < b; ++i)
        {
          const auto end = A.end(node * std::size_t(b) + i);
          for (auto entry = A.begin(node * std::size_t(b) + i); entry != end; ++entry)
          {
            const std::size_t k = place(entry->column() / b, columns);
            if (blocks.size() < columns.size() * b * b)
              blocks.resize(columns.size() * b * b, 0.);
            blocks[k * b * b + i * b + entry->column() % b] = entry->value();
          }
        }
        place.forget(columns);
      }

      std::vector<std::uint32_t> columns; ///< nodes, the first is that of the row
      std::vector<double>        blocks;  ///< row by row

    private:
      const SparseMatrix<double> &A;
      const unsigned              b;
      Places                      place;
    };

    double square(const double *const block, const unsigned n)
    {
      double sum = 0;
      for (unsigned k = 0; k < n; ++k)
        sum += block[k] * block[k];
      return sum;
    }

    bool is_free(const SparseMatrix<double> &A, const std::size_t row)
    {
      for (auto entry = A.begin(row); entry != A.end(row); ++entry)
        if (entry->column() != row && entry->value() != 0)
          return true;
      return false;
    }

    /// On one process at least.
    std::vector<bool> free_unknowns(const SparseMatrix<double> &A, const SharedUnknowns &shared)
    {
      std::vector<float> n_free(A.m());
      for (std::size_t i = 0; i < A.m(); ++i)
        n_free[i] = is_free(A, i) ? 1.F : 0.F;
      shared.add(n_free.data());
      std::vector<bool> result(A.m());
      for (std::size_t i = 0; i < A.m(); ++i)
        result[i] = n_free[i] > 0;
      return result;
    }

    /// Which nodes may be in one aggregate, as each process sees it.
    struct KindsOfNodes
    {
      static constexpr std::int32_t inside = 0, of_others = -1;

      std::vector<std::int32_t>          kind;    ///< of each node: inside, on cuts that the same processes have, of other owners
      std::vector<std::int32_t>          set;     ///< of each node: which of `ranks`; inside: none
      std::vector<std::vector<unsigned>> ranks{}; ///< sets of processes that have nodes on cuts

      KindsOfNodes(const std::size_t n_nodes, const unsigned b, const SharedUnknowns &shared) : kind(n_nodes, inside), set(n_nodes, -1)
      {
        std::map<std::uint32_t, std::vector<unsigned>> ranks_at;
        for (const auto &neighbor : shared.all_neighbors())
          for (const auto dof : neighbor.dofs)
            if (dof % b == 0)
              ranks_at[dof / b].push_back(neighbor.rank);
        std::map<std::vector<unsigned>, std::int32_t> number;
        for (auto &[node, others] : ranks_at)
        {
          others.insert(std::upper_bound(others.begin(), others.end(), shared.processes().rank()), shared.processes().rank());
          const auto [entry, is_new] = number.try_emplace(others, ranks.size());
          if (is_new)
            ranks.push_back(others);
          set[node] = entry->second;
          kind[node] = shared.owns(node * std::size_t(b)) ? 1 + entry->second : of_others;
        }
      }

      bool on_cut(const std::uint32_t node) const { return set[node] >= 0; }
    };

    /// Neighbours of nodes by strong connections, and how strong they are.
    struct Graph
    {
      std::vector<std::size_t>   row_start = {0};
      std::vector<std::uint32_t> columns;
      std::vector<float>         strength;
      std::vector<bool>          is_free;

      /// Nodes of different @p kind are not connected, and those of others not free; empty: all are alike.
      Graph(const SparseMatrix<double>      &A,
            const unsigned                   b,
            const double                     threshold,
            const std::vector<bool>         &free_unknowns,
            const std::vector<std::int32_t> &kind)
      {
        const std::uint32_t n_nodes = A.m() / b;
        std::vector<double> diagonal(n_nodes);
        for (std::uint32_t node = 0; node < n_nodes; ++node)
        {
          double sum = 0;
          for (unsigned i = 0; i < b; ++i)
            for (unsigned j = 0; j < b; ++j)
            {
              const double a = A.el(node * std::size_t(b) + i, node * std::size_t(b) + j);
              sum += a * a;
            }
          diagonal[node] = std::sqrt(sum);
        }
        RowsAtNodes row(A, b);
        is_free.resize(n_nodes);
        for (std::uint32_t node = 0; node < n_nodes; ++node)
        {
          row.go_to(node);
          for (std::size_t k = 0; k < row.columns.size(); ++k)
            if (const std::uint32_t other = row.columns[k]; other != node)
            {
              const double ratio = square(row.blocks.data() + k * b * b, b * b) / (diagonal[node] * diagonal[other]);
              if (ratio > threshold * threshold && kind[node] == kind[other])
              {
                columns.push_back(other);
                strength.push_back(float(ratio));
              }
            }
          row_start.push_back(columns.size());
          for (unsigned i = 0; i < b; ++i)
            is_free[node] = is_free[node] || (free_unknowns[node * std::size_t(b) + i] && kind[node] != KindsOfNodes::of_others);
        }
      }

      std::size_t size() const { return row_start.size() - 1; }

      template <typename Visit>
      void for_each_neighbour(const std::uint32_t node, const Visit &visit) const
      {
        for (std::size_t k = row_start[node]; k < row_start[node + 1]; ++k)
          visit(columns[k], strength[k]);
      }

      /// Each connected part from one of its nodes on, so that aggregates are laid out side by side.
      std::vector<std::uint32_t> breadth_first() const
      {
        std::vector<std::uint32_t> order;
        std::vector<bool>          seen(size());
        order.reserve(size());
        for (std::uint32_t start = 0; start < size(); ++start)
        {
          if (seen[start])
            continue;
          seen[start] = true;
          order.push_back(start);
          for (std::size_t k = order.size() - 1; k < order.size(); ++k)
            for_each_neighbour(order[k],
                               [&](const std::uint32_t other, float)
                               {
                                 if (!seen[other])
                                   order.push_back(other);
                                 seen[other] = true;
                               });
        }
        return order;
      }
    };

    /// The inverses of the diagonal blocks, row by row; zero of nodes on cuts.
    std::vector<double> inverse_blocks(const SparseMatrix<double> &A, const unsigned b, const KindsOfNodes &kinds)
    {
      std::vector<double> result(A.m() * b);
      Matrix              block(b, b);
      for (std::size_t node = 0; node < A.m() / b; ++node)
      {
        if (kinds.on_cut(node))
          continue;
        for (unsigned i = 0; i < b; ++i)
          for (unsigned j = 0; j < b; ++j)
            block(i, j) = A.el(node * b + i, node * b + j);
        Eigen::Map<Matrix>(result.data() + node * b * b, b, b) = block.inverse();
      }
      return result;
    }

    /// Of D^-1 A, by a few steps of the power method, with some margin; of functions that are zero on cuts, where @p inverse is.
    double
    largest_eigenvalue(const SparseMatrix<double> &A, const std::vector<double> &inverse, const unsigned b, const KindsOfNodes &kinds)
    {
      constexpr unsigned                     n_steps = 10;
      constexpr double                       margin = 1.1;
      std::mt19937                           random(1);
      std::uniform_real_distribution<double> between(-1, 1);
      Vector                                 x(A.m()), Ax(A.m());
      for (std::size_t j = 0; j < A.m(); ++j)
        x(j) = kinds.on_cut(j / b) ? 0. : between(random);
      double eigenvalue = 1;
      for (unsigned step = 0; step < n_steps; ++step)
      {
        A.vmult(Ax, x);
        const double energy = x * Ax;
        double       next_norm = 0;
        for (std::size_t node = 0; node < A.m() / b; ++node)
          for (unsigned i = 0; i < b; ++i)
          {
            double sum = 0;
            for (unsigned j = 0; j < b; ++j)
              sum += inverse[(node * b + i) * b + j] * Ax(node * b + j);
            x(node * b + i) = sum;
            next_norm += sum * Ax(node * b + i);
          }
        if (!(energy > 0))
          return 1;
        eigenvalue = next_norm / energy; // (x'A D^-1 A x) / (x'A x)
        x /= x.linfty_norm();
      }
      return margin * eigenvalue;
    }

    /// Near null space at the unknowns of nodes, row by row; zero where they are fixed. One is the constant.
    Matrix modes_of(const std::vector<bool> &free_unknowns, const std::vector<Vector> &near_null_space)
    {
      const std::size_t n = free_unknowns.size(), k = std::max<std::size_t>(near_null_space.size(), 1);
      Matrix            modes = Matrix::Ones(n, k);
      for (std::size_t j = 0; j < near_null_space.size(); ++j)
        for (std::size_t i = 0; i < n; ++i)
          modes(i, j) = near_null_space[j](i);
      for (std::size_t i = 0; i < n; ++i)
        if (!free_unknowns[i])
          modes.row(i).setZero();
      return modes;
    }

    /// modes <- Q and @p coarse <- R, modes = Q R on each aggregate. Columns of Q are zero where nothing new is left.
    void make_orthonormal(const Aggregates &aggregates, const unsigned b, Matrix &modes, Matrix &coarse)
    {
      const Eigen::Index                      k = modes.cols();
      std::vector<std::vector<std::uint32_t>> nodes(aggregates.size);
      for (std::uint32_t node = 0; node < aggregates.of_node.size(); ++node)
        if (aggregates.of_node[node] != Aggregates::none)
          nodes[aggregates.of_node[node]].push_back(node);
        else
          modes.middleRows(node * std::size_t(b), b).setZero();
      coarse = Matrix::Zero(aggregates.size * k, k);
      for (std::uint32_t aggregate = 0; aggregate < aggregates.size; ++aggregate)
      {
        Eigen::MatrixXd Q(nodes[aggregate].size() * b, k), R = Eigen::MatrixXd::Zero(k, k);
        for (std::size_t i = 0; i < nodes[aggregate].size(); ++i)
          Q.middleRows(i * b, b) = modes.middleRows(nodes[aggregate][i] * std::size_t(b), b);
        for (Eigen::Index j = 0; j < k; ++j)
        {
          const double before = Q.col(j).norm();
          for (unsigned pass = 0; pass < 2; ++pass)
            for (Eigen::Index i = 0; i < j; ++i)
            {
              const double part = Q.col(i).dot(Q.col(j));
              R(i, j) += part;
              Q.col(j) -= part * Q.col(i);
            }
          const double left = Q.col(j).norm();
          if (left > nothing_new * before)
          {
            R(j, j) = left;
            Q.col(j) /= left;
          }
          else
            Q.col(j).setZero();
        }
        for (std::size_t i = 0; i < nodes[aggregate].size(); ++i)
          modes.middleRows(nodes[aggregate][i] * std::size_t(b), b) = Q.middleRows(i * b, b);
        coarse.middleRows(aggregate * k, k) = R;
      }
    }

    /// Rows of one node in blocks for aggregates.
    struct RowOfBlocks
    {
      std::vector<std::uint32_t> columns;
      std::vector<double>        blocks;
      Places                     place;

      explicit RowOfBlocks(const std::size_t n_aggregates) : place(n_aggregates) {}

      double *block(const std::uint32_t column, const std::size_t size)
      {
        const std::size_t k = place(column, columns);
        if (blocks.size() < columns.size() * size)
          blocks.resize(columns.size() * size, 0.);
        return blocks.data() + k * size;
      }

      void clear()
      {
        place.forget(columns);
        columns.clear();
        blocks.clear();
      }
    };
    /// An aggregate of nodes on cuts; its number is the same on all processes.
    struct AggregateOnCut
    {
      std::uint64_t number;
      std::uint32_t here; ///< its number on this process
      std::int32_t  set;  ///< of processes that have it

      bool operator<(const AggregateOnCut &other) const { return number < other.number; }
    };

    /// Gives nodes on cuts of other owners the aggregates that these have put them in. Sorted.
    std::vector<AggregateOnCut>
    take_aggregates_of_owners(Aggregates &sets, const KindsOfNodes &kinds, const unsigned b, const SharedUnknowns &shared)
    {
      std::vector<AggregateOnCut> on_cuts;
      if (shared.processes().alone())
        return on_cuts;
      const std::uint64_t first = shared.processes().sum_of_lower_ranks(sets.size) + 1; // 0: none
      std::vector<double> number(sets.of_node.size() * b, 0.);
      std::vector<bool>   listed(sets.size, false);
      for (std::uint32_t node = 0; node < sets.of_node.size(); ++node)
        if (const auto here = sets.of_node[node]; kinds.on_cut(node) && here != Aggregates::none)
        {
          number[node * std::size_t(b)] = double(first + here);
          if (!listed[here])
            on_cuts.push_back({first + here, here, kinds.set[node]});
          listed[here] = true;
        }
      shared.take_from_owner(number.data());
      std::map<std::uint64_t, std::uint32_t> of_others;
      for (std::uint32_t node = 0; node < sets.of_node.size(); ++node)
        if (const auto of_owner = std::uint64_t(number[node * std::size_t(b)]); kinds.kind[node] == KindsOfNodes::of_others && of_owner > 0)
        {
          const auto [entry, is_new] = of_others.try_emplace(of_owner, sets.size);
          if (is_new)
            on_cuts.push_back({of_owner, sets.size++, kinds.set[node]});
          sets.of_node[node] = entry->second;
        }
      std::sort(on_cuts.begin(), on_cuts.end());
      return on_cuts;
    }

    /// The unknowns at these aggregates, @p k each.
    SharedUnknowns shared_by(const std::vector<AggregateOnCut> &on_cuts,
                             const KindsOfNodes                &kinds,
                             const unsigned                     k,
                             const std::size_t                  n_dofs,
                             const SharedUnknowns              &shared)
    {
      std::vector<SharedUnknowns::Entry> entries;
      for (const AggregateOnCut &aggregate : on_cuts)
        for (unsigned j = 0; j < k; ++j)
          entries.push_back({std::uint32_t(aggregate.here * k + j), kinds.ranks[aggregate.set]});
      return shared.processes().alone() ? SharedUnknowns() : SharedUnknowns(shared.processes(), n_dofs, entries);
    }

    Aggregates aggregates(const Graph &graph)
    {
      Aggregates          result;
      constexpr auto      none = Aggregates::none;
      auto               &of_node = result.of_node;
      const std::uint32_t n = graph.size();
      of_node.assign(n, none);
      const auto order = graph.breadth_first();
      const auto taken = [&](const std::uint32_t node) { return of_node[node] != none; };

      // All neighbours of a node that belong to no other.
      for (const std::uint32_t node : order)
      {
        bool alone = !graph.is_free[node] || graph.row_start[node] == graph.row_start[node + 1], next_to_other = taken(node);
        if (alone || next_to_other)
          continue;
        graph.for_each_neighbour(node, [&](const std::uint32_t other, float) { next_to_other = next_to_other || taken(other); });
        if (next_to_other)
          continue;
        of_node[node] = result.size;
        graph.for_each_neighbour(node, [&](const std::uint32_t other, float) { of_node[other] = result.size; });
        ++result.size;
      }
      // What is between goes to the one it is connected with most.
      const std::vector<std::uint32_t> first(of_node);
      std::vector<float>               sum(result.size);
      for (const std::uint32_t node : order)
        if (!taken(node) && graph.is_free[node])
        {
          std::uint32_t best = none;
          graph.for_each_neighbour(node,
                                   [&](const std::uint32_t other, const float strength)
                                   {
                                     if (first[other] == none)
                                       return;
                                     sum[first[other]] += strength;
                                     if (best == none || sum[first[other]] > sum[best])
                                       best = first[other];
                                   });
          graph.for_each_neighbour(node,
                                   [&](const std::uint32_t other, float)
                                   {
                                     if (first[other] != none)
                                       sum[first[other]] = 0;
                                   });
          of_node[node] = best;
        }
      for (const std::uint32_t node : order)
        if (!taken(node) && graph.is_free[node])
        {
          of_node[node] = result.size;
          graph.for_each_neighbour(node,
                                   [&](const std::uint32_t other, float)
                                   {
                                     if (!taken(other))
                                       of_node[other] = result.size;
                                   });
          ++result.size;
        }
      return result;
    }
  } // namespace

  Aggregates aggregates(const SparseMatrix<double> &A, const unsigned block_size, const double threshold)
  {
    return aggregates(Graph(A, block_size, threshold, free_unknowns(A, {}), KindsOfNodes(A.m() / block_size, block_size, {}).kind));
  }

  void BlockProlongation::restrict(const float *const fine, float *const coarse) const
  {
    std::fill_n(coarse, n_coarse(), 0.F);
    add_restriction({n_nodes(), row_start.data(), columns.data(), blocks.data()}, n_rows, n_columns, fine, coarse);
  }

  void BlockProlongation::prolongate(const float *const coarse, const float factor, float *const fine) const
  {
    add_prolongation({n_nodes(), row_start.data(), columns.data(), blocks.data()}, n_rows, n_columns, coarse, factor, fine);
  }

  AggregatedSpace aggregated_space(const SparseMatrix<double>  &A,
                                   const unsigned               b,
                                   const std::vector<Vector>   &near_null_space,
                                   const AggregationParameters &parameters,
                                   const SharedUnknowns        &shared)
  {
    const auto         free = free_unknowns(A, shared);
    const KindsOfNodes kinds(A.m() / b, b, shared);
    Aggregates         sets = aggregates(Graph(A, b, parameters.threshold, free, kinds.kind));
    const auto         on_cuts = take_aggregates_of_owners(sets, kinds, b, shared);
    Matrix             Q = modes_of(free, near_null_space), coarse_modes;
    const unsigned     k = Q.cols();
    make_orthonormal(sets, b, Q, coarse_modes);
    const std::vector<double> inverse = inverse_blocks(A, b, kinds);
    const double              omega = 4. / 3 / shared.processes().max(largest_eigenvalue(A, inverse, b, kinds));

    AggregatedSpace space;
    auto           &P = space.P;
    P.n_rows = b;
    P.n_columns = k;
    P.n_aggregates = sets.size;
    RowsAtNodes                                        row(A, b);
    RowOfBlocks                                        sum(sets.size);
    std::vector<double>                                smoothed(b * k);
    std::vector<std::pair<std::uint32_t, std::size_t>> sorted;
    for (std::uint32_t node = 0; node < sets.of_node.size(); ++node)
    {
      if (kinds.on_cut(node) && sets.of_node[node] != Aggregates::none)
      {
        P.columns.push_back(sets.of_node[node]);
        for (unsigned i = 0; i < b * k; ++i)
          P.blocks.push_back(float(Q.data()[node * std::size_t(b) * k + i]));
      }
      else if (sets.of_node[node] != Aggregates::none)
      {
        row.go_to(node);
        for (std::size_t j = 0; j < row.columns.size(); ++j)
          if (const std::uint32_t aggregate = sets.of_node[row.columns[j]]; aggregate != Aggregates::none)
            add_product(row.blocks.data() + j * b * b, Q.data() + row.columns[j] * std::size_t(b) * k, b, k, sum.block(aggregate, b * k));
        sorted.clear();
        for (std::size_t j = 0; j < sum.columns.size(); ++j)
          sorted.emplace_back(sum.columns[j], j);
        std::sort(sorted.begin(), sorted.end());
        for (const auto &[aggregate, j] : sorted)
        {
          std::fill(smoothed.begin(), smoothed.end(), 0.);
          add_product(inverse.data() + node * std::size_t(b) * b, sum.blocks.data() + j * b * k, b, k, smoothed.data());
          P.columns.push_back(aggregate);
          for (unsigned i = 0; i < b * k; ++i)
          {
            const double of_aggregate = aggregate == sets.of_node[node] ? Q.data()[node * std::size_t(b) * k + i] : 0.;
            P.blocks.push_back(float(of_aggregate - omega * smoothed[i]));
          }
        }
        sum.clear();
      }
      P.row_start.push_back(P.columns.size());
    }
    P.columns.shrink_to_fit();
    P.blocks.shrink_to_fit();
    for (unsigned j = 0; j < k; ++j)
    {
      auto &mode = space.near_null_space.emplace_back(P.n_coarse());
      for (std::size_t i = 0; i < P.n_coarse(); ++i)
        mode(i) = coarse_modes(i, j);
    }
    space.shared = shared_by(on_cuts, kinds, k, P.n_coarse(), shared);
    return space;
  }

  void galerkin_product(const SparseMatrix<double> &A, const BlockProlongation &P, SparsityPattern &pattern, SparseMatrix<double> &product)
  {
    const unsigned      b = P.n_rows, k = P.n_columns;
    const RowsOfColumns nodes(P.row_start, P.columns, P.n_aggregates);

    // AP in blocks.
    std::vector<double>        block(b * k); // of P
    RowsAtNodes                row(A, b);
    RowOfBlocks                sum(P.n_aggregates);
    std::vector<std::size_t>   AP_start = {0};
    std::vector<std::uint32_t> AP_columns;
    std::vector<double>        AP_blocks;
    for (std::uint32_t node = 0; node < P.n_nodes(); ++node)
    {
      if (P.row_start[node] < P.row_start[node + 1])
      {
        row.go_to(node);
        for (std::size_t j = 0; j < row.columns.size(); ++j)
          for (std::size_t l = P.row_start[row.columns[j]]; l < P.row_start[row.columns[j] + 1]; ++l)
          {
            std::copy_n(P.blocks.data() + l * b * k, b * k, block.data());
            add_product(row.blocks.data() + j * b * b, block.data(), b, k, sum.block(P.columns[l], b * k));
          }
        AP_columns.insert(AP_columns.end(), sum.columns.begin(), sum.columns.end());
        AP_blocks.insert(AP_blocks.end(), sum.blocks.begin(), sum.blocks.end());
        sum.clear();
      }
      AP_start.push_back(AP_columns.size());
    }

    // P'(AP), row by row.
    std::vector<std::vector<std::pair<global_dof_index, double>>> rows(P.n_coarse());
    std::vector<std::pair<std::uint32_t, std::size_t>>            sorted;
    for (std::uint32_t c = 0; c < P.n_aggregates; ++c)
    {
      sum.block(c, k * k);
      for (std::size_t i = nodes.start[c]; i < nodes.start[c + 1]; ++i)
      {
        const std::uint32_t node = nodes.rows[i];
        const std::size_t   at =
          std::lower_bound(P.columns.begin() + P.row_start[node], P.columns.begin() + P.row_start[node + 1], c) - P.columns.begin();
        std::copy_n(P.blocks.data() + at * b * k, b * k, block.data());
        for (std::size_t l = AP_start[node]; l < AP_start[node + 1]; ++l)
        {
          double *const to = sum.block(AP_columns[l], k * k);
          add_transposed_product(block.data(), AP_blocks.data() + l * b * k, b, k, to);
        }
      }
      sorted.clear();
      for (std::size_t j = 0; j < sum.columns.size(); ++j)
        sorted.emplace_back(sum.columns[j], j);
      std::sort(sorted.begin(), sorted.end());
      for (unsigned r = 0; r < k; ++r)
      {
        auto &entries = rows[c * std::size_t(k) + r];
        entries.reserve(sorted.size() * k);
        for (const auto &[column, j] : sorted)
          for (unsigned s = 0; s < k; ++s)
          {
            double value = sum.blocks[j * k * k + r * k + s];
            if (column == c && r == s && !(value > 0))
              value = 1;
            entries.emplace_back(column * std::size_t(k) + s, value);
          }
      }
      sum.clear();
    }
    pattern.copy_from(P.n_coarse(), P.n_coarse(), rows.begin(), rows.end());
    product.reinit(pattern);
    product.copy_from(rows.begin(), rows.end());
  }

  OwnSparseRows product(const SparseRows &B, const BlockProlongation &P)
  {
    OwnSparseRows  result;
    const unsigned b = P.n_rows, k = P.n_columns;
    RowOfBlocks    sum(P.n_aggregates);
    result.n_columns = P.n_coarse();
    std::vector<std::pair<std::uint32_t, std::size_t>> sorted;
    for (std::size_t i = 0; i < B.size(); ++i)
    {
      for (std::size_t m = B.row_start[i]; m < B.row_start[i + 1]; ++m)
      {
        const std::size_t node = B.columns[m] / b, component = B.columns[m] % b;
        for (std::size_t l = P.row_start[node]; l < P.row_start[node + 1]; ++l)
        {
          double *const to = sum.block(P.columns[l], k);
          for (unsigned j = 0; j < k; ++j)
            to[j] += B.values[m] * P.blocks[(l * b + component) * k + j];
        }
      }
      sorted.clear();
      for (std::size_t j = 0; j < sum.columns.size(); ++j)
        sorted.emplace_back(sum.columns[j], j);
      std::sort(sorted.begin(), sorted.end());
      for (const auto &[aggregate, j] : sorted)
        for (unsigned l = 0; l < k; ++l)
        {
          result.columns.push_back(aggregate * std::size_t(k) + l);
          result.values.push_back(sum.blocks[j * k + l]);
        }
      result.row_start.push_back(result.columns.size());
      sum.clear();
    }
    return result;
  }
} // namespace unilateral
