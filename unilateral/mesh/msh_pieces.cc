#include "unilateral/mesh/msh_pieces.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <cstring>
#include <limits>
#include <map>
#include <set>
#include <string_view>
#include <tuple>
#include <utility>

#include <fcntl.h>
#include <unistd.h>

namespace unilateral
{
  namespace
  {
    /// The file is not what is read here.
    struct NotRead
    {
    };

    void require(const bool right)
    {
      if (!right)
        throw NotRead();
    }

    /// Numbers in a text, one after the other.
    class Numbers
    {
    public:
      explicit Numbers(const std::string_view text) : at(text.data()), end(text.data() + text.size()) {}

      template <typename T>
      T next()
      {
        skip_spaces();
        T value{};
        const auto [rest, error] = std::from_chars(at, end, value);
        require(error == std::errc() && (rest == end || is_space(*rest)));
        at = rest;
        return value;
      }

      bool at_end()
      {
        skip_spaces();
        return at == end;
      }

      /// What is left.
      std::string_view rest() const { return {at, std::size_t(end - at)}; }

    private:
      static bool is_space(const char c) { return c == ' ' || c == '\n' || c == '\r' || c == '\t'; }
      void        skip_spaces()
      {
        while (at != end && is_space(*at))
          ++at;
      }

      const char *at, *const end;
    };

    /// A file from its beginning to its end, through a buffer.
    class Scanner
    {
    public:
      explicit Scanner(const std::string &file) : descriptor(::open(file.c_str(), O_RDONLY | O_CLOEXEC)) { require(descriptor >= 0); }
      ~Scanner() { ::close(descriptor); }
      Scanner(const Scanner &) = delete;
      Scanner &operator=(const Scanner &) = delete;

      /// The byte that comes next.
      std::uint64_t place() const { return before + at; }

      /// The next line, without its end; it lives until the next one is read.
      std::string_view line()
      {
        long_line.clear();
        for (;;)
        {
          require(at < buffer.size() || fill());
          const char *const begin = buffer.data() + at, *const stop = find_line_end();
          if (stop)
          {
            at += stop - begin + 1;
            if (long_line.empty())
              return without_return({begin, std::size_t(stop - begin)});
            long_line.append(begin, stop);
            return without_return(long_line);
          }
          require(long_line.size() < longest_line);
          long_line.append(begin, buffer.size() - at);
          at = buffer.size();
        }
      }

      void skip_lines(std::uint64_t n)
      {
        while (n > 0)
        {
          require(at < buffer.size() || fill());
          const char *const stop = find_line_end();
          at = stop ? stop + 1 - buffer.data() : buffer.size();
          n -= stop != nullptr;
        }
      }

      template <typename T>
      T binary()
      {
        T     value{};
        char *to = reinterpret_cast<char *>(&value);
        for (std::size_t left = sizeof(T); left > 0;)
        {
          require(at < buffer.size() || fill());
          const std::size_t n = std::min(left, buffer.size() - at);
          std::memcpy(to, buffer.data() + at, n);
          to += n;
          at += n;
          left -= n;
        }
        return value;
      }

      /// Without reading them, where they are many.
      void skip_bytes(const std::uint64_t n)
      {
        if (n <= buffer.size() - at)
        {
          at += n;
          return;
        }
        const std::uint64_t to = place() + n;
        const off_t         size = lseek(descriptor, 0, SEEK_END);
        require(to >= n && size >= 0 && to <= std::uint64_t(size));
        before = to;
        buffer.clear();
        at = 0;
      }

    private:
      static constexpr std::size_t size_of_buffer = 1 << 20, longest_line = 1 << 24;

      static std::string_view without_return(std::string_view line)
      {
        if (!line.empty() && line.back() == '\r')
          line.remove_suffix(1);
        return line;
      }

      const char *find_line_end() const { return static_cast<const char *>(std::memchr(buffer.data() + at, '\n', buffer.size() - at)); }

      bool fill()
      {
        before += buffer.size();
        at = 0;
        buffer.resize(size_of_buffer);
        const ssize_t n = pread(descriptor, buffer.data(), buffer.size(), off_t(before));
        buffer.resize(n > 0 ? n : 0);
        return n > 0;
      }

