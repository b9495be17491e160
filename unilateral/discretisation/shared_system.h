// What the discretisations have in common whose matrices each of several processes has a part of.
#pragma once

#include "unilateral/discretisation/constrained_system.h"
#include "unilateral/discretisation/problem.h"

#include <deal.II/lac/vector.h>

namespace unilateral
{
  /// A is the sum over the processes of what their cells contribute; vectors have equal values at nodes on cuts. How the own part of A is
  /// stored, and how systems with the whole are solved, is left to the classes derived from it.
  class SharedSystem : public ConstrainedSystem
  {
  public:
    const SharedUnknowns &shared() const override { return shared_unknowns; }
    void                  apply_gram(Vector &Hu, const Vector &u) const override;
    std::size_t           n_operator_applications() const override { return applications; }

  protected:
    /// B, the modes, and the unknowns on cuts of the own part of @p problem.
    template <int dim>
    SharedSystem(const Problem<dim> &problem, const ConstraintSet<dim> &constraint_set);

    /// f, from what the own cells contribute.
    template <int dim>
    void take_load(const Problem<dim> &problem, const dealii::Vector<double> &own);

    /// Takes over the bounds where the rows of B are the same on all processes; else nothing has changed, and it returns false.
    template <int dim>
    bool take_bounds(const Problem<dim> &problem, const ConstraintSet<dim> &constraint_set);

    /// To be called before a system with D = diag(@p d) is solved. Calls change_tangent() where D is another one on any process.
    void         set_tangent(const Vector &d);
    virtual void change_tangent() = 0; ///< D is `own_tangent_diagonal` of all processes together

    SharedUnknowns      shared_unknowns;
    Vector              own_tangent_diagonal; ///< d; zero where another process owns the point
    mutable std::size_t applications = 0;

  private:
    Vector tangent_diagonal;
    bool   tangent_is_set = false;
  };
} // namespace unilateral
