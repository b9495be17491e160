#include "cli/manual.h"

#include "cli/command_description.h"

#include "unilateral/case/case_schema.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>

namespace unilateral
{
  namespace
  {
    /// Text for a line of roff: nothing in it is taken for a request or an escape.
    std::string roff(const std::string &text)
    {
      std::string safe;
      for (const char c : text)
        if (c == '\\')
          safe += "\\e";
        else if (c == '-')
          safe += "\\-";
        else if (c == '\'')
          safe += "\\(aq";
        else if (c == '^')
          safe += "\\(ha";
        else if (c == '~')
          safe += "\\(ti";
        else if (c == '\n')
          safe += "\n.br\n";
        else
          safe += c;
      return safe.starts_with('.') ? "\\&" + safe : safe;
    }

    std::string heading(const std::string &title, const std::string &section)
    {
      return fmt::format(".TH {} {} \"\" \"unilateral {}\"\n", title, section, UNILATERAL_VERSION);
    }

    std::string option_lines(const std::vector<OptionDescription> &options)
    {
      std::string text;
      for (const OptionDescription &option : options)
      {
        text += ".TP\n";
        if (!option.short_name.empty())
          text += fmt::format("\\fB{}\\fR, ", roff(option.short_name));
        text += fmt::format("\\fB{}\\fR{}\n{}\n", roff(option.name), option.value.empty() ? "" : " \\fI" + roff(option.value) + "\\fR",
                            roff(option.description));
      }
      return text;
    }

    std::string program_page()
    {
      const std::vector<CommandDescription> all = describe_commands();
      std::string text = heading("UNILATERAL", "1") + ".SH NAME\nunilateral \\- obstacle and contact problems by finite elements\n" +
                         ".SH SYNOPSIS\n.B unilateral\n\\fICOMMAND\\fR [\\fIARGUMENT\\fR] [\\fIOPTION\\fR]...\n.SH DESCRIPTION\n" +
                         roff(all.front().description) +
                         "\nA problem is stated in a case file, see \\fBunilateral\\-case\\fR(5).\n.SH COMMANDS\n";
      for (const CommandDescription &command : all)
      {
        if (command.name.empty())
          continue;
        text += fmt::format(".SS {}{}\n{}.\n", roff(command.name), command.argument.empty() ? "" : " " + command.argument,
                            roff(command.description));
        std::vector<OptionDescription> own;
        for (const OptionDescription &option : command.options)
          if (option.name != "--help")
            own.push_back(option);
        text += option_lines(own);
      }
      text += ".SH OPTIONS\nOf every command:\n" + option_lines(all.front().options);
      text += ".SH EXIT STATUS\n";
      for (const auto &[code, meaning] :
           {std::pair("0", "solved, in equilibrium, and every expectation holds"), std::pair("1", "internal error"),
            std::pair("2", "bad input or usage"), std::pair("3", "not converged or not in equilibrium"),
            std::pair("4", "solved, but an expectation or a certificate fails"), std::pair("130", "interrupted")})
        text += fmt::format(".TP\n.B {}\n{}\n", code, meaning);
      return text + ".SH EXAMPLE\n.nf\nunilateral init membrane\nunilateral run membrane.toml \\-\\-set mesh.refine=5\n.fi\n" +
             ".SH FILES\n.TP\n.I NAME.out/\nthe results of NAME.toml: report.html, results.json, solution.vtu, constraint\\-points.vtu\n" +
             ".TP\n.I share/doc/unilateral/examples/\ncases to copy and change, below the prefix of the installation, /usr for packages\n" +
             ".SH SEE ALSO\n\\fBunilateral\\-case\\fR(5)\n";
    }

    std::string key_lines(const TableDescription &table)
    {
      std::string text;
      for (const KeyDescription &key : table.keys)
      {
        // Tables that have a section of their own need no line at the top.
        if (key.forms.size() == 1 && key.forms[0].table == key.name && table.name == "case")
          continue;
        std::string facts = to_string(key.forms);
        if (key.required)
          facts += "; required";
        if (!key.by_default.empty())
          facts += "; default " + key.by_default;
        if (!key.kinds.empty())
          facts += fmt::format("; {}", fmt::join(key.kinds, ", "));
        text += fmt::format(".TP\n\\fB{}\\fR ({})\n{}\n", key.name == KeyDescription::any_name ? "\\fIname\\fB" : roff(key.name),
                            roff(facts), roff(key.description));
      }
      return text;
    }

    std::string case_page()
    {
      std::string text = heading("UNILATERAL\\-CASE", "5") +
                         ".SH NAME\nunilateral\\-case \\- the case file of unilateral\n.SH DESCRIPTION\n" +
                         "A case file is TOML. Unknown keys are errors. A \\fIfield\\fR is a number, an expression in quotes such as\n" +
                         "\"sin(pi*x)*y\", { raster = \"FILE\" } or { profile = \"FILE\" }; its keys are below. " +
                         "\\fBunilateral expand\\fR prints a case with its defaults.\n";
      for (const TableDescription &table : case_tables())
        text +=
          fmt::format(".SH {}\n{}\n{}", roff(table.title + (table.name.find("condition") != std::string::npos ? ", " + table.name : "")),
                      roff(table.description), key_lines(table));
      return text + ".SH EXAMPLE\n.nf\nmesh.box = [[0, 0], [2, 1]]\nmesh.cells = [16, 8]\nmesh.refine = 3\nmodel.kind = \"membrane\"\n" +
             "model.load = \\-4\nboundary.all = 0\nconstraint.lower = \"if(x < 1, \\-0.2, \\-0.1)\"\n.fi\n.SH SEE "
             "ALSO\n\\fBunilateral\\fR(1)\n";
    }
  } // namespace

  std::string manual_page(const std::string &page)
  {
    return page == "unilateral" ? program_page() : case_page();
  }

  std::string wrapped(const std::string &text, const std::size_t width)
  {
    std::string result;
    std::size_t column = 0, begin = 0;
    while (begin < text.size())
    {
      const std::size_t end = std::min(text.find(' ', begin), text.size());
      if (column > 0)
      {
        const bool fits = column + 1 + end - begin <= width;
        result += fits ? ' ' : '\n';
        column = fits ? column + 1 : 0;
      }
      result += text.substr(begin, end - begin);
      column += end - begin;
      begin = end + 1;
    }
    return result;
  }
} // namespace unilateral
