#include "unilateral/mesh/subdomain.h"

#include <deal.II/grid/manifold_lib.h>

#include <algorithm>
#include <functional>
#include <utility>

namespace unilateral
{
  using namespace dealii;

  namespace
  {
    /// A manifold of the whole mesh for its part. Those that blend boundaries into the inside refer to the coarse mesh they were made for:
    /// a copy would take the mesh as it has become for the coarse one. It is of their type @p Base all the same, since MappingQ asks it
    /// for all nodes of a cell at once then, and else goes by edges and faces, which puts the nodes elsewhere.
    template <int dim, typename Base>
    class ManifoldOfWhole : public Base
    {
    public:
      using Points = ArrayView<const Point<dim>>;
      using Face = typename Triangulation<dim>::face_iterator;

      explicit ManifoldOfWhole(const Manifold<dim> &manifold) : manifold(manifold) {}

      std::unique_ptr<Manifold<dim>> clone() const override { return std::make_unique<ManifoldOfWhole>(manifold); }
      Point<dim>                     get_intermediate_point(const Point<dim> &a, const Point<dim> &b, const double weight) const override
      {
        return manifold.get_intermediate_point(a, b, weight);
      }
      Point<dim> get_new_point(const Points &points, const ArrayView<const double> &weights) const override
      {
        return manifold.get_new_point(points, weights);
      }
      void get_new_points(const Points &points, const Table<2, double> &weights, ArrayView<Point<dim>> new_points) const override
      {
        manifold.get_new_points(points, weights, new_points);
      }
      Point<dim> project_to_manifold(const Points &points, const Point<dim> &candidate) const override
      {
        return manifold.project_to_manifold(points, candidate);
      }
      Tensor<1, dim> get_tangent_vector(const Point<dim> &a, const Point<dim> &b) const override
      {
        return manifold.get_tangent_vector(a, b);
      }
      Tensor<1, dim> normal_vector(const Face &face, const Point<dim> &x) const override { return manifold.normal_vector(face, x); }
      void           get_normals_at_vertices(const Face &face, typename Manifold<dim>::FaceVertexNormals &normals) const override
      {
        manifold.get_normals_at_vertices(face, normals);
      }

    private:
      const Manifold<dim> &manifold;
    };

    template <int dim>
    void take_manifold(Triangulation<dim> &part, const types::manifold_id id, const Manifold<dim> &manifold)
    {
      using Blend = TransfiniteInterpolationManifold<dim>;
      if (dynamic_cast<const SphericalManifold<dim> *>(&manifold)) // refers to no mesh, and is asked for its centre
        part.set_manifold(id, manifold);
      else if (dynamic_cast<const Blend *>(&manifold))
        part.set_manifold(id, ManifoldOfWhole<dim, Blend>(manifold));
      else
        part.set_manifold(id, ManifoldOfWhole<dim, Manifold<dim>>(manifold));
    }
  } // namespace

  namespace
  {
    /// That of the active cells in it, which is the same for all.
    template <typename Cell>
    types::material_id material_of(Cell cell)
    {
      while (!cell->is_active())
        cell = cell->child(0);
      return cell->material_id();
    }

    /// The cells of this process, their vertices in the order of the whole.
    template <int dim>
    struct OwnCells
    {
      std::vector<typename Triangulation<dim>::cell_iterator> in_whole; ///< of each coarse cell of the part
      std::vector<Point<dim>>                                 vertices;
      std::vector<CellData<dim>>                              cells;
    };

