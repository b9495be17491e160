#include "unilateral/discretisation/shared_system.h"

#include "unilateral/discretisation/rigid_body_modes.h"

#include <algorithm>
#include <stdexcept>

namespace unilateral
{
  template <int dim>
  SharedSystem::SharedSystem(const Problem<dim> &problem, const ConstraintSet<dim> &constraint_set)
    : shared_unknowns(problem.space.shared())
  {
    B = ConstraintTrace(constraint_set, problem.space.dirichlet);
    null_vectors = modes_at_unknowns(problem, problem.null_space);
    modes = modes_at_unknowns(problem, problem.unsupported);
  }

  template <int dim>
  void SharedSystem::take_load(const Problem<dim> &problem, const dealii::Vector<double> &own)
  {
    f.reinit(own.size());
    std::copy(own.begin(), own.end(), f.begin());
    shared_unknowns.add(f.begin());
    problem.space.dirichlet.set_zero(f);
  }

  template <int dim>
  bool SharedSystem::take_bounds(const Problem<dim> &problem, const ConstraintSet<dim> &constraint_set)
  {
    ConstraintTrace trace(constraint_set, problem.space.dirichlet);
    if (processes().any(!trace.same_rows(B)))
      return false;
    B.obstacle.swap(trace.obstacle);
    return true;
  }

  void SharedSystem::set_tangent(const Vector &d)
  {
    if (!processes().any(!tangent_is_set || !std::equal(d.begin(), d.end(), tangent_diagonal.begin())))
      return;
    tangent_is_set = false; // should the factorisation, or that of a coarse level, throw
    tangent_diagonal = d;
    own_tangent_diagonal = d;
    for (std::size_t i = 0; i < d.size(); ++i)
      if (!B.owns(i))
        own_tangent_diagonal(i) = 0;
    change_tangent();
    tangent_is_set = true;
  }

  void SharedSystem::apply_gram(Vector &, const Vector &) const
  {
    throw std::logic_error("the Gram matrix is known to Assembled only");
  }

#define INSTANTIATE(dim)                                                                                                                   \
  template SharedSystem::SharedSystem(const Problem<dim> &, const ConstraintSet<dim> &);                                                   \
  template void SharedSystem::take_load(const Problem<dim> &, const dealii::Vector<double> &);                                             \
  template bool SharedSystem::take_bounds(const Problem<dim> &, const ConstraintSet<dim> &);
  INSTANTIATE(1)
  INSTANTIATE(2)
  INSTANTIATE(3)
#undef INSTANTIATE
} // namespace unilateral
