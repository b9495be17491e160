#include "unilateral/case/toml_document.h"

#include "unilateral/base/visible_text.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cctype>
#include <charconv>
#include <stdexcept>
#include <string_view>
#include <utility>

namespace
{
  /// toml++ 3.3 asserts what a malformed text can violate, "[[[" for one; without assertions it would run on into undefined behaviour.
  struct BrokenAssertion : std::logic_error
  {
    using std::logic_error::logic_error;
  };
} // namespace

#undef NDEBUG
#define TOML_ASSERT(condition) ((condition) ? void() : throw BrokenAssertion(#condition))
#pragma GCC diagnostic push
#ifndef __clang__
#  pragma GCC diagnostic ignored "-Wterminate" // some assertions sit in functions that do not throw; none of them depends on the text
#endif
// Its test for white space declares characters such as U+00E9 unreachable; they are no white space.
#include <toml++/impl/forward_declarations.h>
#pragma push_macro("TOML_UNREACHABLE")
#undef TOML_UNREACHABLE
#define TOML_UNREACHABLE return false
#include <toml++/impl/unicode.h>
#pragma pop_macro("TOML_UNREACHABLE")
#include <toml++/toml.h>
#pragma GCC diagnostic pop

namespace unilateral
{
  namespace
  {
    /// Every level of nesting costs stack, and tables named a.b.c... nest without brackets.
    constexpr unsigned max_dots_in_key = 100;

    bool continues_character(const char c)
    {
      return (static_cast<unsigned char>(c) & 0xc0) == 0x80;
    }

    /// The text by lines: toml++ counts columns in characters, the text is bytes.
    class TextLines
    {
    public:
      explicit TextLines(const std::string &text) : text(text), starts(1, 0)
      {
        for (std::size_t i = 0; i < text.size(); ++i)
          if (text[i] == '\n')
            starts.push_back(i + 1);
      }

      unsigned size() const { return static_cast<unsigned>(starts.size()); }

      /// Of the first byte of a character; the end of the text for lines beyond.
      std::size_t offset(const unsigned line, const unsigned column) const
      {
        if (line == 0 || line > starts.size())
          return text.size();
        std::size_t at = starts[line - 1];
        for (unsigned c = 1; c < column && at < text.size(); ++c)
          for (++at; at < text.size() && continues_character(text[at]);)
            ++at;
        return at;
      }

    private:
      const std::string       &text;
      std::vector<std::size_t> starts;
    };

    SourceLocation location(const toml::source_region &region, const std::string &file)
    {
      return {file, region.begin.line, region.begin.column};
    }

    /// Walks the characters of the source and counts lines and columns.
    struct Cursor
    {
      const std::string &text;
      std::size_t        at;
      unsigned           line, column;

      bool starts_with(const std::string_view s) const { return text.compare(at, s.size(), s) == 0; }
      void advance()
      {
        if (text[at] == '\n')
        {
          ++line;
          column = 1;
        }
        else if (at + 1 >= text.size() || !continues_character(text[at + 1]))
          ++column;
        ++at;
      }
      void advance(const std::size_t n)
      {
        for (std::size_t i = 0; i < n && at < text.size(); ++i)
          advance();
      }
    };

