#include "unilateral/discretisation/tensor_numbering.h"

#include <algorithm>
#include <cmath>

namespace unilateral
{
  using namespace dealii;

  template <int dim>
  TensorNumbering<dim>::TensorNumbering(const FiniteElement<dim> &fe, const unsigned degree)
    : degree(degree), n_components(fe.n_components()), element_index(fe.n_dofs_per_cell()), position(fe.n_dofs_per_cell())
  {
    // The coordinates of nodes in one direction.
    std::vector<double> nodes;
    for (unsigned i = 0; i < fe.n_dofs_per_cell(); ++i)
    {
      const double x = fe.unit_support_point(i)[0];
      if (std::none_of(nodes.begin(), nodes.end(), [&](const double node) { return std::abs(node - x) < 1e-8; }))
        nodes.push_back(x);
    }
    std::sort(nodes.begin(), nodes.end());
    for (unsigned i = 0; i < fe.n_dofs_per_cell(); ++i)
    {
      unsigned number = 0;
      for (unsigned d = dim; d-- > 0;)
      {
        position[i][d] = std::lower_bound(nodes.begin(), nodes.end(), fe.unit_support_point(i)[d] - 1e-8) - nodes.begin();
        number = number * (degree + 1) + position[i][d];
      }
      element_index[number * n_components + fe.system_to_component_index(i).first] = i;
    }
  }

  template <int dim>
  CellOperator::PatchShape patch_shape(const TensorNumbering<dim> &numbering, const unsigned n_levels)
  {
    CellOperator::PatchShape shape;
    const unsigned           p = numbering.degree, n_components = numbering.n_components;
    shape.n_cell_dofs = numbering.element_index.size();
    shape.n_cells = 1u << (dim * n_levels);
    const unsigned n_nodes = p * (1u << n_levels) + 1;
    shape.n_patch_dofs = std::pow(n_nodes, dim) * n_components;
    for (unsigned cell = 0; cell < shape.n_cells; ++cell)
    {
      // Bit d of the child at each level of refinement is its place in direction d.
      std::array<unsigned, dim> corner{};
      for (unsigned l = 0; l < n_levels; ++l)
        for (unsigned d = 0; d < dim; ++d)
          corner[d] += (cell >> (dim * l + d) & 1u) << l;
      for (unsigned i = 0; i < shape.n_cell_dofs; ++i)
      {
        unsigned node = i / n_components, number = 0, stride = 1;
        for (unsigned d = 0; d < dim; ++d)
        {
          number += stride * (corner[d] * p + node % (p + 1));
          stride *= n_nodes;
          node /= p + 1;
        }
        shape.cell_dofs.push_back(number * n_components + i % n_components);
      }
    }
    return shape;
  }

  template <int dim>
  unsigned levels_of_patch(const unsigned level, const unsigned degree, const unsigned n_components)
  {
    constexpr double most_unknowns = 260;
    unsigned         levels = std::min(level, 1u);
    while (levels < std::min(level, 3u) && n_components * std::pow((2u << levels) * degree + 1, dim) <= most_unknowns)
      ++levels;
    return levels;
  }

#define INSTANTIATE(dim)                                                                                                                   \
  template class TensorNumbering<dim>;                                                                                                     \
  template CellOperator::PatchShape patch_shape(const TensorNumbering<dim> &, unsigned);                                                   \
  template unsigned                 levels_of_patch<dim>(unsigned, unsigned, unsigned);
  INSTANTIATE(1)
  INSTANTIATE(2)
  INSTANTIATE(3)
#undef INSTANTIATE
} // namespace unilateral
