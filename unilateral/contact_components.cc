#include "unilateral/contact_components.h"

#include "unilateral/rule_on_cells.h"

#include <algorithm>
#include <map>
#include <numeric>
#include <set>

namespace unilateral
{
  using namespace dealii;

  template <int dim>
  std::vector<ContactComponent>
  contact_components(const Problem<dim> &problem, const ConstraintSet<dim> &set, const std::size_t block, const Vector &lambda)
  {
    const std::size_t                  begin = set.blocks[block].begin, n = set.blocks[block].end - begin;
    std::vector<std::set<std::size_t>> neighbors(n);
    for (const auto &rule : rule_on_cells(problem, set, block))
      for (const std::size_t i : rule.points)
        for (const std::size_t j : rule.points)
          if (i != j && i < set.size() && j < set.size())
            neighbors[i - begin].insert(j - begin);

    // A point without pressure among points that have it: discrete pressures vanish a point behind a concentrated force.
    const auto        pressed = [&](const std::size_t i) { return lambda(begin + i) > 0; };
    std::vector<bool> covered(n, false);
    for (std::size_t i = 0; i < n; ++i)
    {
      const std::size_t n_pressed = std::count_if(neighbors[i].begin(), neighbors[i].end(), pressed);
      const auto        next_to_inside = [&](const std::size_t j) {
        return pressed(j) &&
               std::all_of(neighbors[j].begin(), neighbors[j].end(), [&](const std::size_t k) { return k == i || pressed(k); });
      };
      covered[i] = !pressed(i) && 5 * n_pressed >= 3 * neighbors[i].size() && neighbors[i].size() > 0 &&
                   std::any_of(neighbors[i].begin(), neighbors[i].end(), next_to_inside);
    }

    // Every point in contact knows a representative of its piece.
    std::vector<std::size_t> leader(n);
    std::iota(leader.begin(), leader.end(), 0);
    const auto find = [&](std::size_t i)
    {
      while (leader[i] != i)
        i = leader[i] = leader[leader[i]];
      return i;
    };
    const auto active = [&](const std::size_t i) { return pressed(i) || covered[i]; };
    for (std::size_t i = 0; i < n; ++i)
      for (const std::size_t j : neighbors[i])
        if (active(i) && active(j))
          leader[find(i)] = find(j);
    // How many points lie between a point and the rim of its piece, up to `settled`.
    constexpr int            settled = 3;
    std::vector<int>         depth(n, -1);
    std::vector<std::size_t> front;
    for (std::size_t i = 0; i < n; ++i)
      if (active(i) && !std::all_of(neighbors[i].begin(), neighbors[i].end(), active))
      {
        depth[i] = 0;
        front.push_back(i);
      }
    for (int d = 1; d <= settled; ++d)
    {
      std::vector<std::size_t> next;
      for (const std::size_t i : front)
        for (const std::size_t j : neighbors[i])
          if (active(j) && depth[j] < 0)
          {
            depth[j] = d;
            next.push_back(j);
          }
      front = std::move(next);
    }
    std::map<std::size_t, int>                       deepest; // of a piece
    std::map<std::size_t, std::pair<double, double>> inside;  // force and measure of its deepest points
    for (std::size_t i = 0; i < n; ++i)
      if (active(i))
      {
        if (depth[i] < 0)
          depth[i] = settled;
        int &of_piece = deepest[find(i)];
        of_piece = std::max(of_piece, depth[i]);
      }
    for (std::size_t i = 0; i < n; ++i)
      if (pressed(i) && depth[i] == deepest[find(i)])
      {
        inside[find(i)].first += set.weights[begin + i] * lambda(begin + i);
        inside[find(i)].second += set.weights[begin + i];
      }
    // The pressure that is spread out: where it has settled the pressure itself, towards the rim its continuation.
    std::vector<double> spread(n, 0.);
    for (int d = settled; d >= 0; --d)
      for (std::size_t i = 0; i < n; ++i)
        if (depth[i] == d)
        {
          if (d >= deepest[find(i)])
          {
            spread[i] = d > 0 ? (covered[i] ? inside[find(i)].first / inside[find(i)].second : lambda(begin + i)) : 0;
            continue;
          }
          double   sum = 0;
          unsigned n_deeper = 0;
          for (const std::size_t j : neighbors[i])
            if (depth[j] == d + 1)
            {
              sum += spread[j];
              ++n_deeper;
            }
          // A ridge without deeper neighbours, behind a gap, has the pressure of the inside.
          const auto &[force, measure] = inside[find(i)];
          spread[i] = n_deeper > 0 ? sum / n_deeper : force / measure;
        }

    std::map<std::size_t, ContactComponent> pieces;
    for (std::size_t i = 0; i < n; ++i)
    {
      if (!active(i))
        continue;
      auto        &piece = pieces[find(i)];
      const auto  &x = set.points[begin + i];
      const double w = set.weights[begin + i], force = w * lambda(begin + i);
      if (piece.lower.empty())
        piece.lower.assign(x.begin_raw(), x.end_raw()), piece.upper = piece.lower;
      for (unsigned d = 0; d < dim; ++d)
      {
        piece.lower[d] = std::min(piece.lower[d], x[d]);
        piece.upper[d] = std::max(piece.upper[d], x[d]);
      }
      piece.n_points += pressed(i);
      piece.measure += pressed(i) ? w : 0.;
      piece.force += force;
      const double distributed = (depth[i] == 0 ? 0.5 : 1) * w * spread[i];
      piece.distributed += distributed;
      piece.concentrated += force - distributed;
    }
    std::vector<ContactComponent> result;
    for (auto &[representative, piece] : pieces)
      result.push_back(std::move(piece));
    std::sort(result.begin(), result.end(), [](const auto &a, const auto &b) { return a.lower < b.lower; });
    return result;
  }

  template std::vector<ContactComponent> contact_components(const Problem<1> &, const ConstraintSet<1> &, std::size_t, const Vector &);
  template std::vector<ContactComponent> contact_components(const Problem<2> &, const ConstraintSet<2> &, std::size_t, const Vector &);
  template std::vector<ContactComponent> contact_components(const Problem<3> &, const ConstraintSet<3> &, std::size_t, const Vector &);
} // namespace unilateral
