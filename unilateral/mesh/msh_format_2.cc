// Format 2.2: a list of nodes and one of elements, each of which says its kind, group and entity.
#include "unilateral/mesh/msh_elements.h"
#include "unilateral/mesh/msh_format.h"

#include <algorithm>
#include <map>
#include <string>
#include <tuple>
#include <utility>

namespace unilateral::msh
{
  namespace
  {
    class IndexOfFormat2
    {
    public:
      IndexOfFormat2(Scanner &scanner, const Format &format, const std::uint64_t most_in_piece)
        : scanner(scanner), most_in_piece(most_in_piece)
      {
        index.binary = format.binary;
        index.bytes_of_integer = sizeof(std::int32_t);
      }

      void read()
      {
        std::string section(scanner.line());
        if (section == "$PhysicalNames")
        {
          groups.read_names(scanner);
          require(scanner.line() == "$EndPhysicalNames");
          section = scanner.line();
        }
        require(section == "$Nodes");
        read_nodes();
        end_of("Nodes");
        require(scanner.line() == "$Elements");
        read_elements();
        end_of("Elements");
        dim = elements.dimension();
        require((dim == 2 || dim == 3) && index.n_nodes > 0);
      }

      MeshOutline outline() const { return {dim, groups.names(dim - 1), groups.names(dim)}; }

      MshIndex finish()
      {
        index.part_names = groups.names(dim - 1);
        elements.put_into(index, groups, dim);
        return std::move(index);
      }

    private:
      void end_of(const std::string &section)
      {
        if (index.binary)
          require(scanner.line().empty());
        require(scanner.line() == "$End" + section);
      }

      std::uint64_t section_head()
      {
        const std::string line(scanner.line());
        return Numbers(line).next<std::uint64_t>();
      }

      void read_nodes()
      {
        index.n_nodes = section_head();
        index.node_blocks.push_back({0, 3, 1});
        for (std::uint64_t done = 0; done < index.n_nodes; done += most_in_piece)
        {
          auto &piece = index.nodes.emplace_back();
          piece.first = done;
          piece.n = std::min(most_in_piece, index.n_nodes - done);
          piece.begin = scanner.place();
          index.binary ? scanner.skip_bytes(piece.n * (sizeof(std::int32_t) + 3 * sizeof(double))) : scanner.skip_lines(piece.n);
          piece.end = scanner.place();
        }
      }

      /// An element's record. Elements of binary files come in groups, of which kind and number of tags are told once.
      struct Element
      {
        int           type = 0, n_tags = 0, group = 0, entity = 0;
        std::uint64_t begin = 0, end = 0; ///< of its bytes
      };

      Element next_element()
      {
        Element element;
        if (index.binary)
        {
          if (left_of_group == 0)
          {
            type_of_group = scanner.binary<std::int32_t>();
            left_of_group = scanner.binary<std::int32_t>();
            tags_of_group = scanner.binary<std::int32_t>();
            require(left_of_group > 0);
          }
          --left_of_group;
          element = {.type = type_of_group, .n_tags = tags_of_group, .begin = scanner.place()};
          require(element.n_tags == 2);   // more where Gmsh has divided the mesh
          scanner.binary<std::int32_t>(); // the element's number
          element.group = scanner.binary<std::int32_t>();
          element.entity = scanner.binary<std::int32_t>();
          scanner.skip_bytes(kind_of_element(element.type).n_nodes * sizeof(std::int32_t));
        }
        else
        {
          element.begin = scanner.place();
          Numbers numbers(scanner.line());
          numbers.next<std::uint64_t>();
          element.type = numbers.next<int>();
          element.n_tags = numbers.next<int>();
          require(element.n_tags == 2);
          element.group = numbers.next<int>();
          element.entity = numbers.next<int>();
        }
        element.end = scanner.place();
        return element;
      }

      /// Runs of elements of one kind and entity are pieces.
      void read_elements()
      {
        const std::uint64_t                     n = section_head();
        std::map<std::pair<int, int>, int>      group_of; ///< by kind and entity; 0: none
        std::map<std::pair<int, int>, unsigned> block_of;
        Element                                 first, last; ///< of the run
        std::uint64_t                           n_of_run = 0;
        const auto                              end_run = [&]
        {
          if (n_of_run > 0)
            elements.add_piece(block_of.at({first.type, first.entity}), n_of_run, first.begin, last.end);
          n_of_run = 0;
          require(elements.n_pieces() < 10000 + n / 50); // else the index would be no smaller than the mesh
        };
        for (std::uint64_t k = 0; k < n; ++k)
        {
          const Element element = next_element();
          if (n_of_run == 0 || n_of_run == most_in_piece || element.type != first.type || element.entity != first.entity ||
              element.begin != last.end)
          {
            end_run();
            first = element;
            const std::pair<int, int> key(element.type, element.entity);
            if (block_of.count(key) == 0)
            {
              // A record begins with the element's number, in text with kind and number of tags, and the tags.
              const auto kind = kind_of_element(element.type);
              block_of[key] = elements.add_block(kind, element.entity, index.binary ? 3 : 5);
              group_of[key] = element.group;
              if (element.group != 0)
                groups.add(kind.dim, element.entity, element.group);
            }
          }
          require(group_of.at({element.type, element.entity}) == element.group); // else the entity is in several
          last = element;
          ++n_of_run;
        }
        end_run();
      }

      Scanner            &scanner;
      const std::uint64_t most_in_piece;
      unsigned            dim = 0;
      std::int32_t        type_of_group = 0, left_of_group = 0, tags_of_group = 0;
      Groups              groups;
      Elements            elements;
      MshIndex            index;
    };
  } // namespace

  MeshOutline outline_of_format_2(Scanner &scanner, const Format &format)
  {
    IndexOfFormat2 builder(scanner, format, 20000);
    builder.read();
    return builder.outline();
  }

  MshIndex index_of_format_2(Scanner &scanner, const Format &format, const std::uint64_t most_in_piece)
  {
    IndexOfFormat2 builder(scanner, format, most_in_piece);
    builder.read();
    return builder.finish();
  }
} // namespace unilateral::msh
