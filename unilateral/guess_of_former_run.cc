#include "unilateral/guess_of_former_run.h"

#include "unilateral/solution_functions.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <map>
#include <optional>
#include <string>
#include <vector>

namespace unilateral
{
  namespace
  {
    std::string name_of_function(const std::size_t k)
    {
      return k == 0 ? "u" : fmt::format("pressure{}", k - 1);
    }
  } // namespace

  template <int dim>
  std::shared_ptr<const CellFunctions> guess_on_cells(const Solution<dim> &solution)
  {
    const auto guess = guess_from(*solution.problem, solution.constraint_set, solution.displacement, solution.contact_pressure);
    std::map<std::string, const Vector *> functions;
    for (std::size_t k = 0; k < guess.functions.size(); ++k)
      functions[name_of_function(k)] = &guess.functions[k];
    return functions_on_cells(solution.problem->space, functions);
  }

  template <int dim>
  StartingGuess guess_of(const FormerLevel &former, const Problem<dim> &problem, const std::size_t n_blocks)
  {
    const auto     running = problem.time_by_part.run("guess");
    const auto    &space = problem.space;
    const unsigned n_components = space.fe->n_components();
    const auto     names = former.functions->names();
    // [k * n_components + c]: where component c of function k is among the values at a point.
    std::vector<std::size_t> place;
    for (std::size_t k = 0; k <= n_blocks; ++k)
      for (unsigned c = 0; c < n_components; ++c)
      {
        const auto name = std::find(names.begin(), names.end(), component_name(name_of_function(k), c, n_components));
        if (name == names.end())
          return {};
        place.push_back(name - names.begin());
      }
    StartingGuess guess;
    guess.functions.assign(n_blocks + 1, Vector(space.dof_handler.n_dofs()));
    std::vector<double>               values(names.size());
    std::optional<dealii::Point<dim>> last; // components of one node follow each other
    bool                              has_values = false;
    for (const auto &node : space.nodal_values())
    {
      if (last != node.x)
      {
        std::array<double, 3> x{};
        for (unsigned d = 0; d < dim; ++d)
          x[d] = node.x[d];
        has_values = former.functions->values_at(x, values);
        last = node.x;
      }
      for (std::size_t k = 0; k <= n_blocks && has_values; ++k)
        guess.functions[k](node.dof) = values[place[k * n_components + node.component]];
    }
    return guess;
  }

#define INSTANTIATE(dim)                                                                                                                   \
  template std::shared_ptr<const CellFunctions> guess_on_cells(const Solution<dim> &);                                                     \
  template StartingGuess                        guess_of(const FormerLevel &, const Problem<dim> &, std::size_t);
  INSTANTIATE(1)
  INSTANTIATE(2)
  INSTANTIATE(3)
#undef INSTANTIATE
} // namespace unilateral
