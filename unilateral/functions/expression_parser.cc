#include "unilateral/functions/expression_parser.h"

#include "unilateral/functions/expression_functions.h"
#include "unilateral/functions/expression_scanner.h"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

namespace unilateral
{
  namespace
  {
    using Token = ExpressionToken;
    using Operation = ExpressionCode::Operation;

    constexpr std::size_t max_length = 10000;

    /// An operator whose right operand is still being read. `?` waits for its `:`, and `:` for the end of the choice.
    struct PendingOperator
    {
      std::string text;
      unsigned    precedence = 0;
      bool        prefix = false;
    };

    /// 0 is that of a choice. A sign binds weaker than a power, -x^2 = -(x^2), but 2^-x is read.
    unsigned precedence_of(const std::string &operation)
    {
      if (operation == "||")
        return 1;
      if (operation == "&&")
        return 2;
      if (operation == "+" || operation == "-")
        return 4;
      if (operation == "*" || operation == "/")
        return 5;
      if (operation == "^")
        return 6;
      return 3;
    }
    constexpr unsigned precedence_of_sign = 5;

    /// An open parenthesis, or the whole expression.
    struct Frame
    {
      std::size_t                  at = 0;
      const ExpressionFunction    *function = nullptr;
      bool                         call = false; ///< of a function, known or not
      unsigned                     n_arguments = 0;
      unsigned                     n_questions = 0;        ///< `?` without their `:` so far
      std::size_t                  question_at = 0;        ///< the last of them
      bool                         has_comparison = false; ///< since the last &&, ||, ?, : or comma
      std::vector<PendingOperator> pending;
    };

    /// Operator precedence parsing with stacks of its own: nesting as deep as the text is long does not overflow the program's.
    class Parser
    {
    public:
      Parser(const FieldSpec                &spec,
             const std::vector<Parameter>   &parameters,
             const unsigned                  dim,
             Diagnostics                    &diagnostics,
             const std::vector<std::string> &quantities)
        : spec(spec), parameters(parameters), quantities(quantities), dim(dim), diagnostics(diagnostics), scanner(spec, diagnostics),
          frames(1)
      {
      }

      ParsedExpression run()
      {
        if (spec.text.size() > max_length)
        {
          diagnostics.error(spec.where,
                            fmt::format("an expression of more than {} characters; name its pieces in [parameters]", max_length),
                            MessageName("expression-syntax"));
          return {};
        }
        Token token;
        for (;; previous = token)
          if (!scanner.next(token) || !(operand_expected ? read_operand(token) : read_operator(token)) || token.kind == Token::Kind::end)
            return std::move(result);
      }

    private:
      /// Reports a fault after which reading on makes no sense.
      bool fault(const std::size_t at, std::string message)
      {
        remark(at, std::move(message));
        return false;
      }

      /// Reports a fault that leaves the rest readable, but not as a program.
      void remark(const std::size_t at, std::string message, MessageName name = MessageName("expression-syntax"))
      {
        scanner.error(at, std::move(message), std::move(name));
        faultless = false;
      }

      static std::string name_of(const Token &token)
      {
        return token.kind == Token::Kind::end ? "the end of the expression" : "'" + token.text + "'";
      }

      const Parameter *find_parameter(const std::string &name) const
      {
        const auto found = std::find_if(parameters.begin(), parameters.end(), [&](const Parameter &p) { return p.name == name; });
        return found == parameters.end() ? nullptr : &*found;
      }

      const std::string *find_quantity(const std::string &name) const
      {
        const auto found = std::find(quantities.begin(), quantities.end(), name);
        return found == quantities.end() ? nullptr : &*found;
      }

      static const double *find_constant(const std::string &name)
      {
        for (const auto &[known, value] : expression_constants())
          if (known == name)
            return &value;
        return nullptr;
      }

      bool is_coordinate(const std::string &name) const
      {
        return name.size() == 1 && name[0] >= 'x' && name[0] <= 'z' && unsigned(name[0] - 'x') < dim;
      }

      void check_function_name(const Token &name)
      {
        if (find_function(name.text))
          return;
        if (find_parameter(name.text) || find_constant(name.text) || is_coordinate(name.text) || find_quantity(name.text))
          remark(name.at, fmt::format("'{0}' is not a function; to multiply, write {0}*(...)", name.text));
        else
          remark(name.at, fmt::format("unknown function '{}' in expression{}", name.text, suggestion(name.text, function_names())),
                 MessageName("unknown-function"));
      }

