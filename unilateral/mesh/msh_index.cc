#include "unilateral/mesh/msh_index.h"

#include "unilateral/base/number_of_name.h"
#include "unilateral/mesh/gmsh_order.h"
#include "unilateral/mesh/msh_scanner.h"

#include <algorithm>
#include <limits>
#include <map>
#include <set>
#include <tuple>
#include <utility>

namespace unilateral
{
  namespace
  {
    using msh::NotRead;
    using msh::Numbers;
    using msh::require;
    using msh::Scanner;

    /// Of Gmsh's element types those that are read here, and points.
    struct KindOfElement
    {
      unsigned                dim, order, n_nodes;
      std::optional<CellKind> cell = {};
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
        return KindOfElement{2, 1, 3, CellKind::triangle};
      case 9:
        return KindOfElement{2, 2, 6, CellKind::triangle};
      case 3:
        return KindOfElement{2, 1, 4, CellKind::quadrilateral};
      case 10:
        return KindOfElement{2, 2, 9, CellKind::quadrilateral};
      case 4:
        return KindOfElement{3, 1, 4, CellKind::tetrahedron};
      case 11:
        return KindOfElement{3, 2, 10, CellKind::tetrahedron};
      case 5:
        return KindOfElement{3, 1, 8, CellKind::hexahedron};
      case 12:
        return KindOfElement{3, 2, 27, CellKind::hexahedron};
      default:
        return std::nullopt;
      }
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
            number_of_name(name_of_group(dim, group), result);
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
        index.part_names = head.names(head.dim - 1);
        read_nodes();
        end_of("Nodes");
        require(scanner.line() == "$Elements");
        read_elements();
        end_of("Elements");
        require(kind_of_cells && index.n_cells > 0 && index.n_nodes > 0);
        index.kind = *kind_of_cells;
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
            if (kind->cell)
              require_one_kind(*kind->cell, cells);
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

      /// Cells alike, and in space faces of such cells.
      void require_one_kind(const CellKind kind, const bool is_cell)
      {
        auto &before = is_cell ? kind_of_cells : kind_of_faces;
        require(before.value_or(kind) == kind);
        before = kind;
        require(!kind_of_cells || !kind_of_faces || is_simplex(*kind_of_cells) == is_simplex(*kind_of_faces));
      }

      /// Regions in the order of their entities' numbers.
      void name_blocks()
      {
        auto in_order = entities_of_cells;
        std::sort(in_order.begin(), in_order.end());
        const auto region = [&](const int entity)
        {
          const std::string name = head.name_of(head.dim, entity);
          return number_of_name(name.empty() ? "domain" : name, index.region_names);
        };
        for (const int entity : in_order)
          region(entity);
        for (std::size_t b = 0; b < index.cell_blocks.size(); ++b)
          index.cell_blocks[b].name = region(entities_of_cells[b]);
        for (std::size_t b = 0; b < index.face_blocks.size(); ++b)
          index.face_blocks[b].name = number_of_name(head.name_of(head.dim - 1, entities_of_faces[b]), index.part_names);
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

      Scanner                 scanner;
      const MshHead           head;
      const std::uint64_t     most_in_piece;
      MshIndex                index;
      std::vector<int>        entities_of_cells, entities_of_faces; ///< by block
      std::optional<CellKind> kind_of_cells, kind_of_faces;
    };
  } // namespace

  unsigned MshIndex::corners_of_cell() const
  {
    return is_simplex(kind) ? dimension(kind) + 1 : 1u << dimension(kind);
  }

  unsigned MshIndex::corners_of_face() const
  {
    return is_simplex(kind) ? dimension(kind) : 1u << (dimension(kind) - 1);
  }

  unsigned MshIndex::nodes_of_cell() const
  {
    return corners_of_cell() + (order == 1 ? 0 : corners_around_middle_nodes(kind).size());
  }

  std::optional<MeshOutline> outline_of_msh(const std::string &file)
  {
    try
    {
      Scanner       scanner(file);
      const MshHead head(scanner);
      MeshOutline   outline{head.dim, head.names(head.dim - 1), head.names(head.dim)};
      number_of_name("boundary", outline.part_names);
      number_of_name("domain", outline.region_names);
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
} // namespace unilateral
