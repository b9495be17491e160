#include "unilateral/vtu_file.h"

#include <deal.II/base/utilities.h>

#include <fmt/format.h>

#include <algorithm>
#include <cstring>
#include <stdexcept>

#include <zlib.h>

namespace unilateral
{
  namespace
  {
    template <typename T>
    const char *vtk_type_name();
    template <>
    const char *vtk_type_name<double>()
    {
      return "Float64";
    }
    template <>
    const char *vtk_type_name<std::int64_t>()
    {
      return "Int64";
    }
    template <>
    const char *vtk_type_name<std::uint8_t>()
    {
      return "UInt8";
    }

    std::string base64(const void *bytes, const std::size_t size)
    {
      const auto *first = static_cast<const unsigned char *>(bytes);
      return dealii::Utilities::encode_base64(std::vector<unsigned char>(first, first + size));
    }

    /// VTK's compressed form: how many blocks, their size, the size of the last when it is shorter, the compressed sizes; then the blocks.
    std::string encoded(const void *bytes, const std::size_t size)
    {
      constexpr std::size_t      block_size = 1 << 20;
      const std::size_t          n_blocks = (size + block_size - 1) / block_size;
      std::vector<std::uint64_t> header = {n_blocks, block_size, size % block_size};
      std::vector<unsigned char> compressed;
      for (std::size_t block = 0; block < n_blocks; ++block)
      {
        const std::size_t begin = block * block_size, length = std::min(block_size, size - begin);
        uLongf            room = compressBound(length);
        const std::size_t end = compressed.size();
        compressed.resize(end + room);
        if (compress2(compressed.data() + end, &room, static_cast<const Bytef *>(bytes) + begin, length, Z_BEST_SPEED) != Z_OK)
          throw std::runtime_error("zlib ran out of memory while writing a VTU file");
        compressed.resize(end + room);
        header.push_back(room);
      }
      return base64(header.data(), header.size() * sizeof(std::uint64_t)) + base64(compressed.data(), compressed.size());
    }

    template <typename T>
    void append_array(std::string &xml, const std::string &name, const std::vector<T> &values, const unsigned n_components = 1)
    {
      fmt::format_to(std::back_inserter(xml), "<DataArray type=\"{}\" Name=\"{}\" NumberOfComponents=\"{}\" format=\"binary\">\n",
                     vtk_type_name<T>(), name, n_components);
      xml += encoded(values.data(), values.size() * sizeof(T));
      xml += "\n</DataArray>\n";
    }

    std::string escaped(const std::string &name)
    {
      std::string text;
      for (const char c : name)
        text += c == '&' ? "&amp;" : c == '<' ? "&lt;" : c == '"' ? "&quot;" : std::string(1, c);
      return text;
    }

    void append_arrays(std::string &xml, const std::vector<VtuArray> &arrays)
    {
      for (const auto &array : arrays)
        if (array.integral)
          append_array(xml, escaped(array.name), std::vector<std::int64_t>(array.values.begin(), array.values.end()), array.n_components);
        else
          append_array(xml, escaped(array.name), array.values, array.n_components);
    }
  } // namespace

  std::string to_vtu(const VtuGrid &grid)
  {
    std::string xml = "<?xml version=\"1.0\"?>\n<VTKFile type=\"UnstructuredGrid\" version=\"1.0\" byte_order=\"LittleEndian\" "
                      "header_type=\"UInt64\" compressor=\"vtkZLibDataCompressor\">\n<UnstructuredGrid>\n";
    fmt::format_to(std::back_inserter(xml), "<Piece NumberOfPoints=\"{}\" NumberOfCells=\"{}\">\n", grid.points.size(),
                   grid.cell_types.size());

    xml += "<PointData>\n";
    append_arrays(xml, grid.point_arrays);
    xml += "</PointData>\n<CellData>\n";
    append_arrays(xml, grid.cell_arrays);
    xml += "</CellData>\n<Points>\n";
    std::vector<double> coordinates;
    coordinates.reserve(3 * grid.points.size());
    for (const auto &p : grid.points)
      coordinates.insert(coordinates.end(), p.begin(), p.end());
    append_array(xml, "Points", coordinates, 3);
    xml += "</Points>\n<Cells>\n";
    append_array(xml, "connectivity", grid.connectivity);
    append_array(xml, "offsets", grid.offsets);
    append_array(xml, "types", grid.cell_types);
    return xml + "</Cells>\n</Piece>\n</UnstructuredGrid>\n</VTKFile>\n";
  }
} // namespace unilateral