    template <int dim>
    OwnCells<dim> take_own_cells(Subdomain<dim> &subdomain, const std::vector<std::uint32_t> &vertex_ids)
    {
      const auto            id_of = [&](const unsigned vertex) { return vertex_ids.empty() ? vertex : vertex_ids[vertex]; };
      const auto           &whole = *subdomain.whole.triangulation;
      std::vector<unsigned> new_number(whole.n_vertices(), numbers::invalid_unsigned_int);
      OwnCells<dim>         own;
      unsigned              number = 0;
      for (const auto &cell : whole.cell_iterators_on_level(subdomain.division.base_level))
        if (const unsigned k = number++; subdomain.owner(k) == subdomain.processes.rank())
        {
          own.in_whole.push_back(cell);
          subdomain.own_cells.push_back(k);
          for (const unsigned v : cell->vertex_indices())
          {
            subdomain.vertex.push_back(id_of(cell->vertex_index(v)));
            new_number[cell->vertex_index(v)] = 0;
          }
        }
      for (unsigned v = 0; v < new_number.size(); ++v)
        if (new_number[v] == 0)
        {
          new_number[v] = own.vertices.size();
          own.vertices.push_back(whole.get_vertices()[v]);
          subdomain.ids_of_vertices.push_back(id_of(v));
        }
      for (const auto &cell : own.in_whole)
      {
        auto &data = own.cells.emplace_back(cell->n_vertices());
        for (const unsigned v : cell->vertex_indices())
          data.vertices[v] = new_number[cell->vertex_index(v)];
        data.material_id = material_of(cell);
        data.manifold_id = cell->manifold_id();
      }
      return own;
    }

    /// Parts of the boundary, @p cut where the neighbours of other processes are, and manifolds.
    template <int dim>
    void copy_ids(Triangulation<dim> &part, const OwnCells<dim> &own, const types::boundary_id cut)
    {
      for (const auto &cell : part.active_cell_iterators())
      {
        const auto &from = own.in_whole[cell->active_cell_index()];
        for (const auto face : cell->face_indices())
        {
          if (cell->face(face)->at_boundary())
            cell->face(face)->set_boundary_id(from->face(face)->at_boundary() ? from->face(face)->boundary_id() : cut);
          cell->face(face)->set_manifold_id(from->face(face)->manifold_id());
        }
        if constexpr (dim == 3)
          for (const auto line : cell->line_indices())
            cell->line(line)->set_manifold_id(from->line(line)->manifold_id());
      }
    }

    /// Refines @p part as the whole is, and says for each of its active cells which one of the whole it is.
    template <int dim>
    std::vector<unsigned> refine_as_whole(Triangulation<dim> &part, const OwnCells<dim> &own, CurvedCells<dim> *const curved_cells)
    {
      using Iterator = typename Triangulation<dim>::cell_iterator;
      const std::function<bool(const Iterator &, const Iterator &)> flag = [&](const Iterator &cell, const Iterator &in_whole)
      {
        bool any = false;
        for (unsigned c = 0; c < cell->n_children(); ++c)
          any = flag(cell->child(c), in_whole->child(c)) || any;
        if (cell->is_active() && !in_whole->is_active())
        {
          cell->set_refine_flag();
          any = true;
        }
        return any;
      };
      for (bool any = true; any;)
      {
        any = false;
        for (const auto &cell : part.cell_iterators_on_level(0))
          any = flag(cell, own.in_whole[cell->index()]) || any;
        if (any)
        {
          part.execute_coarsening_and_refinement();
          if (curved_cells)
            curved_cells->follow_refinement(part);
        }
      }
      std::vector<unsigned>                                         in_whole(part.n_active_cells());
      const std::function<void(const Iterator &, const Iterator &)> compare = [&](const Iterator &cell, const Iterator &other)
      {
        if (cell->is_active())
        {
          AssertThrow(other->is_active(), ExcMessage("a cell of the part is coarser than in the whole"));
          in_whole[cell->active_cell_index()] = other->active_cell_index();
          return;
        }
        AssertThrow(!other->is_active(), ExcMessage("a cell of the part is finer than in the whole"));
        for (unsigned c = 0; c < cell->n_children(); ++c)
          compare(cell->child(c), other->child(c));
      };
      for (const auto &cell : part.cell_iterators_on_level(0))
        compare(cell, own.in_whole[cell->index()]);
      return in_whole;
    }
  } // namespace

