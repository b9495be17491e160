// The manual pages unilateral(1) and unilateral-case(5), as roff text.
#pragma once

#include <string>

namespace unilateral
{
  /// @p page is "unilateral" or "unilateral-case".
  std::string manual_page(const std::string &page);
} // namespace unilateral
