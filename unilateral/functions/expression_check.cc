// Reads an expression as a person would and says in words what is wrong with it, before muParser sees it.

#include "unilateral/functions/expression.h"
#include "unilateral/functions/expression_functions.h"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <charconv>
#include <utility>

namespace unilateral
{
  namespace
  {
    constexpr std::size_t max_length = 10000; ///< muParser has a limit of its own, of twice that
    constexpr std::size_t max_name_length = 100;

    struct Token
    {
      enum class Kind
      {
        number,
        name,
        operation,
        open,
        close,
        comma,
        question,
        colon,
        end
      };
      Kind        kind = Kind::end;
      std::size_t at = 0;
      std::string text;
    };

    bool begins_name(const char c)
    {
      return std::isalpha(static_cast<unsigned char>(c)) || c == '_';
    }
    bool continues_name(const char c)
    {
      return begins_name(c) || std::isdigit(static_cast<unsigned char>(c));
    }
    bool is_digit(const char c)
    {
      return std::isdigit(static_cast<unsigned char>(c));
    }

    /// Line and column of byte @p at of the text of @p spec.
    SourceLocation place_in(const FieldSpec &spec, const std::size_t at)
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
      for (std::size_t i = 0; i < at && i < spec.text.size(); ++i)
        if (spec.text[i] == '\n')
        {
          ++place.line;
          place.column = 1;
        }
        else if ((static_cast<unsigned char>(spec.text[i]) & 0xc0) != 0x80) // columns count characters, not bytes
          ++place.column;
      return place;
    }

    /// An open parenthesis, or the whole expression.
    struct Frame
    {
      std::size_t               at = 0;
      const ExpressionFunction *function = nullptr;
      bool                      call = false; ///< of a function, known or not
      unsigned                  n_arguments = 0;
      unsigned                  n_questions = 0;        ///< `?` without their `:` so far
      std::size_t               question_at = 0;        ///< the last of them
      bool                      has_comparison = false; ///< since the last &&, ||, ?, : or comma
    };

    class Checker
    {
    public:
      Checker(const FieldSpec &spec, const std::vector<Parameter> &parameters, const unsigned dim, Diagnostics &diagnostics)
        : spec(spec), text(spec.text), parameters(parameters), dim(dim), diagnostics(diagnostics)
      {
      }

      std::vector<std::string> run()
      {
        if (text.size() > max_length)
          diagnostics.error(spec.where,
                            fmt::format("an expression of more than {} characters; name its pieces in [parameters]", max_length));
        else
          check();
        return used;
      }

    private:
      /// Reports a fault after which reading on makes no sense.
      bool fault(const std::size_t at, std::string message)
      {
        diagnostics.error(place_in(spec, at), std::move(message));
        return false;
      }

      /// Reports a fault that leaves the rest readable.
      void remark(const std::size_t at, std::string message) { diagnostics.error(place_in(spec, at), std::move(message)); }

      bool next_token(Token &token)
      {
        while (position < text.size() && std::isspace(static_cast<unsigned char>(text[position])))
          ++position;
        token.at = position;
        token.text.clear();
        if (position >= text.size())
        {
          token.kind = Token::Kind::end;
          return true;
        }
        const char c = text[position];
        if (is_digit(c) || (c == '.' && position + 1 < text.size() && is_digit(text[position + 1])))
          return next_number(token);
        if (begins_name(c))
        {
          while (position < text.size() && continues_name(text[position]))
            token.text += text[position++];
          token.kind = Token::Kind::name;
          if (token.text.size() > max_name_length)
            return fault(token.at, fmt::format("a name of more than {} letters in expression", max_name_length));
          return true;
        }
        return next_sign(token);
      }

      bool next_number(Token &token)
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
        token.kind = Token::Kind::number;
        token.text = text.substr(token.at, position - token.at);
        double value = 0;
        if (std::from_chars(token.text.data(), token.text.data() + token.text.size(), value).ec == std::errc::result_out_of_range)
          return fault(token.at, fmt::format("number {} in expression is out of range", token.text));
        return true;
      }

