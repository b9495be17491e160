#include "unilateral/mesh/mesh_message.h"
#include "unilateral/mesh/drawn_cells.h"

#include <algorithm>
#include <cstdint>
#include <cstring>
#include <stdexcept>
#include <type_traits>

namespace unilateral
{
  namespace
  {
    class Writer
    {
    public:
      template <typename T>
      void add(const T &value)
      {
        if constexpr (std::is_trivially_copyable_v<T>)
          bytes.append(reinterpret_cast<const char *>(&value), sizeof(T));
        else
        {
          add(std::uint64_t(value.size()));
          if constexpr (std::is_trivially_copyable_v<typename T::value_type>)
            bytes.append(reinterpret_cast<const char *>(value.data()), value.size() * sizeof(typename T::value_type));
          else
            for (const auto &element : value)
              add(element);
        }
      }
      std::string bytes;
    };

    class Reader
    {
    public:
      explicit Reader(const std::string &bytes) : bytes(bytes) {}

      template <typename T>
      void get(T &value)
      {
        if constexpr (std::is_same_v<T, bool>)
        {
          const char byte = *take(1);
          if (byte != 0 && byte != 1)
            throw std::runtime_error("a truth value is neither 0 nor 1");
          value = byte == 1;
        }
        else if constexpr (std::is_trivially_copyable_v<T>)
          std::memcpy(&value, take(sizeof(T)), sizeof(T));
        else
        {
          using Element = typename T::value_type;
          std::uint64_t n = 0;
          get(n);
          // An element takes a byte at least, or eight when it has a length of its own.
          if (n > (bytes.size() - place) / (std::is_trivially_copyable_v<Element> ? sizeof(Element) : 8))
            throw std::runtime_error("a list is longer than the message");
          value.resize(n);
          if constexpr (std::is_trivially_copyable_v<Element>)
          {
            if (n > 0)
              std::memcpy(value.data(), take(n * sizeof(Element)), n * sizeof(Element));
          }
          else
            for (Element &element : value)
              get(element);
        }
      }
      void finish() const
      {
        if (place != bytes.size())
          throw std::runtime_error("the message is longer than its content");
      }

    private:
      const char *take(const std::size_t n)
      {
        if (n > bytes.size() - place)
          throw std::runtime_error("the message is cut off");
        place += n;
        return bytes.data() + place - n;
      }

      const std::string &bytes;
      std::size_t        place = 0;
    };

    template <typename Action, typename List>
    void for_each_member(List &list, const Action &action)
    {
      action(list.vertices);
      action(list.cells);
      action(list.cell_region);
      action(list.region_names);
      action(list.faces);
      action(list.face_part);
      action(list.part_names);
      action(list.warnings);
      action(list.middle_vertices);
      action(list.middle_points);
      action(list.drawn_degree);
      action(list.drawn_cells);
      action(list.drawn_points);
      action(list.approximates_curves);
    }

    unsigned n_corners(const CellKind kind)
    {
      switch (kind)
      {
      case CellKind::segment:
        return 2;
      case CellKind::triangle:
        return 3;
      case CellKind::quadrilateral:
      case CellKind::tetrahedron:
        return 4;
      case CellKind::hexahedron:
        return 8;
      }
      throw std::runtime_error("there is no such kind of cell");
    }

    constexpr unsigned most_drawn_degree = 10;

    void check(const CellList &list)
    {
      const auto below = [](const std::vector<unsigned> &numbers, const std::size_t end)
      { return std::all_of(numbers.begin(), numbers.end(), [&](const unsigned number) { return number < end; }); };
      const auto     known = [&](const std::vector<unsigned> &vertices) { return below(vertices, list.vertices.size()); };
      const unsigned n = n_corners(list.kind);
      if (!std::all_of(list.cells.begin(), list.cells.end(), [&](const auto &cell) { return cell.size() == n && known(cell); }) ||
          !std::all_of(list.faces.begin(), list.faces.end(), [&](const auto &face) { return !face.empty() && known(face); }) ||
          list.cell_region.size() != list.cells.size() || list.face_part.size() != list.faces.size() ||
          !std::all_of(list.middle_vertices.begin(), list.middle_vertices.end(), known) ||
          list.middle_points.size() != list.middle_vertices.size() || !below(list.cell_region, list.region_names.size()) ||
          !below(list.face_part, list.part_names.size()))
        throw std::runtime_error("cells or faces name what is not there");
      if (list.drawn_degree > most_drawn_degree || (list.drawn_degree < 2 && !list.drawn_cells.empty()) ||
          !below(list.drawn_cells, list.cells.size()) ||
          list.drawn_points.size() !=
            list.drawn_cells.size() * equidistant_points(is_simplex(list.kind), dimension(list.kind), list.drawn_degree).size())
        throw std::runtime_error("cells of the drawing are not there, or have other points than they should");
    }
  } // namespace

  std::string to_bytes(const MeshOutline &outline)
  {
    Writer writer;
    writer.add(outline.dimension);
    writer.add(outline.part_names);
    writer.add(outline.region_names);
    return std::move(writer.bytes);
  }

  std::string to_bytes(const CellList &list)
  {
    Writer writer;
    writer.add(static_cast<std::uint32_t>(list.kind));
    for_each_member(list, [&](const auto &member) { writer.add(member); });
    return std::move(writer.bytes);
  }

  MeshOutline outline_of_bytes(const std::string &bytes)
  {
    Reader      reader(bytes);
    MeshOutline outline;
    reader.get(outline.dimension);
    reader.get(outline.part_names);
    reader.get(outline.region_names);
    reader.finish();
    if (outline.dimension < 1 || outline.dimension > 3)
      throw std::runtime_error("a dimension that cannot be");
    return outline;
  }

  CellList cells_of_bytes(const std::string &bytes)
  {
    Reader        reader(bytes);
    CellList      list;
    std::uint32_t kind = 0;
    reader.get(kind);
    list.kind = static_cast<CellKind>(kind);
    for_each_member(list, [&](auto &member) { reader.get(member); });
    reader.finish();
    check(list);
    return list;
  }

  std::string to_bytes(const MeshOutline &outline, const std::optional<CellList> &list)
  {
    Writer writer;
    writer.add(to_bytes(outline));
    writer.add(list ? to_bytes(*list) : "");
    return std::move(writer.bytes);
  }

  std::pair<MeshOutline, std::optional<CellList>> outline_and_cells_of_bytes(const std::string &bytes)
  {
    Reader      reader(bytes);
    std::string outline, cells;
    reader.get(outline);
    reader.get(cells);
    reader.finish();
    std::pair<MeshOutline, std::optional<CellList>> result{outline_of_bytes(outline), std::nullopt};
    if (!cells.empty())
      result.second = cells_of_bytes(cells);
    return result;
  }
} // namespace unilateral
