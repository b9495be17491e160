#include "unilateral/nested_iteration.h"

#include "unilateral/evaluation/nodal_pressure.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace unilateral
{
  template <int dim>
  StartingGuess guess_from(const Problem<dim> &problem, const ConstraintSet<dim> &constraint_set, const Vector &u, const Vector &lambda)
  {
    const auto    running = problem.time_by_part.run("guess");
    StartingGuess guess;
    guess.functions.push_back(u);
    for (const auto &block : constraint_set.blocks)
      guess.functions.push_back(nodal_pressure(problem, constraint_set, block, lambda));
    return guess;
  }

  template <int dim>
  bool have_same_points(const ConstraintSet<dim> &a, const ConstraintSet<dim> &b)
  {
    return std::equal(a.blocks.begin(), a.blocks.end(), b.blocks.begin(), b.blocks.end(),
                      [](const ConstraintBlock &x, const ConstraintBlock &y)
                      { return x.on == y.on && x.side == y.side && x.begin == y.begin && x.end == y.end; }) &&
           std::equal(a.points.begin(), a.points.end(), b.points.begin(), b.points.end(),
                      [](const ConstraintPoint<dim> &x, const ConstraintPoint<dim> &y) { return x.x == y.x && x.sign == y.sign; });
  }

  namespace
  {
    /// For each point the largest value (zero at least) at a point that two cells connect with it.
    template <int dim>
    Vector largest_nearby(const ConstraintSet<dim> &constraint_set, const Problem<dim> &problem, Vector values)
    {
      std::vector<double> negative(problem.space.dof_handler.n_dofs()); // at unknowns, since the least is what processes can agree on
      for (unsigned pass = 0; pass < 2; ++pass)
      {
        std::fill(negative.begin(), negative.end(), 0.);
        for (std::size_t i = 0; i < constraint_set.size(); ++i)
          for (const auto dof : constraint_set.trace[i].dofs)
            negative[dof] = std::min(negative[dof], -values(i));
        problem.space.shared().minimize(negative.data());
        for (std::size_t i = 0; i < constraint_set.size(); ++i)
          for (const auto dof : constraint_set.trace[i].dofs)
            values(i) = std::max(values(i), -negative[dof]);
      }
      return values;
    }

    /// Interpolation makes both too large: pressures reach one cell beyond the contact, and gaps open over a curved obstacle. The pressure
    /// that the local compliance makes of the gap weighs one against the other.
    std::vector<bool> contact_at_nodes(const DiscreteProblem &discrete, const double noise, const Vector &u, const Vector &lambda)
    {
      const Vector     &s = discrete.obstacle(), &tau = discrete.compliance();
      Vector            trace(lambda);
      std::vector<bool> contact(lambda.size());
      discrete.apply_trace(trace, u);
      for (std::size_t i = 0; i < contact.size(); ++i)
        contact[i] = lambda(i) > noise && lambda(i) * tau(i) + trace(i) - s(i) > 0;
      return contact;
    }

    /// There gaps say little, since they depend on the mesh: the contact ends where the pressure falls to one half.
    template <int dim>
    std::vector<bool>
    contact_away_from_nodes(const Problem<dim> &problem, const ConstraintSet<dim> &constraint_set, const double noise, const Vector &lambda)
    {
      const Vector      inside = largest_nearby(constraint_set, problem, lambda);
      std::vector<bool> contact(lambda.size());
      for (std::size_t i = 0; i < contact.size(); ++i)
        contact[i] = lambda(i) > noise && lambda(i) > 0.5 * inside(i);
      return contact;
    }
  } // namespace

  template <int dim>
  void start_from(StartingGuess            &guess,
                  const DiscreteProblem    &discrete,
                  const Problem<dim>       &problem,
                  const ConstraintSet<dim> &constraint_set,
                  Vector                   &u,
                  Vector                   &lambda)
  {
    const auto running = problem.time_by_part.run("guess");
    discrete.initialize_dof_vector(u);
    discrete.initialize_point_vector(lambda);
    guess.predicted_active.clear();
    if (guess.functions.empty())
      return;
    u.swap(guess.functions[0]);
    problem.space.dirichlet.set_zero(u);
    for (std::size_t b = 0; b < constraint_set.blocks.size(); ++b)
    {
      const Vector &pressure = guess.functions[b + 1];
      for (std::size_t i = constraint_set.blocks[b].begin; i < constraint_set.blocks[b].end; ++i)
      {
        const auto row = constraint_set.trace[i];
        for (std::size_t k = 0; k < row.dofs.size(); ++k)
          lambda(i) += row.values[k] * pressure(row.dofs[k]);
        lambda(i) = std::max(lambda(i), 0.);
      }
    }
    guess.functions.clear();
    const double noise = 1e-10 * discrete.largest(lambda);
    guess.predicted_active = constraint_set.at_nodes() ? contact_at_nodes(discrete, noise, u, lambda)
                                                       : contact_away_from_nodes(problem, constraint_set, noise, lambda);
  }

#define INSTANTIATE(dim)                                                                                                                   \
  template StartingGuess guess_from(const Problem<dim> &, const ConstraintSet<dim> &, const Vector &, const Vector &);                     \
  template bool          have_same_points(const ConstraintSet<dim> &, const ConstraintSet<dim> &);                                         \
  template void start_from(StartingGuess &, const DiscreteProblem &, const Problem<dim> &, const ConstraintSet<dim> &, Vector &, Vector &);
  INSTANTIATE(1)
  INSTANTIATE(2)
  INSTANTIATE(3)
#undef INSTANTIATE
} // namespace unilateral
