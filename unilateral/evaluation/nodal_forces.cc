#include "unilateral/evaluation/nodal_forces.h"

#include "unilateral/discretisation/terms_across_cuts.h"
#include "unilateral/discretisation/vertex_volumes.h"

#include <cmath>

namespace unilateral
{
  using namespace dealii;

  namespace
  {
    /// Of a face on a cut the own side.
    template <int dim>
    void visit_faces_on_cuts(const Problem<dim> &problem, const Vector &u, const std::function<void(const LocalForces &)> &visit)
    {
      Eigen::VectorXd local_u, Au, diagonal, summands;
      for_each_face_on_cut<dim>(
        problem,
        [&](const std::vector<types::global_dof_index> &dofs, unsigned)
        { return one_function(dofs, [&](const auto dof) { return u(dof); }); },
        [&](const FaceOnCut<dim> &face)
        {
          const FullMatrix<double> rows = rows_of_own_side(face); // one column for each own unknown, and one for u beyond
          const unsigned           n = face.dofs.size();
          local_u.resize(n);
          for (unsigned i = 0; i < n; ++i)
            local_u(i) = u(face.dofs[i]);
          Au.setZero(n);
          summands.setZero(n);
          diagonal.resize(n);
          for (unsigned i = 0; i < n; ++i)
          {
            diagonal(i) = rows(i, i);
            for (unsigned j = 0; j < n; ++j)
            {
              Au(i) += rows(i, j) * local_u(j);
              summands(i) += std::abs(rows(i, j) * local_u(j));
            }
            Au(i) += rows(i, n);
          }
          summands *= 2; // as much beyond
          visit({face.dofs, local_u, Au, diagonal, summands, nullptr, false});
        });
    }
  } // namespace

  template <int dim>
  void for_each_local_force(const Problem<dim> &problem, const Vector &u, const std::function<void(const LocalForces &)> &visit)
  {
    Eigen::VectorXd local_u, Au, diagonal, summands;
    const auto      take = [&](const std::vector<types::global_dof_index> &dofs)
    {
      local_u.resize(dofs.size());
      for (std::size_t i = 0; i < dofs.size(); ++i)
        local_u(i) = u(dofs[i]);
    };
    for_each_local_system<dim>(
      problem,
      [&](const LocalSystem &local)
      {
        take(local.dofs);
        using RowMajor = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;
        const auto                       n = local_u.size();
        const Eigen::Map<const RowMajor> matrix(n > 0 ? &local.matrix(0, 0) : nullptr, n, n);
        Au.noalias() = matrix * local_u;
        diagonal = matrix.diagonal();
        summands.noalias() = matrix.cwiseAbs() * local_u.cwiseAbs();
        visit({local.dofs, local_u, Au, diagonal, summands, &local.load, local.springs});
      },
      Volumes::of_vertices_apart);
    visit_faces_on_cuts(problem, u, visit);
    if (!VertexVolumes<dim>::any(problem))
      return;
    const VertexVolumes<dim>  volumes(problem);
    const std::vector<double> tensions = volumes.tensions(u);
    for (std::size_t k = 0; k < tensions.size(); ++k)
    {
      const auto                             &patch = volumes.patches()[k];
      const Eigen::Map<const Eigen::VectorXd> change(patch.change.data(), patch.change.size());
      take(patch.dofs);
      Au = tensions[k] * change;
      const double to_tension = patch.modulus / (patch.volume * patch.volume);
      diagonal = to_tension * change.cwiseAbs2();
      summands = to_tension * change.cwiseAbs().dot(local_u.cwiseAbs()) * change.cwiseAbs();
      visit({patch.dofs, local_u, Au, diagonal, summands, nullptr, false});
    }
  }

