#include "unilateral/mesh/msh_pieces.h"

#include "unilateral/mesh/msh_scanner.h"

#include <cmath>
#include <cstring>

namespace unilateral
{
  namespace
  {
    using msh::NotRead;
    using msh::Numbers;
    using msh::require;

    /// Numbers of a binary file, or of a text, one after the other.
    class NumbersOfPiece
    {
    public:
      NumbersOfPiece(const std::vector<char> &bytes, const MshIndex &index) : bytes(bytes), index(index), text({bytes.data(), bytes.size()})
      {
      }

      std::uint64_t integer()
      {
        if (!index.binary)
          return text.next<std::uint64_t>();
        if (index.bytes_of_integer == sizeof(std::uint64_t))
          return binary<std::uint64_t>();
        const auto value = binary<std::int32_t>();
        require(value >= 0);
        return value;
      }

      double coordinate()
      {
        const double value = index.binary ? binary<double>() : text.next<double>();
        require(std::isfinite(value));
        return value;
      }

      bool at_end() { return index.binary ? place == bytes.size() : text.at_end(); }

    private:
      template <typename T>
      T binary()
      {
        T value;
        require(bytes.size() - place >= sizeof(T));
        std::memcpy(&value, bytes.data() + place, sizeof(T));
        place += sizeof(T);
        return value;
      }

      const std::vector<char> &bytes;
      const MshIndex          &index;
      Numbers                  text;
      std::size_t              place = 0;
    };
  } // namespace

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
    const auto       &block = index.node_blocks[piece.block];
    std::vector<char> bytes;
    try
    {
      const bool tags_with_coordinates = block.numbers_before > 0;
      if (!tags_with_coordinates)
      {
        require(read_bytes(piece.tags_at, piece.tags_end, bytes));
        NumbersOfPiece tags(bytes, index);
        for (std::uint64_t k = 0; k < piece.n; ++k)
          nodes.tags.push_back(tags.integer());
        require(tags.at_end());
      }
      require(read_bytes(piece.begin, piece.end, bytes));
      NumbersOfPiece numbers(bytes, index);
      for (std::uint64_t k = 0; k < piece.n; ++k)
      {
        if (tags_with_coordinates)
          nodes.tags.push_back(numbers.integer());
        auto &x = nodes.x.emplace_back();
        for (unsigned d = 0; d < block.numbers_of_record; ++d)
        {
          const double value = numbers.coordinate();
          if (d < x.size())
            x[d] = value;
        }
      }
      require(numbers.at_end());
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
    std::vector<char> bytes;
    try
    {
      require(read_bytes(piece.begin, piece.end, bytes));
      NumbersOfPiece numbers(bytes, index);
      for (std::uint64_t k = 0; k < piece.n; ++k)
      {
        for (unsigned i = 0; i < block.numbers_before; ++i)
          numbers.integer();
        for (unsigned i = 0; i < block.numbers_of_record; ++i)
          nodes.push_back(numbers.integer());
      }
      require(numbers.at_end());
    }
    catch (const NotRead &)
    {
      return false;
    }
    return true;
  }
} // namespace unilateral
