#include "unilateral/mesh/mesh_generators.h"

#include "unilateral/mesh/make_outline.h"
#include "unilateral/mesh/sphere_manifold.h"

#include <deal.II/grid/grid_generator.h>
#include <deal.II/grid/grid_tools.h>
#include <deal.II/grid/manifold_lib.h>

#include <algorithm>
#include <array>
#include <map>

namespace unilateral
{
  namespace
  {
    using dealii::CellData;
    using dealii::Point;
    using dealii::SubCellData;
    using dealii::Triangulation;
    using dealii::numbers::flat_manifold_id;

    constexpr dealii::types::manifold_id sphere_id = 0;
    constexpr dealii::types::manifold_id blend_id = 1;

    template <int dim>
    Mesh<dim> new_mesh(const bool simplex)
    {
      Mesh<dim> mesh;
      mesh.triangulation = std::make_unique<Triangulation<dim>>();
      mesh.region_names = {"domain"};
      mesh.simplex = simplex;
      return mesh;
    }

    /// Boundary id 2 d + (0: lower, 1: upper) for the side of the box that a face lies on.
    template <int dim>
    void name_box_sides(Mesh<dim> &mesh, const Point<dim> &lower, const Point<dim> &upper)
    {
      for (const auto &cell : mesh.triangulation->active_cell_iterators())
        for (const auto &face : cell->face_iterators())
          if (face->at_boundary())
          {
            const Point<dim> center = face->center();
            unsigned int     side = 0;
            double           nearest = std::numeric_limits<double>::max();
            for (unsigned int s = 0; s < 2 * dim; ++s)
            {
              const unsigned int d = s / 2;
              const double       distance = std::abs(center[d] - (s % 2 ? upper : lower)[d]) / (upper[d] - lower[d]);
              if (distance < nearest)
              {
                nearest = distance;
                side = s;
              }
            }
            face->set_boundary_id(side);
          }
      mesh.part_names = box_part_names(dim);
    }

    /// Vertices of the regular hexagon or icosahedron of unit circumradius and the edges or triangles between them, turned outwards.
    template <int dim>
    std::pair<std::vector<Point<dim>>, std::vector<std::array<unsigned int, dim>>> regular_surface()
    {
      std::vector<Point<dim>>                    vertices;
      std::vector<std::array<unsigned int, dim>> facets;
      if constexpr (dim == 2)
        for (unsigned int i = 0; i < 6; ++i)
        {
          vertices.push_back({std::cos(i * dealii::numbers::PI / 3), std::sin(i * dealii::numbers::PI / 3)});
          facets.push_back({i, (i + 1) % 6});
        }
      else if constexpr (dim == 3)
      {
        const double golden = (1 + std::sqrt(5.)) / 2, scale = 1 / std::sqrt(1 + golden * golden);
        for (unsigned int d = 0; d < 3; ++d)
          for (const double s : {-1., 1.})
            for (const double t : {-golden, golden})
            {
              Point<3> p;
              p[d] = s * scale;
              p[(d + 1) % 3] = t * scale;
              vertices.push_back(p);
            }
        // An edge joins vertices at distance 2 scale, the next distance is 2 golden scale.
        const auto neighbours = [&](unsigned i, unsigned j) { return vertices[i].distance(vertices[j]) < 2.5 * scale; };
        for (unsigned int i = 0; i < 12; ++i)
          for (unsigned int j = i + 1; j < 12; ++j)
            for (unsigned int k = j + 1; k < 12; ++k)
              if (neighbours(i, j) && neighbours(j, k) && neighbours(k, i))
              {
                const bool outwards = vertices[i] * dealii::cross_product_3d(vertices[j], vertices[k]) > 0;
                facets.push_back(outwards ? std::array<unsigned int, 3>{i, j, k} : std::array<unsigned int, 3>{i, k, j});
              }
      }
      return {vertices, facets};
    }

    template <int dim>
    CellData<dim> simplex_cell(const std::array<unsigned int, dim + 1> &vertices)
    {
      CellData<dim> cell(dim + 1);
      std::copy(vertices.begin(), vertices.end(), cell.vertices.begin());
      cell.material_id = 0;
      return cell;
    }

