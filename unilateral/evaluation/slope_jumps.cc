#include "unilateral/evaluation/slope_jumps.h"

#include "unilateral/discretisation/interior_faces.h"
#include "unilateral/discretisation/terms_across_cuts.h"

#include <array>
#include <cmath>

namespace unilateral
{
  using namespace dealii;

  namespace
  {
    /// du/dn at the points of a side.
    template <int dim>
    std::vector<double> slopes_at_points(const FaceSide<dim> &side, const dealii::Vector<double> &u)
    {
      std::vector<double> result(side.points.size(), 0.);
      for (unsigned q = 0; q < result.size(); ++q)
        for (unsigned k = 0; k < u.size(); ++k)
          result[q] += side.slope(q, k) * u(k);
      return result;
    }
  } // namespace

  template <int dim>
  double add_slope_jumps(const Problem<dim> &problem, const Vector &u, std::vector<double> &cell_squares)
  {
    double total = 0;
    if constexpr (dim > 1)
    {
      if (!problem.form->has_interior_face_terms())
        return 0;
      Flux unit{};
      unit[0] = 1;
      dealii::Vector<double>               local_u;
      std::vector<types::global_dof_index> dofs(problem.space.fe->n_dofs_per_cell());
      const auto                           add = [&](const auto &cell, const double square)
      {
        const double half = 0.5 * square / problem.form->flux_energy(unit, cell->material_id(), cell->center());
        cell_squares[cell->active_cell_index()] += half;
        total += half;
      };
      const auto values_at = [&](const std::vector<types::global_dof_index> &unknowns)
      {
        local_u.reinit(unknowns.size());
        for (std::size_t i = 0; i < unknowns.size(); ++i)
          local_u(i) = u(unknowns[i]);
      };
      for_each_interior_face<dim>(
        problem.space, problem.face_quadrature(),
        [&](const FEInterfaceValues<dim> &values, const std::vector<types::global_dof_index> &)
        {
          std::array<FaceSide<dim>, 2>       sides;
          std::array<std::vector<double>, 2> slope;
          for (const unsigned k : {0, 1})
          {
            const auto &face = values.get_fe_face_values(k);
            typename DoFHandler<dim>::active_cell_iterator(&problem.space.dof_handler.get_triangulation(), face.get_cell()->level(),
                                                           face.get_cell()->index(), &problem.space.dof_handler)
              ->get_dof_indices(dofs);
            values_at(dofs);
            sides[k] = problem.form->interior_face_side(face);
            slope[k] = slopes_at_points(sides[k], local_u);
          }
          const auto place = matching_points(sides[0].points, sides[1].points);
          double     square = 0;
          for (unsigned q = 0; q < place.size(); ++q)
            square += std::pow(slope[0][q] + slope[1][place[q]], 2) * sides[0].JxW[q];
          for (const unsigned k : {0, 1})
            add(values.get_fe_face_values(k).get_cell(), (sides[0].half_inverse_width + sides[1].half_inverse_width) * square);
        });
      for_each_face_on_cut<dim>(
        problem,
        [&](const std::vector<types::global_dof_index> &unknowns, unsigned)
        { return one_function(unknowns, [&](const auto dof) { return u(dof); }); },
        [&](const FaceOnCut<dim> &face)
        {
          values_at(face.dofs);
          const auto here = slopes_at_points(face.here, local_u);
          double     square = 0;
          for (unsigned q = 0; q < here.size(); ++q)
            square += std::pow(here[q] + face.beyond.slope(q, 0), 2) * face.here.JxW[q];
          add(face.cell, (face.here.half_inverse_width + face.beyond.half_inverse_width) * square);
        });
    }
    return std::sqrt(problem.space.processes().sum(total));
  }

#define INSTANTIATE(dim) template double add_slope_jumps(const Problem<dim> &, const Vector &, std::vector<double> &);
  INSTANTIATE(1)
  INSTANTIATE(2)
  INSTANTIATE(3)
#undef INSTANTIATE
} // namespace unilateral
