#include "unilateral/vtu_file.h"

#include <fmt/format.h>

#include <bit>
#include <sstream>
#include <type_traits>

namespace unilateral
{
  namespace
  {
    template <typename T>
    constexpr const char *vtk_type_name()
    {
      if (std::is_same_v<T, double>)
        return "Float64";
      return std::is_same_v<T, std::int32_t> ? "Int32" : "UInt8";
    }

    std::string escaped(const std::string &name)
    {
      std::string text;
      for (const char c : name)
        text += c == '&' ? "&amp;" : c == '<' ? "&lt;" : c == '"' ? "&quot;" : std::string(1, c);
      return text;
    }

    /// The XML grows array by array, and with it the list of what stands behind it.
    class Description
    {
    public:
      std::string xml;

      template <typename T>
      void add(const std::string &name, const T *const values, const std::size_t n, const unsigned n_components = 1)
      {
        fmt::format_to(std::back_inserter(xml),
                       "<DataArray type=\"{}\" Name=\"{}\" NumberOfComponents=\"{}\" format=\"appended\" offset=\"{}\"/>\n",
                       vtk_type_name<T>(), escaped(name), n_components, offset);
        blocks.push_back({reinterpret_cast<const char *>(values), n * sizeof(T)});
        offset += sizeof(std::uint64_t) + n * sizeof(T);
      }

      void add(const std::vector<VtuArray> &arrays)
      {
        for (const auto &array : arrays)
          std::visit([&](const auto &values) { add(array.name, values.data(), values.size(), array.n_components); }, array.values);
      }

      void write_blocks(std::ostream &out) const
      {
        for (const auto &[bytes, size] : blocks)
        {
          const std::uint64_t length = size;
          out.write(reinterpret_cast<const char *>(&length), sizeof length);
          out.write(bytes, size);
        }
      }

    private:
      struct Block
      {
        const char *bytes;
        std::size_t size;
      };
      std::vector<Block> blocks;
      std::size_t        offset = 0;
    };
  } // namespace

  void write_vtu(std::ostream &out, const VtuGrid &grid)
  {
    Description description;
    auto       &xml = description.xml;
    xml =
      fmt::format("<?xml version=\"1.0\"?>\n<VTKFile type=\"UnstructuredGrid\" version=\"1.0\" byte_order=\"{}\" "
                  "header_type=\"UInt64\">\n<UnstructuredGrid>\n<Piece NumberOfPoints=\"{}\" NumberOfCells=\"{}\">\n<PointData>\n",
                  std::endian::native == std::endian::little ? "LittleEndian" : "BigEndian", grid.points.size(), grid.cell_types.size());
    description.add(grid.point_arrays);
    xml += "</PointData>\n<CellData>\n";
    description.add(grid.cell_arrays);
    xml += "</CellData>\n<Points>\n";
    static_assert(sizeof(grid.points[0]) == 3 * sizeof(double));
    description.add("Points", reinterpret_cast<const double *>(grid.points.data()), 3 * grid.points.size(), 3);
    xml += "</Points>\n<Cells>\n";
    description.add("connectivity", grid.connectivity.data(), grid.connectivity.size());
    description.add("offsets", grid.offsets.data(), grid.offsets.size());
    description.add("types", grid.cell_types.data(), grid.cell_types.size());
    xml += "</Cells>\n</Piece>\n</UnstructuredGrid>\n<AppendedData encoding=\"raw\">\n_";
    out << xml;
    description.write_blocks(out);
    out << "\n</AppendedData>\n</VTKFile>\n";
  }

  std::string to_vtu(const VtuGrid &grid)
  {
    std::ostringstream out;
    write_vtu(out, grid);
    return out.str();
  }
} // namespace unilateral
