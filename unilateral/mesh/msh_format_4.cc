// Format 4.1: nodes and elements in blocks, one for each entity; the groups of the entities stand before them.
#include "unilateral/mesh/msh_elements.h"
#include "unilateral/mesh/msh_format.h"

#include <algorithm>
#include <array>
#include <limits>
#include <string>
#include <tuple>
#include <utility>

namespace unilateral::msh
{
  namespace
  {
    /// What stands before the nodes.
    class Head
    {
    public:
      /// Up to the line "$Nodes", which is read, too.
      Head(Scanner &scanner, const Format &format) : binary(format.binary)
      {
        bool has_entities = false;
        for (;;)
        {
          const std::string section(scanner.line());
          if (section == "$Nodes")
            break;
          if (section == "$PhysicalNames")
            groups.read_names(scanner);
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

      const bool binary;
      unsigned   dim = 0;
      Groups     groups;

    private:
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
          groups.add(d, entity, numbers.next<int>());
      }

      void read_binary_entity(Scanner &scanner, const unsigned d)
      {
        const int entity = scanner.binary<int>();
        for (unsigned k = 0; k < (d == 0 ? 3u : 6u); ++k)
          scanner.binary<double>();
        for (auto n = scanner.binary<std::uint64_t>(); n > 0; --n)
          groups.add(d, entity, scanner.binary<int>());
        if (d > 0)
          for (auto n = scanner.binary<std::uint64_t>(); n > 0; --n)
            scanner.binary<int>();
      }
    };

    class IndexOfFormat4
    {
    public:
      IndexOfFormat4(Scanner &scanner, const Format &format, const std::uint64_t most_in_piece)
        : scanner(scanner), head(scanner, format), most_in_piece(most_in_piece)
      {
      }

      MshIndex build()
      {
        index.binary = head.binary;
        index.part_names = head.groups.names(head.dim - 1);
        read_nodes();
        end_of("Nodes");
        require(scanner.line() == "$Elements");
        read_elements();
        end_of("Elements");
        elements.put_into(index, head.groups, head.dim);
        require(index.n_cells > 0 && index.n_nodes > 0);
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
          index.node_blocks.push_back({0, numbers, 0});
        }
        require(index.n_nodes == n_nodes);
      }

      void read_elements()
      {
        const auto n_blocks = section_head()[0];
        for (std::uint64_t b = 0; b < n_blocks; ++b)
        {
          const BlockHead block = block_head();
          const auto      kind = kind_of_element(block.type);
          require(kind.dim == block.dim);
          const unsigned    number = elements.add_block(kind, block.entity, /*numbers_before_nodes=*/1);
          const std::size_t bytes = (1 + kind.n_nodes) * sizeof(std::uint64_t);
          for (std::uint64_t done = 0; done < block.n; done += most_in_piece)
          {
            const std::uint64_t n = std::min(most_in_piece, block.n - done);
            const auto [begin, end] = skip_records(n, bytes);
            elements.add_piece(number, n, begin, end);
          }
        }
      }

      Scanner            &scanner;
      const Head          head;
      const std::uint64_t most_in_piece;
      Elements            elements;
      MshIndex            index;
    };
  } // namespace

  MeshOutline outline_of_format_4(Scanner &scanner, const Format &format)
  {
    require(format.version == 4.1);
    const Head head(scanner, format);
    return {head.dim, head.groups.names(head.dim - 1), head.groups.names(head.dim)};
  }

  MshIndex index_of_format_4(Scanner &scanner, const Format &format, const std::uint64_t most_in_piece)
  {
    require(format.version == 4.1);
    return IndexOfFormat4(scanner, format, most_in_piece).build();
  }
} // namespace unilateral::msh
