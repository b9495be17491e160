#include "unilateral/functions/profile.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <limits>
#include <stdexcept>
#include <string_view>

namespace unilateral
{
  namespace
  {
    constexpr std::uintmax_t max_bytes = 256u << 20;

    std::vector<std::string_view> split(const std::string_view line)
    {
      const bool                    by_sign = line.find_first_of(",;") != std::string_view::npos;
      const std::string_view        separators = by_sign ? ",;" : " \t";
      std::vector<std::string_view> columns;
      for (std::size_t begin = 0; begin <= line.size();)
      {
        const std::size_t end = std::min(line.find_first_of(separators, begin), line.size());
        std::string_view  column = line.substr(begin, end - begin);
        while (!column.empty() && std::string_view(" \t").find(column.front()) != std::string_view::npos)
          column.remove_prefix(1);
        while (!column.empty() && std::string_view(" \t").find(column.back()) != std::string_view::npos)
          column.remove_suffix(1);
        if (by_sign || !column.empty())
          columns.push_back(column);
        begin = end + 1;
      }
      return columns;
    }

    bool read_number(std::string_view text, double &number)
    {
      if (!text.empty() && text.front() == '+')
        text.remove_prefix(1);
      const auto [end, failure] = std::from_chars(text.data(), text.data() + text.size(), number);
      return failure == std::errc() && end == text.data() + text.size() && std::isfinite(number);
    }
  } // namespace

  Profile::Profile(const std::string &file)
  {
    const std::string name = std::filesystem::path(file).filename().string();
    std::error_code   failure;
    const auto        status = std::filesystem::status(file, failure);
    if (!std::filesystem::exists(status))
      throw std::runtime_error(fmt::format("profile '{}' does not exist", file));
    if (!std::filesystem::is_regular_file(status))
      throw std::runtime_error(fmt::format("profile '{}' is not a file", file));
    if (std::filesystem::file_size(file, failure) > max_bytes)
      throw std::runtime_error(fmt::format("profile '{}' is larger than {} MB", name, max_bytes >> 20));
    std::ifstream in(file);
    if (!in)
      throw std::runtime_error(fmt::format("profile '{}' cannot be opened", file));

    std::string line;
    bool        first = true;
    for (unsigned row = 1; std::getline(in, line); ++row)
    {
      if (row == 1 && line.starts_with("\xef\xbb\xbf"))
        line.erase(0, 3);
      if (!line.empty() && line.back() == '\r')
        line.pop_back();
      const std::size_t begin = line.find_first_not_of(" \t");
      if (begin == std::string::npos || line[begin] == '#')
        continue;
      const std::vector<std::string_view> columns = split(std::string_view(line).substr(begin));
      double                              x = 0, value = 0;
      const bool                          x_read = !columns.empty() && read_number(columns[0], x);
      const bool                          value_read = columns.size() > 1 && read_number(columns[1], value);
      const bool                          header = first && !x_read && !value_read;
      first = false;
      if (header)
        continue;
      if (columns.size() != 2)
        throw std::runtime_error(
          fmt::format("profile '{}' line {}: two columns expected, x and value, found {}", name, row, columns.size()));
      if (!x_read || !value_read)
        throw std::runtime_error(fmt::format("profile '{}' line {}: '{}' is not a number", name, row, columns[x_read ? 1 : 0]));
      if (!positions.empty() && x <= positions.back())
        throw std::runtime_error(
          fmt::format("profile '{}' line {}: x must increase from row to row, {} follows {}", name, row, x, positions.back()));
      positions.push_back(x);
      values.push_back(value);
    }
    if (positions.size() < 2)
      throw std::runtime_error(fmt::format("profile '{}' needs two rows of numbers at least, it has {}", name, positions.size()));
  }

  double Profile::sample(double x) const
  {
    const double first = positions.front(), last = positions.back();
    // The end of the domain may miss the end of the table by rounding.
    const double tolerance = 1e-9 * (last - first);
    if (!(x >= first - tolerance && x <= last + tolerance))
      throw std::domain_error(fmt::format("outside the profile, which covers [{}, {}]", first, last));
    x = std::clamp(x, first, last);
    const std::size_t i =
      std::clamp<std::size_t>(std::upper_bound(positions.begin(), positions.end(), x) - positions.begin(), 1, positions.size() - 1);
    const double t = (x - positions[i - 1]) / (positions[i] - positions[i - 1]);
    return (1 - t) * values[i - 1] + t * values[i];
  }

  double Profile::spacing() const
  {
    double least = std::numeric_limits<double>::max();
    for (std::size_t i = 1; i < positions.size(); ++i)
      least = std::min(least, positions[i] - positions[i - 1]);
    return least;
  }
} // namespace unilateral
