#include "unilateral/evaluation/slope_jumps.h"

#include "unilateral/discretisation/interior_faces.h"

#include <Eigen/Dense>

#include <algorithm>
#include <cmath>

namespace unilateral
{
  using namespace dealii;

  namespace
  {
    /// Takes off @p u, the values at the nodes on both sides of a face, the linear function closest to them. Its slope has no jump; with it
    /// the square of the jump would be a difference of numbers h^-4 times as large, and be lost in rounding.
    template <int dim>
    void subtract_linear_part(const Problem<dim> &problem, const FEInterfaceValues<dim> &values, dealii::Vector<double> &u)
    {
      const auto      cell_at = [&](const unsigned side) { return values.get_fe_face_values(side).get_cell(); };
      const auto     &nodes = problem.space.fe->get_unit_support_points();
      const auto      center = cell_at(0)->center();
      const double    size = cell_at(0)->diameter();
      Eigen::MatrixXd linear(u.size(), dim + 1);
      for (unsigned i = 0; i < u.size(); ++i)
      {
        const auto     of_sides = values.interface_dof_to_dof_indices(i);
        const unsigned side = of_sides[0] == numbers::invalid_unsigned_int ? 1 : 0;
        const auto     x = (problem.space.mapping->transform_unit_to_real_cell(cell_at(side), nodes[of_sides[side]]) - center) / size;
        linear(i, 0) = 1;
        for (unsigned d = 0; d < dim; ++d)
          linear(i, d + 1) = x[d];
      }
      Eigen::Map<Eigen::VectorXd> at_nodes(u.begin(), u.size());
      at_nodes -= linear * (linear.transpose() * linear).llt().solve(linear.transpose() * at_nodes);
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
      FullMatrix<double>     gram;
      dealii::Vector<double> local_u, image;
      Flux                   unit{};
      unit[0] = 1;
      for_each_interior_face<dim>(problem.space, problem.face_quadrature(),
                                  [&](const FEInterfaceValues<dim> &values, const std::vector<types::global_dof_index> &dofs)
                                  {
                                    gram.reinit(dofs.size(), dofs.size());
                                    problem.form->add_interior_face_gram(values, gram);
                                    local_u.reinit(dofs.size());
                                    image.reinit(dofs.size());
                                    for (std::size_t i = 0; i < dofs.size(); ++i)
                                      local_u(i) = u(dofs[i]);
                                    subtract_linear_part(problem, values, local_u);
                                    gram.vmult(image, local_u);
                                    const double jump = std::max(0., local_u * image);
                                    for (const unsigned side : {0, 1})
                                    {
                                      const auto  &cell = values.get_fe_face_values(side).get_cell();
                                      const double half = 0.5 * jump / problem.form->flux_energy(unit, cell->material_id(), cell->center());
                                      cell_squares[cell->active_cell_index()] += half;
                                      total += half;
                                    }
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
