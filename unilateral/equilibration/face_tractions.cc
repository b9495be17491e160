#include "unilateral/equilibration/face_tractions.h"

#include <deal.II/base/geometry_info.h>

namespace unilateral
{
  using namespace dealii;

  template <int dim>
  FaceTractions<dim>::FaceTractions(const Triangulation<dim> &triangulation, const unsigned degree)
    : simplex(triangulation.begin_active()->reference_cell().is_simplex()), rule(rule_on_face<dim>(simplex, 2 * degree + 4)),
      basis(rule, degree), tests(basis.values_at(rule.get_points())), n_faces(triangulation.begin_active()->n_faces())
  {
    for (const auto &cell : triangulation.active_cell_iterators())
      cells.push_back(cell);
    numbers.resize(cells.size() * n_faces);
    for (std::size_t c = 0; c < cells.size(); ++c)
      for (unsigned f = 0; f < n_faces; ++f)
      {
        const Cell       &cell = cells[c];
        const std::size_t begin = members.size();
        if (!cell->at_boundary(f))
        {
          const auto neighbor = cell->neighbor(f);
          if (neighbor->has_children())
            for (unsigned part = 0; part < GeometryInfo<dim>::max_children_per_face; ++part)
            {
              if (part == 0)
                members.push_back({c, f});
              members.push_back({cell->neighbor_child_on_subface(f, part)->active_cell_index(), cell->neighbor_of_neighbor(f)});
            }
          else
          {
            // A larger neighbour, or the other of two equal ones, sees to the face.
            if (neighbor->level() < cell->level() || (neighbor->level() == cell->level() && neighbor->index() < cell->index()))
              continue;
            members.push_back({c, f});
            members.push_back({neighbor->active_cell_index(), cell->neighbor_of_neighbor(f)});
          }
        }
        else
          members.push_back({c, f});
        for (std::size_t m = begin; m < members.size(); ++m)
          numbers[members[m].cell * n_faces + members[m].face] = faces.size();
        faces.push_back({begin, members.size(), StraightFace<dim>(cell, f), {}});
      }
    coefficients.resize(faces.size() * basis.size());
  }

  template <int dim>
  void FaceTractions<dim>::set(const std::size_t face, const std::vector<Tensor<1, dim>> &values)
  {
    for (unsigned m = 0; m < basis.size(); ++m)
    {
      Tensor<1, dim> sum;
      for (unsigned q = 0; q < rule.size(); ++q)
        sum += rule.weight(q) * tests(q, m) * values[q];
      coefficients[face * basis.size() + m] = sum;
    }
  }

  template <int dim>
  void FaceTractions<dim>::at_points(const std::size_t            cell,
                                     const unsigned               f,
                                     const StraightFace<dim>     &geometry,
                                     std::vector<Tensor<1, dim>> &values) const
  {
    const std::size_t           face = face_of(cell, f);
    const bool                  owner = owns(cell, f);
    const Tensor<1, dim> *const c = &coefficients[face * basis.size()];
    std::vector<Point<dim - 1>> parameters;
    if (!owner)
      for (const auto &xi : rule.get_points())
        parameters.push_back(faces[face].geometry.parameters(geometry.at(xi)));
    const Eigen::MatrixXd  own = owner ? Eigen::MatrixXd() : basis.values_at(parameters);
    const Eigen::MatrixXd &functions = owner ? tests : own;
    values.assign(rule.size(), Tensor<1, dim>());
    for (unsigned q = 0; q < rule.size(); ++q)
      for (unsigned m = 0; m < basis.size(); ++m)
        values[q] += (owner ? 1. : -1.) * functions(q, m) * c[m];
  }

  template class FaceTractions<2>;
  template class FaceTractions<3>;
} // namespace unilateral
