#include "unilateral/output/vtu_reader.h"

#include "unilateral/base/diagnostics.h"

#include <fmt/format.h>

#include <algorithm>
#include <bit>
#include <charconv>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <optional>
#include <string_view>
#include <system_error>

namespace unilateral
{
  namespace
  {
    [[noreturn]] void damaged(const std::string &path, const std::string &what)
    {
      throw InputError({path, 0, 0}, fmt::format("{}; write the results anew with 'unilateral run'", what), MessageName("file-damaged"));
    }

    std::string bytes_of(const std::string &path)
    {
      std::error_code failure;
      if (!std::filesystem::is_regular_file(path, failure))
        throw InputError({path, 0, 0}, "there is no such file", MessageName("file-not-found"));
      const auto    size = std::filesystem::file_size(path, failure);
      std::string   bytes(failure ? 0 : size, '\0');
      std::ifstream in(path, std::ios::binary);
      if (failure || !in.read(bytes.data(), std::streamsize(bytes.size())))
        throw InputError({path, 0, 0}, "the file cannot be read", MessageName("file-not-found"));
      return bytes;
    }

    /// The value of an attribute of the tag @p tag, "" where it has none.
    std::string_view attribute(const std::string_view tag, const std::string &name)
    {
      const std::string start = " " + name + "=\"";
      const std::size_t begin = tag.find(start);
      if (begin == std::string_view::npos)
        return {};
      const std::size_t from = begin + start.size(), end = tag.find('"', from);
      return end == std::string_view::npos ? std::string_view{} : tag.substr(from, end - from);
    }

    std::string unescaped(std::string_view text)
    {
      std::string result;
      while (!text.empty())
      {
        const auto replace = [&](const std::string_view entity, const char c)
        {
          if (!text.starts_with(entity))
            return false;
          result += c;
          text.remove_prefix(entity.size());
          return true;
        };
        if (!replace("&amp;", '&') && !replace("&lt;", '<') && !replace("&quot;", '"'))
        {
          result += text.front();
          text.remove_prefix(1);
        }
      }
      return result;
    }

    class VtuText
    {
    public:
      explicit VtuText(const std::string &path) : path(path), bytes(bytes_of(path))
      {
        static constexpr std::string_view start = "<AppendedData encoding=\"raw\">\n_";
        const std::size_t                 at = bytes.find(start);
        if (bytes.find(" type=\"UnstructuredGrid\"") == std::string::npos || at == std::string::npos)
          damaged(path, "this is not a VTU file of this program");
        const char *const order = std::endian::native == std::endian::little ? "\"LittleEndian\"" : "\"BigEndian\"";
        xml = std::string_view(bytes).substr(0, at);
        data = std::string_view(bytes).substr(at + start.size());
        if (xml.find(order) == std::string_view::npos || xml.find("header_type=\"UInt64\"") == std::string_view::npos)
          damaged(path, "the file comes from a machine of another kind");
      }

      VtuGrid grid() const
      {
        VtuGrid           result;
        const std::size_t n_points = number(tag("<Piece ", 0), "NumberOfPoints"), n_cells = number(tag("<Piece ", 0), "NumberOfCells");
        result.point_arrays = arrays("PointData", n_points);
        result.cell_arrays = arrays("CellData", n_cells);
        const auto points = arrays("Points", n_points), cells = arrays("Cells", {});
        if (points.size() != 1 || points[0].n_components != 3 || !std::holds_alternative<std::vector<double>>(points[0].values) ||
            cells.size() != 3)
          damaged(path, "points or cells are missing");
        const auto &x = std::get<std::vector<double>>(points[0].values);
        for (std::size_t i = 0; i < n_points; ++i)
          result.points.push_back({x[3 * i], x[3 * i + 1], x[3 * i + 2]});
        result.connectivity = values_of<std::int32_t>(cells[0]);
        result.offsets = values_of<std::int32_t>(cells[1]);
        result.cell_types = values_of<std::uint8_t>(cells[2]);
        std::int32_t last = 0;
        for (const auto end : result.offsets)
        {
          if (end < last || std::size_t(end) > result.connectivity.size())
            damaged(path, "cells do not fit together");
          last = end;
        }
        if (result.offsets.size() != n_cells || result.cell_types.size() != n_cells ||
            std::any_of(result.connectivity.begin(), result.connectivity.end(),
                        [&](const auto p) { return p < 0 || std::size_t(p) >= n_points; }))
          damaged(path, "cells do not fit together");
        return result;
      }

    private:
      std::string_view tag(const std::string &start, const std::size_t from) const
      {
        const std::size_t begin = xml.find(start, from);
        if (begin == std::string_view::npos)
          damaged(path, fmt::format("{}...> is missing", start));
        return xml.substr(begin, xml.find('>', begin) - begin);
      }

