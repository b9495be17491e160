#include "unilateral/functions/cell_functions_file.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cstdint>
#include <cstring>
#include <fstream>
#include <iterator>
#include <map>
#include <stdexcept>
#include <type_traits>
#include <utility>

namespace unilateral
{
  namespace
  {
    /// Its first bytes: name, version, and a number that another order of bytes would change.
    constexpr std::array<char, 8> mark = {'u', 'n', 'i', 'l', 'a', 't', 'c', '1'};
    constexpr std::uint32_t       order_of_bytes = 0x01020304;
    constexpr unsigned            largest_degree = 64;

    template <typename T>
    void append(std::string &bytes, const T &value)
    {
      static_assert(std::is_trivially_copyable_v<T>);
      bytes.append(reinterpret_cast<const char *>(&value), sizeof(value));
    }

    template <typename T>
    void append(std::string &bytes, const std::vector<T> &values)
    {
      append(bytes, std::uint64_t(values.size()));
      bytes.append(reinterpret_cast<const char *>(values.data()), values.size() * sizeof(T));
    }

    void append(std::string &bytes, const std::string &text)
    {
      append(bytes, std::vector<char>(text.begin(), text.end()));
    }

    /// Takes values off the bytes of a file, one after the other.
    class Reader
    {
    public:
      explicit Reader(const std::string &path) : path(path)
      {
        std::ifstream file(path, std::ios::binary);
        if (!file)
          fail("cannot be read");
        bytes.assign(std::istreambuf_iterator<char>(file), {});
      }

      template <typename T>
      T value()
      {
        T result;
        std::memcpy(&result, next(sizeof(T)), sizeof(T));
        return result;
      }

      template <typename T>
      std::vector<T> values()
      {
        const auto n = value<std::uint64_t>();
        if (n > bytes.size() / sizeof(T))
          fail("is cut short or damaged");
        std::vector<T> result(n);
        if (n > 0)
          std::memcpy(result.data(), next(n * sizeof(T)), n * sizeof(T));
        return result;
      }

      bool at_end() const { return place == bytes.size(); }

      [[noreturn]] void fail(const std::string &why) const { throw std::runtime_error(fmt::format("'{}' {}", path, why)); }

    private:
      const char *next(const std::size_t n)
      {
        if (n > bytes.size() - place)
          fail("is cut short or damaged");
        return bytes.data() + std::exchange(place, place + n);
      }

      const std::string path;
      std::string       bytes;
      std::size_t       place = 0;
    };

    struct Part
    {
      CellNodes                                  nodes;
      std::map<std::string, std::vector<double>> functions;
    };

    Part read_part(const std::string &path)
    {
      Reader file(path);
      if (file.value<std::array<char, 8>>() != mark || file.value<std::uint32_t>() != order_of_bytes)
        file.fail("is no file of functions of this version and machine");
      Part  part;
      auto &nodes = part.nodes;
      nodes.dim = file.value<std::uint32_t>();
      nodes.simplex = file.value<std::uint32_t>() != 0;
      nodes.degree = file.value<std::uint32_t>();
      nodes.map_degree = file.value<std::uint32_t>();
      if (nodes.dim < 1 || nodes.dim > 3 || nodes.degree > largest_degree || nodes.map_degree < 1 || nodes.map_degree > largest_degree)
        file.fail("is damaged");
      nodes.points = file.values<std::array<double, 3>>();
      nodes.map_nodes = file.values<std::uint32_t>();
      nodes.value_nodes = file.values<std::uint32_t>();
      const auto n_functions = file.value<std::uint64_t>();
      for (std::uint64_t f = 0; f < n_functions; ++f)
      {
        const std::vector<char> name = file.values<char>();
        part.functions[std::string(name.begin(), name.end())] = file.values<double>();
      }
      const auto are_below = [](const std::vector<std::uint32_t> &numbers, const std::size_t n)
      { return std::all_of(numbers.begin(), numbers.end(), [&](const std::uint32_t number) { return number < n; }); };
      bool good = file.at_end() && !part.functions.empty() && nodes.map_nodes.size() % nodes.n_map_nodes() == 0 &&
                  nodes.value_nodes.size() == nodes.n_cells() * nodes.n_value_nodes() && are_below(nodes.map_nodes, nodes.points.size());
      for (const auto &[name, values] : part.functions)
        good = good && values.size() == part.functions.begin()->second.size() && are_below(nodes.value_nodes, values.size());
      if (!good)
        file.fail("is damaged");
      return part;
    }

    template <typename T>
    void append_to(std::vector<T> &all, const std::vector<T> &more, const T shift)
    {
      for (const T &value : more)
        all.push_back(value + shift);
    }
  } // namespace

  std::string to_bytes(const CellFunctions &functions)
  {
    const CellNodes &nodes = functions.cells();
    std::string      bytes(mark.begin(), mark.end());
    append(bytes, order_of_bytes);
    for (const std::uint32_t number : {nodes.dim, unsigned(nodes.simplex), nodes.degree, nodes.map_degree})
      append(bytes, number);
    append(bytes, nodes.points);
    append(bytes, nodes.map_nodes);
    append(bytes, nodes.value_nodes);
    append(bytes, std::uint64_t(functions.all().size()));
    for (const auto &[name, values] : functions.all())
    {
      append(bytes, name);
      append(bytes, values);
    }
    return bytes;
  }

  std::shared_ptr<const CellFunctions> read_cell_functions(const std::vector<std::string> &paths)
  {
    Part whole;
    for (const std::string &path : paths)
    {
      Part part = read_part(path);
      if (&path == &paths.front())
      {
        whole = std::move(part);
        continue;
      }
      auto       &all = whole.nodes;
      const auto &more = part.nodes;
      if (more.dim != all.dim || more.simplex != all.simplex || more.degree != all.degree || more.map_degree != all.map_degree ||
          part.functions.size() != whole.functions.size())
        throw std::runtime_error(fmt::format("'{}' is not of the same solution as '{}'", path, paths.front()));
      append_to(all.map_nodes, more.map_nodes, std::uint32_t(all.points.size()));
      append_to(all.value_nodes, more.value_nodes, std::uint32_t(whole.functions.begin()->second.size()));
      all.points.insert(all.points.end(), more.points.begin(), more.points.end());
      for (auto &[name, values] : whole.functions)
      {
        const auto found = part.functions.find(name);
        if (found == part.functions.end())
          throw std::runtime_error(fmt::format("'{}' is not of the same solution as '{}'", path, paths.front()));
        values.insert(values.end(), found->second.begin(), found->second.end());
      }
    }
    return std::make_shared<const CellFunctions>(std::move(whole.nodes), std::move(whole.functions));
  }
} // namespace unilateral
