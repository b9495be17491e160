// A TOML text as a tree in which every key and value knows its place.
#pragma once

#include "unilateral/base/diagnostics.h"

#include <cstdint>
#include <memory>
#include <string>
#include <utility>
#include <vector>

namespace unilateral
{
  /// An override from the command line, e.g. {"mesh.refine", "6"}, {"constraint.0.lower", "\"x^2\""}; the value is TOML, or else taken as a
  /// string.
  using Override = std::pair<std::string, std::string>;

  struct TomlEntry;
  class GivenFunction;

  /// A value and where it stands.
  struct TomlValue
  {
    enum class Kind
    {
      boolean,
      integer,
      real,
      string,
      date, ///< dates and times: no case has a use for them
      array,
      table,
      given ///< a function that the program hands over, see insert_given_functions(); never in a text
    };
    Kind                   kind = Kind::table;
    bool                   boolean = false;
    std::int64_t           integer = 0;
    double                 real = 0;
    std::string            string;
    std::vector<TomlValue> elements; ///< of an array
    std::vector<TomlEntry> entries;  ///< of a table, in the order of the text

    std::shared_ptr<const GivenFunction> given; ///< number `integer` of those that the program has handed over

    SourceLocation where;  ///< of the first character; of a [table] its bracket
    SourceLocation inside; ///< string: of the first character after the opening quotes
    /// String: line and column of each byte, when escapes or folded lines make them differ from those counted from `inside`; else empty.
    std::vector<std::pair<unsigned, unsigned>> places;

    /// The entry of a table, or nullptr.
    TomlValue       *find(const std::string &key);
    const TomlValue *find(const std::string &key) const;

    /// "a string", "a table", ... for messages.
    std::string kind_name() const;
  };

  struct TomlEntry
  {
    std::string    key;
    SourceLocation where; ///< of the key
    TomlValue      value;
  };

  /// Parses a whole document. Throws InputError at the first fault of syntax.
  TomlValue parse_toml(const std::string &text, const std::string &file);

  /// @p text as a basic string of TOML, in quotes.
  std::string toml_quoted(const std::string &text);

  /// "[1, 2.5]"
  std::string toml_list(const std::vector<double> &values);

  /// The words of "a.b.c".
  std::vector<std::string> split_path(const std::string &path);

  /// The value as it would stand in a document, tables in braces.
  std::string to_toml(const TomlValue &value);

  /// The text of a key: bare where TOML allows it, else in quotes.
  std::string toml_key(const std::string &name);

  /// What stands at a dotted path, where set_value() would set it; nullptr where nothing does.
  const TomlValue *value_at(const TomlValue &document, const std::string &path);

  /// The same as the next, for a value that has been read: places in it are kept, and what is wrong with @p path is reported at @p where.
  void
  set_value(TomlValue &document, const std::string &path, const TomlValue &value, const SourceLocation &where, Diagnostics &diagnostics);

  /// Sets the value at a dotted path; integers index arrays (a single table answers to index 0), missing tables are created and an
  /// array grows by one, and an array of one table answers to its keys. The value is TOML or else a string; its location is "--set path"
  /// without a line.
  void set_value(TomlValue &document, const Override &assignment, Diagnostics &diagnostics);
} // namespace unilateral
