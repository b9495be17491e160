#include "unilateral/equilibration/tractions_across_cuts.h"

#include "unilateral/algebra/dense_solvers.h"

namespace unilateral
{
  using namespace dealii;

  template <int dim>
  TractionsAcrossCuts<dim>::TractionsAcrossCuts(const Problem<dim>       &problem,
                                                const CutFaces<dim>      &cuts,
                                                const FaceTractions<dim> &tractions,
                                                const RigidMotions<dim>  &body)
    : tractions(tractions), body(body), processes(problem.space.processes()), products(processes.size() * n_modes * n_modes, 0.)
  {
    std::vector<Tensor<1, dim>> all;
    for (unsigned d = 0; d < dim; ++d)
      all.push_back(Point<dim>::unit_vector(d));
    for (std::size_t f = 0; f < tractions.faces.size(); ++f)
    {
      const auto &owner = tractions.members[tractions.faces[f].begin];
      const auto &cell = tractions.cell(owner.cell);
      if (const auto *const beyond = cuts.find(owner.cell, owner.face))
      {
        cut_faces.push_back({f, beyond->process});
        add_products(f, all, &products[beyond->process * n_modes * n_modes]);
      }
      else if (cell->at_boundary(owner.face))
        add_products(f, tractions.faces[f].open, &products[processes.rank() * n_modes * n_modes]);
    }
  }

  template <int dim>
  void
  TractionsAcrossCuts<dim>::add_products(const std::size_t face, const std::vector<Tensor<1, dim>> &directions, double *const matrix) const
  {
    const auto &geometry = tractions.faces[face].geometry;
    for (unsigned q = 0; q < tractions.rule.size(); ++q)
    {
      const double w = tractions.rule.weight(q) * geometry.dS;
      const auto   modes = body.at(geometry.at(tractions.rule.point(q)));
      for (const auto &direction : directions)
        for (unsigned k = 0; k < n_modes; ++k)
          for (unsigned l = 0; l < n_modes; ++l)
            matrix[k * n_modes + l] += w * (direction * modes[k]) * (direction * modes[l]);
    }
  }

  template <int dim>
  std::vector<typename TractionsAcrossCuts<dim>::OnFace> TractionsAcrossCuts<dim>::solve(const Eigen::VectorXd &r) const
  {
    const unsigned            n = processes.size(), size = n_modes * n_modes;
    const std::vector<double> all_products = processes.gather(products), all_r = processes.gather(std::vector<double>(r.begin(), r.end()));
    using Block = Eigen::Map<const Eigen::Matrix<double, n_modes, n_modes>>;
    const auto block = [&](const unsigned p, const unsigned q) { return Block(&all_products[(p * n + q) * size]); };
    // Both sides integrate over a cut, and round.
    Eigen::MatrixXd matrix = Eigen::MatrixXd::Zero(n * n_modes, n * n_modes);
    for (unsigned p = 0; p < n; ++p)
    {
      matrix.block<n_modes, n_modes>(p * n_modes, p * n_modes) += block(p, p);
      for (unsigned q = 0; q < n; ++q)
        if (q != p)
        {
          const Eigen::MatrixXd common = 0.5 * (block(p, q) + block(q, p));
          matrix.block<n_modes, n_modes>(p * n_modes, p * n_modes) += common;
          matrix.block<n_modes, n_modes>(p * n_modes, q * n_modes) -= common;
        }
    }
    Eigen::CompleteOrthogonalDecomposition<Eigen::MatrixXd> solver;
    solver.setThreshold(1e-12);
    solver.compute(matrix);
    const Eigen::VectorXd mu = solver.solve(Eigen::Map<const Eigen::VectorXd>(all_r.data(), all_r.size()));

    const auto                             &rule = tractions.rule;
    const Eigen::Map<const Eigen::VectorXd> weights(rule.get_weights().data(), rule.size());
    std::vector<OnFace>                     result;
    for (const auto &[face, beyond] : cut_faces)
    {
      const Eigen::VectorXd jump = mu.segment(processes.rank() * n_modes, n_modes) - mu.segment(beyond * n_modes, n_modes);
      Eigen::MatrixXd       values = Eigen::MatrixXd::Zero(rule.size(), dim);
      for (unsigned q = 0; q < rule.size(); ++q)
      {
        const auto modes = body.at(tractions.faces[face].geometry.at(rule.point(q)));
        for (unsigned k = 0; k < n_modes; ++k)
          for (unsigned d = 0; d < dim; ++d)
            values(q, d) += jump(k) * modes[k][d];
      }
      result.push_back({face, tractions.tests.transpose() * weights.asDiagonal() * values});
    }
    return result;
  }

  template class TractionsAcrossCuts<2>;
  template class TractionsAcrossCuts<3>;
} // namespace unilateral
