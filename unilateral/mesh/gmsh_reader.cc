#include "unilateral/mesh/gmsh_reader.h"
#include "unilateral/base/number_of_name.h"
#include "unilateral/mesh/gmsh_elements.h"
#include "unilateral/mesh/gmsh_meshing.h"
#include "unilateral/mesh/gmsh_order.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdlib>
#include <map>
#include <optional>
#include <set>
#include <unordered_map>
#include <utility>
#include <vector>

#include <gmsh.h>

namespace unilateral
{
  namespace
  {
    /// Runs @p action inside Gmsh; its errors (strings or numbers, by version) become InputError saying what was tried and why it failed.
    template <typename Action>
    auto in_gmsh(const MeshDescription &spec, const std::string &what, const Action &action)
    {
      std::string reason;
      try
      {
        return action();
      }
      catch (const InputError &)
      {
        throw;
      }
      catch (const std::string &error)
      {
        reason = error;
      }
      catch (const std::exception &error)
      {
        reason = error.what();
      }
      catch (...)
      {
      }
      try
      {
        if (reason.empty())
          gmsh::logger::getLastError(reason);
      }
      catch (...)
      {
      }
      while (!reason.empty() && (reason.back() == '.' || std::isspace(static_cast<unsigned char>(reason.back()))))
        reason.pop_back();
      const char *const remedy = reason.starts_with("Unable to open file")
                                   ? "a script may read what lies in its own folder and below, nothing else"
                                 : reason.find("syntax error") != std::string::npos
                                   ? "correct the script there"
                                   : "the file may be incomplete or damaged: save it again, and see whether Gmsh opens it";
      throw InputError(spec.where,
                       fmt::format("{} '{}' failed: {}; {}", what, spec.file, reason.empty() ? "Gmsh gives no reason" : reason, remedy),
                       MessageName("mesh-damaged"));
    }

    /// Highest dimension that has elements, or of the geometry when it has no mesh.
    int highest_dimension()
    {
      std::vector<int>                      types;
      std::vector<std::vector<std::size_t>> tags, nodes;
      int                                   dim = -1;
      for (const int d : {3, 2, 1, 0})
      {
        gmsh::model::mesh::getElements(types, tags, nodes, d);
        if (!types.empty())
        {
          dim = d;
          break;
        }
      }
      return std::max(dim, gmsh::model::getDimension());
    }

    /// The file, read and, if it is a geometry, meshed.
    void open(const MeshDescription &spec, const MeshFormat format, const bool with_cells, const bool simplex, const unsigned order)
    {
      in_gmsh(spec, "reading",
              [&]
              {
                if (format != MeshFormat::step)
                {
                  gmsh::open(spec.file);
                  return;
                }
                // Not by open(), which goes by the ending of the name and also reads a file of options beside this one.
                gmsh::option::setNumber("Geometry.OCCImportLabels", 1);
                gmsh::vectorpair shapes;
                gmsh::model::occ::importShapes(spec.file, shapes, false, "step");
                gmsh::model::occ::synchronize();
              });
      if (with_cells && format != MeshFormat::msh)
        in_gmsh(spec, "meshing", [&] { mesh_geometry(spec, format, simplex, order); });
    }

    std::string group_name(const int dim, const int tag)
    {
      std::string name;
      gmsh::model::getPhysicalName(dim, tag, name);
      return name.empty() ? std::to_string(tag) : name;
    }