  template <int dim>
  ForcesAtUnknowns
  forces_at_unknowns(const Problem<dim> &problem, const ConstraintSet<dim> &constraint_set, const Vector &u, const Vector &lambda)
  {
    ForcesAtUnknowns forces;
    for (Vector *const force : {&forces.load, &forces.springs, &forces.contact, &forces.missing, &forces.diagonal, &forces.summands})
      force->reinit(u.size());
    for_each_local_force<dim>(problem, u,
                              [&](const LocalForces &local)
                              {
                                for (std::size_t i = 0; i < local.dofs.size(); ++i)
                                {
                                  forces.missing(local.dofs[i]) += local.Au(i);
                                  forces.diagonal(local.dofs[i]) += local.diagonal(i);
                                  forces.summands(local.dofs[i]) += local.summands(i);
                                  if (local.load)
                                    forces.load(local.dofs[i]) += (*local.load)(i);
                                  if (local.springs)
                                    forces.springs(local.dofs[i]) -= local.Au(i);
                                }
                              });
    for (std::size_t i = 0; i < constraint_set.size(); ++i)
    {
      const auto   row = constraint_set.trace[i];
      const double pressure = constraint_set.owns(i) ? constraint_set.points[i].weight * lambda(i) * constraint_set.points[i].sign : 0.;
      for (std::size_t k = 0; k < row.dofs.size() && pressure != 0; ++k)
        forces.contact(row.dofs[k]) -= pressure * row.values[k];
    }
    // Of a point on a periodic part what its image has taken over acts there.
    for (const auto &image : constraint_set.images)
    {
      const auto  &point = constraint_set.points[image.point];
      const double force = image.weight * lambda(image.point) * point.sign;
      const auto   row = constraint_set.trace[image.point];
      for (std::size_t k = 0; k < row.dofs.size(); ++k)
        forces.contact(row.dofs[k]) += force * row.values[k];
      for (std::size_t k = 0; k < image.row.dofs.size(); ++k)
        forces.contact(image.row.dofs[k]) -= force * image.row.values[k];
    }
    forces.missing -= forces.load;
    forces.missing -= forces.contact;
    for (Vector *const force : {&forces.load, &forces.springs, &forces.contact, &forces.missing})
      for (const auto &line : problem.space.hanging_nodes.get_lines())
      {
        for (const auto &[dof, weight] : line.entries)
          (*force)(dof) += weight * (*force)(line.index);
        (*force)(line.index) = 0;
      }
    for (const auto &line : problem.space.hanging_nodes.get_lines())
    {
      for (const auto &[dof, weight] : line.entries)
      {
        forces.diagonal(dof) += weight * weight * forces.diagonal(line.index);
        forces.summands(dof) += std::abs(weight) * forces.summands(line.index);
      }
      forces.diagonal(line.index) = forces.summands(line.index) = 0;
    }
    return forces;
  }

  template <int dim>
  void hand_over_at_ties(const Problem<dim> &problem, Vector &force)
  {
    for (const auto &tie : problem.space.couplings.ties)
    {
      for (const auto &[dof, factor] : tie.entries)
        force(dof) += factor * force(tie.dof);
      force(tie.dof) = 0;
    }
  }

  template <int dim>
  std::vector<bool> tied_unknowns(const Problem<dim> &problem)
  {
    std::vector<bool> tied(problem.space.dof_handler.n_dofs(), false);
    for (const auto &tie : problem.space.couplings.ties)
      tied[tie.dof] = true;
    return tied;
  }

#define INSTANTIATE(dim)                                                                                                                   \
  template void              for_each_local_force(const Problem<dim> &, const Vector &, const std::function<void(const LocalForces &)> &); \
  template ForcesAtUnknowns  forces_at_unknowns(const Problem<dim> &, const ConstraintSet<dim> &, const Vector &, const Vector &);         \
  template void              hand_over_at_ties(const Problem<dim> &, Vector &);                                                            \
  template std::vector<bool> tied_unknowns(const Problem<dim> &);
  INSTANTIATE(1)
  INSTANTIATE(2)
  INSTANTIATE(3)
#undef INSTANTIATE
} // namespace unilateral
