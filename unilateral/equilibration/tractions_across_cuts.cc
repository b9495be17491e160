#include "unilateral/equilibration/tractions_across_cuts.h"

#include <map>

namespace unilateral
{
  using namespace dealii;

  template <int dim>
  TractionsAcrossCuts<dim>::TractionsAcrossCuts(const Problem<dim>       &problem,
                                                const CutFaces<dim>      &cuts,
                                                const FaceTractions<dim> &tractions,
                                                const RigidMotions<dim>  &body)
    : tractions(tractions), body(body), processes(problem.space.processes())
  {
    std::vector<Tensor<1, dim>> all;
    for (unsigned d = 0; d < dim; ++d)
      all.push_back(Point<dim>::unit_vector(d));
    std::map<unsigned, Eigen::MatrixXd> products; // on common cuts; with the own process: on open directions of the boundary
    const auto                          of = [&](const unsigned process) -> Eigen::MatrixXd &
    { return products.try_emplace(process, Eigen::MatrixXd::Zero(n_modes, n_modes)).first->second; };
    for (std::size_t f = 0; f < tractions.faces.size(); ++f)
    {
      const auto &owner = tractions.members[tractions.faces[f].begin];
      const auto &cell = tractions.cell(owner.cell);
      if (const auto *const beyond = cuts.find(owner.cell, owner.face))
      {
        cut_faces.push_back({f, beyond->process});
        add_products(f, all, of(beyond->process));
      }
      else if (cell->at_boundary(owner.face))
        add_products(f, tractions.faces[f].open, of(processes.rank()));
    }
    system = std::make_unique<SystemOfParts>(processes, n_modes, products);
  }

  template <int dim>
  void TractionsAcrossCuts<dim>::add_products(const std::size_t                  face,
                                              const std::vector<Tensor<1, dim>> &directions,
                                              Eigen::MatrixXd                   &matrix) const
  {
    const auto &geometry = tractions.faces[face].geometry;
    for (unsigned q = 0; q < tractions.rule.size(); ++q)
    {
      const double w = tractions.rule.weight(q) * geometry.dS;
      const auto   modes = body.at(geometry.at(tractions.rule.point(q)));
      for (const auto &direction : directions)
        for (unsigned k = 0; k < n_modes; ++k)
          for (unsigned l = 0; l < n_modes; ++l)
            matrix(k, l) += w * (direction * modes[k]) * (direction * modes[l]);
    }
  }

  template <int dim>
  std::vector<typename TractionsAcrossCuts<dim>::OnFace> TractionsAcrossCuts<dim>::solve(const Eigen::VectorXd &r) const
  {
    const Eigen::VectorXd                   mu = system->solve(r);
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