    /// Name of an entity's cells or faces: its first physical group, or in a .step file its own name or kind and number; else nothing.
    /// Also nothing for the one body of a .step file that has no name of its own: a number tells it from nobody.
    std::string entity_name(const int dim, const int tag, const MeshFormat format)
    {
      std::vector<int> groups;
      gmsh::model::getPhysicalGroupsForEntity(dim, tag, groups);
      if (!groups.empty())
        return group_name(dim, groups.front());
      if (format != MeshFormat::step)
        return "";
      std::string name;
      gmsh::model::getEntityName(dim, tag, name);
      name = name.substr(name.rfind('/') + 1);              // labels are paths: assembly/part/face
      if (name.starts_with("Open CASCADE STEP translator")) // what the writer puts where the drawing has no name
        name.clear();
      gmsh::vectorpair entities;
      gmsh::model::getEntities(entities, dim);
      static const std::array<const char *, 4> kinds = {"point", "curve", "surface", "volume"};
      return !name.empty() ? name : entities.size() == 1 && dim == gmsh::model::getDimension() ? "" : fmt::format("{}{}", kinds[dim], tag);
    }

    /// Shifts a mesh into its coordinate plane or axis; InputError when it does not lie parallel to one.
    void check_flat(const MeshDescription &spec, const unsigned dim, CellList &list)
    {
      double size = 0;
      for (const auto &v : list.vertices)
        for (unsigned d = 0; d < 3; ++d)
          size = std::max(size, std::abs(v[d] - list.vertices.front()[d]));
      for (unsigned d = dim; d < 3; ++d)
      {
        const double level = list.vertices.front()[d];
        for (auto &v : list.vertices)
        {
          if (std::abs(v[d] - level) > 1e-9 * size)
            throw InputError(spec.where,
                             dim == 2 ? "the mesh is a surface in space; a 2-D mesh must lie in the x-y plane"
                                      : "the mesh is a curve; a 1-D mesh must lie on the x axis",
                             MessageName("mesh-does-not-fit"));
          v[d] = 0;
        }
        for (auto &v : list.middle_points)
          v[d] = 0;
      }
    }

    /// Collects the cells of the mesh that Gmsh has open, and the faces with names.
    class CellReader
    {
    public:
      CellReader(const MeshDescription &spec, const MeshFormat format) : spec(spec), format(format) {}

      CellList read()
      {
        const int dim = highest_dimension();
        if (dim < 1)
          throw InputError(spec.where, fmt::format("'{}' holds no cells", spec.file), MessageName("mesh-damaged"));
        read_nodes();
        read_cells(dim);
        if (list.cells.empty())
          throw InputError(spec.where, fmt::format("'{}' holds no cells", spec.file), MessageName("mesh-damaged"));
        list.kind = *kind;
        check_flat(spec, dim, list);
        read_faces(dim - 1);
        if (highest_order > 2 && format == MeshFormat::msh)
          list.warnings.push_back(
            fmt::format("the mesh has cells of order {}; their geometry is taken as polynomials of degree 2", highest_order));
        list.approximates_curves = format != MeshFormat::msh && has_curved_entities(dim - 1);
        return std::move(list);
      }

    private:
      using Tags = std::vector<std::size_t>;

      /// Curves that are no lines, or surfaces that are no planes.
      static bool has_curved_entities(const int dim)
      {
        gmsh::vectorpair entities;
        gmsh::model::getEntities(entities, dim);
        return dim > 0 && std::any_of(entities.begin(), entities.end(),
                                      [](const auto &entity)
                                      {
                                        std::string type;
                                        gmsh::model::getType(entity.first, entity.second, type);
                                        return type != "Line" && !type.starts_with("Plane") && !is_flat(entity);
                                      });
      }