      void read_variable(const Token &name)
      {
        const Parameter *const   parameter = find_parameter(name.text);
        const std::string *const quantity = find_quantity(name.text);
        if (parameter && quantity)
          remark(name.at, fmt::format("'{}' is a parameter and a quantity of the solution; call the parameter otherwise", name.text),
                 MessageName("parameter-name"));
        else if (is_coordinate(name.text) || parameter || quantity)
        {
          if (std::find(result.used.begin(), result.used.end(), name.text) == result.used.end())
            result.used.push_back(name.text);
          emit(
            [&]
            {
              result.code.variable(is_coordinate(name.text) ? name.text[0] - 'x'
                                   : parameter              ? 3 + (parameter - parameters.data())
                                                            : 3 + parameters.size() + (quantity - quantities.data()));
            });
        }
        else if (const double *const constant = find_constant(name.text))
          emit([&] { result.code.constant(*constant); });
        else if (find_function(name.text))
          remark(name.at, fmt::format("'{0}' is a function; write {0}(...)", name.text));
        else if (name.text == "y" || name.text == "z")
          remark(name.at,
                 fmt::format("unknown name '{}' in expression; a {}-D mesh has only {}", name.text, dim, dim == 1 ? "x" : "x and y"),
                 MessageName("unknown-name"));
        else
          remark(name.at, fmt::format("unknown name '{}' in expression{}", name.text, suggestion(name.text, known_names())),
                 MessageName("unknown-name"));
      }

      std::vector<std::string> known_names() const
      {
        std::vector<std::string> known;
        for (unsigned d = 0; d < dim; ++d)
          known.emplace_back(1, static_cast<char>('x' + d));
        for (const auto &constant : expression_constants())
          known.push_back(constant.first);
        for (const Parameter &parameter : parameters)
          known.push_back(parameter.name);
        known.insert(known.end(), quantities.begin(), quantities.end());
        return known;
      }

      /// Appends to the code; after a fault its operands are incomplete, and it is left alone.
      template <typename Append>
      void emit(const Append &append)
      {
        if (faultless)
          append();
      }

      void emit_operator(const PendingOperator &pending)
      {
        ExpressionCode &code = result.code;
        if (pending.prefix)
        {
          if (pending.text == "-")
            code.apply(Operation::negative);
        }
        else if (pending.text == "+")
          code.apply(Operation::plus);
        else if (pending.text == "-")
          code.apply(Operation::minus);
        else if (pending.text == "*")
          code.apply(Operation::times);
        else if (pending.text == "/")
          code.apply(Operation::divided_by);
        else if (pending.text == "^")
          code.call(*find_function("pow"), 2);
        else if (pending.text == ":")
          code.call(*find_function("if"), 3);
        else
          code.call(*find_comparison(pending.text), 2);
      }

      /// Emits the pending operators that bind at least as strongly.
      void reduce(const unsigned precedence)
      {
        auto &pending = frames.back().pending;
        while (!pending.empty() && pending.back().precedence >= precedence)
        {
          emit([&] { emit_operator(pending.back()); });
          pending.pop_back();
        }
      }

      /// The end of an argument, of a parenthesis or of the expression.
      bool end_operand()
      {
        const Frame &frame = frames.back();
        if (frame.n_questions > 0)
          return fault(frame.question_at, "'?' without its ':' in expression; a choice is written c ? a : b");
        reduce(0);
        return true;
      }