      int               descriptor;
      std::uint64_t     before = 0; ///< bytes of the file before those of the buffer
      std::vector<char> buffer;
      std::size_t       at = 0;
      std::string       long_line;
    };

    /// Of Gmsh's element types those that are read here, and points.
    struct KindOfElement
    {
      unsigned dim, order, n_nodes;
    };

    std::optional<KindOfElement> kind_of_element(const int type)
    {
      switch (type)
      {
      case 15:
        return KindOfElement{0, 1, 1};
      case 1:
        return KindOfElement{1, 1, 2};
      case 8:
        return KindOfElement{1, 2, 3};
      case 2:
        return KindOfElement{2, 1, 3};
      case 9:
        return KindOfElement{2, 2, 6};
      case 4:
        return KindOfElement{3, 1, 4};
      case 11:
        return KindOfElement{3, 2, 10};
      default:
        return std::nullopt;
      }
    }

    unsigned number_in(const std::string &name, std::vector<std::string> &names)
    {
      const auto found = std::find(names.begin(), names.end(), name);
      if (found != names.end())
        return found - names.begin();
      names.push_back(name);
      return names.size() - 1;
    }

    /// What stands before the nodes.
    class MshHead
    {
    public:
      /// Up to the line "$Nodes", which is read, too.
      explicit MshHead(Scanner &scanner)
      {
        require(scanner.line() == "$MeshFormat");
        const std::string format(scanner.line());
        Numbers           numbers(format);
        require(numbers.next<double>() == 4.1);
        const int kind = numbers.next<int>();
        require((kind == 0 || kind == 1) && numbers.next<int>() == sizeof(std::uint64_t));
        binary = kind == 1;
        if (binary)
        {
          require(scanner.binary<int>() == 1); // else the bytes of its numbers come in another order
          require(scanner.line().empty());
        }
        require(scanner.line() == "$EndMeshFormat");
        bool has_entities = false;
        for (;;)
        {
          const std::string section(scanner.line());
          if (section == "$Nodes")
            break;
          if (section == "$PhysicalNames")
            read_names(scanner);
          else
          {
            require(section == "$Entities");
            read_entities(scanner);
            has_entities = true;
          }
          require(scanner.line() == "$End" + section.substr(1));
        }
        require(has_entities && (dim == 2 || dim == 3));
      }

      /// Of the entity's first physical group; empty: it is in none.
      std::string name_of(const unsigned dim, const int entity) const
      {
        const auto group = group_of.find({dim, entity});
        return group == group_of.end() ? "" : name_of_group(dim, group->second);
      }

      /// Those of all groups of a dimension that have entities, by their numbers.
      std::vector<std::string> names(const unsigned dim) const
      {
        std::vector<std::string> result;
        for (const auto &[d, group] : groups)
          if (d == dim)
            number_in(name_of_group(dim, group), result);
        return result;
      }

      bool     binary = false;
      unsigned dim = 0;

    private:
      std::string name_of_group(const unsigned dim, const int group) const
      {
        const auto name = group_names.find({dim, group});
        return name == group_names.end() || name->second.empty() ? std::to_string(group) : name->second;
      }

      void read_names(Scanner &scanner)
      {
        const std::string head(scanner.line());
        for (auto n = Numbers(head).next<std::uint64_t>(); n > 0; --n)
        {
          const std::string line(scanner.line());
          Numbers           numbers(line);
          const auto        dimension = numbers.next<unsigned>();
          const int         group = numbers.next<int>();
          const std::size_t first = line.find('"'), last = line.rfind('"');
          require(first != std::string::npos && last > first);
          group_names[{dimension, group}] = line.substr(first + 1, last - first - 1);
        }
      }

      void read_entities(Scanner &scanner)
      {
        std::array<std::uint64_t, 4> n{};
        if (binary)
          for (auto &number : n)
            number = scanner.binary<std::uint64_t>();
        else
        {
          const std::string line(scanner.line());
          Numbers           numbers(line);
          for (auto &number : n)
            number = numbers.next<std::uint64_t>();
        }
        for (unsigned d = 0; d < n.size(); ++d)
        {
          for (std::uint64_t k = 0; k < n[d]; ++k)
            binary ? read_binary_entity(scanner, d) : read_text_entity(scanner, d);
          if (n[d] > 0)
            dim = d;
        }
        if (binary)
          require(scanner.line().empty());
      }

