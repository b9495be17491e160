#include "unilateral/discretisation/cell_systems.h"

#include <algorithm>
#include <map>
#include <utility>

namespace unilateral
{
  using namespace dealii;

  template <int dim>
  CellSystems<dim>::CellSystems(const Problem<dim> &problem, const CellNumbering<dim> &numbering)
    : problem(problem), numbering(numbering), shapes(shapes_for_systems(problem)), repeated_load(problem),
      values(*problem.space.mapping, *problem.space.fe, problem.cell_quadrature(), cell_flags(*problem.form)), n(numbering.size()),
      local_matrix(n, n), local_load(n)
  {
  }

  template <int dim>
  std::int32_t CellSystems<dim>::integrate(const Cell &cell)
  {
    element_index = &numbering.element_index(problem.space.corner_order(cell));
    const unsigned shape = shapes(cell);
    if (shape < matrix_of_shape.size() && repeated_load.varies_in(cell->material_id()))
    {
      repeated_load.integrate(cell, shape, local_load);
      keep_load();
      current_load = own_load.data();
      return matrix_of_shape[shape];
    }
    if (shape < matrix_of_shape.size())
    {
      current_load = load_of_shape.data() + shape * n;
      return matrix_of_shape[shape];
    }
    const std::int32_t number = compute(cell, shape != shapes.none);
    current_load = own_load.data();
    if (shape != shapes.none)
    {
      matrix_of_shape.push_back(number);
      load_of_shape.insert(load_of_shape.end(), own_load.begin(), own_load.end());
      repeated_load.add_shape(values);
    }
    return number;
  }

  template <int dim>
  std::int32_t CellSystems<dim>::compute(const Cell &cell, const bool repeats)
  {
    local_matrix = 0.;
    local_load = 0.;
    values.reinit(cell);
    problem.form->add_cell_terms(values, local_matrix, local_load);
    keep_load();
    if (numbering.simplex && repeats && problem.symmetric())
      if (const std::int32_t turned = find_turned(cell); turned >= 0)
        return turned;
    const std::int32_t number = matrices.size() / (n * n);
    if (!problem.symmetric())
    {
      FullMatrix<double> local_convection(n, n);
      problem.form->add_convection_terms(values, local_convection);
      local_matrix.add(-1, local_convection);
      append(convection, local_convection);
    }
    append(matrices, local_matrix);
    return number;
  }

  template <int dim>
  std::int32_t CellSystems<dim>::find_turned(const Cell &cell)
  {
    constexpr std::size_t most = 16; // the descendants of a cell follow each other
    constexpr double      tolerance = 1e-10;
    const CornerOrder    &order = problem.space.corner_order(cell);
    KnownSimplex          simplex{cell->material_id(), {}, std::int32_t(matrices.size() / (n * n))};
    double                size = 0;
    for (unsigned k = 0; k < dim; ++k)
    {
      simplex.edges[k] = cell->vertex(order[k + 1]) - cell->vertex(order[0]);
      size = std::max(size, simplex.edges[k].norm());
    }
    const auto congruent = [&](const KnownSimplex &other, const double sign)
    {
      for (unsigned k = 0; k < dim; ++k)
        if (!((simplex.edges[k] - sign * other.edges[k]).norm() <= tolerance * size))
          return false;
      return other.region == simplex.region;
    };
    for (auto other = simplices.rbegin(); other != simplices.rend(); ++other)
      if (congruent(*other, 1) || congruent(*other, -1))
        return other->matrix;
    if (simplices.size() == most)
      simplices.erase(simplices.begin());
    simplices.push_back(simplex);
    return -1;
  }

  template <int dim>
  void CellSystems<dim>::append(std::vector<double> &to, const FullMatrix<double> &matrix) const
  {
    for (unsigned i = 0; i < n; ++i)
      for (unsigned j = 0; j < n; ++j)
        to.push_back(matrix((*element_index)[i], (*element_index)[j]));
  }

  template <int dim>
  void CellSystems<dim>::keep_load()
  {
    own_load.resize(n);
    for (unsigned i = 0; i < n; ++i)
      own_load[i] = local_load((*element_index)[i]);
  }

  AffineDependence::AffineDependence(const std::vector<types::global_dof_index> &dofs, const AffineConstraints<double> &dirichlet)
    : g(dofs.size(), 0.)
  {
    std::map<types::global_dof_index, unsigned>           number;
    std::vector<std::vector<std::pair<unsigned, double>>> rows(dofs.size());
    const auto                                            master = [&](const types::global_dof_index dof)
    {
      const auto [entry, is_new] = number.try_emplace(dof, number.size());
      if (is_new)
        masters.push_back(dof);
      return entry->second;
    };
    for (std::size_t i = 0; i < dofs.size(); ++i)
      if (dirichlet.is_constrained(dofs[i]))
      {
        g[i] = dirichlet.get_inhomogeneity(dofs[i]);
        for (const auto &[dof, weight] : *dirichlet.get_constraint_entries(dofs[i]))
          rows[i].emplace_back(master(dof), weight);
      }
      else
        rows[i].emplace_back(master(dofs[i]), 1.);
    C.assign(dofs.size() * masters.size(), 0.);
    for (std::size_t i = 0; i < dofs.size(); ++i)
      for (const auto &[column, weight] : rows[i])
        C[i * masters.size() + column] += weight;
  }

#define INSTANTIATE(dim) template class CellSystems<dim>;
  INSTANTIATE(1)
  INSTANTIATE(2)
  INSTANTIATE(3)
#undef INSTANTIATE
} // namespace unilateral