      std::size_t number(const std::string_view where, const std::string &name) const
      {
        const std::string_view text = attribute(where, name);
        std::size_t            value = 0;
        const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
        if (error != std::errc() || end != text.data() + text.size() || value > data.size())
          damaged(path, fmt::format("{} is not a number that the file can hold", name));
        return value;
      }

      template <typename T>
      std::vector<T> values_of(const VtuArray &array) const
      {
        if (!std::holds_alternative<std::vector<T>>(array.values))
          damaged(path, fmt::format("array '{}' has numbers of another type", array.name));
        return std::get<std::vector<T>>(array.values);
      }

      /// All that the array at @p offset has.
      template <typename T>
      std::vector<T> values_at(const std::size_t offset) const
      {
        std::uint64_t length = 0;
        if (offset > data.size() || data.size() - offset < sizeof length)
          damaged(path, "the file ends early");
        std::memcpy(&length, data.data() + offset, sizeof length);
        if (length > data.size() - offset - sizeof length || length % sizeof(T) != 0)
          damaged(path, "the file ends early or is damaged");
        std::vector<T> values(length / sizeof(T));
        if (length > 0)
          std::memcpy(values.data(), data.data() + offset + sizeof length, length);
        return values;
      }

      /// Those of a section, @p n_tuples each, or as many as there are.
      std::vector<VtuArray> arrays(const std::string &section, const std::optional<std::size_t> n_tuples) const
      {
        const std::size_t begin = xml.find("<" + section + ">"), end = xml.find("</" + section + ">");
        if (begin == std::string_view::npos || end == std::string_view::npos || end < begin)
          damaged(path, fmt::format("section {} is missing", section));
        std::vector<VtuArray> result;
        for (std::size_t at = xml.find("<DataArray ", begin); at < end; at = xml.find("<DataArray ", at + 1))
        {
          const std::string_view here = tag("<DataArray ", at);
          const std::string_view type = attribute(here, "type");
          const std::size_t      n_components = number(here, "NumberOfComponents"), offset = number(here, "offset");
          if (n_components < 1 || n_components > 9)
            damaged(path, "an array has too many components");
          VtuArray array{.name = unescaped(attribute(here, "Name")), .n_components = unsigned(n_components)};
          if (type == "Float64")
            array.values = values_at<double>(offset);
          else if (type == "Int32")
            array.values = values_at<std::int32_t>(offset);
          else if (type == "UInt8")
            array.values = values_at<std::uint8_t>(offset);
          else
            damaged(path, fmt::format("numbers of type '{}' are not expected", std::string(type)));
          if (n_tuples && std::visit([](const auto &values) { return values.size(); }, array.values) != *n_tuples * n_components)
            damaged(path, fmt::format("array '{}' has another length than the grid", array.name));
          result.push_back(std::move(array));
        }
        return result;
      }

      const std::string path, bytes;
      std::string_view  xml, data;
    };

    template <typename T>
    void append(std::vector<T> &to, const std::vector<T> &more)
    {
      to.insert(to.end(), more.begin(), more.end());
    }

    /// Keeps the arrays that both have.
    void append_arrays(std::vector<VtuArray> &to, const std::vector<VtuArray> &more)
    {
      std::vector<VtuArray> kept;
      for (VtuArray &array : to)
        for (const VtuArray &other : more)
          if (other.name == array.name && other.values.index() == array.values.index() && other.n_components == array.n_components)
          {
            std::visit([&](auto &values) { append(values, std::get<std::decay_t<decltype(values)>>(other.values)); }, array.values);
            kept.push_back(std::move(array));
            break;
          }
      to = std::move(kept);
    }

    VtuGrid joined(VtuGrid a, const VtuGrid &b)
    {
      const auto first_point = std::int32_t(a.points.size()), first_corner = std::int32_t(a.connectivity.size());
      append(a.points, b.points);
      for (const auto p : b.connectivity)
        a.connectivity.push_back(first_point + p);
      for (const auto end : b.offsets)
        a.offsets.push_back(first_corner + end);
      append(a.cell_types, b.cell_types);
      append_arrays(a.point_arrays, b.point_arrays);
      append_arrays(a.cell_arrays, b.cell_arrays);
      return a;
    }
  } // namespace

  VtuGrid read_vtu(const std::string &path)
  {
    if (!path.ends_with(".pvtu"))
      return VtuText(path).grid();
    const std::string text = bytes_of(path);
    VtuGrid           all;
    bool              first = true;
    for (std::size_t at = text.find("<Piece "); at != std::string::npos; at = text.find("<Piece ", at + 1))
    {
      const std::string name = unescaped(attribute(std::string_view(text).substr(at, text.find('>', at) - at), "Source"));
      if (name.empty() || name.find('/') != std::string::npos)
        damaged(path, "a piece is not in the folder of the file");
      VtuGrid piece = VtuText((std::filesystem::path(path).parent_path() / name).string()).grid();
      all = first ? std::move(piece) : joined(std::move(all), piece);
      first = false;
    }
    if (first)
      damaged(path, "no pieces are named");
    return all;
  }
} // namespace unilateral