    /// Finds where the content of a string begins and, if it is not written verbatim, where each of its bytes comes from.
    void locate_string(TomlValue &value, const std::string &text, const TextLines &lines)
    {
      value.inside = value.where;
      Cursor cursor{text, lines.offset(value.where.line, value.where.column), value.where.line, value.where.column};
      if (cursor.at >= text.size() || (text[cursor.at] != '"' && text[cursor.at] != '\''))
        return;
      const bool basic = text[cursor.at] == '"';
      const bool multi_line = cursor.starts_with(basic ? "\"\"\"" : "'''");
      cursor.advance(multi_line ? 3 : 1);
      if (multi_line && cursor.starts_with("\r\n"))
        cursor.advance(2);
      else if (multi_line && cursor.starts_with("\n"))
        cursor.advance();
      value.inside.line = cursor.line;
      value.inside.column = cursor.column;

      if (text.compare(cursor.at, value.string.size(), value.string) == 0)
        return;
      // The size of the value says when to stop; escapes never decode to more bytes than they are long.
      std::vector<std::pair<unsigned, unsigned>> places;
      while (places.size() < value.string.size() && cursor.at < text.size())
      {
        const std::pair<unsigned, unsigned> here(cursor.line, cursor.column);
        if (!basic || text[cursor.at] != '\\')
        {
          places.push_back(here);
          cursor.advance();
          continue;
        }
        cursor.advance();
        const char escape = cursor.at < text.size() ? text[cursor.at] : '\0';
        if (escape == 'u' || escape == 'U')
        {
          const unsigned char first = static_cast<unsigned char>(value.string[places.size()]);
          places.insert(places.end(), first < 0x80 ? 1 : first < 0xe0 ? 2 : first < 0xf0 ? 3 : 4, here);
          cursor.advance(escape == 'u' ? 5 : 9);
        }
        else if (escape == ' ' || escape == '\t' || escape == '\r' || escape == '\n')
          while (cursor.at < text.size() && std::string_view(" \t\r\n").find(text[cursor.at]) != std::string_view::npos)
            cursor.advance();
        else
        {
          places.push_back(here);
          cursor.advance();
        }
      }
      if (places.size() == value.string.size())
        value.places = std::move(places);
    }

    TomlValue convert(const toml::node &node, const std::string &file, const std::string &text, const TextLines &lines)
    {
      TomlValue value;
      value.where = location(node.source(), file);
      switch (node.type())
      {
      case toml::node_type::boolean:
        value.kind = TomlValue::Kind::boolean;
        value.boolean = node.as_boolean()->get();
        break;
      case toml::node_type::integer:
        value.kind = TomlValue::Kind::integer;
        value.integer = node.as_integer()->get();
        break;
      case toml::node_type::floating_point:
        value.kind = TomlValue::Kind::real;
        value.real = node.as_floating_point()->get();
        break;
      case toml::node_type::string:
        value.kind = TomlValue::Kind::string;
        value.string = node.as_string()->get();
        locate_string(value, text, lines);
        break;
      case toml::node_type::array:
        value.kind = TomlValue::Kind::array;
        for (const toml::node &element : *node.as_array())
          value.elements.push_back(convert(element, file, text, lines));
        break;
      case toml::node_type::table:
        value.kind = TomlValue::Kind::table;
        for (const auto &[key, element] : *node.as_table())
          value.entries.push_back({std::string(key.str()), location(key.source(), file), convert(element, file, text, lines)});
        // toml++ sorts by name, people read from top to bottom.
        std::stable_sort(value.entries.begin(), value.entries.end(),
                         [](const TomlEntry &a, const TomlEntry &b)
                         { return std::pair(a.where.line, a.where.column) < std::pair(b.where.line, b.where.column); });
        break;
      default:
        value.kind = TomlValue::Kind::date;
      }
      return value;
    }

    void refuse_deep_keys(const std::string &text, const std::string &file)
    {
      unsigned dots = 0, line = 1;
      bool     after_name = false;
      for (const char c : text)
      {
        const bool name = std::isalnum(static_cast<unsigned char>(c)) || c == '_' || c == '-' || c == '"' || c == '\'';
        if (c == '\n')
          ++line;
        if (c == '.' && after_name)
          ++dots;
        else if (!name && c != ' ' && c != '\t')
          dots = 0;
        if (c != ' ' && c != '\t')
          after_name = name;
        if (dots > max_dots_in_key)
          throw InputError({file, line, 1}, fmt::format("a name with more than {} dots", max_dots_in_key), MessageName("toml-syntax"));
      }
    }

    /// The first line that toml++ stumbles over: a text up to it does, one that ends before does not.
    unsigned first_malformed_line(const std::string &text)
    {
      const TextLines lines(text);
      const auto      stumbles = [&](const unsigned n_lines)
      {
        try
        {
          const toml::table document = toml::parse(std::string_view(text).substr(0, lines.offset(n_lines + 1, 1)));
        }
        catch (const toml::parse_error &)
        {
        }
        catch (const BrokenAssertion &)
        {
          return true;
        }
        return false;
      };
      unsigned last_sound = 0, malformed = lines.size();
      while (malformed > last_sound + 1)
      {
        const unsigned middle = last_sound + (malformed - last_sound) / 2;
        (stumbles(middle) ? malformed : last_sound) = middle;
      }
      return malformed;
    }

