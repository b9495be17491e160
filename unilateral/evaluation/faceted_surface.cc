#include "unilateral/evaluation/faceted_surface.h"

#include "unilateral/base/byte_archive.h"
#include "unilateral/constraints/quadrature_rule.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>
#include <set>

namespace unilateral
{
  using namespace dealii;

  namespace
  {
    /// Of the angle between facets: beyond 45 degrees it is an edge of the body.
    const double cosine_of_edge = std::sqrt(0.5);

    /// E/(1 - nu^2) from the energies of simple stresses.
    template <int dim>
    double contact_modulus(const Problem<dim> &problem, const types::material_id region, const Point<dim> &x)
    {
      Flux tension{}, shear{};
      tension[0] = 1;
      shear[3] = 1;
      const double E = 1 / problem.form->flux_energy(tension, region, x);
      const double nu = problem.form->flux_energy(shear, region, x) * E / 2 - 1;
      return E / (1 - nu * nu);
    }

    /// A face of a body, as if it were flat.
    template <int dim>
    struct FlatFace
    {
      types::boundary_id      part = 0;
      std::vector<unsigned>   vertices;     ///< the same numbers on all processes
      std::vector<Point<dim>> corners;      ///< these
      Point<dim>              lower, upper; ///< the box around it
      Tensor<1, dim>          normal;       ///< outward, of length 1
      double                  area = 0;
      double                  modulus = 0;
    };

    /// The faces around each vertex of a part, in their order.
    using FacesAtVertices = std::map<std::pair<types::boundary_id, unsigned>, std::set<int>>;

    /// @p dim > 1.
    template <int dim>
    FlatFace<dim> flat_face(const Problem<dim> &problem, const typename Triangulation<dim>::active_cell_iterator &cell, const unsigned f)
    {
      const auto    face = cell->face(f);
      FlatFace<dim> result;
      result.part = face->boundary_id();
      result.lower = result.upper = face->vertex(0);
      for (const unsigned v : face->vertex_indices())
      {
        const unsigned vertex = face->vertex_index(v);
        result.vertices.push_back(problem.space.subdomain ? problem.space.subdomain->ids_of_vertices[vertex] : vertex);
        result.corners.push_back(face->vertex(v));
        for (unsigned d = 0; d < dim; ++d)
        {
          result.lower[d] = std::min(result.lower[d], face->vertex(v)[d]);
          result.upper[d] = std::max(result.upper[d], face->vertex(v)[d]);
        }
      }
      const Tensor<1, dim> first = face->vertex(1) - face->vertex(0);
      if constexpr (dim == 2)
        result.normal = cross_product_2d(first);
      else
        result.normal = face->n_vertices() == 3 ? cross_product_3d(first, face->vertex(2) - face->vertex(0))
                                                : cross_product_3d(face->vertex(3) - face->vertex(0), face->vertex(2) - face->vertex(1));
      result.area = dim == 2 ? first.norm() : result.normal.norm() / 2;
      result.normal /= result.normal.norm();
      if (result.normal * (face->center() - cell->center()) < 0)
        result.normal *= -1;
      result.modulus = contact_modulus(problem, cell->material_id(), face->center());
      return result;
    }

    /// Those of the parts where contact may act. @p dim > 1.
    template <int dim>
    std::vector<FlatFace<dim>> faces_for_contact(const Problem<dim> &problem)
    {
      std::set<types::boundary_id> parts;
      for (const auto &condition : problem.conditions)
        if (condition.part)
          parts.insert(*condition.part);
      std::vector<FlatFace<dim>> faces;
      if (parts.empty())
        return faces;
      for (const auto &cell : problem.space.mesh.triangulation->active_cell_iterators())
        for (const auto f : cell->face_indices())
          if (cell->at_boundary(f) && parts.count(cell->face(f)->boundary_id()) != 0)
            faces.push_back(flat_face(problem, cell, f));
      return faces;
    }

    template <int dim>
    std::vector<FlatFace<dim>> gather(const std::vector<FlatFace<dim>> &own, const Processes &processes)
    {
      if (processes.alone())
        return own;
      ByteWriter writer;
      for (const FlatFace<dim> &face : own)
      {
        writer(face.part);
        writer(face.vertices);
        for (const Point<dim> &x : face.corners)
          for (unsigned d = 0; d < dim; ++d)
            writer(x[d]);
        for (unsigned d = 0; d < dim; ++d)
          for (const double number : {face.lower[d], face.upper[d], face.normal[d]})
            writer(number);
        writer(face.area);
        writer(face.modulus);
      }
      const auto                 bytes = processes.gather(writer.bytes);
      std::vector<FlatFace<dim>> all;
      for (ByteReader reader(bytes); !reader.at_end();)
      {
        FlatFace<dim> &face = all.emplace_back();
        reader(face.part);
        reader(face.vertices);
        face.corners.resize(face.vertices.size());
        for (Point<dim> &x : face.corners)
          for (unsigned d = 0; d < dim; ++d)
            reader(x[d]);
        for (unsigned d = 0; d < dim; ++d)
          for (double *const number : {&face.lower[d], &face.upper[d], &face.normal[d]})
            reader(*number);
        reader(face.area);
        reader(face.modulus);
      }
      return all;
    }

