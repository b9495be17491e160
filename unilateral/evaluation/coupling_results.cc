#include "unilateral/evaluation/coupling_results.h"

#include "unilateral/algebra/dense_solvers.h"
#include "unilateral/evaluation/nodal_forces.h"
#include "unilateral/forms/adapted_face_values.h"

#include <deal.II/lac/full_matrix.h>
#include <deal.II/lac/vector.h>

namespace unilateral
{
  using namespace dealii;

  namespace
  {
    /// Adds what the loads and springs of the part itself do at its nodes: all that is not the body's.
    template <int dim>
    void add_forces_on_part(const Problem<dim> &problem, const types::boundary_id part, const Vector &u, Vector &force)
    {
      const auto &form = *problem.form;
      if (!form.has_face_terms(part))
        return;
      const auto                           functions = form.face_functions(part);
      const unsigned                       n = problem.space.fe->n_dofs_per_cell();
      FullMatrix<double>                   matrix(n, n);
      dealii::Vector<double>               load(n);
      std::vector<types::global_dof_index> dofs(n);
      AdaptedFaceValues<dim>               values(*problem.space.mapping, *problem.space.fe, problem.face_quadrature(),
                                                  update_values | update_quadrature_points | update_JxW_values | update_normal_vectors);
      for (const auto &cell : problem.space.dof_handler.active_cell_iterators())
        for (const auto face : cell->face_indices())
          if (cell->at_boundary(face) && cell->face(face)->boundary_id() == part)
          {
            matrix = 0.;
            load = 0.;
            form.add_face_terms(values.reinit(cell, face, functions), part, matrix, load);
            cell->get_dof_indices(dofs);
            for (unsigned i = 0; i < n; ++i)
            {
              force(dofs[i]) += load(i);
              for (unsigned j = 0; j < n; ++j)
                force(dofs[i]) -= matrix(i, j) * u(dofs[j]);
            }
          }
      for (const auto &line : problem.space.hanging_nodes.get_lines())
      {
        for (const auto &[dof, weight] : line.entries)
          force(dof) += weight * force(line.index);
        force(line.index) = 0;
      }
    }

    /// Least squares: the nodes agree to rounding. Zero where another process has the nodes.
    template <int dim>
    Eigen::VectorXd motion_of(const RigidPart<dim> &platen, const Vector &u)
    {
      const RigidMotion<dim> motion(platen.reference, platen.length);
      const unsigned         n = dim + RigidMotion<dim>::n_rotations;
      Eigen::MatrixXd        products = Eigen::MatrixXd::Zero(n, n);
      Eigen::VectorXd        right = Eigen::VectorXd::Zero(n);
      for (const auto &node : platen.nodes)
        for (unsigned c = 0; c < dim; ++c)
        {
          const Eigen::RowVectorXd row = motion.row(c, node.x);
          products += row.transpose() * row;
          right += u(node.dofs[c]) * row.transpose();
        }
      Eigen::VectorXd q = Eigen::CompleteOrthogonalDecomposition<Eigen::MatrixXd>(products).solve(right);
      for (unsigned a = 0; a < RigidMotion<dim>::n_rotations; ++a)
        q(dim + a) = motion.row_of_rotation(a).dot(q);
      return q;
    }
  } // namespace

  template <int dim>
  std::vector<PlatenResult>
  platen_results(const Problem<dim> &problem, const ConstraintSet<dim> &constraint_set, const Vector &u, const Vector &lambda)
  {
    std::vector<PlatenResult> results;
    if (problem.space.couplings.rigid_parts.empty())
      return results;
    const Vector missing = forces_at_unknowns(problem, constraint_set, u, lambda).missing;
    for (const auto &platen : problem.space.couplings.rigid_parts)
    {
      Vector force(missing);
      add_forces_on_part(problem, platen.part, u, force);
      PlatenResult result{problem.space.mesh.part_names[platen.part], {}, {}, {}, std::vector<double>(dim, 0.), {}};
      auto         q = motion_of(platen, u);
      problem.space.processes().sum(q.data(), q.size());
      const unsigned n_rotations = problem.axisymmetric() ? 0 : RigidMotion<dim>::n_rotations;
      for (unsigned d = 0; d < dim; ++d)
      {
        result.about.push_back(platen.reference[d]);
        result.translation.push_back(platen.translation[d].value_or(q(d)));
      }
      for (unsigned a = 0; a < n_rotations; ++a)
        result.rotation.push_back(platen.rotation[a].value_or(q(dim + a)));
      result.moment.assign(n_rotations, 0.);
      for (const auto &node : platen.nodes)
      {
        const Tensor<1, dim> r = node.x - platen.reference;
        for (unsigned d = 0; d < dim; ++d)
          result.force[d] += force(node.dofs[d]);
        if (n_rotations == 1)
          result.moment[0] += r[0] * force(node.dofs[1 % dim]) - r[1 % dim] * force(node.dofs[0]);
        if (n_rotations == 3)
          for (unsigned a = 0; a < 3; ++a)
            result.moment[a] += r[(a + 1) % dim] * force(node.dofs[(a + 2) % dim]) - r[(a + 2) % dim] * force(node.dofs[(a + 1) % dim]);
      }
      problem.space.processes().sum(result.force.data(), dim);
      problem.space.processes().sum(result.moment.data(), n_rotations);
      if (problem.axisymmetric()) // radial forces cancel around the circle
        result.force[0] = result.about[0] = 0;
      results.push_back(std::move(result));
    }
    return results;
  }

  template <int dim>
  std::vector<PeriodicResult>
  periodic_results(const Problem<dim> &problem, const ConstraintSet<dim> &constraint_set, const Vector &u, const Vector &lambda)
  {
    std::vector<PeriodicResult> results;
    if (problem.prescribed.periodic.empty())
      return results;
    const unsigned n_components = problem.form->n_components();
    const Vector   missing = forces_at_unknowns(problem, constraint_set, u, lambda).missing;
    for (const auto &pair : problem.prescribed.periodic)
    {
      PeriodicResult result{{pair.first_name, pair.second_name}, std::vector<double>(n_components, 0.)};
      for (const auto &node : nodes_of_part(pair.second, *problem.space.mapping, problem.space.dof_handler))
        for (unsigned c = 0; c < n_components; ++c)
          result.force[c] += missing(node.dofs[c]);
      problem.space.processes().sum(result.force.data(), n_components);
      results.push_back(std::move(result));
    }
    return results;
  }

#define INSTANTIATE(dim)                                                                                                                   \
  template std::vector<PlatenResult>   platen_results(const Problem<dim> &, const ConstraintSet<dim> &, const Vector &, const Vector &);   \
  template std::vector<PeriodicResult> periodic_results(const Problem<dim> &, const ConstraintSet<dim> &, const Vector &, const Vector &);
  INSTANTIATE(1)
  INSTANTIATE(2)
  INSTANTIATE(3)
#undef INSTANTIATE
} // namespace unilateral
