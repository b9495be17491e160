#include "unilateral/discretisation/matrix_free.h"

#include "unilateral/algebra/gmres.h"
#include "unilateral/discretisation/free_boundary_rows.h"

#include <algorithm>
#include <map>
#include <span>
#include <stdexcept>
#include <utility>

namespace unilateral
{
  namespace
  {
    constexpr std::uint32_t no_cell = -1;

    using Dofs = std::span<const dealii::types::global_dof_index>;

    /// For each of @p points a cell that has all unknowns of its row.
    void
    find_cells(const std::vector<std::pair<std::size_t, Dofs>> &points, const CellOperator &op, std::vector<std::uint32_t> &cell_of_point)
    {
      if (points.empty())
        return;
      // Points by one of their unknowns.
      std::vector<std::uint32_t> first(op.n_dofs() + 2, 0), by_dof(points.size());
      for (const auto &[point, dofs] : points)
        ++first[dofs[0] + 2];
      for (std::size_t j = 1; j < first.size(); ++j)
        first[j] += first[j - 1];
      for (std::size_t k = 0; k < points.size(); ++k)
        by_dof[first[points[k].second[0] + 1]++] = k;
      std::vector<std::uint32_t> dofs(op.n_cell_dofs());
      for (std::size_t cell = 0; cell < op.n_cells(); ++cell)
      {
        op.cell_dofs(cell, dofs.data());
        for (const auto dof : dofs)
          for (std::uint32_t k = first[dof]; k < first[dof + 1]; ++k)
          {
            const auto &[point, row] = points[by_dof[k]];
            if (cell_of_point[point] == no_cell &&
                std::all_of(row.begin(), row.end(),
                            [&](const auto column) { return std::find(dofs.begin(), dofs.end(), column) != dofs.end(); }))
              cell_of_point[point] = cell;
          }
      }
    }
  } // namespace

  MatrixFree::MatrixFree(std::shared_ptr<const LevelHierarchy> levels,
                         ConstraintTrace                       trace,
                         Vector                                load,
                         std::vector<Vector>                   null_space,
                         std::vector<Vector>                   rigid_body_modes,
                         const Parameters                     &parameters)
    : hierarchy(std::move(levels)), parameters(parameters), cell_of_point(trace.n_points(), no_cell),
      multigrid(hierarchy, parameters.multigrid)
  {
    B = std::move(trace);
    f.swap(load);
    null_vectors = std::move(null_space);
    modes = std::move(rigid_body_modes);
    find_cells_of_points();
    const auto &entries = hierarchy->finest().diagonal();
    diagonal.reinit(entries.size());
    std::copy(entries.begin(), entries.end(), diagonal.begin());
    set_scales();
  }

  bool MatrixFree::set_data(ConstraintTrace trace, Vector load)
  {
    if (processes().any(!trace.same_rows(B)))
      return false;
    B.obstacle.swap(trace.obstacle);
    f.swap(load);
    return true;
  }

  void MatrixFree::find_cells_of_points()
  {
    std::vector<std::pair<std::size_t, Dofs>> points;
    for (std::size_t i = 0; i < B.n_points(); ++i)
      if (B.row_start[i + 1] - B.row_start[i] > 1)
        points.emplace_back(i, Dofs(B.columns.data() + B.row_start[i], B.columns.data() + B.row_start[i + 1]));
    find_cells(points, hierarchy->finest(), cell_of_point);
    points.clear();
    for (const auto &[i, row] : B.rows_on_cells)
      if (cell_of_point[i] == no_cell)
      {
        points.emplace_back(i, Dofs(row.columns));
        known_on_cell.insert(i);
      }
    find_cells(points, hierarchy->finest(), cell_of_point);
  }

  void MatrixFree::apply_stiffness(Vector &Au, const Vector &u) const
  {
    hierarchy->finest().vmult(Au.begin(), u.begin());
    if (hierarchy->convection)
      hierarchy->convection->vmult_add(Au.begin(), u.begin());
    shared().add(Au.begin());
    ++applications;
  }

  void MatrixFree::apply_gram(Vector &, const Vector &) const
  {
    throw std::logic_error("the Gram matrix is known to Assembled only");
  }

  LocalRows MatrixFree::rows_near_free_boundary(const std::vector<bool> &active) const
  {
    return unilateral::rows_near_free_boundary(*hierarchy, B, active);
  }

  std::vector<std::uint32_t> MatrixFree::node_of(const std::size_t point, const std::vector<std::uint32_t> &dofs_of_cell) const
  {
    const unsigned n_components = hierarchy->n_components;
    const auto     number = [&](const std::size_t k)
    { return std::find(dofs_of_cell.begin(), dofs_of_cell.end(), B.columns[k]) - dofs_of_cell.begin(); };
    const auto node = number(B.row_start[point]) / n_components;
    for (std::size_t k = B.row_start[point]; k < B.row_start[point + 1]; ++k)
      if (number(k) / n_components != node)
        return {};
    const auto first = dofs_of_cell.begin() + node * n_components;
    return {first, first + n_components};
  }

