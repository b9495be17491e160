#include "unilateral/spaces/boundary_normal.h"

#include <deal.II/grid/manifold.h>

#include <algorithm>
#include <cmath>

namespace unilateral
{
  using namespace dealii;

  template <int dim>
  Tensor<1, dim> boundary_normal(const FEFaceValues<dim> &values, const unsigned q)
  {
    const Tensor<1, dim> of_cell = values.normal_vector(q);
    if constexpr (dim > 1)
    {
      const auto  face = values.get_cell()->face(values.get_face_number());
      const auto &manifold = face->get_manifold();
      if (dynamic_cast<const FlatManifold<dim> *>(&manifold) == nullptr)
      {
        const Tensor<1, dim> of_geometry = manifold.normal_vector(face, values.quadrature_point(q));
        if (std::abs(of_geometry * of_cell) > 0.7) // else the manifold does not mean this face
          return of_geometry * of_cell > 0 ? of_geometry : -of_geometry;
      }
    }
    return of_cell;
  }

  template <int dim>
  void NodeNormals<dim>::add(const Tensor<1, dim> &normal, const double weight)
  {
    constexpr double cosine_of_50_degrees = 0.64278760968653936;
    // A face without weight (on the axis of a body of revolution) still has a direction.
    const Tensor<1, dim> contribution = normal * std::max(weight, 1e-100);
    for (Side &side : all)
      if (side.normal() * normal > cosine_of_50_degrees)
      {
        side.sum += contribution;
        side.weight += weight;
        return;
      }
    all.push_back({contribution, weight});
  }

#define INSTANTIATE(dim)                                                                                                                   \
  template Tensor<1, dim> boundary_normal(const FEFaceValues<dim> &, unsigned);                                                            \
  template class NodeNormals<dim>;
  INSTANTIATE(1)
  INSTANTIATE(2)
  INSTANTIATE(3)
#undef INSTANTIATE
} // namespace unilateral
