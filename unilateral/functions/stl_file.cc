#include "unilateral/functions/stl_file.h"

#include <fmt/format.h>

#include <bit>
#include <charconv>
#include <cmath>
#include <cstdint>
#include <filesystem>
#include <fstream>
#include <stdexcept>
#include <string_view>

namespace unilateral
{
  namespace
  {
    constexpr std::uintmax_t max_stl_bytes = 256u << 20;

    // A binary file: 80 bytes of anything, the number of triangles, and for each the normal, three vertices and two bytes of attributes.
    constexpr std::size_t header_bytes = 84, triangle_bytes = 50;

    bool is_blank(const char c)
    {
      return c == ' ' || c == '\t' || c == '\n' || c == '\r' || c == '\v' || c == '\f';
    }

    std::string lower_case(std::string_view word)
    {
      std::string result(word);
      for (char &c : result)
        if (c >= 'A' && c <= 'Z')
          c = static_cast<char>(c - 'A' + 'a');
      return result;
    }

    /// @p word fit for a message: of a damaged file it can be long and unprintable.
    std::string shown(const std::string_view word)
    {
      std::string result(word.substr(0, 24));
      for (char &c : result)
        if (c < 0x20 || c > 0x7e)
          c = '?';
      return "'" + result + (word.size() > 24 ? "...'" : "'");
    }

    /// The words of a text STL file, in any spacing and case.
    class StlText
    {
    public:
      StlText(const std::string_view text, const std::string &name) : text(text), name(name) {}

      std::vector<StlTriangle> triangles()
      {
        std::vector<StlTriangle> result;
        for (word = next(); !word.empty(); word = next())
        {
          require("solid");
          skip_line(); // its name
          for (word = next(); lower_case(word) == "facet"; word = next())
            result.push_back(facet());
          require("endsolid", "'facet' or 'endsolid'");
          skip_line();
        }
        return result;
      }

    private:
      StlTriangle facet()
      {
        require_next("normal");
        for (unsigned i = 0; i < 3; ++i)
          next();
        require_next("outer");
        require_next("loop");
        StlTriangle triangle;
        for (auto &vertex : triangle)
        {
          require_next("vertex", "'vertex', of which a facet has three,");
          for (double &coordinate : vertex)
            coordinate = number();
        }
        require_next("endloop", "'endloop' after three vertices");
        require_next("endfacet");
        return triangle;
      }

      double number()
      {
        word = next();
        std::string_view digits = word;
        if (!digits.empty() && digits.front() == '+')
          digits.remove_prefix(1);
        double value = 0;
        const auto [end, failure] = std::from_chars(digits.data(), digits.data() + digits.size(), value);
        // Numbers below the least one are zero.
        const bool small = failure == std::errc::result_out_of_range && lower_case(digits).find("e-") != std::string::npos;
        if (word.empty() || end != digits.data() + digits.size() || (failure != std::errc() && !small) || !std::isfinite(value))
          complain("a coordinate, a finite number,");
        return small ? 0 : value;
      }

      /// The next word; empty at the end of the text.
      std::string_view next()
      {
        while (at < text.size() && is_blank(text[at]))
          step();
        const std::size_t begin = at;
        while (at < text.size() && !is_blank(text[at]))
          ++at;
        word_line = line;
        return text.substr(begin, at - begin);
      }

      void skip_line()
      {
        while (at < text.size() && text[at] != '\n' && text[at] != '\r')
          ++at;
      }

      void step()
      {
        if (text[at] == '\n' || (text[at] == '\r' && (at + 1 == text.size() || text[at + 1] != '\n')))
          ++line;
        ++at;
      }

      void require_next(const std::string &keyword, const std::string &expected = "")
      {
        word = next();
        require(keyword, expected);
      }

      void require(const std::string &keyword, const std::string &expected = "") const
      {
        if (lower_case(word) != keyword)
          complain(expected.empty() ? "'" + keyword + "'" : expected);
      }

      [[noreturn]] void complain(const std::string &expected) const
      {
        if (word.empty())
          throw std::runtime_error(
            fmt::format("STL file '{}' is cut short: it ends at line {} where {} is expected; write it again", name, word_line, expected));
        throw std::runtime_error(fmt::format("STL file '{}' line {}: {} expected, found {}", name, word_line, expected, shown(word)));
      }

