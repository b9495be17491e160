#include "unilateral/inequality/free_boundary_relaxation.h"

#include "unilateral/base/sort_unique.h"

#include <Eigen/Cholesky>

#include <algorithm>
#include <array>
#include <numeric>

namespace unilateral
{
  namespace
  {
    constexpr unsigned most_sweeps = 8, most_local_steps = 4;
    constexpr double   damping_on_cuts = 0.7;

    /// The unknowns at a node are few.
    constexpr unsigned largest_block = 3;
    using BlockVector = std::array<double, largest_block>;

    class LocalRelaxation
    {
    public:
      LocalRelaxation(const AugmentedProblem &augmented, const LocalRows &rows, Vector &u)
        : rows(rows), u(u.begin()), f(augmented.problem.load().begin()), diagonal(augmented.problem.stiffness_diagonal()),
          shared(augmented.problem.shared()), number(u.size(), none)
      {
        const DiscreteProblem &problem = augmented.problem;
        for (std::size_t k = 0; k < rows.unknowns.size(); ++k)
          number[rows.unknowns[k]] = k;
        for (std::size_t q = 0; q < rows.points.size(); ++q)
        {
          const auto i = rows.points[q];
          double     g = augmented.shift(i) * augmented.multiplier(i) - problem.obstacle()(i);
          for (std::size_t k = rows.B.start[q]; k < rows.B.start[q + 1]; ++k)
            g += rows.B.values[k] * u(rows.B.columns[k]);
          gap.push_back(g);
          penalty.push_back(problem.weights()(i) / (augmented.epsilon + augmented.shift(i)));
        }
        make_blocks();
        find_points_of_blocks();
        find_stiffness_of_blocks();
      }

      /// Every block in order and once more in reverse, those on cuts between processes all at once after each; returns how many points
      /// changed sides.
      std::size_t sweep()
      {
        std::size_t n_changes = 0;
        for (std::size_t b = 0; b < blocks.size(); ++b)
          n_changes += relax(blocks[b]);
        n_changes += relax_on_cuts();
        for (std::size_t b = blocks.size(); b-- > 0;)
          n_changes += relax(blocks[b]);
        return n_changes + relax_on_cuts();
      }

      bool in_contact(const std::size_t q) const { return gap[q] > 0; }

      /// Some a_jk^2 > a_jj a_kk: there is no minimum, and steps towards it grow beyond all bounds.
      bool shows_lack_of_coercivity() const
      {
        for (std::size_t row = 0; row < rows.unknowns.size(); ++row)
        {
          const double a_jj = diagonal(rows.unknowns[row]);
          for (std::size_t k = rows.A.start[row]; k < rows.A.start[row + 1]; ++k)
          {
            const auto   column = rows.A.columns[k];
            const double a_jk = rows.A.values[k];
            if (number[column] != none && !(a_jj > 0 && a_jk * a_jk <= (1 + 1e-8) * a_jj * diagonal(column)))
              return true;
          }
        }
        return false;
      }

    private:
      static constexpr std::uint32_t none = -1;

      /// Unknowns that are relaxed together, and the points that see them.
      struct Block
      {
        unsigned                                 size = 1;
        std::array<std::uint32_t, largest_block> members; ///< places in rows.unknowns
        std::uint32_t                            points_begin = 0, points_end = 0;
        std::size_t                              stiffness_begin = 0;
      };
      struct PointOfBlock
      {
        std::uint32_t point;
        BlockVector   values; ///< of the row of B, for each member
      };

      /// Together are the unknowns that a point couples, if they are so few.
      void make_blocks()
      {
        std::vector<Block>         of_unknown(rows.unknowns.size()); // of the first member
        std::vector<std::uint32_t> first(rows.unknowns.size());
        std::iota(first.begin(), first.end(), 0);
        for (std::uint32_t k = 0; k < first.size(); ++k)
          of_unknown[k].members[0] = k;
        std::vector<std::uint32_t> together;
        for (std::size_t q = 0; q < rows.points.size(); ++q)
        {
          const std::size_t begin = rows.B.start[q], end = rows.B.start[q + 1];
          if (end - begin < 2 || end - begin > largest_block)
            continue;
          together.clear();
          for (std::size_t k = begin; k < end; ++k)
            if (const auto row = number[rows.B.columns[k]]; row != none)
            {
              const Block &block = of_unknown[first[row]];
              together.insert(together.end(), block.members.begin(), block.members.begin() + block.size);
            }
          sort_unique(together);
          if (together.size() > largest_block)
            continue;
          for (const auto row : together)
            first[row] = together[0];
          if (!together.empty())
          {
            of_unknown[together[0]].size = together.size();
            std::copy(together.begin(), together.end(), of_unknown[together[0]].members.begin());
          }
        }
        block_of.resize(first.size());
        for (std::uint32_t k = 0; k < first.size(); ++k)
          if (first[k] == k)
          {
            for (unsigned a = 0; a < of_unknown[k].size; ++a)
              block_of[of_unknown[k].members[a]] = blocks.size();
            blocks.push_back(of_unknown[k]);
          }
      }