    /// What toml++ says of a syntax error, and what to do about it.
    std::string with_remedy(std::string description)
    {
      while (!description.empty() && (description.back() == '.' || description.back() == '\n'))
        description.pop_back();
      const auto says = [&](const char *const words) { return description.find(words) != std::string::npos; };
      return description + (says("redefine") || says("already") ? "; every key and [section] may be given once: keep one of the two"
                            : says("string")                    ? "; a text stands between quotes, \"...\", and ends on its line"
                            : says("array")                     ? "; a list stands between [ and ], with commas between its entries"
                            : says("inline table")              ? "; a table within a line is { key = value, key = value }"
                                                                : "; a line is key = value, [section] or # comment, texts stand in quotes");
    }

    /// Where a text begins that is never closed, and its quotes.
    struct OpenText
    {
      std::size_t offset = 0;
      std::string quotes;
    };

    /// The first such text; none where every text has an end.
    std::optional<OpenText> open_text(const std::string &text)
    {
      for (std::size_t i = 0; i < text.size(); ++i)
      {
        if (text[i] == '#')
          i = std::min(text.find('\n', i), text.size());
        else if (text[i] == '"' || text[i] == '\'')
        {
          const std::size_t begin = i;
          std::string       quotes(1, text[i]);
          if (text.compare(i, 3, std::string(3, text[i])) == 0)
            quotes = std::string(3, text[i]);
          for (i += quotes.size(); text.compare(i, quotes.size(), quotes) != 0; ++i)
          {
            if (quotes[0] == '"' && i < text.size() && text[i] == '\\')
              ++i;
            if (i >= text.size() || (quotes.size() == 1 && text[i] == '\n'))
              return OpenText{begin, quotes};
          }
          i += quotes.size() - 1;
          for (unsigned inside = 0; quotes.size() == 3 && inside < 2 && text.compare(i + 1, 1, quotes, 0, 1) == 0; ++inside)
            ++i; // up to two quotes may stand before the three that end it
        }
      }
      return {};
    }

    /// toml++ stumbles over the end of the line, or of the file; the mistake is where the text begins.
    InputError unclosed_text(const OpenText &open, const std::string &text, const std::string &file)
    {
      SourceLocation where{file, 1, 1};
      for (std::size_t i = 0; i < open.offset; ++i)
        if (text[i] == '\n')
          where = {file, where.line + 1, 1};
        else if ((static_cast<unsigned char>(text[i]) & 0xC0) != 0x80) // columns are characters, not bytes
          ++where.column;
      return {where,
              fmt::format("the text that begins here is {}; add {} at its end",
                          open.quotes.size() == 1 ? "not closed before the line ends" : "never closed", open.quotes),
              MessageName("toml-syntax")};
    }

    /// The value of an override, or nothing when the text is not TOML.
    std::optional<TomlValue> parse_lone_value(const std::string &text)
    {
      try
      {
        TomlValue table = parse_toml("value = " + text, "");
        if (table.entries.size() == 1 && table.entries[0].key == "value")
          return std::move(table.entries[0].value);
      }
      catch (const InputError &)
      {
      }
      return {};
    }

    void relocate(TomlValue &value, const SourceLocation &where)
    {
      value.where = value.inside = where;
      value.places.clear();
      for (TomlValue &element : value.elements)
        relocate(element, where);
      for (TomlEntry &entry : value.entries)
      {
        entry.where = where;
        relocate(entry.value, where);
      }
    }

    std::optional<std::size_t> parse_index(const std::string &text)
    {
      std::size_t index = 0;
      const auto [end, failure] = std::from_chars(text.data(), text.data() + text.size(), index);
      if (text.empty() || failure != std::errc() || end != text.data() + text.size())
        return {};
      return index;
    }
  } // namespace

  const TomlValue *TomlValue::find(const std::string &key) const
  {
    for (const TomlEntry &entry : entries)
      if (entry.key == key)
        return &entry.value;
    return nullptr;
  }

  TomlValue *TomlValue::find(const std::string &key)
  {
    return const_cast<TomlValue *>(std::as_const(*this).find(key));
  }