      bool read_operand(Token &token)
      {
        const bool after_sign = std::exchange(this->after_sign, false);
        switch (token.kind)
        {
        case Token::Kind::number:
          emit([&] { result.code.constant(token.value); });
          operand_expected = false;
          return true;
        case Token::Kind::name:
          if (scanner.open_follows())
            return open_call(token);
          read_variable(token);
          operand_expected = false;
          return true;
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
          frames.back().pending.push_back({token.text, precedence_of_sign, true});
          return true;
        case Token::Kind::close:
          if (frames.size() > 1 && frames.back().call && previous.kind == Token::Kind::open)
          {
            // f(): no arguments
            if (frames.back().function)
              remark(frames.back().at, fmt::format("'{}' takes {}, not 0", frames.back().function->name, frames.back().function->arity()),
                     MessageName("wrong-arguments"));
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

      /// The name of a function, and the parenthesis behind it, which @p token is then.
      bool open_call(Token &token)
      {
        check_function_name(token);
        Frame frame;
        frame.at = token.at;
        frame.call = true;
        frame.function = find_function(token.text);
        frames.push_back(std::move(frame));
        return scanner.next(token);
      }

      bool read_operator(const Token &token)
      {
        after_sign = false;
        switch (token.kind)
        {
        case Token::Kind::operation:
          read_binary(token);
          return true;
        case Token::Kind::question:
        case Token::Kind::colon:
          return read_choice(token);
        case Token::Kind::comma:
        {
          if (!frames.back().call)
            return fault(token.at, "unexpected ',' in expression; a decimal point is '.', and only functions take several arguments");
          if (!end_operand())
            return false;
          ++frames.back().n_arguments;
          frames.back().has_comparison = false;
          operand_expected = true;
          return true;
        }
        case Token::Kind::close:
          return close(token);
        case Token::Kind::end:
          if (frames.size() > 1)
            return fault(frames.back().at, "'(' without ')' in expression");
          return end_operand();
        default:
          return fault(token.at,
                       fmt::format("operator missing between '{}' and '{}' in expression{}", previous.text, token.text,
                                   previous.kind == Token::Kind::number && token.kind == Token::Kind::name
                                     ? "; if that is a unit, leave it out: numbers have none, and all quantities one system of units"
                                     : ""));
        }
      }

      void read_binary(const Token &token)
      {
        Frame &frame = frames.back();
        operand_expected = true;
        if (token.text == "&&" || token.text == "||")
          frame.has_comparison = false;
        else if (token.text[0] == '<' || token.text[0] == '>' || token.text[0] == '=' || token.text[0] == '!')
        {
          if (frame.has_comparison)
            remark(token.at, fmt::format("'{}' compares the outcome of a comparison; write a < b && b < c for a < b < c", token.text));
          frame.has_comparison = true;
        }
        const unsigned precedence = precedence_of(token.text);
        reduce(token.text == "^" ? precedence + 1 : precedence); // a^b^c = a^(b^c)
        frame.pending.push_back({token.text, precedence, false});
      }

      bool read_choice(const Token &token)
      {
        Frame     &frame = frames.back();
        const bool question = token.kind == Token::Kind::question;
        if (!question && frame.n_questions == 0)
          return fault(token.at, "':' without '?' in expression; a choice is written c ? a : b");
        reduce(1);
        if (question)
        {
          ++frame.n_questions;
          frame.question_at = token.at;
        }
        else
        {
          --frame.n_questions;
          // The choices that end here, and the `?` to which this `:` belongs.
          while (frame.pending.back().text == ":")
          {
            emit([&] { emit_operator(frame.pending.back()); });
            frame.pending.pop_back();
          }
          frame.pending.pop_back();
        }
        frame.pending.push_back({token.text, 0, false});
        frame.has_comparison = false;
        operand_expected = true;
        return true;
      }

      bool close(const Token &token)
      {
        if (frames.size() == 1)
          return fault(token.at, "')' without '(' in expression");
        if (!end_operand())
          return false;
        const Frame &frame = frames.back();
        if (const ExpressionFunction *const function = frame.function)
        {
          const unsigned n_arguments = frame.n_arguments + 1;
          if (!function->takes(n_arguments))
            remark(frame.at, fmt::format("'{}' takes {}, not {}", function->name, function->arity(), n_arguments),
                   MessageName("wrong-arguments"));
          emit([&] { result.code.call(*function, n_arguments); });
        }
        frames.pop_back();
        return true;
      }

      const FieldSpec                &spec;
      const std::vector<Parameter>   &parameters;
      const std::vector<std::string> &quantities;
      const unsigned                  dim;
      Diagnostics                    &diagnostics;
      ExpressionScanner               scanner;
      std::vector<Frame>              frames;
      Token                           previous;
      bool                            operand_expected = true;
      bool                            after_sign = false;
      bool                            faultless = true;
      ParsedExpression                result;
    };
  } // namespace

  ParsedExpression parse_expression(const FieldSpec                &spec,
                                    const std::vector<Parameter>   &parameters,
                                    const unsigned                  dim,
                                    Diagnostics                    &diagnostics,
                                    const std::vector<std::string> &quantities)
  {
    return Parser(spec, parameters, dim, diagnostics, quantities).run();
  }

  std::vector<std::string> function_names()
  {
    std::vector<std::string> names;
    for (const ExpressionFunction &function : expression_functions())
      names.push_back(function.name);
    return names;
  }
} // namespace unilateral
