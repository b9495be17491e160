#include "unilateral/mesh/reference_face.h"

#include <algorithm>
#include <cmath>

namespace unilateral
{
  using namespace dealii;

  template <int dim>
  std::optional<std::pair<unsigned, double>> fixed_coordinate(const ReferenceCell reference, const unsigned face)
  {
    if (dim == 1)
      return std::pair(0u, double(face));
    for (unsigned d = 0; d < dim; ++d)
    {
      double low = 1, high = 0;
      for (const unsigned v : reference.face_reference_cell(face).vertex_indices())
      {
        const double x = reference.template vertex<dim>(reference.face_to_cell_vertices(face, v, 1))[d];
        low = std::min(low, x);
        high = std::max(high, x);
      }
      if (high - low < 1e-12)
        return std::pair(d, low);
    }
    return {};
  }

  template <int dim>
  double distance_outside(const Point<dim> &x, const bool simplex)
  {
    double outside = 0, sum = 0;
    for (unsigned d = 0; d < dim; ++d)
    {
      outside = std::max({outside, -x[d], simplex ? 0. : x[d] - 1});
      sum += x[d];
    }
    return simplex ? std::max(outside, sum - 1) : outside;
  }

  template <int dim>
  double distance_from_face(const ReferenceCell reference, const unsigned face, const Point<dim> &x)
  {
    if (const auto fixed = fixed_coordinate<dim>(reference, face))
      return std::abs(x[fixed->first] - fixed->second);
    double sum = 0;
    for (unsigned d = 0; d < dim; ++d)
      sum += x[d];
    return std::abs(sum - 1) / std::sqrt(double(dim));
  }

  template <int dim>
  bool lies_on_face(const ReferenceCell reference, const unsigned face, const Point<dim> &x)
  {
    return distance_from_face(reference, face, x) < 1e-6;
  }

#define INSTANTIATE(dim)                                                                                                                   \
  template std::optional<std::pair<unsigned, double>> fixed_coordinate<dim>(ReferenceCell, unsigned);                                      \
  template double                                     distance_outside(const Point<dim> &, bool);                                          \
  template double                                     distance_from_face(ReferenceCell, unsigned, const Point<dim> &);                     \
  template bool                                       lies_on_face(ReferenceCell, unsigned, const Point<dim> &);
  INSTANTIATE(1)
  INSTANTIATE(2)
  INSTANTIATE(3)
#undef INSTANTIATE
} // namespace unilateral
