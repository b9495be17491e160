// Meshes of a block for patch tests: distorted, turned, of any kind of cell, as Gmsh files.
#pragma once

#include <fmt/format.h>

#include <array>
#include <cmath>
#include <fstream>
#include <string>
#include <vector>

namespace unilateral
{
  /// The box [0,2] x [0,1] (x [0,1]) turned about z by an angle, its inner grid points moved; parts left, right, bottom, top, and in 3-D
  /// front and back (z- and z+).
  struct ElasticBlock
  {
    unsigned dim = 2, n = 2; ///< n cells along the short sides
    bool     simplex = false, distorted = true;
    double   angle = 0;

    /// Writes the mesh in format 2.2.
    void write(const std::string &path) const
    {
      const unsigned                     nx = 2 * n, ny = n, nz = dim == 3 ? n : 0;
      const auto                         index = [&](unsigned i, unsigned j, unsigned k) { return i + (nx + 1) * (j + (ny + 1) * k); };
      std::vector<std::array<double, 3>> points;
      for (unsigned k = 0; k <= nz; ++k)
        for (unsigned j = 0; j <= ny; ++j)
          for (unsigned i = 0; i <= nx; ++i)
          {
            std::array<double, 3> x = {2. * i / nx, double(j) / ny, nz ? double(k) / nz : 0.};
            if (distorted)
            {
              // Points stay on the faces on which they lie.
              const double a = 0.2 / n * std::sin(3 * i + 5 * j + 7 * k + 1), b = 0.2 / n * std::sin(2 * i + 11 * j + 3 * k + 2),
                           c = 0.2 / n * std::sin(5 * i + 2 * j + 13 * k + 3);
              x[0] += i > 0 && i < nx ? a : 0;
              x[1] += j > 0 && j < ny ? b : 0;
              x[2] += nz && k > 0 && k < nz ? c : 0;
            }
            points.push_back({std::cos(angle) * x[0] - std::sin(angle) * x[1], std::sin(angle) * x[0] + std::cos(angle) * x[1], x[2]});
          }

      std::vector<std::pair<unsigned, std::vector<unsigned>>> faces, cells; // physical number, points
      const auto                                              add = [&](unsigned number, std::vector<unsigned> p)
      {
        if (p.size() == 4 && simplex && dim == 3)
        {
          faces.push_back({number, {p[0], p[1], p[2]}});
          faces.push_back({number, {p[0], p[2], p[3]}});
        }
        else
          faces.push_back({number, p});
      };
      if (dim == 2)
      {
        for (unsigned i = 0; i < nx; ++i)
        {
          add(3, {index(i, 0, 0), index(i + 1, 0, 0)});
          add(4, {index(i, ny, 0), index(i + 1, ny, 0)});
        }
        for (unsigned j = 0; j < ny; ++j)
        {
          add(1, {index(0, j, 0), index(0, j + 1, 0)});
          add(2, {index(nx, j, 0), index(nx, j + 1, 0)});
        }
        for (unsigned j = 0; j < ny; ++j)
          for (unsigned i = 0; i < nx; ++i)
          {
            const std::array<unsigned, 4> q = {index(i, j, 0), index(i + 1, j, 0), index(i + 1, j + 1, 0), index(i, j + 1, 0)};
            if (simplex)
            {
              cells.push_back({7, {q[0], q[1], q[2]}});
              cells.push_back({7, {q[0], q[2], q[3]}});
            }
            else
              cells.push_back({7, {q[0], q[1], q[2], q[3]}});
          }
      }
      else
        for (unsigned k = 0; k < nz; ++k)
          for (unsigned j = 0; j < ny; ++j)
            for (unsigned i = 0; i < nx; ++i)
            {
              std::array<unsigned, 8> v; // binary order
              for (unsigned b = 0; b < 8; ++b)
                v[b] = index(i + (b & 1), j + (b >> 1 & 1), k + (b >> 2));
              if (simplex)
                // Kuhn's six tetrahedra around the diagonal, the same in every cube: faces match.
                for (const auto &path : std::vector<std::array<unsigned, 4>>{
                       {0, 1, 3, 7}, {0, 3, 2, 7}, {0, 2, 6, 7}, {0, 6, 4, 7}, {0, 4, 5, 7}, {0, 5, 1, 7}})
                  cells.push_back({7, {v[path[0]], v[path[1]], v[path[2]], v[path[3]]}});
              else
                cells.push_back({7, {v[0], v[1], v[3], v[2], v[4], v[5], v[7], v[6]}});
              // Diagonals from the corner nearest to the origin, as the tetrahedra have them.
              const auto face = [&](unsigned number, unsigned a, unsigned b, unsigned c, unsigned d) {
                add(number, {v[a], v[b], v[c], v[d]});
              };
              if (i == 0)
                face(1, 0, 2, 6, 4);
              if (i + 1 == nx)
                face(2, 1, 3, 7, 5);
              if (j == 0)
                face(3, 0, 1, 5, 4);
              if (j + 1 == ny)
                face(4, 2, 3, 7, 6);
              if (k == 0)
                face(5, 0, 1, 3, 2);
              if (k + 1 == nz)
                face(6, 4, 5, 7, 6);
            }

      std::ofstream out(path);
      out << "$MeshFormat\n2.2 0 8\n$EndMeshFormat\n$PhysicalNames\n" << (dim == 2 ? 5 : 7) << "\n";
      const std::vector<std::string> names = {"left", "right", "bottom", "top", "front", "back"};
      for (unsigned part = 0; part < 2 * dim; ++part)
        out << fmt::format("{} {} \"{}\"\n", dim - 1, part + 1, names[part]);
      out << fmt::format("{} 7 \"block\"\n$EndPhysicalNames\n$Nodes\n{}\n", dim, points.size());
      for (std::size_t p = 0; p < points.size(); ++p)
        out << fmt::format("{} {:.17g} {:.17g} {:.17g}\n", p + 1, points[p][0], points[p][1], points[p][2]);
      out << fmt::format("$EndNodes\n$Elements\n{}\n", faces.size() + cells.size());
      std::size_t number = 0;
      const auto  element = [&](const auto &entry, const bool is_face)
      {
        const auto &[physical, corners] = entry;
        const unsigned type = is_face    ? (dim == 2              ? 1
                                            : corners.size() == 3 ? 2
                                                                  : 3)
                              : dim == 2 ? (corners.size() == 3 ? 2 : 3)
                                         : (corners.size() == 4 ? 4 : 5);
        out << fmt::format("{} {} 2 {} {}", ++number, type, physical, physical);
        for (const unsigned corner : corners)
          out << ' ' << corner + 1;
        out << '\n';
      };
      for (const auto &face : faces)
        element(face, true);
      for (const auto &cell : cells)
        element(cell, false);
      out << "$EndElements\n";
    }
  };
} // namespace unilateral
