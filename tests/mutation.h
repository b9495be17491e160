// Bytes changed at random, the same for the same seed everywhere.
#pragma once

#include <cstddef>
#include <random>
#include <string>
#include <vector>

namespace mutation
{
  using Random = std::mt19937_64;

  /// std::uniform_int_distribution differs between libraries.
  inline std::size_t below(Random &random, const std::size_t n)
  {
    return static_cast<std::size_t>(random() % n);
  }

  /// One to @p most changes: other bytes, bits, holes, copies from elsewhere, repetitions, and @p pieces that mean something to the reader.
  inline std::string mutate(std::string text, Random &random, const std::vector<std::string> &pieces, const std::size_t most = 3)
  {
    const std::size_t n_changes = 1 + below(random, most);
    for (std::size_t change = 0; change < n_changes; ++change)
    {
      const std::size_t at = below(random, text.size() + 1);
      switch (below(random, 8))
      {
      case 0: // another byte
        if (at < text.size())
          text[at] = static_cast<char>(random());
        break;
      case 1: // a bit
        if (at < text.size())
          text[at] ^= static_cast<char>(1u << below(random, 8));
        break;
      case 2: // something that means something
        text.insert(at, pieces[below(random, pieces.size())]);
        break;
      case 3: // a hole
        text.erase(at, 1 + below(random, 20));
        break;
      case 4: // a copy from elsewhere
        text.insert(at, text.substr(below(random, text.size() + 1), 1 + below(random, 60)));
        break;
      case 5: // the same again
        text.insert(at, std::string(1 + below(random, 40), at < text.size() ? text[at] : '('));
        break;
      }
    }
    return text;
  }

  /// What means something in a case file.
  inline const std::vector<std::string> &pieces_of_cases()
  {
    static const std::vector<std::string> pieces = {"\"",
                                                    "'''",
                                                    "\"\"\"",
                                                    "[",
                                                    "]",
                                                    "[[",
                                                    "]]",
                                                    "{",
                                                    "}",
                                                    "=",
                                                    "\n",
                                                    "\r\n",
                                                    ".",
                                                    ",",
                                                    "#",
                                                    "\\",
                                                    "-",
                                                    "1e9",
                                                    "inf",
                                                    "nan",
                                                    "0x7",
                                                    "99999999999999999999",
                                                    "(",
                                                    ")",
                                                    "((((",
                                                    "?",
                                                    ":",
                                                    "&&",
                                                    "if(",
                                                    "max(",
                                                    "x",
                                                    "\t",
                                                    "\xc3\xa9",
                                                    "\xff",
                                                    "1e-400",
                                                    "..",
                                                    "refine = 20\n",
                                                    "cells = 100000\n",
                                                    "\\u0000",
                                                    "<",
                                                    ">=",
                                                    "^",
                                                    "*"};
    return pieces;
  }
} // namespace mutation