  std::string TomlValue::kind_name() const
  {
    switch (kind)
    {
    case Kind::boolean:
      return "true or false";
    case Kind::integer:
    case Kind::real:
      return "a number";
    case Kind::string:
      return "a string";
    case Kind::date:
      return "a date";
    case Kind::array:
      return "a list";
    case Kind::table:
      return "a table";
    case Kind::given:
      return "a function of the calling program";
    }
    return "";
  }

  TomlValue parse_toml(const std::string &text, const std::string &file)
  {
    refuse_deep_keys(text, file);
    try
    {
      const toml::table document = toml::parse(std::string_view(text));
      return convert(document, file, text, TextLines(text));
    }
    catch (const toml::parse_error &e)
    {
      const auto open = open_text(text);
      if (e.description().find("string") != std::string_view::npos && open)
        throw unclosed_text(*open, text, file);
      throw InputError(location(e.source(), file), with_remedy(std::string(e.description())), MessageName("toml-syntax"));
    }
    catch (const BrokenAssertion &)
    {
      throw InputError({file, first_malformed_line(text), 1}, "malformed line; expected key = value, [table] or [[table]]",
                       MessageName("toml-syntax"));
    }
  }

  std::vector<std::string> split_path(const std::string &path)
  {
    std::vector<std::string> words(1);
    for (std::size_t k = 0; k < path.size(); ++k)
      if (const std::size_t end = path[k] == '"' && words.back().empty() ? path.find('"', k + 1) : std::string::npos;
          end != std::string::npos) // a name in quotes, as TOML has them
      {
        words.back() = path.substr(k + 1, end - k - 1);
        k = end;
      }
      else if (path[k] == '.')
        words.emplace_back();
      else
        words.back() += path[k];
    return words;
  }

  std::string toml_quoted(const std::string &text)
  {
    std::string result = "\"";
    for (const char c : text)
      switch (c)
      {
      case '"':
        result += "\\\"";
        break;
      case '\\':
        result += "\\\\";
        break;
      case '\n':
        result += "\\n";
        break;
      case '\t':
        result += "\\t";
        break;
      case '\r':
        result += "\\r";
        break;
      default:
        if (static_cast<unsigned char>(c) < 0x20 || c == 0x7f)
          result += fmt::format("\\u{:04X}", static_cast<unsigned>(c));
        else
          result += c;
      }
    return visible(result) + "\""; // what is left to write out has more than one byte, and its form there is TOML's
  }

  std::string toml_list(const std::vector<double> &values)
  {
    return fmt::format("[{}]", fmt::join(values, ", "));
  }

  std::string toml_key(const std::string &name)
  {
    const auto bare = [](const char c)
    { return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '_' || c == '-'; };
    return !name.empty() && std::all_of(name.begin(), name.end(), bare) ? name : toml_quoted(name);
  }

  std::string to_toml(const TomlValue &value)
  {
    std::vector<std::string> parts;
    switch (value.kind)
    {
    case TomlValue::Kind::boolean:
      return value.boolean ? "true" : "false";
    case TomlValue::Kind::integer:
      return std::to_string(value.integer);
    case TomlValue::Kind::real:
      return fmt::format("{}", value.real);
    case TomlValue::Kind::string:
    case TomlValue::Kind::date:
      return toml_quoted(value.string);
    case TomlValue::Kind::array:
      for (const TomlValue &element : value.elements)
        parts.push_back(to_toml(element));
      return fmt::format("[{}]", fmt::join(parts, ", "));
    case TomlValue::Kind::table:
      for (const TomlEntry &entry : value.entries)
        parts.push_back(fmt::format("{} = {}", toml_key(entry.key), to_toml(entry.value)));
      return parts.empty() ? "{}" : fmt::format("{{ {} }}", fmt::join(parts, ", "));
    case TomlValue::Kind::given:
      return fmt::format("{{ given = {} }}", value.integer);
    }
    return "";
  }

