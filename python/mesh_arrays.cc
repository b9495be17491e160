#include "python/mesh_arrays.h"

#include "unilateral/base/diagnostics.h"
#include "unilateral/base/number_of_name.h"

#include <pybind11/numpy.h>
#include <pybind11/stl.h>

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <map>
#include <optional>

namespace py = pybind11;

namespace unilateral
{
  namespace
  {
    using Doubles = py::array_t<double, py::array::c_style | py::array::forcecast>;
    using Numbers = py::array_t<std::int64_t, py::array::c_style | py::array::forcecast>;

    std::string text_of(const py::handle &value)
    {
      return py::str(value);
    }

    Doubles doubles(const py::handle &value, const std::string &name)
    {
      Doubles array = Doubles::ensure(value);
      if (!array)
      {
        PyErr_Clear();
        throw py::type_error(fmt::format("'{}' must be an array of numbers", name));
      }
      return array;
    }

    /// Whole numbers, those of an array of floats that are none refused.
    Numbers whole_numbers(const py::handle &value, const std::string &name)
    {
      const py::array array = py::array::ensure(value);
      if (array && (array.dtype().kind() == 'i' || array.dtype().kind() == 'u' || array.size() == 0))
        return Numbers::ensure(array);
      PyErr_Clear();
      throw py::type_error(fmt::format("'{}' must be an array of whole numbers", name));
    }

    /// From the order of VTK to that of deal.II.
    unsigned lexicographic(const std::size_t n_corners, const bool simplex, const unsigned k)
    {
      static constexpr unsigned around[] = {0, 1, 3, 2, 4, 5, 7, 6};
      return simplex || n_corners == 2 ? k : around[k];
    }

    CellKind kind_of(const unsigned dim, const py::ssize_t n_corners)
    {
      using Kinds = std::map<std::pair<unsigned, py::ssize_t>, CellKind>;
      static const Kinds kinds = {{{1, 2}, CellKind::segment},
                                  {{2, 3}, CellKind::triangle},
                                  {{2, 4}, CellKind::quadrilateral},
                                  {{3, 4}, CellKind::tetrahedron},
                                  {{3, 8}, CellKind::hexahedron}};
      const auto         found = kinds.find({dim, n_corners});
      if (found == kinds.end())
        throw py::value_error(fmt::format("'cells' have {} corners each; in {}-D they have {}", n_corners, dim,
                                          dim == 1   ? "2"
                                          : dim == 2 ? "3 (triangles) or 4 (quadrilaterals)"
                                                     : "4 (tetrahedra) or 8 (hexahedra)"));
      return found->second;
    }

    std::string shape_text_of(const py::array &array)
    {
      return py::str(py::tuple(array.attr("shape")));
    }

    /// Collects a mesh from arrays.
    class ArrayMeshBuilder
    {
    public:
      ArrayMeshBuilder(const py::handle &point_array, const py::handle &cell_array)
      {
        read_points(doubles(point_array, "points"));
        read_cells(whole_numbers(cell_array, "cells"));
        list.region_names = {"domain"};
        list.cell_region.assign(nodes.cells.size(), 0);
      }

      unsigned dim() const { return nodes.dim; }

      void add_parts(const py::dict &parts)
      {
        for (const auto &[key, facets] : parts)
        {
          const std::string name = text_of(key);
          if (py::isinstance<py::str>(facets) || PyCallable_Check(facets.ptr()))
            parts_by_place.emplace_back(name, py::reinterpret_borrow<py::object>(facets));
          else
            add_part(name, whole_numbers(facets, "parts: " + name));
        }
      }

      void add_part(const std::string &name, const Numbers &facets)
      {
        const unsigned n_corners = corners_of_facet();
        if (facets.ndim() != (n_corners == 1 && facets.ndim() == 1 ? 1 : 2) || facets.size() % n_corners != 0 ||
            (facets.ndim() == 2 && facets.shape(1) != n_corners))
          throw py::value_error(fmt::format("part '{}' must be an array (k, {}) of the point numbers of its facets, an expression, or a "
                                            "function of points; the shape of the array is {}",
                                            name, n_corners, shape_text_of(facets)));
        const unsigned part = number_of_name(name, list.part_names);
        for (py::ssize_t f = 0; f < facets.size(); f += n_corners)
        {
          std::vector<unsigned> facet;
          for (unsigned k = 0; k < n_corners; ++k)
            facet.push_back(point_number(facets.data()[f + k], "parts: " + name));
          list.faces.push_back(std::move(facet));
          list.face_part.push_back(part);
        }
      }