      void find_points_of_blocks()
      {
        std::vector<std::uint32_t> last(blocks.size());
        for (const bool fill : {false, true})
        {
          std::fill(last.begin(), last.end(), none);
          for (std::uint32_t q = 0; q < rows.points.size(); ++q)
            for (std::size_t k = rows.B.start[q]; k < rows.B.start[q + 1]; ++k)
            {
              const auto row = number[rows.B.columns[k]];
              if (row == none)
                continue;
              Block     &block = blocks[block_of[row]];
              const bool is_new = last[block_of[row]] != q;
              last[block_of[row]] = q;
              block.points_end += is_new;
              if (!fill)
                continue;
              auto &point = points_of_blocks[block.points_end - 1];
              if (is_new)
                point = {q, {}};
              for (unsigned a = 0; a < block.size; ++a)
                if (block.members[a] == row)
                  point.values[a] += rows.B.values[k];
            }
          std::uint32_t total = 0;
          for (auto &block : blocks)
            if (!fill)
            {
              const auto n = block.points_end;
              block.points_begin = block.points_end = total;
              total += n;
            }
          if (!fill)
            points_of_blocks.resize(total);
        }
      }

      /// The part of A between the unknowns of a block. Where that is spread over processes the block goes into a list of its own.
      void find_stiffness_of_blocks()
      {
        const auto first_on_cut =
          std::stable_partition(blocks.begin(), blocks.end(), [&](const Block &block) { return !shared.shares(unknown(block, 0)); });
        cut_blocks.assign(first_on_cut, blocks.end());
        blocks.erase(first_on_cut, blocks.end());
        for (auto *const list : {&blocks, &cut_blocks})
          for (Block &block : *list)
          {
            block.stiffness_begin = stiffness.size();
            for (unsigned a = 0; a < block.size; ++a)
              for (unsigned b = 0; b < block.size; ++b)
                stiffness.push_back(entry(block.members[a], unknown(block, b)));
          }
        if (shared.processes().alone())
          return;
        on_cuts.assign(number.size(), 0.);
        for (unsigned b = 0; b < largest_block; ++b)
        {
          for (const Block &block : cut_blocks)
            for (unsigned a = 0; a < block.size; ++a)
              on_cuts[unknown(block, a)] = b < block.size ? stiffness[block.stiffness_begin + a * block.size + b] : 0;
          shared.add(on_cuts.data());
          for (const Block &block : cut_blocks)
            for (unsigned a = 0; a < block.size && b < block.size; ++a)
              stiffness[block.stiffness_begin + a * block.size + b] = on_cuts[unknown(block, a)];
        }
      }

      /// (A u) there needs the cells of all processes, so that these blocks move at the same time, damped.
      std::size_t relax_on_cuts()
      {
        if (shared.processes().alone())
          return 0;
        for (const Block &block : cut_blocks)
          for (unsigned a = 0; a < block.size; ++a)
            on_cuts[unknown(block, a)] = product(block.members[a]);
        shared.add(on_cuts.data());
        std::size_t n_changes = 0;
        for (const Block &block : cut_blocks)
          n_changes += relax(block, damping_on_cuts, [&](const unsigned a) { return on_cuts[unknown(block, a)]; });
        return n_changes;
      }

      std::uint32_t unknown(const Block &block, const unsigned a) const { return rows.unknowns[block.members[a]]; }

      double entry(const std::uint32_t row, const std::uint32_t column) const
      {
        for (std::size_t k = rows.A.start[row]; k < rows.A.start[row + 1]; ++k)
          if (rows.A.columns[k] == column)
            return rows.A.values[k];
        return 0;
      }

