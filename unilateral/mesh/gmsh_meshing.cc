#include "unilateral/mesh/gmsh_meshing.h"

#include "unilateral/mesh/gmsh_elements.h"

#include <fmt/format.h>

#include <algorithm>
#include <string>
#include <vector>

#include <gmsh.h>

namespace unilateral
{
  namespace
  {
    bool only_cells_of(const bool simplex, const int dim)
    {
      std::vector<int>                      types;
      std::vector<std::vector<std::size_t>> tags, nodes;
      gmsh::model::mesh::getElements(types, tags, nodes, dim);
      return !types.empty() && std::all_of(types.begin(), types.end(),
                                           [&](const int type)
                                           {
                                             const auto kind = ElementType(type).kind();
                                             return dim == 1 || (kind && simplex == is_simplex(*kind));
                                           });
    }

    void set_size(const double size)
    {
      if (size > 0)
      {
        gmsh::option::setNumber("Mesh.MeshSizeMin", size);
        gmsh::option::setNumber("Mesh.MeshSizeMax", size);
      }
    }

    /// Meshes what is open. Gmsh's way to throw errors must not be used here: out of its parallel loops they would end the program.
    void generate(const int dim)
    {
      gmsh::model::mesh::clear();
      gmsh::option::setNumber("General.AbortOnError", 0);
      gmsh::logger::start();
      gmsh::model::mesh::generate(dim);
      std::vector<std::string> log;
      gmsh::logger::get(log);
      gmsh::logger::stop();
      gmsh::option::setNumber("General.AbortOnError", 2);
      for (const auto &line : log)
        if (line.rfind("Error: ", 0) == 0)
          throw line.substr(7);
    }

    /// Nodes of order 4 take Gmsh twice as long as the mesh itself, and it is stopped after two minutes.
    constexpr std::size_t most_drawn_cells = 100'000;

    std::size_t n_cells(const int dim)
    {
      std::vector<int>                      types;
      std::vector<std::vector<std::size_t>> tags, nodes;
      gmsh::model::mesh::getElements(types, tags, nodes, dim);
      std::size_t n = 0;
      for (const auto &of_type : tags)
        n += of_type.size();
      return n;
    }

    /// Cells of @p order on the geometry; of order 2 where there are many, or where some are folded over themselves with that. Those that
    /// Gmsh cannot mend are left to mesh_of_cells().
    void curve(const int dim, const unsigned order)
    {
      const auto all_valid = [&]
      {
        std::vector<int>                      types;
        std::vector<std::vector<std::size_t>> tags, nodes;
        gmsh::model::mesh::getElements(types, tags, nodes, dim);
        for (std::size_t t = 0; t < types.size(); ++t)
        {
          const ElementType   type(types[t]);
          std::vector<double> places, jacobians, determinants, points;
          for (int node = 0; node < type.n_nodes; ++node)
            for (int d = 0; d < 3; ++d)
              places.push_back(d < dim ? type.coordinates[node * dim + d] : 0);
          gmsh::model::mesh::getJacobians(types[t], places, jacobians, determinants, points);
          if (dim == 2) // Gmsh gives the areas of surfaces without a sign
            for (std::size_t q = 0; q < determinants.size(); ++q)
              determinants[q] = jacobians[9 * q] * jacobians[9 * q + 4] - jacobians[9 * q + 1] * jacobians[9 * q + 3];
          for (std::size_t begin = 0; begin < determinants.size(); begin += type.n_nodes)
          {
            const auto [least, largest] = std::minmax_element(determinants.begin() + begin, determinants.begin() + begin + type.n_nodes);
            if (!(*least * *largest > 0)) // cells may be the other way round, but as a whole
              return false;
          }
        }
        return true;
      };
      gmsh::model::mesh::setOrder(2);
      if (!all_valid())
        gmsh::model::mesh::optimize("HighOrder");
      else if (order > 2 && n_cells(dim) <= most_drawn_cells)
        gmsh::model::mesh::setOrder(static_cast<int>(order));
    }
  } // namespace

  void mesh_geometry(const MeshDescription &spec, const MeshFormat format, const bool simplex, const unsigned order)
  {
    const int dim = gmsh::model::getDimension();
    if (dim < 1)
      throw InputError(spec.where, fmt::format("'{}' has no curve, surface or volume to mesh", spec.file), MessageName("mesh-damaged"));
    gmsh::option::setNumber("Mesh.ElementOrder", 1);
    if (format == MeshFormat::step && spec.size == 0)
      gmsh::option::setNumber("Mesh.MeshSizeFromCurvature", 12);
    set_size(spec.size);
    if (!only_cells_of(simplex, dim)) // a script may have meshed itself
      generate(dim);
    if (!only_cells_of(simplex, dim))
    {
      gmsh::option::setNumber("Mesh.RecombineAll", simplex || dim == 3 ? 0 : 1);
      // Cuts what is not a quadrilateral (hexahedron) into such; the cells come out half as large.
      gmsh::option::setNumber("Mesh.SubdivisionAlgorithm", simplex ? 0 : dim - 1);
      set_size(simplex ? spec.size : 2 * spec.size);
      generate(dim);
    }
    if (order > 1 && dim > 1)
      curve(dim, order);
  }
} // namespace unilateral
