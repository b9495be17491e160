// What the names of messages and verdicts stand for, at length: `unilateral explain`.
#pragma once

#include <string>
#include <vector>

namespace unilateral
{
  struct Explanation
  {
    std::string name;    ///< as in brackets at the end of a message
    std::string sort;    ///< error, warning, verdict
    std::string summary; ///< one line
    std::string cause, example, remedy;
  };

  /// All of them, errors first.
  const std::vector<Explanation> &explanations();
} // namespace unilateral
