#include "unilateral/discretisation/cell_systems.h"

#include <map>
#include <utility>

namespace unilateral
{
  using namespace dealii;

  template <int dim>
  CellSystems<dim>::CellSystems(const Problem<dim> &problem, const CellNumbering<dim> &numbering)
    : problem(problem), numbering(numbering), shapes(shapes_for_systems(problem)), repeated_load(problem),
      values(*problem.space.mapping, *problem.space.fe, problem.cell_quadrature(), cell_flags(*problem.form)), n(numbering.size()),
      affine(numbering.simplex && is_multilinear(*problem.space.mapping)), local_matrix(n, n), local_load(n)
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
    const std::int32_t number = compute(cell);
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
  std::int32_t CellSystems<dim>::compute(const Cell &cell)
  {
    values.reinit(cell);
    local_load = 0.;
    const bool is_repeated = affine && problem.symmetric() && problem.form->uniform_in(cell->material_id());
    if (const KnownSimplex *const simplex = is_repeated ? find_congruent(cell) : nullptr)
      return take_from(*simplex, cell);
    local_matrix = 0.;
    problem.form->add_cell_terms(values, local_matrix, local_load);
    keep_load();
    const std::int32_t number = matrices.size() / (n * n);
    if (!problem.symmetric())
    {
      FullMatrix<double> local_convection(n, n);
      problem.form->add_convection_terms(values, local_convection);
      local_matrix.add(-1, local_convection);
      append(convection, local_convection);
    }
    append(matrices, local_matrix);
    if (is_repeated)
      keep_simplex(cell, number);
    return number;
  }

  template <int dim>
  typename CellSystems<dim>::Edges CellSystems<dim>::edges_of(const Cell &cell) const
  {
    const CornerOrder &order = problem.space.corner_order(cell);
    Edges              edges;
    for (unsigned k = 0; k < dim; ++k)
      edges[k] = cell->vertex(order[k + 1]) - cell->vertex(order[0]);
    return edges;
  }

  template <int dim>
  const typename CellSystems<dim>::KnownSimplex *CellSystems<dim>::find_congruent(const Cell &cell) const
  {
    constexpr double tolerance = 1e-10;
    const Edges      edges = edges_of(cell);
    const auto       congruent = [&](const KnownSimplex &simplex, const double sign)
    {
      for (unsigned k = 0; k < dim; ++k)
        if (!((edges[k] - sign * simplex.edges[k]).norm() <= tolerance * edges[k].norm()))
          return false;
      return simplex.region == cell->material_id();
    };
    for (auto simplex = simplices.rbegin(); simplex != simplices.rend(); ++simplex)
      if (congruent(*simplex, 1) || congruent(*simplex, -1))
        return &*simplex;
    return nullptr;
  }

  template <int dim>
  std::int32_t CellSystems<dim>::take_from(const KnownSimplex &simplex, const Cell &cell)
  {
    if (problem.form->load_uniform_in(cell->material_id()))
      own_load = simplex.load;
    else
    {
      problem.form->add_cell_load(values, local_load);
      keep_load();
    }
    return simplex.matrix;
  }

  template <int dim>
  void CellSystems<dim>::keep_simplex(const Cell &cell, const std::int32_t matrix)
  {
    constexpr std::size_t most = 16; // the descendants of a coarse cell follow each other
    if (simplices.size() == most)
      simplices.erase(simplices.begin());
    simplices.push_back({cell->material_id(), edges_of(cell), matrix, own_load});
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
