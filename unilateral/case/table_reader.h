// Typed access to a TOML table; whatever nobody asked for is an unknown key.
#pragma once

#include "unilateral/case/toml_document.h"

#include <optional>
#include <string>
#include <vector>

namespace unilateral
{
  /// The names that a key may take, and those that are fixed but have no meaning yet.
  struct Choice
  {
    std::vector<std::string> available, announced;
  };

  /// Reads one table. Every call names a key that may be there; finish() reports the others. A value of the wrong type is reported and
  /// counts as absent.
  class TableReader
  {
  public:
    /// @p section for messages: "[mesh]".
    TableReader(const TomlValue &table, std::string section, Diagnostics &diagnostics);

    /// The value of @p key or nullptr; marks the key as known.
    const TomlValue *find(const std::string &key);
    /// Where @p key stands; the table's own place when it is absent.
    SourceLocation where_key(const std::string &key) const;

    std::optional<double>              number(const std::string &key); ///< finite
    std::optional<unsigned>            whole_number(const std::string &key, unsigned least, unsigned most);
    std::optional<std::string>         string(const std::string &key);
    std::optional<bool>                boolean(const std::string &key);
    std::optional<std::vector<double>> numbers(const std::string &key); ///< a list

    /// The value of @p key, or nothing with an error that lists the names that can be chosen. A name that is announced but not available
    /// yet is an error, too, and is returned.
    std::optional<std::string> choice(const std::string &key, const Choice &names);

    /// @p key is there, or one that is unknown and looks like it: finish() will say so, and that it is missing is no news then. To be
    /// asked when every other key has been.
    bool has_or_misspells(const std::string &key);

    /// Makes @p key a known one that is an error: it belongs elsewhere, for the reason given.
    void refuse(const std::string &key, const std::string &reason);

    /// Reports the keys that nobody asked for.
    void finish();

    Diagnostics          &diagnostics;
    const std::string     section;
    const SourceLocation &where;

  private:
    const TomlValue         &table;
    std::vector<std::string> known;
    std::vector<std::string> refused; ///< known, but no help to the reader of a list of keys
  };

  /// A finite number, or nothing with an error that calls it @p name.
  std::optional<double> read_number(const TomlValue &value, const std::string &name, Diagnostics &diagnostics);

  /// A list of finite numbers, or nothing with an error.
  std::optional<std::vector<double>> read_numbers(const TomlValue &value, const std::string &name, Diagnostics &diagnostics);

  /// Tables under @p value: itself, or the elements of a list of tables. Anything else is an error that shows @p section.
  std::vector<const TomlValue *> read_tables(const TomlValue &value, const std::string &section, Diagnostics &diagnostics);
} // namespace unilateral
