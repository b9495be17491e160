#include "unilateral/mesh/refinement_goal.h"

#include <regex>

namespace unilateral
{
  std::optional<RefinementGoal> refinement_goal(const std::string &text)
  {
    RefinementGoal goal;
    goal.name = text;
    static const std::regex path(R"(solution\.probes\.([0-9]{1,6})\.value(\.([0-2]))?)");
    if (std::smatch match; std::regex_match(text, match, path))
    {
      goal.kind = RefinementGoal::Kind::probe;
      goal.probe = std::stoul(match[1]);
      if (match[3].matched)
        goal.component = unsigned(std::stoul(match[3]));
      return goal;
    }
    if (text == "contact_force")
      goal.kind = RefinementGoal::Kind::contact_force;
    else if (text != "energy")
      return std::nullopt;
    return goal;
  }
} // namespace unilateral
