// .msh files with a block of tetrahedra or hexahedra, whole or with a mistake in it.
#pragma once

#include <algorithm>
#include <array>
#include <map>
#include <sstream>
#include <string>
#include <vector>

/// The unit cube in n^3 cubes; its sides are the parts "x-" to "z+".
struct BlockOfCells
{
  std::vector<std::array<double, 3>>                        nodes;
  std::vector<std::vector<unsigned>>                        cells; ///< corners, and with order 2 the other nodes, in Gmsh's order
  std::map<std::string, std::vector<std::vector<unsigned>>> faces;

  /// In Gmsh's format 4.1.
  std::string text() const
  {
    std::ostringstream out;
    out.precision(17);
    out << "$MeshFormat\n4.1 0 8\n$EndMeshFormat\n$PhysicalNames\n" << faces.size() << '\n';
    unsigned entity = 0, n_elements = cells.size();
    for (const auto &[name, of_part] : faces)
    {
      out << "2 " << ++entity << " \"" << name << "\"\n";
      n_elements += of_part.size();
    }
    out << "$EndPhysicalNames\n$Entities\n0 0 " << faces.size() << " 1\n";
    for (entity = 1; entity <= faces.size(); ++entity)
      out << entity << " 0 0 0 1 1 1 1 " << entity << " 0\n";
    out << "1 0 0 0 1 1 1 0 0\n$EndEntities\n$Nodes\n1 " << nodes.size() << " 1 " << nodes.size() << "\n3 1 0 " << nodes.size() << '\n';
    for (unsigned k = 1; k <= nodes.size(); ++k)
      out << k << '\n';
    for (const auto &x : nodes)
      out << x[0] << ' ' << x[1] << ' ' << x[2] << '\n';
    out << "$EndNodes\n$Elements\n" << faces.size() + 1 << ' ' << n_elements << " 1 " << n_elements << '\n';
    unsigned   tag = 0;
    const auto write = [&](const unsigned dim, const unsigned number, const unsigned type, const auto &elements)
    {
      out << dim << ' ' << number << ' ' << type << ' ' << elements.size() << '\n';
      for (const auto &element : elements)
      {
        out << ++tag;
        for (const unsigned node : element)
          out << ' ' << node + 1;
        out << '\n';
      }
    };
    entity = 0;
    for (const auto &part : faces)
      write(2, ++entity, type_of_faces, part.second);
    write(3, 1, type_of_cells, cells);
    out << "$EndElements\n";
    return out.str();
  }

  /// In format 2.2.
  std::string text_of_format_2() const
  {
    std::ostringstream out;
    out.precision(17);
    out << "$MeshFormat\n2.2 0 8\n$EndMeshFormat\n$PhysicalNames\n" << faces.size() << '\n';
    unsigned entity = 0, n_elements = cells.size(), tag = 0;
    for (const auto &[name, of_part] : faces)
    {
      out << "2 " << ++entity << " \"" << name << "\"\n";
      n_elements += of_part.size();
    }
    out << "$EndPhysicalNames\n$Nodes\n" << nodes.size() << '\n';
    for (const auto &x : nodes)
      out << ++tag << ' ' << x[0] << ' ' << x[1] << ' ' << x[2] << '\n';
    out << "$EndNodes\n$Elements\n" << n_elements << '\n';
    tag = 0;
    const auto write = [&](const unsigned type, const unsigned group, const unsigned of_entity, const auto &elements)
    {
      for (const auto &element : elements)
      {
        out << ++tag << ' ' << type << " 2 " << group << ' ' << of_entity;
        for (const unsigned node : element)
          out << ' ' << node + 1;
        out << '\n';
      }
    };
    entity = 0;
    for (const auto &part : faces)
    {
      ++entity;
      write(type_of_faces, entity, entity, part.second);
    }
    write(type_of_cells, 0, 1, cells);
    out << "$EndElements\n";
    return out.str();
  }

protected:
  using Lattice = std::array<unsigned, 3>;

  BlockOfCells(const unsigned n, const unsigned order, const unsigned type_of_cells, const unsigned type_of_faces)
    : order(order), m(n * order + 1), type_of_cells(type_of_cells), type_of_faces(type_of_faces)
  {
    for (unsigned k = 0; k < m * m * m; ++k)
      nodes.push_back({double(k % m) / (m - 1), double(k / m % m) / (m - 1), double(k / m / m) / (m - 1)});
  }

  unsigned number(const Lattice &x) const { return x[0] + m * (x[1] + m * x[2]); }

  unsigned middle(const std::vector<Lattice> &corners) const
  {
    Lattice x{};
    for (const Lattice &corner : corners)
      for (unsigned d = 0; d < 3; ++d)
        x[d] += corner[d];
    for (unsigned d = 0; d < 3; ++d)
      x[d] /= corners.size();
    return number(x);
  }