      bool next_sign(Token &token)
      {
        const char        c = text[position];
        const std::string two = text.substr(position, 2);
        if (two == "**")
          return fault(token.at, "unexpected '**' in expression; a power is written a^b");
        for (const char *const operation : {"<=", ">=", "==", "!=", "&&", "||"})
          if (two == operation)
          {
            token.kind = Token::Kind::operation;
            token.text = two;
            position += 2;
            return true;
          }
        switch (c)
        {
        case '(':
          token.kind = Token::Kind::open;
          break;
        case ')':
          token.kind = Token::Kind::close;
          break;
        case ',':
          token.kind = Token::Kind::comma;
          break;
        case '?':
          token.kind = Token::Kind::question;
          break;
        case ':':
          token.kind = Token::Kind::colon;
          break;
        case '+':
        case '-':
        case '*':
        case '/':
        case '^':
        case '<':
        case '>':
          token.kind = Token::Kind::operation;
          break;
        case '=':
          return fault(token.at, "unexpected '=' in expression; to compare, write ==");
        case '%':
          return fault(token.at, "unexpected '%' in expression; the remainder is mod(a, b)");
        case '&':
        case '|':
          return fault(token.at, fmt::format("unexpected '{0}' in expression; write {0}{0}", c));
        case '!':
          return fault(token.at, "unexpected '!' in expression; write a == 0 for 'not a'");
        case '[':
        case ']':
        case '{':
        case '}':
          return fault(token.at, fmt::format("unexpected '{}' in expression; group with ( and )", c));
        default:
          return fault(token.at, fmt::format("unexpected {} in expression", printable(token.at)));
        }
        token.text = std::string(1, c);
        ++position;
        return true;
      }

      /// The character at @p at in quotes, whole when it is of several bytes.
      std::string printable(const std::size_t at) const
      {
        std::size_t end = at + 1;
        while (end < text.size() && (static_cast<unsigned char>(text[end]) & 0xc0) == 0x80)
          ++end;
        const unsigned char c = static_cast<unsigned char>(text[at]);
        if (c < 0x20 || c == 0x7f)
          return fmt::format("control character {}", static_cast<unsigned>(c));
        return "'" + text.substr(at, end - at) + "'";
      }

      static std::string name_of(const Token &token)
      {
        return token.kind == Token::Kind::end ? "the end of the expression" : "'" + token.text + "'";
      }

      bool is_parameter(const std::string &name) const
      {
        return std::any_of(parameters.begin(), parameters.end(), [&](const Parameter &p) { return p.name == name; });
      }

      bool is_constant(const std::string &name) const
      {
        const auto &constants = expression_constants();
        return std::any_of(constants.begin(), constants.end(), [&](const auto &constant) { return constant.first == name; });
      }

      bool is_coordinate(const std::string &name) const
      {
        return name.size() == 1 && name[0] >= 'x' && name[0] <= 'z' && unsigned(name[0] - 'x') < dim;
      }

      void check_function_name(const Token &name)
      {
        if (find_function(name.text))
          return;
        if (is_parameter(name.text) || is_constant(name.text) || is_coordinate(name.text))
          remark(name.at, fmt::format("'{0}' is not a function; to multiply, write {0}*(...)", name.text));
        else
          remark(name.at, fmt::format("unknown function '{}' in expression{}", name.text, suggestion(name.text, function_names())));
      }

      void check_variable_name(const Token &name)
      {
        if (is_coordinate(name.text) || is_parameter(name.text))
        {
          if (std::find(used.begin(), used.end(), name.text) == used.end())
            used.push_back(name.text);
          return;
        }
        if (is_constant(name.text))
          return;
        if (find_function(name.text))
        {
          remark(name.at, fmt::format("'{0}' is a function; write {0}(...)", name.text));
          return;
        }
        if (name.text == "y" || name.text == "z")
        {
          remark(name.at,
                 fmt::format("unknown name '{}' in expression; a {}-D mesh has only {}", name.text, dim, dim == 1 ? "x" : "x and y"));
          return;
        }
        std::vector<std::string> known;
        for (unsigned d = 0; d < dim; ++d)
          known.emplace_back(1, static_cast<char>('x' + d));
        for (const auto &constant : expression_constants())
          known.push_back(constant.first);
        for (const Parameter &parameter : parameters)
          known.push_back(parameter.name);
        remark(name.at, fmt::format("unknown name '{}' in expression{}", name.text, suggestion(name.text, known)));
      }

      bool close_frame(const std::vector<Frame> &frames)
      {
        const Frame &frame = frames.back();
        if (frame.n_questions > 0)
          return fault(frame.question_at, "'?' without its ':' in expression; a choice is written c ? a : b");
        return true;
      }

      void check()
      {
        std::vector<Frame> frames(1);
        bool               operand_expected = true;
        Token              token, previous;
        for (;; previous = token)
        {
          if (!next_token(token))
            return;
          const bool go_on = operand_expected ? read_operand(token, previous, frames, operand_expected)
                                              : read_operator(token, previous, frames, operand_expected);
          if (!go_on || token.kind == Token::Kind::end)
            return;
        }
      }

