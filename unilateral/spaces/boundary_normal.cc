#include "unilateral/spaces/boundary_normal.h"

#include <deal.II/grid/manifold.h>
#include <deal.II/grid/manifold_lib.h>

#include <algorithm>
#include <cmath>

namespace unilateral
{
  using namespace dealii;

  namespace
  {
    /// The normal of the geometry, of any sign; zero where the mesh knows none.
    template <int dim>
    Tensor<1, dim> normal_of_geometry(const typename Triangulation<dim>::face_iterator &face, const Point<dim> &x)
    {
      const auto &manifold = face->get_manifold();
      if (dynamic_cast<const FlatManifold<dim> *>(&manifold) != nullptr)
        return {};
      // deal.II 9.4 takes any face of a sphere for a quadrilateral, and reads a fourth vertex of triangles.
      if (const auto *const sphere = dynamic_cast<const SphericalManifold<dim> *>(&manifold); sphere && dim == 3 && face->n_vertices() == 3)
        return (x - sphere->center) / (x - sphere->center).norm();
      return manifold.normal_vector(face, x);
    }
  } // namespace

  template <int dim>
  Tensor<1, dim> boundary_normal(const FEFaceValues<dim> &values, const unsigned q)
  {
    const Tensor<1, dim> of_cell = values.normal_vector(q);
    if constexpr (dim > 1)
    {
      const typename Triangulation<dim>::face_iterator face = values.get_cell()->face(values.get_face_number());
      const Tensor<1, dim>                             of_geometry = normal_of_geometry<dim>(face, values.quadrature_point(q));
      if (std::abs(of_geometry * of_cell) > 0.7) // else the manifold does not mean this face
        return of_geometry * of_cell > 0 ? of_geometry : -of_geometry;
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