  void MatrixFree::set_penalty(const Vector &d)
  {
    auto &on_diagonal = penalty_on_diagonal;
    on_diagonal.assign(f.size(), 0.);
    const double *const                          d_of = d.begin();
    std::map<std::uint32_t, std::vector<double>> blocks;
    std::map<std::uint32_t, DenseBlock>          nodes; // by the first unknown
    std::vector<std::uint32_t>                   dofs(hierarchy->finest().n_cell_dofs());
    const unsigned                               n = dofs.size();
    for (std::size_t i = 0; i < d.size(); ++i)
    {
      if (d_of[i] == 0)
        continue;
      const std::size_t begin = B.row_start[i], end = B.row_start[i + 1];
      if (end - begin == 1)
      {
        on_diagonal[B.columns[begin]] += d_of[i] * B.values[begin] * B.values[begin];
        continue;
      }
      if (cell_of_point[i] == no_cell)
        throw std::runtime_error("a point of the constraint couples unknowns of several cells: geometric multigrid does not take that");
      hierarchy->finest().cell_dofs(cell_of_point[i], dofs.data());
      const bool own_row = known_on_cell.count(i) == 0;
      if (const auto node = own_row ? node_of(i, dofs) : std::vector<std::uint32_t>(); !node.empty())
      {
        auto &block = nodes[node[0]];
        block.dofs = node;
        block.matrix.resize(node.size() * node.size());
        const auto at = [&](const std::size_t k) { return std::find(node.begin(), node.end(), B.columns[k]) - node.begin(); };
        for (std::size_t k = begin; k < end; ++k)
          for (std::size_t l = begin; l < end; ++l)
            block.matrix[at(k) * node.size() + at(l)] += d_of[i] * B.values[k] * B.values[l];
        continue;
      }
      auto &block = blocks[cell_of_point[i]];
      block.resize(n * n);
      const auto add = [&](const dealii::types::global_dof_index *const columns, const double *const values, const std::size_t size)
      {
        const auto number = [&](const std::size_t k) { return std::find(dofs.begin(), dofs.end(), columns[k]) - dofs.begin(); };
        for (std::size_t k = 0; k < size; ++k)
          for (std::size_t l = 0, row = number(k); l < size; ++l)
            block[row * n + number(l)] += d_of[i] * values[k] * values[l];
      };
      if (own_row)
        add(B.columns.data() + begin, B.values.data() + begin, end - begin);
      else
        add(B.rows_on_cells.at(i).columns.data(), B.rows_on_cells.at(i).values.data(), B.rows_on_cells.at(i).values.size());
    }
    // An unknown that a node couples belongs to it altogether.
    std::vector<DenseBlock> node_blocks;
    for (auto &[first, block] : nodes)
    {
      for (unsigned a = 0; a < block.dofs.size(); ++a)
        block.matrix[a * (block.dofs.size() + 1)] += std::exchange(on_diagonal[block.dofs[a]], 0.);
      node_blocks.push_back(std::move(block));
    }
    std::vector<TangentPenalty::CellBlock> cell_blocks;
    for (auto &[cell, matrix] : blocks)
      cell_blocks.push_back({cell, std::move(matrix)});
    multigrid.set_penalty(on_diagonal, node_blocks, std::move(cell_blocks));
  }

  LinearSolve MatrixFree::solve_tangent(const Vector &d, const Vector &rhs, const SolveTolerance &tolerance, Vector &x, Vector *Ax)
  {
    if (processes().any(!tangent_is_set || !std::equal(d.begin(), d.end(), tangent_diagonal.begin())))
    {
      tangent_is_set = false; // should the coarse level be singular
      set_penalty(d);
      conjugate_gradients.forget_spectrum();
      tangent_diagonal = d;
      tangent_is_set = true;
    }
    const LinearMap T = [this](Vector &y, const Vector &v)
    {
      apply_stiffness(y, v);
      multigrid.add_penalty(y.begin(), v.begin());
    };
    const LinearMap     precondition = [this](Vector &z, const Vector &r) { multigrid.vmult(z.begin(), r.begin()); };
    const ScalarProduct product = [this](const Vector &u, const Vector &v) { return dot(u, v); };
    if (!symmetric())
    {
      const LinearSolve result = gmres(T, precondition, rhs, product, tolerance, parameters.max_iterations, parameters.gmres_basis, x);
      if (Ax)
        apply_stiffness(*Ax, x);
      return result;
    }
    const LinearSolve result = conjugate_gradients.solve(T, precondition, rhs, product, tolerance, parameters.max_iterations, x, Ax);
    if (Ax)
      multigrid.add_penalty(Ax->begin(), x.begin(), -1); // what the tangent has besides A
    return result;
  }
} // namespace unilateral
