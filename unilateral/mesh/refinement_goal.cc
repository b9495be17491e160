#include "unilateral/mesh/refinement_goal.h"

#include <regex>

namespace unilateral
{
  std::optional<RefinementGoal> refinement_goal(const std::string &text)
  {
    RefinementGoal goal;
    goal.name = text;
    static const std::regex probe(R"(solution\.probes\.([0-9]{1,6})\.value(\.([0-2]))?)"),
      reaction(R"(balance\.reactions\.([0-9]{1,6})\.force(\.([0-2])))");
    std::smatch match;
    const bool  is_probe = std::regex_match(text, match, probe);
    if (is_probe || std::regex_match(text, match, reaction))
    {
      goal.kind = is_probe ? RefinementGoal::Kind::probe : RefinementGoal::Kind::reaction;
      goal.number = std::stoul(match[1]);
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