      void add_regions(const py::dict &regions)
      {
        for (const auto &[key, cells] : regions)
          add_region(text_of(key), PyCallable_Check(cells.ptr()) ? cells(centres()) : py::reinterpret_borrow<py::object>(cells));
      }

      void add_region(const std::string &name, const py::object &cells)
      {
        const py::ssize_t n = nodes.cells.size();
        const py::array   array = py::array::ensure(cells);
        const unsigned    region = number_of_name(name, list.region_names);
        if (array && array.dtype().kind() == 'b')
        {
          const py::array_t<bool, py::array::c_style | py::array::forcecast> mask(array);
          if (mask.ndim() != 1 || mask.size() != n)
            throw py::value_error(
              fmt::format("region '{}' as a mask must have the shape ({},), an entry for each cell, not {}", name, n, shape_text_of(mask)));
          for (py::ssize_t c = 0; c < n; ++c)
            if (mask.data()[c])
              list.cell_region[c] = region;
          return;
        }
        const Numbers numbers = whole_numbers(cells, "regions: " + name);
        for (py::ssize_t k = 0; k < numbers.size(); ++k)
        {
          if (numbers.data()[k] < 0 || numbers.data()[k] >= n)
            throw py::value_error(fmt::format("region '{}' names cell {}, there are {}", name, numbers.data()[k], n));
          list.cell_region[numbers.data()[k]] = region;
        }
      }

      ArrayMesh finish()
      {
        leave_out_unused_points();
        drop_unused_regions();
        return {std::make_shared<const CellList>(std::move(list)), std::make_shared<const NodalMesh>(std::move(nodes)),
                std::move(parts_by_place)};
      }

    private:
      void read_points(const Doubles &points)
      {
        if (points.ndim() != 2 || points.shape(1) < 1 || points.shape(1) > 3 || points.shape(0) < 2)
          throw py::value_error(fmt::format("'points' must be an array (n, dim) with n >= 2 points and dim = 1, 2 or 3; its shape is {}",
                                            shape_text_of(points)));
        const auto x = points.unchecked<2>();
        nodes.points.resize(x.shape(0), {0, 0, 0});
        for (py::ssize_t i = 0; i < x.shape(0); ++i)
          for (py::ssize_t d = 0; d < x.shape(1); ++d)
          {
            if (!std::isfinite(x(i, d)))
              throw py::value_error(fmt::format("'points' must be finite; point {} is not", i));
            nodes.points[i][d] = x(i, d);
          }
        // Many programs write three coordinates whatever the dimension.
        nodes.dim = unsigned(x.shape(1));
        const auto is_flat = [&](const unsigned d)
        {
          return std::all_of(nodes.points.begin(), nodes.points.end(),
                             [&](const std::array<double, 3> &p) { return p[d] == nodes.points[0][d]; });
        };
        while (nodes.dim > 1 && is_flat(nodes.dim - 1))
          --nodes.dim;
        for (std::array<double, 3> &p : nodes.points)
          for (unsigned d = nodes.dim; d < 3; ++d)
            p[d] = 0;
      }

      void read_cells(const Numbers &cells)
      {
        if (cells.ndim() != 2 || cells.shape(0) < 1)
          throw py::value_error(
            fmt::format("'cells' must be an array (m, corners) of point numbers with m >= 1 cells; its shape is {}", shape_text_of(cells)));
        list.kind = kind_of(nodes.dim, cells.shape(1));
        const auto c = cells.unchecked<2>();
        nodes.cells.resize(c.shape(0), std::vector<unsigned>(c.shape(1)));
        for (py::ssize_t i = 0; i < c.shape(0); ++i)
          for (py::ssize_t k = 0; k < c.shape(1); ++k)
            nodes.cells[i][lexicographic(c.shape(1), is_simplex(list.kind), k)] = point_number(c(i, k), "cells");
      }

