// Tables of numbers for papers.
#pragma once

#include <string>

namespace unilateral
{
  /// A table of a CSV file (RFC 4180, first line: names of the columns) as a LaTeX tabular with the rules of the package booktabs: whole
  /// numbers as they are, others with four digits, names in typewriter type. What means something to TeX is escaped.
  std::string latex_table(const std::string &csv);
} // namespace unilateral
