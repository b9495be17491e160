#include "unilateral/mesh/rule_of_total_degree.h"
#include "unilateral/mesh/gauss_rule.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

namespace unilateral
{
  using namespace dealii;

  namespace
  {
    /// A rule that is the same after all 48 reflections and rotations of the cube [-1, 1]^3 (mapped to [0, 1]^3 at the end).
    class SymmetricCubeRule
    {
    public:
      /// All points with the coordinates of @p corner in any order and with any signs, each once.
      void add(const std::array<double, 3> &corner, const double weight)
      {
        std::array<double, 3> coordinates = corner;
        std::sort(coordinates.begin(), coordinates.end());
        do
          for (unsigned signs = 0; signs < 8; ++signs)
          {
            Point<3> x;
            bool     again = false; // 0 has no other sign
            for (unsigned d = 0; d < 3; ++d)
            {
              const bool negative = (signs >> d & 1) != 0;
              again = again || (negative && coordinates[d] == 0);
              x[d] = 0.5 * (1 + (negative ? -coordinates[d] : coordinates[d]));
            }
            if (again)
              continue;
            points.push_back(x);
            weights.push_back(weight / 8);
          }
        while (std::next_permutation(coordinates.begin(), coordinates.end()));
      }

      Quadrature<3> rule() const { return Quadrature<3>(points, weights); }

    private:
      std::vector<Point<3>> points;
      std::vector<double>   weights;
    };

    Quadrature<3> hammer_stroud_14()
    {
      const double      r = std::sqrt(19. / 30), s = std::sqrt(19. / 33);
      SymmetricCubeRule cube;
      cube.add({0, 0, r}, 320. / 361);
      cube.add({s, s, s}, 121. / 361);
      return cube.rule();
    }

    Quadrature<3> sarma_stroud_34()
    {
      const double      root = 3 * std::sqrt(28798.), s2 = (960 - root) / 2726, t2 = (960 + root) / 2726, r = std::sqrt(6. / 7);
      const double      s = std::sqrt(s2), t = std::sqrt(t2);
      SymmetricCubeRule cube;
      cube.add({0, 0, r}, 1078. / 3645);
      cube.add({0, r, r}, 343. / 3645);
      cube.add({s, s, s}, (774 * t2 - 230) / (1215 * (t2 - s2)));
      cube.add({t, t, t}, (230 - 774 * s2) / (1215 * (t2 - s2)));
      return cube.rule();
    }
  } // namespace

  template <int dim>
  Quadrature<dim> rule_of_total_degree(const bool simplex, const unsigned n)
  {
    if constexpr (dim == 3)
      if (!simplex && (n == 3 || n == 4))
        return n == 3 ? hammer_stroud_14() : sarma_stroud_34();
    return gauss_rule<dim>(simplex, n);
  }

  template Quadrature<1> rule_of_total_degree(bool, unsigned);
  template Quadrature<2> rule_of_total_degree(bool, unsigned);
  template Quadrature<3> rule_of_total_degree(bool, unsigned);
} // namespace unilateral