      /// A surface of another type that is a plane all the same, as the sides are that Gmsh's own kernel makes by extrusion: 5 x 5 points
      /// of it lie in one plane.
      static bool is_flat(const std::pair<int, int> &entity)
      {
        constexpr unsigned n = 5;
        if (entity.first != 2)
          return false;
        std::vector<double> low, high, parameters, points;
        try
        {
          gmsh::model::getParametrizationBounds(entity.first, entity.second, low, high);
          for (unsigned i = 0; i < n * n; ++i)
            for (unsigned d = 0; d < 2; ++d)
              parameters.push_back(low.at(d) + (high.at(d) - low.at(d)) * (d == 0 ? i % n : i / n) / (n - 1));
          gmsh::model::getValue(entity.first, entity.second, parameters, points);
        }
        catch (...)
        {
          return false; // Gmsh throws texts or numbers, by version, where it has no parameters of a surface
        }
        if (points.size() != 3 * n * n)
          return false;
        using Vector = std::array<double, 3>;
        const auto from_first = [&](const unsigned i) {
          return Vector{points[3 * i] - points[0], points[3 * i + 1] - points[1], points[3 * i + 2] - points[2]};
        };
        const auto product = [](const Vector &a, const Vector &b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; };
        // The normal of the largest triangle with the first point and two that follow each other.
        Vector normal{};
        double size = 0, extent = 0;
        for (unsigned i = 2; i < n * n; ++i)
        {
          const Vector a = from_first(i - 1), b = from_first(i);
          const Vector cross = {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
          extent = std::max(extent, std::sqrt(product(b, b)));
          if (const double length = std::sqrt(product(cross, cross)); length > size)
          {
            size = length;
            normal = cross;
          }
        }
        for (unsigned i = 1; i < n * n && size > 0; ++i)
          if (!(std::abs(product(from_first(i), normal)) < 1e-10 * extent * size))
            return false;
        return size > 0;
      }

      void read_nodes()
      {
        Tags                tags;
        std::vector<double> parameters;
        gmsh::model::mesh::getNodes(tags, coordinates, parameters, -1, -1, false, false);
        for (std::size_t i = 0; i < tags.size(); ++i)
          node_of_tag.emplace(tags[i], i);
      }

      /// Calls action(name, type, nodes), the corners first, for every element of dimension @p dim.
      template <typename Action>
      void for_each_element(const int dim, const Action &action)
      {
        gmsh::vectorpair entities;
        gmsh::model::getEntities(entities, dim);
        for (const auto &[entity_dim, tag] : entities)
        {
          std::vector<int>  types;
          std::vector<Tags> tags, nodes;
          gmsh::model::mesh::getElements(types, tags, nodes, dim, tag);
          if (types.empty())
            continue;
          const std::string name = entity_name(dim, tag, format);
          for (std::size_t t = 0; t < types.size(); ++t)
          {
            const ElementType type(types[t]);
            for (std::size_t begin = 0; begin < nodes[t].size(); begin += type.n_nodes)
              action(name, type, Tags(nodes[t].begin() + begin, nodes[t].begin() + begin + type.n_nodes));
          }
        }
      }

      /// Of a script with physical groups those in a group only.
      void read_cells(const int dim)
      {
        gmsh::vectorpair groups;
        gmsh::model::getPhysicalGroups(groups, dim);
        const bool only_groups = format == MeshFormat::geo && !groups.empty();
        for_each_element(dim,
                         [&](const std::string &name, const ElementType &type, const Tags &nodes)
                         {
                           if (!only_groups || !name.empty())
                             add_cell(name, type, nodes);
                         });
      }

      void add_cell(const std::string &name, const ElementType &type, const Tags &nodes)
      {
        const auto this_kind = type.kind();
        if (!this_kind)
          throw InputError(spec.where,
                           fmt::format("the mesh has cells of the kind '{}'; only segments, triangles, "
                                       "quadrilaterals, tetrahedra and hexahedra can be used",
                                       type.name),
                           MessageName("mesh-does-not-fit"));
        if (kind && *kind != *this_kind)
          throw InputError(
            spec.where, fmt::format("the mesh mixes {} and {}; all cells must be of one kind", plural_name(*kind), plural_name(*this_kind)),
            MessageName("mesh-does-not-fit"));
        kind = this_kind;
        std::vector<unsigned> cell(type.n_corners), corners;
        for (unsigned v = 0; v < cell.size(); ++v)
        {
          corners.push_back(vertex_at(nodes[v]));
          cell[corner_of_gmsh(*kind, v)] = corners.back();
        }
        if (type.order > 1 && type.dim > 1)
          add_middle_points(type, nodes, corners);
        if (type.order > 2 && type.dim > 1 && format != MeshFormat::msh)
          add_drawn_points(type, nodes);
        list.cells.push_back(cell);
        list.cell_region.push_back(number_of_name(name.empty() ? "domain" : name, list.region_names));
      }

      void add_middle_points(const ElementType &type, const Tags &nodes, const std::vector<unsigned> &corners)
      {
        highest_order = std::max(highest_order, type.order);
        const MiddlePoints &middle = middle_points.try_emplace(type.type, type).first->second;
        for (std::size_t k = 0; k < middle.corners.size(); ++k)
        {
          std::vector<unsigned> vertices;
          for (const unsigned v : middle.corners[k])
            vertices.push_back(corners[v]);
          std::sort(vertices.begin(), vertices.end());
          if (!known_middles.insert(vertices).second)
            continue;
          std::array<double, 3> x{};
          for (std::size_t i = 0; i < nodes.size(); ++i)
          {
            const double *const node = node_at(nodes[i]);
            for (unsigned d = 0; d < 3; ++d)
              x[d] += middle.weights[k * nodes.size() + i] * node[d];
          }
          list.middle_vertices.push_back(std::move(vertices));
          list.middle_points.push_back(x);
        }
      }

      /// All nodes of the cell that is added next, unless it is straight.
      void add_drawn_points(const ElementType &type, const Tags &nodes)
      {
        const EquidistantNodes &equidistant = equidistant_nodes.try_emplace(type.type, type).first->second;
        if (equidistant.nodes.empty() || (list.drawn_degree > 0 && list.drawn_degree != unsigned(type.order)) ||
            is_straight(nodes, equidistant.weights))
          return;
        list.drawn_degree = type.order;
        list.drawn_cells.push_back(list.cells.size());
        for (const unsigned node : equidistant.nodes)
        {
          const double *const x = node_at(nodes[node]);
          list.drawn_points.push_back({x[0], x[1], x[2]});
        }
      }

      /// Every node lies where the corners have it with these weights, but for round-off.
      bool is_straight(const Tags &nodes, const std::vector<double> &weights) const
      {
        const std::size_t n_corners = weights.size() / nodes.size();
        double            deviation = 0, size = 0, largest = 0;
        for (std::size_t i = 0; i < nodes.size(); ++i)
          for (unsigned d = 0; d < 3; ++d)
          {
            double straight = 0;
            for (std::size_t v = 0; v < n_corners; ++v)
              straight += weights[i * n_corners + v] * node_at(nodes[v])[d];
            const double x = node_at(nodes[i])[d];
            deviation = std::max(deviation, std::abs(x - straight));
            size = std::max(size, std::abs(x - node_at(nodes[0])[d]));
            largest = std::max(largest, std::abs(x));
          }
        return deviation <= std::max(1e-9 * size, 1e-14 * largest);
      }

      const double *node_at(const std::size_t tag) const
      {
        const auto node = node_of_tag.find(tag);
        if (node == node_of_tag.end())
          throw InputError(spec.where, fmt::format("'{}' is damaged: a cell names node {}, which is not there", spec.file, tag),
                           MessageName("mesh-damaged"));
        return &coordinates[3 * node->second];
      }

      /// The number of a corner in the list, which gets it when it is new.
      unsigned vertex_at(const std::size_t tag)
      {
        const auto [entry, is_new] = vertex_of_tag.try_emplace(tag, list.vertices.size());
        if (is_new)
        {
          const double *const x = node_at(tag);
          list.vertices.push_back({x[0], x[1], x[2]});
        }
        return entry->second;
      }

      /// Those with a name whose corners are corners of cells.
      void read_faces(const int dim)
      {
        gmsh::vectorpair groups;
        gmsh::model::getPhysicalGroups(groups, dim);
        for (const auto &[group_dim, tag] : groups) // parts in the order of their numbers, also those without faces
          number_of_name(group_name(group_dim, tag), list.part_names);
        for_each_element(dim,
                         [&](const std::string &name, const ElementType &type, const Tags &nodes)
                         {
                           std::vector<unsigned> face;
                           for (int v = 0; v < type.n_corners; ++v)
                             if (const auto vertex = vertex_of_tag.find(nodes[v]); vertex != vertex_of_tag.end())
                               face.push_back(vertex->second);
                           if (name.empty() || int(face.size()) != type.n_corners)
                             return;
                           list.faces.push_back(face);
                           list.face_part.push_back(number_of_name(name, list.part_names));
                         });
      }

      const MeshDescription                       &spec;
      const MeshFormat                             format;
      std::vector<double>                          coordinates; ///< of the nodes
      std::unordered_map<std::size_t, std::size_t> node_of_tag;
      std::unordered_map<std::size_t, unsigned>    vertex_of_tag;
      std::optional<CellKind>                      kind; ///< of all cells so far
      int                                          highest_order = 1;
      std::map<int, MiddlePoints>                  middle_points;     ///< by Gmsh's number of the type
      std::map<int, EquidistantNodes>              equidistant_nodes; ///< likewise
      std::set<std::vector<unsigned>>              known_middles;
      CellList                                     list;
    };

