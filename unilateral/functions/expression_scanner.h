// The text of an expression as numbers, names and signs.
#pragma once

#include "unilateral/base/diagnostics.h"
#include "unilateral/functions/field_spec.h"

#include <string>

namespace unilateral
{
  struct ExpressionToken
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
    std::size_t at = 0; ///< position of the first byte
    std::string text;
    double      value = 0; ///< of a number
  };

  class ExpressionScanner
  {
  public:
    ExpressionScanner(const FieldSpec &spec, Diagnostics &diagnostics) : spec(spec), text(spec.text), diagnostics(diagnostics) {}

    /// Reads the next token. False after a fault, which is reported then.
    bool next(ExpressionToken &token);

    /// The next token is '('.
    bool open_follows() const;

    /// Reports an error at a byte of the text, by its line and column in the file.
    void error(std::size_t at, std::string message, MessageName name);

  private:
    bool           fault(std::size_t at, std::string message);
    bool           next_number(ExpressionToken &token);
    bool           next_sign(ExpressionToken &token);
    bool           reject_sign(std::size_t at);
    SourceLocation place_of(std::size_t at) const;
    std::string    printable(std::size_t at) const;

    const FieldSpec   &spec;
    const std::string &text;
    Diagnostics       &diagnostics;
    std::size_t        position = 0;
  };
} // namespace unilateral