      unsigned point_number(const std::int64_t number, const std::string &name) const
      {
        if (number < 0 || std::size_t(number) >= nodes.points.size())
          throw py::value_error(fmt::format("'{}' names point {}; there are {}, counted from 0", name, number, nodes.points.size()));
        return unsigned(number);
      }

      unsigned corners_of_facet() const { return nodes.dim == 1 ? 1 : nodes.dim == 2 ? 2 : is_simplex(list.kind) ? 3 : 4; }

      py::array_t<double> centres() const
      {
        py::array_t<double> result({py::ssize_t(nodes.cells.size()), py::ssize_t(nodes.dim)});
        auto                x = result.mutable_unchecked<2>();
        for (std::size_t c = 0; c < nodes.cells.size(); ++c)
          for (unsigned d = 0; d < nodes.dim; ++d)
          {
            x(c, d) = 0;
            for (const unsigned v : nodes.cells[c])
              x(c, d) += nodes.points[v][d] / double(nodes.cells[c].size());
          }
        return result;
      }

      void leave_out_unused_points()
      {
        constexpr unsigned    none = std::numeric_limits<unsigned>::max();
        std::vector<unsigned> number(nodes.points.size(), none);
        list.cells = nodes.cells;
        for (auto &cell : list.cells)
          for (unsigned &v : cell)
          {
            if (number[v] == none)
            {
              number[v] = list.vertices.size();
              list.vertices.push_back(nodes.points[v]);
            }
            v = number[v];
          }
        // A facet with a point of no cell belongs to none.
        for (std::size_t f = list.faces.size(); f-- > 0;)
          if (std::any_of(list.faces[f].begin(), list.faces[f].end(), [&](const unsigned v) { return number[v] == none; }))
          {
            list.faces.erase(list.faces.begin() + std::ptrdiff_t(f));
            list.face_part.erase(list.face_part.begin() + std::ptrdiff_t(f));
          }
          else
            for (unsigned &v : list.faces[f])
              v = number[v];
      }

      /// `domain`, where every cell has another name.
      void drop_unused_regions()
      {
        if (list.region_names.size() == 1 || std::count(list.cell_region.begin(), list.cell_region.end(), 0u) > 0)
          return;
        list.region_names.erase(list.region_names.begin());
        for (unsigned &region : list.cell_region)
          --region;
      }

      CellList                                        list;
      NodalMesh                                       nodes;
      std::vector<std::pair<std::string, py::object>> parts_by_place;
    };

    struct MeshioType
    {
      unsigned dim, n_corners;
    };

    const std::map<std::string, MeshioType> &meshio_types()
    {
      static const std::map<std::string, MeshioType> types = {{"vertex", {0, 1}}, {"line", {1, 2}},  {"triangle", {2, 3}},
                                                              {"quad", {2, 4}},   {"tetra", {3, 4}}, {"hexahedron", {3, 8}}};
      return types;
    }

    MeshioType type_of(const py::handle &block)
    {
      const std::string name = text_of(block.attr("type"));
      const auto        found = meshio_types().find(name);
      if (found == meshio_types().end())
        throw py::value_error(
          fmt::format("cells of type '{}' are not read from meshio: save the mesh with linear triangles, quadrilaterals, "
                      "tetrahedra or hexahedra, or give the Gmsh file itself, {{'file': 'a.msh'}}",
                      name));
      return found->second;
    }