    template <int dim>
    FacesAtVertices faces_at_vertices(const std::vector<FlatFace<dim>> &faces)
    {
      FacesAtVertices result;
      for (std::size_t k = 0; k < faces.size(); ++k)
        for (const unsigned vertex : faces[k].vertices)
          result[{faces[k].part, vertex}].insert(k);
      return result;
    }

    /// At each vertex of @p face the mean of the normals of the faces around it that no edge of the body separates from @p face.
    template <int dim>
    std::vector<Tensor<1, dim>>
    normals_at_vertices(const FlatFace<dim> &face, const std::vector<FlatFace<dim>> &faces, const FacesAtVertices &faces_at)
    {
      std::vector<Tensor<1, dim>> normals;
      for (const unsigned vertex : face.vertices)
      {
        Tensor<1, dim> sum;
        for (const int other : faces_at.at({face.part, vertex}))
          if (faces[other].normal * face.normal > cosine_of_edge)
            sum += faces[other].normal;
        normals.push_back(sum / sum.norm());
      }
      return normals;
    }
  } // namespace

  template <int dim>
  FacetedSurface<dim>::FacetedSurface(const Problem<dim> &problem)
  {
    if constexpr (dim > 1)
    {
      if (problem.form->n_components() == 1)
        return;
      const std::vector<FlatFace<dim>> faces = gather(faces_for_contact(problem), problem.space.processes());
      const FacesAtVertices            faces_at = faces_at_vertices(faces);
      for (const FlatFace<dim> &face : faces)
      {
        Facet facet{.lower = face.lower, .upper = face.upper, .area = face.area, .modulus = face.modulus, .part = face.part};
        const std::vector<Tensor<1, dim>> normals = normals_at_vertices(face, faces, faces_at);
        for (unsigned a = 0; a < face.vertices.size(); ++a)
          for (unsigned b = 0; b < a; ++b)
          {
            const Tensor<1, dim> chord = face.corners[b] - face.corners[a];
            const double         s = std::abs((normals[b] - normals[a]) * chord) / 8;
            facet.sagitta = std::max(facet.sagitta, s);
            facet.slope = std::max(facet.slope, s / chord.norm());
          }
        facets.push_back(facet);
      }
    }
    else
      (void)problem;
  }

  template <int dim>
  std::optional<typename FacetedSurface<dim>::Finding> FacetedSurface<dim>::look_at(const Problem<dim>       &problem,
                                                                                    const ConstraintSet<dim> &set,
                                                                                    const ConstraintBlock    &block,
                                                                                    const unsigned            part,
                                                                                    const Vector             &lambda) const
  {
    std::vector<Point<dim>> active; // by their first coordinate
    double                  force = 0, area = 0, change = 0;
    for (std::size_t i = block.begin; i < block.end; ++i)
      if (lambda(i) > 0)
      {
        active.push_back(set.points[i].x);
        if (set.owns(i))
          force += set.points[i].weight * lambda(i);
      }
    const auto earlier = [](const Point<dim> &a, const Point<dim> &b) { return a[0] < b[0]; };
    std::sort(active.begin(), active.end(), earlier);
    Finding finding;
    for (const Facet &facet : facets)
    {
      if (facet.part != part)
        continue;
      const double slack = 1e-6 * facet.lower.distance(facet.upper);
      Point<dim>   lower = facet.lower, upper = facet.upper;
      for (unsigned d = 0; d < dim; ++d)
      {
        lower[d] -= slack;
        upper[d] += slack;
      }
      const auto touches = [&](const Point<dim> &x)
      {
        for (unsigned d = 0; d < dim; ++d)
          if (x[d] < lower[d] || x[d] > upper[d])
            return false;
        return true;
      };
      const auto from = std::lower_bound(active.begin(), active.end(), lower, earlier);
      const auto to = std::upper_bound(from, active.end(), upper, earlier);
      if (!problem.space.processes().any(std::any_of(from, to, touches)))
        continue;
      area += facet.area;
      change += facet.area * 2 * facet.modulus * facet.slope;
      finding.sagitta = std::max(finding.sagitta, facet.sagitta);
      finding.angle = std::max(finding.angle, 8 * facet.slope * 180 / std::numbers::pi);
    }
    force = problem.space.processes().sum(force);
    if (area == 0 || finding.sagitta == 0 || force == 0)
      return {};
    finding.pressure = change / area;
    finding.mean = force / area;
    return finding;
  }

  template <int dim>
  bool feels_inside_faces(const Problem<dim> &problem, const RuleName &rule)
  {
    const Quadrature<dim - 1> points = quadrature_rule<dim - 1>(rule, problem.space.element);
    return std::any_of(points.get_points().begin(), points.get_points().end(),
                       [](const Point<dim - 1> &x)
                       {
                         for (unsigned d = 0; d + 1 < dim; ++d)
                           if (std::abs(x[d]) > 1e-12 && std::abs(x[d] - 1) > 1e-12)
                             return true;
                         return false;
                       });
  }

#define INSTANTIATE(dim)                                                                                                                   \
  template class FacetedSurface<dim>;                                                                                                      \
  template bool feels_inside_faces(const Problem<dim> &, const RuleName &);
  INSTANTIATE(1)
  INSTANTIATE(2)
  INSTANTIATE(3)
#undef INSTANTIATE
} // namespace unilateral
