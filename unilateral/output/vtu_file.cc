#include "unilateral/output/vtu_file.h"

#include <fmt/format.h>

#include <bit>
#include <sstream>
#include <type_traits>
#include <utility>

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

    std::string head(const char *const type)
    {
      return fmt::format("<?xml version=\"1.0\"?>\n<VTKFile type=\"{}\" version=\"1.0\" byte_order=\"{}\" header_type=\"UInt64\">\n", type,
                         std::endian::native == std::endian::little ? "LittleEndian" : "BigEndian");
    }

    struct Array
    {
      std::string attributes;
      const char *bytes;
      std::size_t size;
    };

    template <typename T>
    Array described(const std::string &name, const T *const values, const std::size_t n, const unsigned n_components = 1)
    {
      return {fmt::format("type=\"{}\" Name=\"{}\" NumberOfComponents=\"{}\"", vtk_type_name<T>(), escaped(name), n_components),
              reinterpret_cast<const char *>(values), n * sizeof(T)};
    }

    std::vector<Array> described(const std::vector<VtuArray> &arrays)
    {
      std::vector<Array> result;
      for (const auto &array : arrays)
        std::visit([&](const auto &values) { result.push_back(described(array.name, values.data(), values.size(), array.n_components)); },
                   array.values);
      return result;
    }
  } // namespace

  void write_vtu(std::ostream &out, const VtuGrid &grid)
  {
    static_assert(sizeof(grid.points[0]) == 3 * sizeof(double));
    const std::vector<std::pair<std::string, std::vector<Array>>> sections = {
      {"PointData", described(grid.point_arrays)},
      {"CellData", described(grid.cell_arrays)},
      {"Points", {described("Points", reinterpret_cast<const double *>(grid.points.data()), 3 * grid.points.size(), 3)}},
      {"Cells",
       {described("connectivity", grid.connectivity.data(), grid.connectivity.size()),
        described("offsets", grid.offsets.data(), grid.offsets.size()),
        described("types", grid.cell_types.data(), grid.cell_types.size())}}};

    // Behind the XML the arrays stand in reverse order. VTK does not mind; meshio 5 searches the XML for the array of an offset while
    // it moves the offsets of those that it has seen, and would find a wrong one first.
    std::size_t offset = 0;
    for (const auto &[name, arrays] : sections)
      for (const auto &array : arrays)
        offset += sizeof(std::uint64_t) + array.size;
    fmt::memory_buffer xml;
    fmt::format_to(std::back_inserter(xml), "{}<UnstructuredGrid>\n<Piece NumberOfPoints=\"{}\" NumberOfCells=\"{}\">\n",
                   head("UnstructuredGrid"), grid.points.size(), grid.cell_types.size());
    for (const auto &[name, arrays] : sections)
    {
      fmt::format_to(std::back_inserter(xml), "<{}>\n", name);
      for (const auto &array : arrays)
      {
        offset -= sizeof(std::uint64_t) + array.size;
        fmt::format_to(std::back_inserter(xml), "<DataArray {} format=\"appended\" offset=\"{}\"/>\n", array.attributes, offset);
      }
      fmt::format_to(std::back_inserter(xml), "</{}>\n", name);
    }
    out.write(xml.data(), xml.size());
    out << "</Piece>\n</UnstructuredGrid>\n<AppendedData encoding=\"raw\">\n_";
    for (auto section = sections.rbegin(); section != sections.rend(); ++section)
      for (auto array = section->second.rbegin(); array != section->second.rend(); ++array)
      {
        const std::uint64_t length = array->size;
        out.write(reinterpret_cast<const char *>(&length), sizeof length);
        out.write(array->bytes, array->size);
      }
    out << "\n</AppendedData>\n</VTKFile>\n";
  }

  std::string to_vtu(const VtuGrid &grid)
  {
    std::ostringstream out;
    write_vtu(out, grid);
    return out.str();
  }

  std::string to_pvtu(const VtuGrid &grid, const std::vector<std::string> &files)
  {
    std::string text = head("PUnstructuredGrid") + "<PUnstructuredGrid GhostLevel=\"0\">\n";
    const auto  section = [&](const std::string &name, const std::vector<Array> &arrays)
    {
      text += fmt::format("<{}>\n", name);
      for (const auto &array : arrays)
        text += fmt::format("<PDataArray {}/>\n", array.attributes);
      text += fmt::format("</{}>\n", name);
    };
    section("PPointData", described(grid.point_arrays));
    section("PCellData", described(grid.cell_arrays));
    section("PPoints", {described("Points", reinterpret_cast<const double *>(grid.points.data()), 3 * grid.points.size(), 3)});
    for (const auto &file : files)
      text += fmt::format("<Piece Source=\"{}\"/>\n", escaped(file));
    return text + "</PUnstructuredGrid>\n</VTKFile>\n";
  }

  std::string to_pvd(const std::vector<std::string> &files, const std::vector<double> &times)
  {
    std::string text = "<?xml version=\"1.0\"?>\n<VTKFile type=\"Collection\" version=\"0.1\">\n  <Collection>\n";
    for (std::size_t k = 0; k < files.size(); ++k)
      text += fmt::format("    <DataSet timestep=\"{}\" file=\"{}\"/>\n", times.empty() ? double(k) : times[k], files[k]);
    return text + "  </Collection>\n</VTKFile>\n";
  }
} // namespace unilateral
