// Errors and warnings about what the user wrote, each with its place and a remedy.
#pragma once

#include <exception>
#include <string>
#include <utility>
#include <vector>

namespace unilateral
{
  /// A place in a text file; line and column count from 1, 0 means "no place".
  struct SourceLocation
  {
    std::string file;
    unsigned    line = 0;
    unsigned    column = 0;
  };

  enum class Severity
  {
    error,
    warning,
    note
  };

  /// What kind of message it is: `unilateral explain NAME` tells its cause and remedy (case/explanations.h). A type of its own, so that no
  /// text is taken for it.
  struct MessageName
  {
    MessageName() = default;
    explicit MessageName(const char *const name) : text(name) {}
    explicit MessageName(std::string name) : text(std::move(name)) {}

    std::string text; ///< "" for none
  };

  /// One message, printed as `file:line:column: error: message [name]`.
  struct Diagnostic
  {
    SourceLocation where;
    Severity       severity = Severity::error;
    std::string    message;
    MessageName    name = {};
  };

  std::string to_string(const Diagnostic &diagnostic);

  /// Collects messages so that the user sees all of them in one go.
  class Diagnostics
  {
  public:
    void error(const SourceLocation &where, std::string message, MessageName name = {});
    void warning(const SourceLocation &where, std::string message, MessageName name = {});
    void note(const SourceLocation &where, std::string message, MessageName name = {});

    /// Those of somebody else, each as an error at its place.
    void add_errors(const std::vector<Diagnostic> &found);

    bool                           has_errors() const;
    const std::vector<Diagnostic> &all() const { return entries; }

    /// Throws InputError with everything collected so far, sorted by place, when there is an error among it.
    void throw_if_errors() const;

  private:
    std::vector<Diagnostic> entries;
  };

  /// In the order of the text; what has no place last.
  std::vector<Diagnostic> sorted_by_place(std::vector<Diagnostic> diagnostics);

  /// Bad input: exit code 2. what() is all messages, a line each.
  class InputError : public std::exception
  {
  public:
    explicit InputError(std::vector<Diagnostic> diagnostics);
    InputError(const SourceLocation &where, std::string message, MessageName name = {});

    const char *what() const noexcept override { return text.c_str(); }

    std::vector<Diagnostic> diagnostics;

  private:
    std::string text;
  };

  /// The candidate nearest to @p word in edit distance, or "" when none is near enough to be a slip of the pen.
  std::string did_you_mean(const std::string &word, const std::vector<std::string> &candidates);

  /// "; did you mean 'x'?" when a candidate is near, else "; known: a, b, c".
  std::string suggestion(const std::string &word, const std::vector<std::string> &candidates);

  /// For short lists that are always worth showing: "; did you mean 'x'? Parts: a, b, x", or "; parts: a, b, x" when none is near.
  /// @p title is the word before the list, "parts".
  std::string suggestion_with_list(const std::string &word, const std::vector<std::string> &candidates, const std::string &title);
} // namespace unilateral