    /// The vertices in the order that makes the cell's volume positive.
    template <int dim>
    std::array<unsigned int, dim + 1> oriented(std::array<unsigned int, dim + 1> v, const std::vector<Point<dim>> &points)
    {
      dealii::Tensor<2, dim> edges;
      for (unsigned int d = 0; d < dim; ++d)
        edges[d] = points[v[d + 1]] - points[v[0]];
      if (dealii::determinant(edges) < 0)
        std::swap(v[0], v[2]); // keeps the pair of edge midpoints 02, 13 that refinement of a tetrahedron joins
      return v;
    }

    template <int dim>
    void triangulate_simplex_ball(Triangulation<dim> &triangulation, const Point<dim> &center, const double radius)
    {
      const auto [directions, facets] = regular_surface<dim>();
      std::vector<Point<dim>> points = {center};
      for (const auto &direction : directions)
        points.push_back(center + radius * (direction - Point<dim>()));
      std::vector<CellData<dim>> cells;
      for (const auto &facet : facets)
      {
        std::array<unsigned int, dim + 1> cell{};
        for (unsigned int v = 0; v < dim; ++v)
          cell[v + 1] = facet[v] + 1;
        cells.push_back(simplex_cell<dim>(oriented<dim>(cell, points)));
      }
      triangulation.create_triangulation(points, cells, SubCellData());
    }

    /// Each facet of the surface spans a quadrilateral or prism between inner and outer sphere, cut along diagonals that run from the
    /// lower to the higher vertex number, so that neighbours agree.
    template <int dim>
    void triangulate_simplex_shell(Triangulation<dim>                               &triangulation,
                                   const Point<dim>                                 &center,
                                   const double                                      inner,
                                   const double                                      outer,
                                   const std::vector<Point<dim>>                    &directions,
                                   const std::vector<std::array<unsigned int, dim>> &facets)
    {
      const unsigned int      n = directions.size();
      std::vector<Point<dim>> points;
      for (const double r : {inner, outer})
        for (const auto &direction : directions)
          points.push_back(center + r * (direction - Point<dim>()));
      std::vector<CellData<dim>> cells;
      for (auto facet : facets)
      {
        std::sort(facet.begin(), facet.end());
        for (unsigned int step = 0; step < dim; ++step)
        {
          // Walk up from the inner to the outer facet: the path leaves the inner one at vertex `step`.
          std::array<unsigned int, dim + 1> cell{};
          for (unsigned int v = 0; v <= dim; ++v)
            cell[v] = v <= step ? facet[v] : n + facet[v - 1];
          cells.push_back(simplex_cell<dim>(oriented<dim>(cell, points)));
        }
      }
      triangulation.create_triangulation(points, cells, SubCellData());
    }

    /// Unit vectors and facets around: a polygon of @p n_around edges.
    std::pair<std::vector<Point<2>>, std::vector<std::array<unsigned int, 2>>> polygon(const unsigned int n_around)
    {
      std::vector<Point<2>>                    directions;
      std::vector<std::array<unsigned int, 2>> facets;
      for (unsigned int i = 0; i < n_around; ++i)
      {
        const double angle = 2 * dealii::numbers::PI * i / n_around;
        directions.push_back({std::cos(angle), std::sin(angle)});
        facets.push_back({i, (i + 1) % n_around});
      }
      return {directions, facets};
    }

    /// Every triangle in four, new vertices on the sphere.
    void refine_surface(std::vector<Point<3>> &directions, std::vector<std::array<unsigned int, 3>> &facets)
    {
      std::map<std::pair<unsigned int, unsigned int>, unsigned int> middle;
      const auto                                                    between = [&](const unsigned int a, const unsigned int b)
      {
        const auto [entry, is_new] = middle.try_emplace(std::minmax(a, b), directions.size());
        if (is_new)
        {
          const dealii::Tensor<1, 3> sum = (directions[a] - Point<3>()) + (directions[b] - Point<3>());
          directions.push_back(Point<3>(sum / sum.norm()));
        }
        return entry->second;
      };
      std::vector<std::array<unsigned int, 3>> finer;
      for (const auto &[a, b, c] : facets)
      {
        const unsigned int ab = between(a, b), bc = between(b, c), ca = between(c, a);
        finer.push_back({a, ab, ca});
        finer.push_back({ab, b, bc});
        finer.push_back({ca, bc, c});
        finer.push_back({ab, bc, ca});
      }
      facets = finer;
    }

