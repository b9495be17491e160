// A .msh file with a block of tetrahedra, whole or with a mistake in it.
#pragma once

#include <algorithm>
#include <array>
#include <map>
#include <sstream>
#include <string>
#include <vector>

/// The unit cube in n^3 cubes of six tetrahedra each; its sides are the parts "x-" to "z+".
struct BlockOfTetrahedra
{
  std::vector<std::array<double, 3>>                        nodes;
  std::vector<std::vector<unsigned>>                        cells; ///< four corners, and with order 2 the middles of edges in Gmsh's order
  std::map<std::string, std::vector<std::vector<unsigned>>> faces;

  explicit BlockOfTetrahedra(const unsigned n, const unsigned order = 1) : order(order), m(n * order + 1)
  {
    for (unsigned k = 0; k < m * m * m; ++k)
      nodes.push_back({double(k % m) / (m - 1), double(k / m % m) / (m - 1), double(k / m / m) / (m - 1)});
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
        add_cell(corners);
      }
  }

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
      write(2, ++entity, order == 1 ? 2 : 9, part.second);
    write(3, 1, order == 1 ? 4 : 11, cells);
    out << "$EndElements\n";
    return out.str();
  }

private:
  using Lattice = std::array<unsigned, 3>;

  unsigned number(const Lattice &x) const { return x[0] + m * (x[1] + m * x[2]); }

  void add_cell(const std::vector<Lattice> &corners)
  {
    const auto middle = [&](const unsigned a, const unsigned b)
    {
      Lattice x;
      for (unsigned d = 0; d < 3; ++d)
        x[d] = (corners[a][d] + corners[b][d]) / 2;
      return number(x);
    };
    auto &cell = cells.emplace_back();
    for (const Lattice &x : corners)
      cell.push_back(number(x));
    if (order == 2)
      for (const auto &[a, b] : std::vector<std::array<unsigned, 2>>{{0, 1}, {1, 2}, {2, 0}, {3, 0}, {2, 3}, {1, 3}})
        cell.push_back(middle(a, b));
    for (const auto &[a, b, c] : std::vector<std::array<unsigned, 3>>{{0, 1, 2}, {0, 1, 3}, {0, 2, 3}, {1, 2, 3}})
      for (unsigned d = 0; d < 3; ++d)
        for (const unsigned side : {0u, m - 1})
          if (corners[a][d] == side && corners[b][d] == side && corners[c][d] == side)
          {
            auto &face = faces[std::string(1, "xyz"[d]) + (side == 0 ? "-" : "+")].emplace_back();
            face = {number(corners[a]), number(corners[b]), number(corners[c])};
            if (order == 2)
              face.insert(face.end(), {middle(a, b), middle(b, c), middle(c, a)});
          }
  }

  unsigned order, m;
};
