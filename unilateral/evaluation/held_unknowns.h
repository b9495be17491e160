// At which unknowns supports hold a body, and which part of the boundary does.
#pragma once

#include "unilateral/discretisation/problem.h"

#include <map>
#include <vector>

namespace unilateral
{
  template <int dim>
  struct HeldUnknowns
  {
    explicit HeldUnknowns(const Problem<dim> &problem);

    std::vector<unsigned char> component; ///< of each unknown
    /// A support that couples components holds a node along a direction: what is missing at all its components. What acts at hanging nodes
    /// and at ties has been handed on, so that these are not held.
    std::vector<bool> is_held;
    /// Of unknowns on parts with supports: one of the parts, the first in the order of the mesh's names.
    std::map<unsigned, unsigned> part_of;

    /// Those that are held, by part, and all at the nodes of platens that something holds.
    std::map<unsigned, std::vector<dealii::types::global_dof_index>> by_part() const;

  private:
    void find_parts();

    const Problem<dim> &problem;
  };
} // namespace unilateral