      /// (A u) in a row.
      double product(const std::uint32_t row) const
      {
        double sum = 0;
        for (std::size_t k = rows.A.start[row]; k < rows.A.start[row + 1]; ++k)
          sum += rows.A.values[k] * u[rows.A.columns[k]];
        return sum;
      }

      std::size_t relax(const Block &block)
      {
        return relax(block, 1, [&](const unsigned a) { return product(block.members[a]); });
      }

      /// @p Au: entry a of A u.
      template <typename Product>
      std::size_t relax(const Block &block, const double damping, const Product &Au)
      {
        switch (block.size)
        {
        case 1:
          return relax_together<1>(block, damping, Au);
        case 2:
          return relax_together<2>(block, damping, Au);
        default:
          return relax_together<3>(block, damping, Au);
        }
      }

      /// That part of the way to the minimum of the energy, piecewise quadratic in so few unknowns, by Newton's method.
      template <unsigned m, typename Product>
      std::size_t relax_together(const Block &block, const double damping, const Product &Au)
      {
        using Vector = Eigen::Matrix<double, m, 1>;
        using Matrix = Eigen::Matrix<double, m, m, m == 1 ? Eigen::ColMajor : Eigen::RowMajor>;
        const Eigen::Map<const Matrix> A(stiffness.data() + block.stiffness_begin);
        Vector                         residual, change = Vector::Zero();
        for (unsigned a = 0; a < m; ++a)
          residual[a] = f[unknown(block, a)] - Au(a);
        const auto  begin = points_of_blocks.begin() + block.points_begin, end = points_of_blocks.begin() + block.points_end;
        std::size_t n_changes = 0;
        bool        at_rest = false;
        for (unsigned k = 0; k < most_local_steps && !at_rest; ++k)
        {
          Matrix tangent = A;
          Vector r = residual;
          for (auto p = begin; p != end; ++p)
            if (const auto q = p->point; gap[q] > 0)
            {
              const Eigen::Map<const Vector> b(p->values.data());
              r -= penalty[q] * gap[q] * b;
              tangent += penalty[q] * b * b.transpose();
            }
          const Eigen::LLT<Matrix> factorised(tangent);
          if (factorised.info() != Eigen::Success)
            break;
          const Vector step = factorised.solve(r);
          at_rest = true;
          for (auto p = begin; p != end; ++p)
          {
            double    &g = gap[p->point];
            const bool before = g > 0;
            g += step.dot(Eigen::Map<const Vector>(p->values.data()));
            at_rest &= (g > 0) == before;
            n_changes += (g > 0) != before;
          }
          change += step;
          residual -= A * step;
        }
        // Where that does not settle, no step is the better one.
        const double part = at_rest ? damping : 0;
        if (part != 1)
          for (auto p = begin; p != end; ++p)
            gap[p->point] -= (1 - part) * change.dot(Eigen::Map<const Vector>(p->values.data()));
        for (unsigned a = 0; a < m; ++a)
          u[unknown(block, a)] += part * change[a];
        return at_rest ? n_changes : 0;
      }

      const LocalRows           &rows;
      double *const              u;
      const double *const        f;
      const Vector              &diagonal;
      const SharedUnknowns      &shared;
      std::vector<std::uint32_t> number, block_of; ///< unknown -> place in rows.unknowns -> block
      std::vector<double>        gap, penalty;     ///< (Bu - s + R lambda)_i and w_i / (eps + r_i) at rows.points
      std::vector<Block>         blocks;
      std::vector<PointOfBlock>  points_of_blocks;
      std::vector<double>        stiffness; ///< of each block, row by row
      std::vector<Block>         cut_blocks;
      std::vector<double>        on_cuts; ///< by unknown: what is brought together
    };
  } // namespace

  void relax_near_free_boundary(const AugmentedProblem &augmented, std::vector<bool> &active, Vector &u)
  {
    if (!augmented.problem.symmetric())
      return;
    const Processes &processes = augmented.problem.processes();
    const LocalRows  rows = augmented.problem.rows_near_free_boundary(active);
    LocalRelaxation  relaxation(augmented, rows, u);
    if (processes.any(relaxation.shows_lack_of_coercivity()))
      return; // that is for Newton's method to tell
    for (unsigned k = 0; k < most_sweeps && processes.any(relaxation.sweep() > 0); ++k)
      ;
    augmented.problem.shared().take_from_owner(u.begin()); // to the last bit
    for (std::size_t q = 0; q < rows.points.size(); ++q)
      active[rows.points[q]] = relaxation.in_contact(q);
  }
} // namespace unilateral
