// A table of two columns as a function of x.
#pragma once

#include <string>
#include <vector>

namespace unilateral
{
  /// Piecewise linear through the rows (x, value) of a text file. Columns are separated by comma, semicolon or blanks; a first row without
  /// numbers is a header; empty lines and lines that begin with # are skipped; x increases from row to row.
  class Profile
  {
  public:
    /// Throws std::runtime_error with the reason and the line of the table.
    explicit Profile(const std::string &file);

    /// Throws std::domain_error when @p x is outside the table.
    double sample(double x) const;

    double spacing() const; ///< the least distance of two rows

  private:
    std::vector<double> positions, values;
  };
} // namespace unilateral
