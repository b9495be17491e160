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

    /// The k-th number of a binary file's bytes.
    template <typename T>
    T number_at(const std::vector<char> &bytes, const std::size_t k)
    {
      T value;
      std::memcpy(&value, bytes.data() + k * sizeof(T), sizeof(T));
      return value;
    }
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
