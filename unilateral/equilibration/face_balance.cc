#include "unilateral/equilibration/face_balance.h"

#include "unilateral/algebra/sparse_cholesky.h"

#include <deal.II/lac/dynamic_sparsity_pattern.h>
#include <deal.II/lac/sparse_matrix.h>
#include <deal.II/lac/sparsity_pattern.h>

#include <algorithm>

namespace unilateral
{
  using namespace dealii;

  template <int dim>
  FaceBalance<dim>::FaceBalance(const Triangulation<dim>  &triangulation,
                                const std::vector<bool>   &closed,
                                const std::vector<double> &stiffness)
    : n_cells(triangulation.n_active_cells())
  {
    const auto resistance = [&](const auto &cell, const unsigned f)
    {
      double area = 1;
      if constexpr (dim > 1)
        area = cell->face(f)->measure();
      else
        (void)f;
      return cell->measure() / (2 * area * area * stiffness[cell->active_cell_index()]);
    };
    for (const auto &cell : triangulation.active_cell_iterators())
    {
      n_faces = std::max(n_faces, cell->n_faces());
      for (const unsigned f : cell->face_indices())
      {
        const std::size_t begin = entries.size();
        double            against = resistance(cell, f);
        if (cell->at_boundary(f))
        {
          if (closed[cell->face(f)->boundary_id()])
            continue;
          any_open = true;
          entries.push_back({cell->active_cell_index(), f, 1});
        }
        else if (cell->neighbor(f)->has_children())
        {
          entries.push_back({cell->active_cell_index(), f, 1});
          const unsigned opposite = cell->neighbor_of_neighbor(f), n = dim == 1 ? 1 : GeometryInfo<dim>::max_children_per_face;
          for (unsigned part = 0; part < n; ++part)
          {
            auto child = cell->neighbor(f);
            if constexpr (dim == 1)
              while (child->has_children())
                child = child->child(1 - f);
            else
              child = cell->neighbor_child_on_subface(f, part);
            entries.push_back({child->active_cell_index(), opposite, -1. / n});
            if (part == 0)
              against += resistance(child, opposite) / n;
          }
        }
        else
        {
          const auto neighbor = cell->neighbor(f);
          // A larger neighbour, or the other of two equal ones, sees to the face.
          if (neighbor->level() < cell->level() || (neighbor->level() == cell->level() && neighbor->index() < cell->index()))
            continue;
          const unsigned opposite = cell->neighbor_of_neighbor(f);
          entries.push_back({cell->active_cell_index(), f, 1});
          entries.push_back({neighbor->active_cell_index(), opposite, -1});
          against += resistance(neighbor, opposite);
        }
        faces.push_back({begin, entries.size(), 1 / against});
      }
    }
    flows.assign(n_cells * n_faces, 0.);
  }

  template <int dim>
  void FaceBalance<dim>::solve(const std::vector<double> &r)
  {
    DynamicSparsityPattern couplings(n_cells, n_cells);
    for (const Face &face : faces)
      for (std::size_t a = face.begin; a < face.end; ++a)
        for (std::size_t b = face.begin; b < face.end; ++b)
          couplings.add(entries[a].cell, entries[b].cell);
    SparsityPattern pattern;
    pattern.copy_from(couplings);
    SparseMatrix<double> matrix(pattern);
    for (const Face &face : faces)
      for (std::size_t a = face.begin; a < face.end; ++a)
        for (std::size_t b = face.begin; b < face.end; ++b)
          matrix.add(entries[a].cell, entries[b].cell, entries[a].share * entries[b].share * face.weight);
    if (!any_open) // one value of mu is free
      matrix.diag_element(0) *= 2;
    SparseCholesky factors(matrix, {}, dim == 2 ? SparseCholesky::Order::minimum_degree : SparseCholesky::Order::nested_dissection);
    factors.factorise(matrix);

    flows.assign(n_cells * n_faces, 0.);
    std::vector<double> rest(r), mu(n_cells);
    // The second time for what rounding has left.
    for (unsigned pass = 0; pass < 2; ++pass)
    {
      factors.forward(rest.data(), mu.data());
      factors.backward(mu.data(), mu.data());
      for (const Face &face : faces)
      {
        double difference = 0;
        for (std::size_t a = face.begin; a < face.end; ++a)
          difference += entries[a].share * mu[entries[a].cell];
        for (std::size_t a = face.begin; a < face.end; ++a)
        {
          const double flow = face.weight * difference * entries[a].share;
          flows[entries[a].cell * n_faces + entries[a].face] += flow;
          rest[entries[a].cell] -= flow;
        }
      }
    }
  }

  template class FaceBalance<1>;
  template class FaceBalance<2>;
  template class FaceBalance<3>;
} // namespace unilateral
