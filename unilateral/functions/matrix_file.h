// A plain matrix of numbers in a text file.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

namespace unilateral
{
  struct NumberMatrix
  {
    std::size_t         n_columns = 0, n_rows = 0;
    std::vector<double> values; ///< row by row; NaN where the file says nan or has nothing between two commas
  };

  /// Rows of numbers, all of one length, separated by comma, semicolon, tab or blanks; empty lines and lines that begin with # are skipped.
  /// At most @p max_numbers. Throws std::runtime_error with the reason and the line.
  NumberMatrix read_matrix(const std::string &file, std::size_t max_numbers);
} // namespace unilateral
