#include "unilateral/inequality/method.h"

#include <array>
#include <utility>

namespace unilateral
{
  namespace
  {
    constexpr std::array<std::pair<Method::Solver, const char *>, 4> solver_names = {{{Method::Solver::automatic, "auto"},
                                                                                      {Method::Solver::direct, "direct"},
                                                                                      {Method::Solver::amg, "amg"},
                                                                                      {Method::Solver::multigrid, "multigrid"}}};
  }

  std::string name_of(const Method::Solver solver)
  {
    for (const auto &[known, name] : solver_names)
      if (known == solver)
        return name;
    return "";
  }

  std::optional<Method::Solver> solver_called(const std::string &name)
  {
    for (const auto &[solver, known] : solver_names)
      if (known == name)
        return solver;
    return {};
  }
} // namespace unilateral