  namespace
  {
    /// The value at a dotted path, which is made where it is missing; nullptr and an error at @p where when there can be none.
    TomlValue *place_at(TomlValue &document, const std::string &path, const SourceLocation &where, Diagnostics &diagnostics)
    {
      const std::vector<std::string> names = split_path(path);
      if (std::any_of(names.begin(), names.end(), [](const std::string &n) { return n.empty(); }) || names.size() > max_dots_in_key)
      {
        diagnostics.error(where.line > 0 ? where : SourceLocation{"--set", 0, 0},
                          fmt::format("'{}' is not a path of names and numbers with dots between them", path), MessageName("bad-setting"));
        return nullptr;
      }

      TomlValue  *place = &document;
      std::string so_far;
      for (std::size_t i = 0; i < names.size(); ++i)
      {
        const std::string &name = names[i];
        const auto         index = parse_index(name);
        const bool         index_follows = i + 1 < names.size() && parse_index(names[i + 1]);
        // The list of one [[constraint]] is a single [constraint].
        if (place->kind == TomlValue::Kind::array && !index && i > 0 && place->elements.size() == 1 &&
            place->elements[0].kind == TomlValue::Kind::table)
          place = &place->elements[0];
        if (place->kind == TomlValue::Kind::array)
        {
          if (!index || *index > place->elements.size())
          {
            diagnostics.error(
              where,
              fmt::format("'{}' is a list of {}: its entries are numbered from 0, not called '{}'", so_far, place->elements.size(), name),
              MessageName("bad-setting"));
            return nullptr;
          }
          if (*index == place->elements.size())
          {
            place->elements.emplace_back();
            relocate(place->elements.back(), where);
          }
          place = &place->elements[*index];
        }
        else if (place->kind == TomlValue::Kind::table && index == 0u && i > 0 && place->find(name) == nullptr)
        {
          // A single [constraint] is the list of one.
        }
        else if (place->kind == TomlValue::Kind::table)
        {
          TomlValue *entry = place->find(name);
          if (entry == nullptr)
          {
            TomlValue created;
            created.kind = index_follows ? TomlValue::Kind::array : TomlValue::Kind::table;
            relocate(created, where);
            place->entries.push_back({name, where, std::move(created)});
            entry = &place->entries.back().value;
          }
          place = entry;
        }
        else
        {
          diagnostics.error(where, fmt::format("'{}' is {}, it has no entry '{}'", so_far, place->kind_name(), name),
                            MessageName("bad-setting"));
          return nullptr;
        }
        so_far += (i > 0 ? "." : "") + name;
      }

      return place;
    }
  } // namespace

  const TomlValue *value_at(const TomlValue &document, const std::string &path)
  {
    const TomlValue *place = &document;
    for (const std::string &name : split_path(path))
    {
      const auto index = parse_index(name);
      if (place->kind == TomlValue::Kind::array && !index && place->elements.size() == 1)
        place = &place->elements[0];
      if (place->kind == TomlValue::Kind::array)
        place = index && *index < place->elements.size() ? &place->elements[*index] : nullptr;
      else if (place->kind == TomlValue::Kind::table && (index != 0u || place == &document || place->find(name)))
        place = place->find(name); // else a single [constraint], which is the list of one
      else if (place->kind != TomlValue::Kind::table)
        place = nullptr;
      if (!place)
        return nullptr;
    }
    return place;
  }

  void
  set_value(TomlValue &document, const std::string &path, const TomlValue &value, const SourceLocation &where, Diagnostics &diagnostics)
  {
    if (TomlValue *const place = place_at(document, path, where, diagnostics))
      *place = value;
  }

  void set_value(TomlValue &document, const Override &assignment, Diagnostics &diagnostics)
  {
    const auto &[path, text] = assignment;
    const SourceLocation where{"--set " + path, 0, 0};
    if (const TomlValue *const parameters = document.find("parameters"); parameters && !document.find(path) && parameters->find(path))
    {
      diagnostics.error(where, fmt::format("the case has no key '{0}', but a parameter of this name: write parameters.{0}", path),
                        MessageName("unknown-key"));
      return;
    }
    TomlValue *const place = place_at(document, path, where, diagnostics);
    if (!place)
      return;
    if (auto value = parse_lone_value(text))
      *place = std::move(*value);
    else
    {
      *place = {};
      place->kind = TomlValue::Kind::string;
      place->string = text;
    }
    relocate(*place, where);
  }
} // namespace unilateral