      void read_text_entity(Scanner &scanner, const unsigned d)
      {
        const std::string line(scanner.line());
        Numbers           numbers(line);
        const int         entity = numbers.next<int>();
        for (unsigned k = 0; k < (d == 0 ? 3u : 6u); ++k)
          numbers.next<double>();
        for (auto n = numbers.next<std::uint64_t>(); n > 0; --n)
          add_group(d, entity, numbers.next<int>());
      }

      void read_binary_entity(Scanner &scanner, const unsigned d)
      {
        const int entity = scanner.binary<int>();
        for (unsigned k = 0; k < (d == 0 ? 3u : 6u); ++k)
          scanner.binary<double>();
        for (auto n = scanner.binary<std::uint64_t>(); n > 0; --n)
          add_group(d, entity, scanner.binary<int>());
        if (d > 0)
          for (auto n = scanner.binary<std::uint64_t>(); n > 0; --n)
            scanner.binary<int>();
      }

      void add_group(const unsigned d, const int entity, const int group)
      {
        require(group > 0); // Gmsh turns entities of negative ones around
        groups.insert({d, group});
        group_of.try_emplace({d, entity}, group);
      }

      using DimAndTag = std::pair<unsigned, int>;
      std::map<DimAndTag, std::string> group_names;
      std::map<DimAndTag, int>         group_of; ///< of an entity the first one
      std::set<DimAndTag>              groups;   ///< those of entities
    };

    class IndexBuilder
    {
    public:
      IndexBuilder(const std::string &file, const std::uint64_t most_in_piece) : scanner(file), head(scanner), most_in_piece(most_in_piece)
      {
      }

      MshIndex build()
      {
        index.binary = head.binary;
        index.kind = head.dim == 2 ? CellKind::triangle : CellKind::tetrahedron;
        index.part_names = head.names(head.dim - 1);
        read_nodes();
        end_of("Nodes");
        require(scanner.line() == "$Elements");
        read_elements();
        end_of("Elements");
        require(index.n_cells > 0 && index.n_nodes > 0);
        name_blocks();
        number_by_entities(index.cells, entities_of_cells);
        number_by_entities(index.faces, entities_of_faces);
        return std::move(index);
      }

    private:
      void end_of(const std::string &section)
      {
        if (head.binary)
          require(scanner.line().empty());
        require(scanner.line() == "$End" + section);
      }

      /// Blocks, records, smallest and largest tag.
      std::array<std::uint64_t, 4> section_head()
      {
        std::array<std::uint64_t, 4> result{};
        if (head.binary)
          for (auto &number : result)
            number = scanner.binary<std::uint64_t>();
        else
        {
          Numbers numbers(scanner.line());
          for (auto &number : result)
            number = numbers.next<std::uint64_t>();
        }
        return result;
      }

      struct BlockHead
      {
        unsigned      dim = 0;
        int           entity = 0, type = 0; ///< nodes: whether they have parameters
        std::uint64_t n = 0;
      };

      BlockHead block_head()
      {
        BlockHead result;
        if (head.binary)
        {
          result.dim = scanner.binary<int>();
          result.entity = scanner.binary<int>();
          result.type = scanner.binary<int>();
          result.n = scanner.binary<std::uint64_t>();
        }
        else
        {
          Numbers numbers(scanner.line());
          result.dim = numbers.next<unsigned>();
          result.entity = numbers.next<int>();
          result.type = numbers.next<int>();
          result.n = numbers.next<std::uint64_t>();
        }
        require(result.dim <= 3 && result.n <= std::numeric_limits<std::uint32_t>::max());
        return result;
      }

      /// The next records of a block, @p bytes each in a binary file: which bytes they take.
      std::pair<std::uint64_t, std::uint64_t> skip_records(const std::uint64_t n, const std::uint64_t bytes)
      {
        const std::uint64_t begin = scanner.place();
        head.binary ? scanner.skip_bytes(n * bytes) : scanner.skip_lines(n);
        return {begin, scanner.place()};
      }

