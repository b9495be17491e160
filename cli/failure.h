// How a command ends that does not come to its end.
#pragma once

#include "cli/console.h"

#include <exception>
#include <functional>

namespace unilateral
{
  struct Failure
  {
    int                            exit_code = 0;
    std::function<void(Console &)> show; ///< says what has happened
  };

  /// What an exception of any kind means; @p diagnostics: what was found before it.
  Failure failure_of(const std::exception_ptr &exception, const Diagnostics &diagnostics);

  Failure out_of_memory();

  /// A fault of the program; @p details are for the log alone.
  Failure internal_error(const std::string &text, const std::string &details = "");

  /// Of what a library throws when memory runs out, some say so in words only.
  bool is_shortage_of_memory(const std::exception &e);
} // namespace unilateral