      bool read_operand(Token &token, const Token &previous, std::vector<Frame> &frames, bool &operand_expected)
      {
        const bool after_sign = std::exchange(this->after_sign, false);
        switch (token.kind)
        {
        case Token::Kind::number:
          operand_expected = false;
          return true;
        case Token::Kind::name:
        {
          const Token name = token;
          std::size_t ahead = position;
          while (ahead < text.size() && std::isspace(static_cast<unsigned char>(text[ahead])))
            ++ahead;
          if (ahead >= text.size() || text[ahead] != '(')
          {
            check_variable_name(name);
            operand_expected = false;
            return true;
          }
          check_function_name(name);
          next_token(token);
          Frame frame;
          frame.at = name.at;
          frame.call = true;
          frame.function = find_function(name.text);
          frames.push_back(frame);
          return true;
        }
        case Token::Kind::open:
          frames.emplace_back();
          frames.back().at = token.at;
          return true;
        case Token::Kind::operation:
          if (token.text != "-" && token.text != "+")
            break;
          if (after_sign)
            return fault(token.at, fmt::format("two signs in a row in expression; write {}({}...)", previous.text, token.text));
          this->after_sign = true;
          return true;
        case Token::Kind::close:
          if (frames.size() > 1 && frames.back().call && previous.kind == Token::Kind::open)
          {
            // f(): no arguments
            if (frames.back().function)
              remark(frames.back().at, fmt::format("'{}' takes {}, not 0", frames.back().function->name, frames.back().function->arity()));
            frames.pop_back();
            operand_expected = false;
            return true;
          }
          break;
        default:
          break;
        }
        if (token.kind == Token::Kind::end && previous.kind == Token::Kind::end)
          return fault(0, "empty expression");
        if (previous.kind == Token::Kind::end)
          return fault(token.at, fmt::format("{} at the beginning of the expression", name_of(token)));
        return fault(token.at,
                     fmt::format("{} after '{}' in expression: a number, a name or '(' is missing", name_of(token), previous.text));
      }

      bool read_operator(const Token &token, const Token &previous, std::vector<Frame> &frames, bool &operand_expected)
      {
        Frame &frame = frames.back();
        after_sign = false;
        switch (token.kind)
        {
        case Token::Kind::operation:
          operand_expected = true;
          if (token.text == "&&" || token.text == "||")
            frame.has_comparison = false;
          else if (token.text[0] == '<' || token.text[0] == '>' || token.text[0] == '=' || token.text[0] == '!')
          {
            if (frame.has_comparison)
              remark(token.at, fmt::format("'{}' compares the outcome of a comparison; write a < b && b < c for a < b < c", token.text));
            frame.has_comparison = true;
          }
          return true;
        case Token::Kind::question:
          ++frame.n_questions;
          frame.question_at = token.at;
          frame.has_comparison = false;
          operand_expected = true;
          return true;
        case Token::Kind::colon:
          if (frame.n_questions == 0)
            return fault(token.at, "':' without '?' in expression; a choice is written c ? a : b");
          --frame.n_questions;
          frame.has_comparison = false;
          operand_expected = true;
          return true;
        case Token::Kind::comma:
          if (!frame.call)
            return fault(token.at, "unexpected ',' in expression; a decimal point is '.', and only functions take several arguments");
          if (!close_frame(frames))
            return false;
          ++frame.n_arguments;
          frame.has_comparison = false;
          operand_expected = true;
          return true;
        case Token::Kind::close:
          if (frames.size() == 1)
            return fault(token.at, "')' without '(' in expression");
          if (!close_frame(frames))
            return false;
          if (frame.function && !frame.function->takes(frame.n_arguments + 1))
            remark(frame.at, fmt::format("'{}' takes {}, not {}", frame.function->name, frame.function->arity(), frame.n_arguments + 1));
          frames.pop_back();
          return true;
        case Token::Kind::end:
          if (frames.size() > 1)
            return fault(frame.at, "'(' without ')' in expression");
          return close_frame(frames);
        default:
          return fault(token.at, fmt::format("operator missing between '{}' and '{}' in expression", previous.text, token.text));
        }
      }

      const FieldSpec              &spec;
      const std::string            &text;
      const std::vector<Parameter> &parameters;
      const unsigned                dim;
      Diagnostics                  &diagnostics;
      std::vector<std::string>      used;
      std::size_t                   position = 0;
      bool                          after_sign = false;
    };
  } // namespace

  std::vector<std::string>
  check_expression(const FieldSpec &spec, const std::vector<Parameter> &parameters, const unsigned dim, Diagnostics &diagnostics)
  {
    return Checker(spec, parameters, dim, diagnostics).run();
  }

  std::vector<std::string> function_names()
  {
    std::vector<std::string> names;
    for (const ExpressionFunction &function : expression_functions())
      names.push_back(function.name);
    return names;
  }
} // namespace unilateral
