#include "unilateral/case/table_reader.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>

namespace unilateral
{
  TableReader::TableReader(const TomlValue &table, std::string section, Diagnostics &diagnostics)
    : diagnostics(diagnostics), section(std::move(section)), where(table.where), table(table)
  {
  }

  const TomlValue *TableReader::find(const std::string &key)
  {
    if (std::find(known.begin(), known.end(), key) == known.end())
      known.push_back(key);
    for (const TomlEntry &entry : table.entries)
      if (entry.key == key)
        return &entry.value;
    return nullptr;
  }

  SourceLocation TableReader::where_key(const std::string &key) const
  {
    for (const TomlEntry &entry : table.entries)
      if (entry.key == key)
        return entry.where;
    return where;
  }

  std::optional<double> TableReader::number(const std::string &key)
  {
    const TomlValue *value = find(key);
    return value ? read_number(*value, key, diagnostics) : std::nullopt;
  }

  std::optional<unsigned> TableReader::whole_number(const std::string &key, const unsigned least, const unsigned most)
  {
    const TomlValue *value = find(key);
    if (!value)
      return {};
    if (value->kind != TomlValue::Kind::integer)
      diagnostics.error(value->where, fmt::format("'{}' must be a whole number, not {}", key, value->kind_name()),
                        MessageName("wrong-type"));
    else if (value->integer < std::int64_t(least) || value->integer > std::int64_t(most))
      diagnostics.error(value->where, fmt::format("'{}' must lie between {} and {}, it is {}", key, least, most, value->integer),
                        MessageName("out-of-range"));
    else
      return static_cast<unsigned>(value->integer);
    return {};
  }

  std::optional<std::string> TableReader::string(const std::string &key)
  {
    const TomlValue *value = find(key);
    if (value && value->kind != TomlValue::Kind::string)
    {
      diagnostics.error(value->where, fmt::format("'{}' must be a string, not {}", key, value->kind_name()), MessageName("wrong-type"));
      return {};
    }
    return value ? std::optional(value->string) : std::nullopt;
  }

  std::optional<bool> TableReader::boolean(const std::string &key)
  {
    const TomlValue *value = find(key);
    if (value && value->kind != TomlValue::Kind::boolean)
    {
      diagnostics.error(value->where, fmt::format("'{}' must be true or false, not {}", key, value->kind_name()),
                        MessageName("wrong-type"));
      return {};
    }
    return value ? std::optional(value->boolean) : std::nullopt;
  }

  std::optional<std::vector<double>> TableReader::numbers(const std::string &key)
  {
    const TomlValue *value = find(key);
    return value ? read_numbers(*value, key, diagnostics) : std::nullopt;
  }

  std::optional<std::string> TableReader::choice(const std::string &key, const Choice &names)
  {
    const auto word = string(key);
    if (!word || std::find(names.available.begin(), names.available.end(), *word) != names.available.end())
      return word;
    if (std::find(names.announced.begin(), names.announced.end(), *word) != names.announced.end())
    {
      diagnostics.error(find(key)->where,
                        fmt::format("{} \"{}\" is not available yet; known: {}", key, *word, fmt::join(names.available, ", ")),
                        MessageName("unknown-choice"));
      return word;
    }
    const std::string later = did_you_mean(*word, names.available).empty() ? did_you_mean(*word, names.announced) : "";
    diagnostics.error(find(key)->where,
                      fmt::format("unknown {} '{}'{}", key, *word,
                                  later.empty() ? suggestion_with_list(*word, names.available, "known")
                                                : fmt::format("; did you mean '{}'? That is not available yet; known: {}", later,
                                                              fmt::join(names.available, ", "))),
                      MessageName("unknown-choice"));
    return {};
  }

  bool TableReader::has_or_misspells(const std::string &key)
  {
    if (find(key))
      return true;
    const auto is_known = [this](const std::string &name) {
      return std::find(known.begin(), known.end(), name) != known.end() || std::find(refused.begin(), refused.end(), name) != refused.end();
    };
    return std::any_of(table.entries.begin(), table.entries.end(),
                       [&](const TomlEntry &entry) { return !is_known(entry.key) && did_you_mean(entry.key, known) == key; });
  }

  void TableReader::refuse(const std::string &key, const std::string &reason)
  {
    refused.push_back(key);
    for (const TomlEntry &entry : table.entries)
      if (entry.key == key)
        diagnostics.error(entry.where, fmt::format("'{}' in {}: {}", key, section, reason), MessageName("misplaced-key"));
  }

  void TableReader::finish()
  {
    for (const TomlEntry &entry : table.entries)
      if (std::find(known.begin(), known.end(), entry.key) == known.end() &&
          std::find(refused.begin(), refused.end(), entry.key) == refused.end())
        diagnostics.error(entry.where, fmt::format("unknown key '{}' in {}{}", entry.key, section, suggestion(entry.key, known)),
                          MessageName("unknown-key"));
  }

  std::optional<double> read_number(const TomlValue &value, const std::string &name, Diagnostics &diagnostics)
  {
    if (value.kind == TomlValue::Kind::integer)
      return static_cast<double>(value.integer);
    if (value.kind != TomlValue::Kind::real)
      diagnostics.error(value.where, fmt::format("'{}' must be a number, not {}", name, value.kind_name()), MessageName("wrong-type"));
    else if (!std::isfinite(value.real))
      diagnostics.error(value.where, fmt::format("'{}' must be a finite number", name), MessageName("wrong-type"));
    else
      return value.real + 0.0; // no negative zero: as an integer it would be zero again when it is written and read
    return {};
  }

  std::optional<std::vector<double>> read_numbers(const TomlValue &value, const std::string &name, Diagnostics &diagnostics)
  {
    if (value.kind != TomlValue::Kind::array)
    {
      diagnostics.error(value.where, fmt::format("'{}' must be a list of numbers, not {}", name, value.kind_name()),
                        MessageName("wrong-type"));
      return {};
    }
    std::vector<double> numbers;
    bool                complete = true;
    for (const TomlValue &element : value.elements)
      if (const auto number = read_number(element, name, diagnostics))
        numbers.push_back(*number);
      else
        complete = false;
    return complete ? std::optional(numbers) : std::nullopt;
  }

  std::vector<const TomlValue *> read_tables(const TomlValue &value, const std::string &section, Diagnostics &diagnostics)
  {
    std::vector<const TomlValue *> tables;
    if (value.kind == TomlValue::Kind::table)
      tables.push_back(&value);
    else if (value.kind == TomlValue::Kind::array)
      for (const TomlValue &element : value.elements)
        if (element.kind == TomlValue::Kind::table)
          tables.push_back(&element);
        else
          diagnostics.error(element.where, fmt::format("[{}] must be a table, not {}", section, element.kind_name()),
                            MessageName("wrong-type"));
    else
      diagnostics.error(value.where, fmt::format("'{0}' must be a table [{0}], not {1}", section, value.kind_name()),
                        MessageName("wrong-type"));
    return tables;
  }
} // namespace unilateral
