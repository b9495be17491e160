#include "unilateral/functions/matrix_file.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <filesystem>
#include <fstream>
#include <limits>
#include <stdexcept>
#include <string_view>

namespace unilateral
{
  namespace
  {
    constexpr std::string_view blanks = " \t\r";

    std::string_view trimmed(std::string_view text)
    {
      const auto first = text.find_first_not_of(blanks);
      if (first == std::string_view::npos)
        return {};
      return text.substr(first, text.find_last_not_of(blanks) - first + 1);
    }

    /// Comma, semicolon and tab separate entries that may be empty; without them blanks do.
    std::vector<std::string_view> entries_of(const std::string_view line)
    {
      const auto                    at = line.find_first_of(",;\t");
      std::vector<std::string_view> entries;
      if (at == std::string_view::npos)
        for (std::size_t begin = 0; begin < line.size();)
        {
          const std::size_t end = std::min(line.find_first_of(blanks, begin), line.size());
          entries.push_back(line.substr(begin, end - begin));
          begin = std::min(line.find_first_not_of(blanks, end), line.size());
        }
      else
        for (std::size_t begin = 0; begin <= line.size();)
        {
          const std::size_t end = std::min(line.find(line[at], begin), line.size());
          entries.push_back(trimmed(line.substr(begin, end - begin)));
          begin = end + 1;
        }
      return entries;
    }
  } // namespace

  NumberMatrix read_matrix(const std::string &file, const std::size_t max_numbers)
  {
    const std::string name = std::filesystem::path(file).filename().string();
    std::ifstream     in(file);
    if (!in)
      throw std::runtime_error(fmt::format("'{}' cannot be opened", file));
    NumberMatrix matrix;
    std::string  line;
    for (std::size_t number = 1; std::getline(in, line); ++number)
    {
      const std::string_view content = trimmed(line);
      if (content.empty() || content.front() == '#')
        continue;
      const auto entries = entries_of(content);
      if (matrix.n_rows > 0 && entries.size() != matrix.n_columns)
        throw std::runtime_error(
          fmt::format("'{}', line {}: {} numbers, {} in the rows before", name, number, entries.size(), matrix.n_columns));
      matrix.n_columns = entries.size();
      for (const std::string_view entry : entries)
      {
        double     value = std::numeric_limits<double>::quiet_NaN();
        const auto from = entry.starts_with('+') ? entry.substr(1) : entry;
        if (!entry.empty())
          if (const auto [end, error] = std::from_chars(from.data(), from.data() + from.size(), value);
              error != std::errc() || end != from.data() + from.size())
            throw std::runtime_error(fmt::format("'{}', line {}: '{}' is no number", name, number, std::string(entry.substr(0, 40))));
        matrix.values.push_back(value);
        if (matrix.values.size() > max_numbers)
          throw std::runtime_error(fmt::format("'{}' has more than {} numbers", name, max_numbers));
      }
      ++matrix.n_rows;
    }
    if (matrix.n_rows == 0)
      throw std::runtime_error(fmt::format("'{}' has no numbers", name));
    return matrix;
  }
} // namespace unilateral
