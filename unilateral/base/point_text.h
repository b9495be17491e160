// Points in messages.
#pragma once

#include <deal.II/base/point.h>

#include <fmt/format.h>

#include <string>

namespace unilateral
{
  /// "(0.25, -1)"
  template <int dim>
  std::string point_text(const dealii::Point<dim> &p, const int n_digits = 6)
  {
    std::string text = "(";
    for (unsigned d = 0; d < dim; ++d)
      text += fmt::format("{}{:.{}g}", d ? ", " : "", p[d], n_digits);
    return text + ")";
  }
} // namespace unilateral
