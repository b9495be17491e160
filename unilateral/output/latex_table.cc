#include "unilateral/output/latex_table.h"

#include <fmt/format.h>

#include <cmath>
#include <cstdlib>
#include <vector>

namespace unilateral
{
  namespace
  {
    std::vector<std::vector<std::string>> rows_of_csv(const std::string &csv)
    {
      std::vector<std::vector<std::string>> rows;
      std::vector<std::string>              row(1);
      bool                                  quoted = false;
      for (std::size_t i = 0; i < csv.size(); ++i)
      {
        const char c = csv[i];
        if (quoted && c == '"' && i + 1 < csv.size() && csv[i + 1] == '"')
        {
          row.back() += c;
          ++i;
        }
        else if (c == '"')
          quoted = !quoted;
        else if (quoted || (c != ',' && c != '\n'))
          row.back() += c;
        else if (c == ',')
          row.emplace_back();
        else
        {
          rows.push_back(row);
          row.assign(1, "");
        }
      }
      if (row.size() > 1 || !row[0].empty())
        rows.push_back(row);
      return rows;
    }

    std::string escaped_for_tex(const std::string &text)
    {
      std::string result;
      for (const char c : text)
        switch (c)
        {
        case '\\':
          result += "\\textbackslash{}";
          break;
        case '~':
          result += "\\textasciitilde{}";
          break;
        case '^':
          result += "\\textasciicircum{}";
          break;
        case '#':
        case '$':
        case '%':
        case '&':
        case '_':
        case '{':
        case '}':
          result += '\\';
          [[fallthrough]];
        default:
          result += c;
        }
      return result;
    }

    /// 12, 0.1235, $1.235\cdot10^{-7}$; what is no number as a text.
    std::string entry(const std::string &text)
    {
      char        *end = nullptr;
      const double value = std::strtod(text.c_str(), &end);
      if (text.empty() || end != text.c_str() + text.size() || !std::isfinite(value))
        return escaped_for_tex(text);
      if (text.find_first_of(".eE") == std::string::npos)
        return fmt::format("${}$", text);
      if (value == 0)
        return "$0$";
      const double size = std::abs(value);
      if (size >= 1e-2 && size < 1e4)
        return fmt::format("${:.4g}$", value);
      const std::string number = fmt::format("{:.3e}", value);
      const auto        e = number.find('e');
      return fmt::format("${}\\cdot10^{{{}}}$", number.substr(0, e), std::atoi(number.c_str() + e + 1));
    }
  } // namespace

  std::string latex_table(const std::string &csv)
  {
    const auto rows = rows_of_csv(csv);
    if (rows.empty())
      return "";
    std::string text = fmt::format("% \\usepackage{{booktabs}}\n\\begin{{tabular}}{{{}}}\n  \\toprule\n", std::string(rows[0].size(), 'r'));
    for (std::size_t k = 0; k < rows.size(); ++k)
    {
      text += "  ";
      for (std::size_t c = 0; c < rows[k].size(); ++c)
      {
        text += c > 0 ? " & " : "";
        text += k == 0 ? fmt::format("\\texttt{{{}}}", escaped_for_tex(rows[k][c])) : entry(rows[k][c]);
      }
      text += k == 0 ? " \\\\\n  \\midrule\n" : " \\\\\n";
    }
    return text + "  \\bottomrule\n\\end{tabular}\n";
  }
} // namespace unilateral