      void read_nodes()
      {
        const auto [n_blocks, n_nodes, smallest, largest] = section_head();
        for (std::uint64_t b = 0; b < n_blocks; ++b)
        {
          const BlockHead block = block_head();
          require(block.type == 0 || block.type == 1);
          const unsigned numbers = 3 + (block.type == 1 ? block.dim : 0);
          const auto     first_piece = index.nodes.size();
          for (std::uint64_t done = 0; done < block.n; done += most_in_piece)
          {
            auto &piece = index.nodes.emplace_back();
            piece.block = index.node_blocks.size();
            piece.first = index.n_nodes + done;
            piece.n = std::min(most_in_piece, block.n - done);
            std::tie(piece.tags_at, piece.tags_end) = skip_records(piece.n, sizeof(std::uint64_t));
          }
          for (auto k = first_piece; k < index.nodes.size(); ++k)
            std::tie(index.nodes[k].begin, index.nodes[k].end) = skip_records(index.nodes[k].n, numbers * sizeof(double));
          index.n_nodes += block.n;
          index.node_blocks.push_back({0, numbers});
        }
        require(index.n_nodes == n_nodes);
      }

      void read_elements()
      {
        const auto    n_blocks = section_head()[0];
        std::uint64_t order = 0;
        for (std::uint64_t b = 0; b < n_blocks; ++b)
        {
          const BlockHead block = block_head();
          const auto      kind = kind_of_element(block.type);
          require(kind && kind->dim == block.dim && block.dim <= head.dim);
          const bool cells = block.dim == head.dim, faces = block.dim + 1 == head.dim;
          if (cells || faces)
          {
            require(order == 0 || order == kind->order);
            order = kind->order;
          }
          const bool        named = !head.name_of(block.dim, block.entity).empty();
          const std::size_t bytes = (1 + kind->n_nodes) * sizeof(std::uint64_t);
          if (!cells && !(faces && named))
          {
            skip_records(block.n, bytes);
            continue;
          }
          auto &blocks = cells ? index.cell_blocks : index.face_blocks;
          for (std::uint64_t done = 0; done < block.n; done += most_in_piece)
          {
            auto &piece = (cells ? index.cells : index.faces).emplace_back();
            piece.block = blocks.size();
            piece.n = std::min(most_in_piece, block.n - done);
            std::tie(piece.begin, piece.end) = skip_records(piece.n, bytes);
          }
          (cells ? index.n_cells : index.n_faces) += block.n;
          blocks.push_back({0, kind->n_nodes});
          (cells ? entities_of_cells : entities_of_faces).push_back(block.entity);
        }
        index.order = order;
      }

      /// Regions in the order of their entities' numbers.
      void name_blocks()
      {
        auto in_order = entities_of_cells;
        std::sort(in_order.begin(), in_order.end());
        const auto region = [&](const int entity)
        {
          const std::string name = head.name_of(head.dim, entity);
          return number_in(name.empty() ? "domain" : name, index.region_names);
        };
        for (const int entity : in_order)
          region(entity);
        for (std::size_t b = 0; b < index.cell_blocks.size(); ++b)
          index.cell_blocks[b].name = region(entities_of_cells[b]);
        for (std::size_t b = 0; b < index.face_blocks.size(); ++b)
          index.face_blocks[b].name = number_in(head.name_of(head.dim - 1, entities_of_faces[b]), index.part_names);
      }

      /// As Gmsh goes through a file: entity by entity, in the order of their numbers.
      static void number_by_entities(std::vector<MshPiece> &pieces, const std::vector<int> &entities)
      {
        std::stable_sort(pieces.begin(), pieces.end(),
                         [&](const MshPiece &a, const MshPiece &b) { return entities[a.block] < entities[b.block]; });
        std::uint64_t n = 0;
        for (MshPiece &piece : pieces)
        {
          piece.first = n;
          n += piece.n;
        }
      }

      Scanner             scanner;
      const MshHead       head;
      const std::uint64_t most_in_piece;
      MshIndex            index;
      std::vector<int>    entities_of_cells, entities_of_faces; ///< by block
    };