    /// Average of points that all lie on the sphere: on the sphere; of any others: on the straight line or plane. One such manifold for all
    /// cells, faces and edges of a ball of simplices, whose mapping insists on the same manifold all over a cell.
    template <int dim>
    class StraightInsideSphere : public dealii::Manifold<dim>
    {
    public:
      StraightInsideSphere(const Point<dim> &center, const double radius) : center(center), radius(radius) {}

      std::unique_ptr<dealii::Manifold<dim>> clone() const override { return std::make_unique<StraightInsideSphere>(center, radius); }

      Point<dim> get_new_point(const dealii::ArrayView<const Point<dim>> &points,
                               const dealii::ArrayView<const double>     &weights) const override
      {
        dealii::Tensor<1, dim> average;
        unsigned int           n_used = 0;
        bool                   on_sphere = true;
        for (unsigned int i = 0; i < points.size(); ++i)
          if (weights[i] != 0)
          {
            average += weights[i] * (points[i] - center);
            on_sphere = on_sphere && std::abs(points[i].distance(center) - radius) < 1e-8 * radius;
            ++n_used;
          }
        if (on_sphere && n_used > 1)
          average *= radius / average.norm();
        return center + average;
      }

      /// Radial; faces inside the ball do not ask.
      dealii::Tensor<1, dim> normal_vector(const typename Triangulation<dim>::face_iterator &, const Point<dim> &p) const override
      {
        return (p - center) / p.distance(center);
      }

    private:
      const Point<dim> center;
      const double     radius;
    };

    /// Spherical boundary, straight core, cells between them blended.
    template <int dim>
    void attach_ball_manifolds(Triangulation<dim> &triangulation, const Point<dim> &center, const double radius)
    {
      triangulation.set_all_manifold_ids(flat_manifold_id);
      for (const auto &face : triangulation.active_face_iterators())
        if (face->at_boundary())
          face->set_all_manifold_ids(sphere_id);
      triangulation.set_manifold(sphere_id, SphereManifold<dim>(center, radius));

      const auto touches_sphere = [](const auto &object)
      {
        for (unsigned int l = 0; l < object->n_lines(); ++l)
          if (object->line(l)->manifold_id() == sphere_id)
            return true;
        return false;
      };
      for (const auto &cell : triangulation.active_cell_iterators())
        if (touches_sphere(cell))
        {
          cell->set_manifold_id(blend_id);
          if constexpr (dim == 3)
            for (const auto &face : cell->face_iterators())
              if (!face->at_boundary() && touches_sphere(face))
                face->set_manifold_id(blend_id);
        }
      dealii::TransfiniteInterpolationManifold<dim> blend;
      blend.initialize(triangulation);
      triangulation.set_manifold(blend_id, blend);
    }

    /// How many times the lateral size of a shell's cells must be halved to come down to their thickness.
    unsigned int lateral_halvings(const double lateral, const double thickness)
    {
      return static_cast<unsigned int>(std::clamp(std::round(std::log2(lateral / thickness)), 0., 2.));
    }
  } // namespace

  template <int dim>
  Mesh<dim> box_mesh(const Point<dim> &lower, const Point<dim> &upper, const std::vector<unsigned int> &cells, const bool simplex)
  {
    Mesh<dim> mesh = new_mesh<dim>(simplex);
    if (simplex && dim > 1)
      dealii::GridGenerator::subdivided_hyper_rectangle_with_simplices(*mesh.triangulation, cells, lower, upper);
    else
      dealii::GridGenerator::subdivided_hyper_rectangle(*mesh.triangulation, cells, lower, upper);
    name_box_sides(mesh, lower, upper);
    return mesh;
  }