    MeshOutline outline_of_open(const MeshDescription &spec, const MeshFormat format)
    {
      const int dim = highest_dimension();
      if (dim < 1)
        throw InputError(spec.where, fmt::format("'{}' holds no mesh: neither curves nor surfaces nor volumes", spec.file),
                         MessageName("mesh-damaged"));
      const auto names = [&](const int d, const std::string &otherwise)
      {
        std::vector<std::string> found;
        gmsh::vectorpair         groups, entities;
        gmsh::model::getPhysicalGroups(groups, d);
        for (const auto &[group_dim, tag] : groups)
          number_of_name(group_name(d, tag), found);
        if (format == MeshFormat::step)
          gmsh::model::getEntities(entities, d);
        for (const auto &[entity_dim, tag] : entities)
          if (const std::string name = entity_name(d, tag, format); !name.empty())
            number_of_name(name, found);
        number_of_name(otherwise, found);
        return found;
      };
      return {static_cast<unsigned>(dim), names(dim - 1, "boundary"), names(dim, "domain")};
    }
  } // namespace

  void start_gmsh()
  {
    // The library of Gmsh's windows keeps preferences in the home folder, or in /etc when there is none.
    setenv("HOME", "/dev/null", 1);
    gmsh::initialize(0, nullptr, false);
    gmsh::option::setNumber("General.Terminal", 0);
    gmsh::option::setNumber("General.Verbosity", 1);
    gmsh::option::setNumber("General.NumThreads", 1);
  }

  MeshOutline outline_by_gmsh(const MeshDescription &spec, const MeshFormat format)
  {
    open(spec, format, false, true, 1);
    return in_gmsh(spec, "reading", [&] { return outline_of_open(spec, format); });
  }

  std::pair<MeshOutline, std::optional<CellList>> outline_and_cells_by_gmsh(const MeshDescription &spec)
  {
    std::pair<MeshOutline, std::optional<CellList>> result{outline_by_gmsh(spec, MeshFormat::msh), std::nullopt};
    try
    {
      result.second = in_gmsh(spec, "reading", [&] { return CellReader(spec, MeshFormat::msh).read(); });
    }
    catch (const InputError &) // said where the mesh is made
    {
    }
    return result;
  }

  CellList cells_by_gmsh(const MeshDescription &spec, const MeshFormat format, const bool simplex, const unsigned order)
  {
    open(spec, format, true, simplex, order);
    CellList list = in_gmsh(spec, "reading", [&] { return CellReader(spec, format).read(); });
    check_kind_of_cells(list.kind, simplex, spec.where);
    return list;
  }
} // namespace unilateral
