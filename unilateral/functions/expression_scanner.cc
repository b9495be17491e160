#include "unilateral/functions/expression_scanner.h"

#include <fmt/format.h>

#include <cctype>
#include <charconv>
#include <string_view>

namespace unilateral
{
  namespace
  {
    using Kind = ExpressionToken::Kind;

    constexpr std::size_t max_name_length = 100;

    bool begins_name(const char c)
    {
      return std::isalpha(static_cast<unsigned char>(c)) || c == '_';
    }
    bool is_digit(const char c)
    {
      return std::isdigit(static_cast<unsigned char>(c));
    }
    bool is_space(const char c)
    {
      return std::isspace(static_cast<unsigned char>(c));
    }
    /// A byte within a character of UTF-8, behind its first.
    bool continues_character(const char c)
    {
      return (static_cast<unsigned char>(c) & 0xc0) == 0x80;
    }
  } // namespace

  SourceLocation ExpressionScanner::place_of(const std::size_t at) const
  {
    SourceLocation place = spec.where;
    if (place.line == 0)
      return place;
    if (at < spec.places.size())
    {
      place.line = spec.places[at].first;
      place.column = spec.places[at].second;
      return place;
    }
    for (std::size_t i = 0; i < at && i < text.size(); ++i)
      if (text[i] == '\n')
      {
        ++place.line;
        place.column = 1;
      }
      else if (!continues_character(text[i]))
        ++place.column;
    return place;
  }

  void ExpressionScanner::error(const std::size_t at, std::string message, MessageName name)
  {
    diagnostics.error(place_of(at), std::move(message), std::move(name));
  }

  bool ExpressionScanner::fault(const std::size_t at, std::string message)
  {
    error(at, std::move(message), MessageName("expression-syntax"));
    return false;
  }

  bool ExpressionScanner::open_follows() const
  {
    std::size_t ahead = position;
    while (ahead < text.size() && is_space(text[ahead]))
      ++ahead;
    return ahead < text.size() && text[ahead] == '(';
  }

  bool ExpressionScanner::next(ExpressionToken &token)
  {
    while (position < text.size() && is_space(text[position]))
      ++position;
    token = {Kind::end, position, "", 0};
    if (position >= text.size())
      return true;
    const char c = text[position];
    if (is_digit(c) || (c == '.' && position + 1 < text.size() && is_digit(text[position + 1])))
      return next_number(token);
    if (!begins_name(c))
      return next_sign(token);
    while (position < text.size() && (begins_name(text[position]) || is_digit(text[position])))
      token.text += text[position++];
    token.kind = Kind::name;
    if (token.text.size() > max_name_length)
      return fault(token.at, fmt::format("a name of more than {} letters in expression", max_name_length));
    return true;
  }

  bool ExpressionScanner::next_number(ExpressionToken &token)
  {
    const auto digits = [&]
    {
      while (position < text.size() && is_digit(text[position]))
        ++position;
    };
    digits();
    if (position < text.size() && text[position] == '.')
    {
      ++position;
      digits();
    }
    if (position < text.size() && (text[position] == 'e' || text[position] == 'E'))
    {
      const bool has_sign = position + 1 < text.size() && (text[position + 1] == '+' || text[position + 1] == '-');
      if (position + 1 + has_sign < text.size() && is_digit(text[position + 1 + has_sign]))
      {
        position += 1 + has_sign;
        digits();
      }
    }
    token.kind = Kind::number;
    token.text = text.substr(token.at, position - token.at);
    if (std::from_chars(token.text.data(), token.text.data() + token.text.size(), token.value).ec == std::errc::result_out_of_range)
      return fault(token.at, fmt::format("number {} in expression is out of range", token.text));
    return true;
  }

  bool ExpressionScanner::next_sign(ExpressionToken &token)
  {
    const auto take = [&](const Kind kind, const std::size_t length)
    {
      token.kind = kind;
      token.text = text.substr(position, length);
      position += length;
      return true;
    };
    const std::string two = text.substr(position, 2);
    if (two == "**")
      return fault(token.at, "unexpected '**' in expression; a power is written a^b");
    for (const char *const operation : {"<=", ">=", "==", "!=", "&&", "||"})
      if (two == operation)
        return take(Kind::operation, 2);
    switch (text[position])
    {
    case '(':
      return take(Kind::open, 1);
    case ')':
      return take(Kind::close, 1);
    case ',':
      return take(Kind::comma, 1);
    case '?':
      return take(Kind::question, 1);
    case ':':
      return take(Kind::colon, 1);
    default:
      if (std::string_view("+-*/^<>").find(text[position]) != std::string_view::npos)
        return take(Kind::operation, 1);
      return reject_sign(token.at);
    }
  }

  bool ExpressionScanner::reject_sign(const std::size_t at)
  {
    switch (const char c = text[at]; c)
    {
    case '=':
      return fault(at, "unexpected '=' in expression; to compare, write ==");
    case '%':
      return fault(at, "unexpected '%' in expression; the remainder is mod(a, b)");
    case '&':
    case '|':
      return fault(at, fmt::format("unexpected '{0}' in expression; write {0}{0}", c));
    case '!':
      return fault(at, "unexpected '!' in expression; write a == 0 for 'not a'");
    case '[':
    case ']':
    case '{':
    case '}':
      return fault(at, fmt::format("unexpected '{}' in expression; group with ( and )", c));
    default:
      return fault(at, fmt::format("unexpected {} in expression", printable(at)));
    }
  }

  /// The character at a byte in quotes, whole when it is of several bytes.
  std::string ExpressionScanner::printable(const std::size_t at) const
  {
    std::size_t end = at + 1;
    while (end < text.size() && continues_character(text[end]))
      ++end;
    const unsigned char c = static_cast<unsigned char>(text[at]);
    if (c < 0x20 || c == 0x7f)
      return fmt::format("control character {}", static_cast<unsigned>(c));
    return "'" + text.substr(at, end - at) + "'";
  }
} // namespace unilateral