  template <int dim>
  Mesh<dim> ball_mesh(const Point<dim> &center, const double radius, const bool simplex)
  {
    Mesh<dim> mesh = new_mesh<dim>(simplex);
    mesh.part_names = {"surface"};
    if constexpr (dim == 1)
    {
      dealii::GridGenerator::subdivided_hyper_cube(*mesh.triangulation, 2, center[0] - radius, center[0] + radius);
      for (const auto &cell : mesh.triangulation->active_cell_iterators())
        for (const auto &face : cell->face_iterators())
          if (face->at_boundary())
            face->set_boundary_id(0); // segments have 0 on the left, 1 on the right
    }
    else
    {
      mesh.curved = true;
      if (simplex)
      {
        triangulate_simplex_ball(*mesh.triangulation, center, radius);
        mesh.triangulation->set_all_manifold_ids(sphere_id);
        mesh.triangulation->set_manifold(sphere_id, StraightInsideSphere<dim>(center, radius));
      }
      else
      {
        // The generator compares lengths with squared lengths: only the unit ball comes out as it should.
        dealii::GridGenerator::hyper_ball_balanced(*mesh.triangulation);
        mesh.triangulation->reset_all_manifolds();
        dealii::GridTools::scale(radius, *mesh.triangulation);
        dealii::GridTools::shift(center, *mesh.triangulation);
        attach_ball_manifolds(*mesh.triangulation, center, radius);
      }
    }
    return mesh;
  }

  template <int dim>
  Mesh<dim> shell_mesh(const Point<dim> &center, const double inner, const double outer, const bool simplex)
  {
    static_assert(dim > 1);
    Mesh<dim>    mesh = new_mesh<dim>(simplex);
    auto        &triangulation = *mesh.triangulation;
    const double thickness = outer - inner, middle = (inner + outer) / 2;
    mesh.part_names = {"inner", "outer"};
    mesh.curved = true;

    if constexpr (dim == 2)
    {
      // A multiple of four keeps the symmetry about the axes.
      const unsigned int n_around = 4 * std::clamp(std::round(dealii::numbers::PI / 2 * middle / thickness), 2., 64.);
      if (simplex)
      {
        const auto [directions, facets] = polygon(n_around);
        triangulate_simplex_shell<2>(triangulation, center, inner, outer, directions, facets);
      }
      else
        dealii::GridGenerator::hyper_shell(triangulation, center, inner, outer, n_around);
    }
    else if (simplex)
    {
      auto [directions, facets] = regular_surface<3>();
      for (unsigned int i = 0; i < lateral_halvings(1.05 * middle, thickness); ++i)
        refine_surface(directions, facets);
      triangulate_simplex_shell<3>(triangulation, center, inner, outer, directions, facets);
    }
    else
    {
      constexpr std::array<unsigned int, 3> n_around = {6, 24, 96};
      dealii::GridGenerator::hyper_shell(triangulation, center, inner, outer,
                                         n_around[lateral_halvings(dealii::numbers::PI / 2 * middle, thickness)]);
    }

    triangulation.reset_all_manifolds();
    triangulation.set_all_manifold_ids(sphere_id);
    triangulation.set_manifold(sphere_id, SphereManifold<dim>(center, outer));
    for (const auto &face : triangulation.active_face_iterators())
      if (face->at_boundary())
        face->set_all_boundary_ids(face->vertex(0).distance(center) < middle ? 0 : 1);
    return mesh;
  }

  template Mesh<1> box_mesh<1>(const Point<1> &, const Point<1> &, const std::vector<unsigned int> &, bool);
  template Mesh<2> box_mesh<2>(const Point<2> &, const Point<2> &, const std::vector<unsigned int> &, bool);
  template Mesh<3> box_mesh<3>(const Point<3> &, const Point<3> &, const std::vector<unsigned int> &, bool);
  template Mesh<1> ball_mesh<1>(const Point<1> &, double, bool);
  template Mesh<2> ball_mesh<2>(const Point<2> &, double, bool);
  template Mesh<3> ball_mesh<3>(const Point<3> &, double, bool);
  template Mesh<2> shell_mesh<2>(const Point<2> &, double, double, bool);
  template Mesh<3> shell_mesh<3>(const Point<3> &, double, double, bool);
} // namespace unilateral
