// The specification of the case file: every table and key with its types, default, range and a sentence. The JSON Schema, the manual page
// and the completion of --set come from it, and tests hold the reader and doc/case-file.md against it.
#pragma once

#include <optional>
#include <string>
#include <vector>

namespace unilateral
{
  /// One form that a value can take; most keys have a single one.
  struct ValueForm
  {
    enum class Type
    {
      number,
      whole_number,
      text,
      boolean,
      list,
      table,           ///< one table
      table_or_tables, ///< [name], or as many [[name]] as wanted
      anything,        ///< whatever the key takes that it is set to
      field            ///< a number, an expression, a raster, a profile or a solution
    };
    Type                     type = Type::number;
    std::optional<double>    least, most;                            ///< of a number
    bool                     open_below = false, open_above = false; ///< whether `least`, `most` are excluded
    std::vector<std::string> words;                                  ///< those that a text may be; empty: any
    std::vector<std::string> not_words;                              ///< those that it may not be
    std::string              pattern;                                ///< of a text, a regular expression of ECMAScript
    std::vector<ValueForm>   elements;                               ///< of a list: the forms that its entries can take
    std::vector<unsigned>    lengths;                                ///< of a list; empty: any
    std::string              table;                                  ///< name of the TableDescription of a table
  };

  struct KeyDescription
  {
    std::string              name;  ///< any_name: whatever the user calls it
    std::vector<std::string> kinds; ///< of problems that have it; empty: all
    std::vector<ValueForm>   forms;
    std::string              by_default; ///< as it would stand in a case, or "" when there is none
    bool                     required = false;
    std::string              description;
    std::string              example; ///< a value, as it would stand in a case

    static constexpr const char *any_name = "*";
  };

  /// What holds between the keys of a table.
  struct KeyRule
  {
    enum class Type
    {
      exactly_one,
      at_least_one,
      not_together,
      needs ///< the first asks for the second
    };
    Type                     type;
    std::vector<std::string> keys;
    std::vector<std::string> kinds; ///< of problems for which it holds; empty: all
  };

  struct TableDescription
  {
    std::string                 name;
    std::string                 title; ///< as users know it: [mesh]
    std::string                 description;
    std::vector<KeyDescription> keys;
    std::vector<KeyRule>        rules;
  };

  /// The kinds of problems.
  const std::vector<std::string> &kinds_of_problems();

  /// All tables; the first is the top level of a case file.
  const std::vector<TableDescription> &case_tables();
  const TableDescription              &case_table(const std::string &name);

  bool holds_for(const std::vector<std::string> &kinds, const std::string &kind);

  /// "number > 0", "\"auto\", \"direct\" or ...": what a value may be, for people.
  std::string to_string(const std::vector<ValueForm> &forms);

  /// The keys that `--set` takes, each once: "mesh.refine", "constraint.0.lower". Names that the user invents are not among them.
  std::vector<std::string> settable_keys();
} // namespace unilateral