    /// Cells of the highest dimension make the mesh; names are those of physical groups (Gmsh) and of sets.
    ArrayMeshBuilder builder_of_meshio(const py::object &mesh)
    {
      const py::list             blocks(mesh.attr("cells"));
      std::optional<std::size_t> top;
      py::list                   arrays;
      std::vector<py::ssize_t>   first_cell;
      py::ssize_t                n_cells = 0;
      for (std::size_t b = 0; b < blocks.size(); ++b)
        if (!top || type_of(blocks[b]).dim > type_of(blocks[*top]).dim)
          top = b;
      if (!top)
        throw py::value_error("the mesh of meshio has no cells");
      for (const auto &block : blocks)
      {
        first_cell.push_back(n_cells);
        if (type_of(block).dim != type_of(blocks[*top]).dim)
          continue;
        if (type_of(block).n_corners != type_of(blocks[*top]).n_corners)
          throw py::value_error("the mesh of meshio mixes kinds of cells; make it of one kind");
        arrays.append(block.attr("data"));
        n_cells += py::len(block.attr("data"));
      }
      const py::object numpy = py::module_::import("numpy");
      ArrayMeshBuilder builder(mesh.attr("points"), numpy.attr("concatenate")(arrays));
      const unsigned   dim = type_of(blocks[*top]).dim;
      const auto       add = [&](const std::string &name, const std::size_t b, const py::object &chosen)
      {
        if (type_of(blocks[b]).dim == dim)
          builder.add_region(name, numpy.attr("asarray")(chosen, "int64") + py::int_(first_cell[b]));
        else if (type_of(blocks[b]).dim + 1 == dim)
          builder.add_part(name, whole_numbers(numpy.attr("asarray")(blocks[b].attr("data"))[chosen], name));
      };

      const py::dict cell_data(mesh.attr("cell_data")), field_data(mesh.attr("field_data")), sets(mesh.attr("cell_sets"));
      if (cell_data.contains("gmsh:physical"))
      {
        std::map<std::pair<unsigned, std::int64_t>, std::string> names;
        for (const auto &[name, tag] : field_data)
        {
          const auto numbers = tag.cast<std::vector<std::int64_t>>();
          if (numbers.size() == 2)
            names[{unsigned(numbers[1]), numbers[0]}] = text_of(name);
        }
        const py::list tags_of_blocks(cell_data["gmsh:physical"]);
        for (std::size_t b = 0; b < blocks.size(); ++b)
          for (const auto &tag : numpy.attr("unique")(tags_of_blocks[b]))
          {
            const auto number = tag.cast<std::int64_t>();
            const auto named = names.find({type_of(blocks[b]).dim, number});
            if (number != 0)
              add(named != names.end() ? named->second : std::to_string(number), b,
                  numpy.attr("flatnonzero")(numpy.attr("equal")(tags_of_blocks[b], tag)));
          }
      }
      for (const auto &[name, chosen_in_blocks] : sets)
        if (!text_of(name).starts_with("gmsh:"))
        {
          const py::list chosen(py::reinterpret_borrow<py::object>(chosen_in_blocks));
          for (std::size_t b = 0; b < blocks.size() && b < chosen.size(); ++b)
            if (!chosen[b].is_none() && py::len(chosen[b]) > 0 && !field_data.contains(name))
              add(text_of(name), b, chosen[b]);
        }
      return builder;
    }

    bool is_meshio(const py::handle &mesh)
    {
      return !py::isinstance<py::dict>(mesh) && py::hasattr(mesh, "points") && py::hasattr(mesh, "cells") && py::hasattr(mesh, "cell_data");
    }
  } // namespace

  bool is_array_mesh(const py::handle &mesh)
  {
    return is_meshio(mesh) || (py::isinstance<py::dict>(mesh) && (mesh.contains("points") || mesh.contains("meshio")));
  }

  ArrayMesh mesh_of_arrays(const py::handle &mesh)
  {
    if (is_meshio(mesh))
      return builder_of_meshio(py::reinterpret_borrow<py::object>(mesh)).finish();
    const auto content = py::reinterpret_borrow<py::dict>(mesh);
    if (content.contains("meshio") && content.contains("points"))
      throw py::value_error("[mesh] has two sources, 'meshio' and 'points'; keep one");
    if (content.contains("meshio") && !is_meshio(content["meshio"]))
      throw py::type_error("'meshio' must be a mesh of meshio: meshio.read('a.vtu')");
    if (!content.contains("meshio") && !content.contains("cells"))
      throw py::value_error("a mesh by 'points' needs 'cells', an array (m, corners) of point numbers");
    ArrayMeshBuilder builder =
      content.contains("meshio") ? builder_of_meshio(content["meshio"]) : ArrayMeshBuilder(content["points"], content["cells"]);
    if (content.contains("parts"))
      builder.add_parts(content["parts"].cast<py::dict>());
    if (content.contains("regions"))
      builder.add_regions(content["regions"].cast<py::dict>());
    return builder.finish();
  }
} // namespace unilateral