  /// The corners of @p element with these numbers.
  static std::vector<Lattice> some_of(const std::vector<Lattice> &element, const std::vector<unsigned> &which)
  {
    std::vector<Lattice> result;
    for (const unsigned corner : which)
      result.push_back(element[corner]);
    return result;
  }

  /// An element of the block's order. @p middles: the corners around nodes of order 2.
  std::vector<unsigned> element(const std::vector<Lattice> &corners, const std::vector<std::vector<unsigned>> &middles) const
  {
    std::vector<unsigned> result;
    for (const Lattice &x : corners)
      result.push_back(number(x));
    if (order == 2)
      for (const auto &around : middles)
        result.push_back(middle(some_of(corners, around)));
    return result;
  }

  void add_face(const std::vector<Lattice> &corners, const std::vector<std::vector<unsigned>> &middles)
  {
    for (unsigned d = 0; d < 3; ++d)
      for (const unsigned side : {0u, m - 1})
        if (std::all_of(corners.begin(), corners.end(), [&](const Lattice &x) { return x[d] == side; }))
          faces[std::string(1, "xyz"[d]) + (side == 0 ? "-" : "+")].push_back(element(corners, middles));
  }

  unsigned order, m;

private:
  unsigned type_of_cells, type_of_faces;
};

/// Each cube is six tetrahedra.
struct BlockOfTetrahedra : BlockOfCells
{
  explicit BlockOfTetrahedra(const unsigned n, const unsigned order = 1) : BlockOfCells(n, order, order == 1 ? 4 : 11, order == 1 ? 2 : 9)
  {
    const std::array<std::array<unsigned, 3>, 6> ways = {{{0, 1, 2}, {0, 2, 1}, {1, 0, 2}, {1, 2, 0}, {2, 0, 1}, {2, 1, 0}}};
    for (unsigned c = 0; c < n * n * n; ++c)
      for (const auto &way : ways)
      {
        Lattice              corner = {c % n * order, c / n % n * order, c / n / n * order};
        std::vector<Lattice> corners = {corner};
        for (const unsigned d : way)
        {
          corner[d] += order;
          corners.push_back(corner);
        }
        cells.push_back(element(corners, {{0, 1}, {1, 2}, {2, 0}, {3, 0}, {2, 3}, {1, 3}}));
        for (const auto &face : std::vector<std::vector<unsigned>>{{0, 1, 2}, {0, 1, 3}, {0, 2, 3}, {1, 2, 3}})
          add_face(some_of(corners, face), {{0, 1}, {1, 2}, {2, 0}});
      }
  }
};

/// Each cube is a hexahedron, which begins with another one of its corners than its neighbours.
struct BlockOfHexahedra : BlockOfCells
{
  explicit BlockOfHexahedra(const unsigned n, const unsigned order = 1) : BlockOfCells(n, order, order == 1 ? 5 : 12, order == 1 ? 3 : 10)
  {
    const std::vector<std::vector<unsigned>> middles = {{0, 1},
                                                        {0, 3},
                                                        {0, 4},
                                                        {1, 2},
                                                        {1, 5},
                                                        {2, 3},
                                                        {2, 6},
                                                        {3, 7},
                                                        {4, 5},
                                                        {4, 7},
                                                        {5, 6},
                                                        {6, 7},
                                                        {0, 1, 2, 3},
                                                        {0, 1, 4, 5},
                                                        {0, 3, 4, 7},
                                                        {1, 2, 5, 6},
                                                        {2, 3, 6, 7},
                                                        {4, 5, 6, 7},
                                                        {0, 1, 2, 3, 4, 5, 6, 7}};
    for (unsigned c = 0; c < n * n * n; ++c)
    {
      const std::vector<Lattice> square = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}};
      std::vector<Lattice>       corners;
      for (const unsigned z : {0u, 1u})
        for (unsigned v = 0; v < 4; ++v)
        {
          const Lattice &at = square[(v + c) % 4];
          corners.push_back({(c % n + at[0]) * order, (c / n % n + at[1]) * order, (c / n / n + z) * order});
        }
      cells.push_back(element(corners, middles));
      for (const auto &face :
           std::vector<std::vector<unsigned>>{{0, 1, 2, 3}, {4, 5, 6, 7}, {0, 1, 5, 4}, {1, 2, 6, 5}, {2, 3, 7, 6}, {3, 0, 4, 7}})
        add_face(some_of(corners, face), {{0, 1}, {1, 2}, {2, 3}, {3, 0}, {0, 1, 2, 3}});
    }
  }
};
