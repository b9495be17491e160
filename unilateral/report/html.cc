#include "unilateral/report/html.h"

#include "unilateral/base/visible_text.h"

#include <fmt/format.h>

#include <cmath>

namespace unilateral
{
  std::string escaped(const std::string &text)
  {
    std::string result;
    for (const char c : visible_lines(text))
      switch (c)
      {
      case '&':
        result += "&amp;";
        break;
      case '<':
        result += "&lt;";
        break;
      case '>':
        result += "&gt;";
        break;
      case '"':
        result += "&quot;";
        break;
      case '\'':
        result += "&#39;";
        break;
      default:
        result += c;
      }
    return result;
  }

  std::string number_text(const double value)
  {
    if (!std::isfinite(value))
      return "–";
    const double size = std::abs(value);
    if (size == 0)
      return "0";
    if (size < 1e-3 || size >= 1e6)
      return fmt::format("{:.3e}", value);
    return fmt::format("{:.5g}", value);
  }

  std::string base64(const void *const bytes, const std::size_t size)
  {
    static constexpr char      digits[] = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
    const unsigned char *const from = static_cast<const unsigned char *>(bytes);
    std::string                text;
    text.reserve((size + 2) / 3 * 4);
    for (std::size_t i = 0; i < size; i += 3)
    {
      const std::size_t n = std::min<std::size_t>(3, size - i);
      std::uint32_t     group = 0;
      for (std::size_t k = 0; k < 3; ++k)
        group = group << 8 | (k < n ? from[i + k] : 0);
      for (std::size_t k = 0; k < 4; ++k)
        text += k <= n ? digits[group >> (18 - 6 * k) & 63] : '=';
    }
    return text;
  }

  namespace
  {
    constexpr std::size_t longest_number = 32; ///< what is longer is prose, which wraps
  }

  namespace
  {
    /// A heading that may break after the dots of a path, constraint.0.total_contact_force.
    std::string breakable(const std::string &heading)
    {
      std::string html;
      for (const char c : escaped(heading))
      {
        html += c;
        if (c == '.')
          html += "<wbr>";
      }
      return html;
    }
  } // namespace

  std::string html_table(const std::vector<std::string> &headings, const std::vector<std::vector<std::string>> &rows)
  {
    std::string html = "<div class=\"scroll\" tabindex=\"0\"><table class=\"numbers\">\n<thead><tr>";
    for (const auto &heading : headings)
      html += fmt::format("<th scope=\"col\">{}</th>", breakable(heading));
    html += "</tr></thead>\n<tbody>\n";
    for (const auto &row : rows)
    {
      html += "<tr>";
      for (std::size_t k = 0; k < row.size(); ++k)
        html += k == 0                           ? fmt::format("<th scope=\"row\">{}</th>", escaped(row[k]))
                : row[k].size() > longest_number ? fmt::format("<td class=\"text\">{}</td>", escaped(row[k]))
                                                 : fmt::format("<td>{}</td>", escaped(row[k]));
      html += "</tr>\n";
    }
    return html + "</tbody></table></div>\n";
  }

  std::string html_section(const std::string &id, const std::string &heading, const std::string &content)
  {
    return fmt::format("<section id=\"{}\">\n<h2>{}</h2>\n{}</section>\n", escaped(id), escaped(heading), content);
  }

  std::string html_details(const std::string &summary, const std::string &text)
  {
    return fmt::format("<details><summary>{}</summary><pre tabindex=\"0\">{}</pre></details>\n", escaped(summary), escaped(text));
  }
} // namespace unilateral
