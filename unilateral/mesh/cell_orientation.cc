#include "unilateral/mesh/cell_orientation.h"

#include <deal.II/base/tensor.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

namespace unilateral
{
  using dealii::Point;

  namespace
  {
    /// Volume spanned by the edges that leave corner @p c, relative to their lengths: -1 (mirrored cube) to 1 (cube).
    template <int dim>
    double corner_volume(const std::vector<Point<dim>> &points, const std::vector<unsigned> &cell, const bool simplex, const unsigned c)
    {
      dealii::Tensor<2, dim> edges;
      double                 lengths = 1;
      for (unsigned d = 0; d < dim; ++d)
      {
        // Edge d of a hypercube joins the corners whose numbers differ in bit d; that of a simplex leads to the d-th of the others.
        const unsigned bit = 1u << d, from = simplex ? c : c & ~bit, to = simplex ? d + (d >= c) : c | bit;
        edges[d] = points[cell[to]] - points[cell[from]];
        lengths *= edges[d].norm();
      }
      const double sign = simplex && c % 2 == 1 ? -1 : 1; // of the permutation that brings the corner to the front
      return lengths > 0 ? sign * dealii::determinant(edges) / lengths : 0;
    }

    void mirror(std::vector<unsigned> &cell, const bool simplex)
    {
      if (simplex)
        std::swap(cell[0], cell[1]);
      else if (cell.size() == 4)
        std::swap(cell[1], cell[2]);
      else
        for (unsigned v = 0; v < 4; ++v)
          std::swap(cell[v], cell[v + 4]);
    }
  } // namespace

  template <int dim>
  bool turn_to_positive_volume(std::vector<unsigned> &cell, const bool simplex, const std::vector<Point<dim>> &points)
  {
    double smallest = std::numeric_limits<double>::max(), largest = -smallest;
    for (unsigned c = 0; c < cell.size(); ++c)
    {
      const double volume = corner_volume(points, cell, simplex, c);
      if (!std::isfinite(volume)) // coordinates too large for a volume, or none at all
        return false;
      smallest = std::min(smallest, volume);
      largest = std::max(largest, volume);
    }
    // The corners of a simplex span the same volume, and see it at angles of their own: one may be sharp, as long as its edges are not
    // parallel up to round-off.
    constexpr double flat = 1e-10, round_off = 1e-13;
    const auto       positive = [simplex](const double least, const double most)
    { return simplex ? most > flat && least > round_off : least > flat; };
    if (positive(-largest, -smallest))
      mirror(cell, simplex);
    else if (!positive(smallest, largest))
      return false;
    return true;
  }

  template bool turn_to_positive_volume(std::vector<unsigned> &, bool, const std::vector<Point<1>> &);
  template bool turn_to_positive_volume(std::vector<unsigned> &, bool, const std::vector<Point<2>> &);
  template bool turn_to_positive_volume(std::vector<unsigned> &, bool, const std::vector<Point<3>> &);
} // namespace unilateral