  namespace
  {
    /// Cells of neighbour parts get numbers after those of the whole that is divided here.
    template <int dim>
    void add_neighbor_parts(Subdomain<dim> &subdomain, const NeighborParts &neighbors)
    {
      for (unsigned v = 0; v < neighbors.vertex_ids.size(); ++v)
        subdomain.number_of_vertex.emplace(neighbors.vertex_ids[v], v);
      std::unordered_map<std::uint64_t, unsigned> number_of_cell;
      for (const auto &[vertex, cell] : neighbors.cells)
      {
        const auto [entry, is_new] = number_of_cell.try_emplace(cell.id, subdomain.division.owner.size());
        if (is_new)
          subdomain.division.owner.push_back(cell.owner);
        auto &cells = subdomain.cells_at_vertex[vertex];
        cells.insert(std::upper_bound(cells.begin(), cells.end(), entry->second), entry->second);
      }
    }
  } // namespace

  template <int dim>
  std::unique_ptr<Subdomain<dim>> cut_out_subdomain(Mesh<dim>                      &mesh,
                                                    const unsigned                  level,
                                                    const Processes                &processes,
                                                    Division                        division,
                                                    std::unique_ptr<Subdomain<dim>> previous,
                                                    const NeighborParts            &neighbors)
  {
    auto subdomain = std::make_unique<Subdomain<dim>>();
    subdomain->processes = processes;
    subdomain->level = level;
    subdomain->whole = std::exchange(mesh, Mesh<dim>());
    std::swap(subdomain->division, division);
    const auto &whole = *subdomain->whole.triangulation;
    subdomain->some_point = previous ? previous->some_point : Point<dim>(whole.begin_active()->center());
    subdomain->cells_at_vertex = find_cells_at_vertices(whole, subdomain->division.base_level);
    add_neighbor_parts(*subdomain, neighbors);
    const OwnCells<dim> own = take_own_cells(*subdomain, neighbors.vertex_ids);

    mesh.part_names = subdomain->whole.part_names;
    mesh.region_names = subdomain->whole.region_names;
    mesh.curved = subdomain->whole.curved;
    mesh.approximates_curves = subdomain->whole.approximates_curves;
    mesh.simplex = subdomain->whole.simplex;
    if (!previous)
      mesh.part_names.push_back("");
    const types::boundary_id cut = mesh.part_names.size() - 1;
    subdomain->previous = std::move(previous);
    mesh.triangulation = std::make_unique<Triangulation<dim>>();
    mesh.triangulation->create_triangulation(own.vertices, own.cells, SubCellData());
    mesh.curved_cells = std::move(subdomain->whole.curved_cells);
    if (mesh.curved_cells)
      mesh.curved_cells->keep_cells(whole, subdomain->division.base_level, subdomain->own_cells);
    for (const auto id : whole.get_manifold_ids())
      if (id != numbers::flat_manifold_id)
        take_manifold(*mesh.triangulation, id, whole.get_manifold(id));
    copy_ids(*mesh.triangulation, own, cut);
    subdomain->own_active_cells = refine_as_whole(*mesh.triangulation, own, mesh.curved_cells.get());
    return subdomain;
  }

  template <int dim>
  std::unique_ptr<Subdomain<dim>> without_whole(const Subdomain<dim> &subdomain)
  {
    auto copy = std::make_unique<Subdomain<dim>>();
    copy->processes = subdomain.processes;
    copy->n_alike = subdomain.n_alike;
    copy->level = subdomain.level;
    copy->whole.simplex = subdomain.whole.simplex;
    copy->division = subdomain.division;
    copy->own_cells = subdomain.own_cells;
    copy->ids_of_cells = subdomain.ids_of_cells;
    copy->own_active_cells = subdomain.own_active_cells;
    copy->vertex = subdomain.vertex;
    copy->ids_of_vertices = subdomain.ids_of_vertices;
    copy->cells_at_vertex = subdomain.cells_at_vertex;
    copy->some_point = subdomain.some_point;
    copy->number_of_vertex = subdomain.number_of_vertex;
    return copy;
  }

#define INSTANTIATE(dim)                                                                                                                   \
  template std::unique_ptr<Subdomain<dim>> cut_out_subdomain(Mesh<dim> &, unsigned, const Processes &, Division,                           \
                                                             std::unique_ptr<Subdomain<dim>>, const NeighborParts &);                      \
  template std::unique_ptr<Subdomain<dim>> without_whole(const Subdomain<dim> &);
  INSTANTIATE(2)
  INSTANTIATE(3)
#undef INSTANTIATE
} // namespace unilateral
