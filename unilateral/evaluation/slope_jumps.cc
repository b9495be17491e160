#include "unilateral/evaluation/slope_jumps.h"

#include "unilateral/discretisation/interior_faces.h"

#include <algorithm>
#include <cmath>

namespace unilateral
{
  using namespace dealii;

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