      const std::string_view text;
      const std::string     &name;
      std::size_t            at = 0;
      unsigned               line = 1, word_line = 1;
      std::string_view       word;
    };

    std::uint32_t whole_number(const char *bytes)
    {
      std::uint32_t value = 0;
      for (unsigned i = 0; i < 4; ++i)
        value |= static_cast<std::uint32_t>(static_cast<unsigned char>(bytes[i])) << (8 * i);
      return value;
    }

    std::vector<StlTriangle> binary_triangles(const std::string &bytes, const std::string &name)
    {
      std::vector<StlTriangle> triangles((bytes.size() - header_bytes) / triangle_bytes);
      for (std::size_t i = 0; i < triangles.size(); ++i)
      {
        const char *place = bytes.data() + header_bytes + i * triangle_bytes + 12;
        for (auto &vertex : triangles[i])
          for (double &coordinate : vertex)
          {
            coordinate = std::bit_cast<float>(whole_number(place));
            if (!std::isfinite(coordinate))
              throw std::runtime_error(
                fmt::format("STL file '{}': triangle {} of {} has a vertex that is not finite", name, i + 1, triangles.size()));
            place += 4;
          }
      }
      return triangles;
    }

    std::string read_bytes(const std::string &file, const std::string &name)
    {
      std::error_code failure;
      const auto      status = std::filesystem::status(file, failure);
      if (!std::filesystem::exists(status))
        throw std::runtime_error(fmt::format("STL file '{}' does not exist", file));
      if (!std::filesystem::is_regular_file(status))
        throw std::runtime_error(fmt::format("STL file '{}' is not a file", file));
      const std::uintmax_t size = std::filesystem::file_size(file, failure);
      if (failure || size > max_stl_bytes)
        throw std::runtime_error(
          fmt::format("STL file '{}' is larger than {} MB; write it with fewer triangles, or as binary STL", name, max_stl_bytes >> 20));
      std::ifstream in(file, std::ios::binary);
      if (!in)
        throw std::runtime_error(fmt::format("STL file '{}' cannot be opened", file));
      std::string bytes(size, '\0');
      in.read(bytes.data(), static_cast<std::streamsize>(size));
      bytes.resize(static_cast<std::size_t>(in.gcount()));
      return bytes;
    }
  } // namespace

  std::vector<StlTriangle> read_stl(const std::string &file)
  {
    const std::string name = std::filesystem::path(file).filename().string();
    const std::string bytes = read_bytes(file, name);
    if (bytes.empty())
      throw std::runtime_error(fmt::format("STL file '{}' is empty", name));

    const std::uint64_t announced = bytes.size() < header_bytes ? 0 : whole_number(bytes.data() + 80);
    const bool          binary = bytes.size() >= header_bytes && bytes.size() == header_bytes + announced * triangle_bytes;

    // The header of a binary file may begin with "solid", too, but a text has no zero bytes.
    std::string_view text = bytes;
    if (text.starts_with("\xef\xbb\xbf"))
      text.remove_prefix(3);
    std::size_t begin = 0;
    while (begin < text.size() && is_blank(text[begin]))
      ++begin;
    const bool is_text = lower_case(text.substr(begin, 5)) == "solid" && text.substr(0, 1000).find('\0') == std::string_view::npos;

    if (!binary && !is_text)
    {
      if (bytes.size() < header_bytes)
        throw std::runtime_error(
          fmt::format("STL file '{}' is damaged or not STL: text begins with 'solid', and binary STL has {} bytes at "
                      "least, this {}",
                      name, header_bytes, bytes.size()));
      throw std::runtime_error(fmt::format("STL file '{}' is damaged or not STL: text begins with 'solid', and binary STL of the {} "
                                           "triangles that it announces has {} bytes, this {}",
                                           name, announced, header_bytes + announced * triangle_bytes, bytes.size()));
    }
    auto triangles = binary ? binary_triangles(bytes, name) : StlText(text, name).triangles();
    if (triangles.empty())
      throw std::runtime_error(fmt::format("STL file '{}' has no triangles", name));
    return triangles;
  }
} // namespace unilateral