    /// @p n numbers of a binary file.
    template <typename T>
    T number_at(const std::vector<char> &bytes, const std::size_t k)
    {
      T value;
      std::memcpy(&value, bytes.data() + k * sizeof(T), sizeof(T));
      return value;
    }
  } // namespace

  unsigned MshIndex::nodes_of_cell() const
  {
    return kind == CellKind::triangle ? (order == 1 ? 3 : 6) : (order == 1 ? 4 : 10);
  }

  unsigned MshIndex::nodes_of_face() const
  {
    return kind == CellKind::triangle ? 1 + order : (order == 1 ? 3 : 6);
  }

  std::optional<MeshOutline> outline_of_msh(const std::string &file)
  {
    try
    {
      Scanner       scanner(file);
      const MshHead head(scanner);
      MeshOutline   outline{head.dim, head.names(head.dim - 1), head.names(head.dim)};
      number_in("boundary", outline.part_names);
      number_in("domain", outline.region_names);
      return outline;
    }
    catch (const NotRead &)
    {
      return std::nullopt;
    }
  }

  std::optional<MshIndex> index_of_msh(const std::string &file, const std::uint64_t most_in_piece)
  {
    try
    {
      return IndexBuilder(file, most_in_piece).build();
    }
    catch (const NotRead &)
    {
      return std::nullopt;
    }
  }

  MshPieces::MshPieces(const std::string &file) : descriptor(::open(file.c_str(), O_RDONLY | O_CLOEXEC)) {}

  MshPieces::~MshPieces()
  {
    if (descriptor >= 0)
      ::close(descriptor);
  }

  bool MshPieces::read_bytes(const std::uint64_t begin, const std::uint64_t end, std::vector<char> &bytes) const
  {
    bytes.resize(end - begin);
    for (std::size_t done = 0; done < bytes.size();)
    {
      const ssize_t n = pread(descriptor, bytes.data() + done, bytes.size() - done, off_t(begin + done));
      if (n <= 0)
        return false;
      done += n;
    }
    return true;
  }

  bool MshPieces::read_nodes(const MshIndex &index, const MshPiece &piece, MshNodes &nodes) const
  {
    const unsigned    numbers_of_node = index.node_blocks[piece.block].numbers_of_record;
    std::vector<char> bytes;
    try
    {
      require(read_bytes(piece.tags_at, piece.tags_end, bytes));
      Numbers tags({bytes.data(), bytes.size()});
      for (std::uint64_t k = 0; k < piece.n; ++k)
        nodes.tags.push_back(index.binary ? number_at<std::uint64_t>(bytes, k) : tags.next<std::uint64_t>());
      require(index.binary || tags.at_end());
      require(read_bytes(piece.begin, piece.end, bytes));
      Numbers coordinates({bytes.data(), bytes.size()});
      for (std::uint64_t k = 0; k < piece.n; ++k)
      {
        auto &x = nodes.x.emplace_back();
        for (unsigned d = 0; d < numbers_of_node; ++d)
        {
          const double value = index.binary ? number_at<double>(bytes, k * numbers_of_node + d) : coordinates.next<double>();
          require(std::isfinite(value));
          if (d < x.size())
            x[d] = value;
        }
      }
      require(index.binary || coordinates.at_end());
    }
    catch (const NotRead &)
    {
      return false;
    }
    return true;
  }

  bool MshPieces::read_elements(const MshIndex             &index,
                                const MshPiece             &piece,
                                const MshIndex::Block      &block,
                                std::vector<std::uint64_t> &nodes) const
  {
    const unsigned    n_nodes = block.numbers_of_record;
    std::vector<char> bytes;
    try
    {
      require(read_bytes(piece.begin, piece.end, bytes));
      Numbers numbers({bytes.data(), bytes.size()});
      for (std::uint64_t k = 0; k < piece.n; ++k)
        for (unsigned i = 0; i <= n_nodes; ++i)
        {
          const auto number = index.binary ? number_at<std::uint64_t>(bytes, k * (n_nodes + 1) + i) : numbers.next<std::uint64_t>();
          if (i > 0) // the element's own tag
            nodes.push_back(number);
        }
      require(index.binary || numbers.at_end());
    }
    catch (const NotRead &)
    {
      return false;
    }
    return true;
  }
} // namespace unilateral
