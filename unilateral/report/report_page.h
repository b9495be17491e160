// The script and the style sheet of reports, as report/page/ builds them.
#pragma once

#include <string_view>

namespace unilateral
{
  std::string_view report_script();
  std::string_view report_style();
} // namespace unilateral
