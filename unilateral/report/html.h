// Pieces of HTML and SVG. Whatever comes from outside passes through escaped().
#pragma once

#include <cstdint>
#include <string>
#include <vector>

namespace unilateral
{
  /// @p text as text of HTML or as the value of an attribute in double quotes: nothing in it is markup. Control characters and bytes
  /// that are no UTF-8 are written out (see visible_lines()).
  std::string escaped(const std::string &text);

  /// For people: five significant digits, "–" for what is not a number.
  std::string number_text(double value);

  /// Base64 (RFC 4648) of bytes.
  std::string base64(const void *bytes, std::size_t size);

  /// The numbers as they are in memory of a little-endian machine.
  template <typename T>
  std::string base64(const std::vector<T> &values)
  {
    return base64(values.data(), values.size() * sizeof(T));
  }

  /// A table with a line of headings; the cells of the first column are headings of their rows. All texts are escaped.
  std::string html_table(const std::vector<std::string> &headings, const std::vector<std::vector<std::string>> &rows);

  /// A section with a heading; @p content is HTML.
  std::string html_section(const std::string &id, const std::string &heading, const std::string &content);

  /// Something that opens by a click: a text as it is.
  std::string html_details(const std::string &summary, const std::string &text);
} // namespace unilateral
