#include "unilateral/equilibration/stress_balance.h"

#include "unilateral/algebra/dense_solvers.h"

#include <deal.II/lac/dynamic_sparsity_pattern.h>
#include <deal.II/lac/sparse_matrix.h>
#include <deal.II/lac/sparsity_pattern.h>

#include <algorithm>
#include <cmath>

namespace unilateral
{
  using namespace dealii;

  template <int dim>
  StressBalance<dim>::StressBalance(const FaceTractions<dim>             &tractions,
                                    const std::vector<RigidMotions<dim>> &motions,
                                    const std::vector<double>            &stiffness,
                                    const Eigen::MatrixXd                &free,
                                    const RigidMotions<dim>              &body)
    : motions(motions)
  {
    const auto                 &rule = tractions.rule;
    std::vector<Point<dim - 1>> parameters(rule.size());
    for (const auto &face : tractions.faces)
    {
      double yield = 0;
      for (std::size_t m = face.begin; m < face.end; ++m)
      {
        const auto             &member = tractions.members[m];
        const auto             &cell = tractions.cell(member.cell);
        const bool              owner = m == face.begin;
        const StraightFace<dim> own = owner ? face.geometry : StraightFace<dim>(cell, member.face);
        yield += cell->measure() / (2 * own.dS * (tractions.simplex && dim == 3 ? 0.5 : 1) * stiffness[member.cell]) /
                 (owner ? 1. : double(face.end - face.begin - 1));
        for (unsigned q = 0; q < rule.size(); ++q)
          parameters[q] = face.geometry.parameters(own.at(rule.point(q)));
        const Eigen::MatrixXd functions = tractions.basis.values_at(parameters);
        starts.push_back(couplings.size());
        couplings.resize(couplings.size() + face.open.size() * dim * n_modes, 0.);
        double *const S = couplings.data() + starts.back();
        for (unsigned q = 0; q < rule.size(); ++q)
        {
          const auto   modes = motions[member.cell].at(own.at(rule.point(q)));
          const double w = rule.weight(q) * own.dS / std::sqrt(face.geometry.dS) * (owner ? 1 : -1);
          for (unsigned d = 0; d < face.open.size(); ++d)
            for (unsigned k = 0; k < n_modes; ++k)
            {
              const double along = w * (face.open[d] * modes[k]);
              for (unsigned a = 0; a < dim; ++a)
                S[(d * dim + a) * n_modes + k] += along * functions(q, a);
            }
        }
      }
      weights.push_back(1 / yield);
    }
    factorise(tractions, free, body);
  }

  template <int dim>
  Eigen::MatrixXd
  StressBalance<dim>::free_modes(const FaceTractions<dim> &tractions, const RigidMotions<dim> &body, const Processes &processes)
  {
    Eigen::MatrixXd resistance = Eigen::MatrixXd::Zero(n_modes, n_modes);
    double          area = 0;
    for (const auto &face : tractions.faces)
      if (face.end - face.begin == 1)
        for (unsigned q = 0; q < tractions.rule.size(); ++q)
        {
          const double w = tractions.rule.weight(q) * face.geometry.dS;
          const auto   modes = body.at(face.geometry.at(tractions.rule.point(q)));
          area += w;
          for (const auto &direction : face.open)
            for (unsigned k = 0; k < n_modes; ++k)
              for (unsigned l = 0; l < n_modes; ++l)
                resistance(k, l) += w * (direction * modes[k]) * (direction * modes[l]);
        }
    processes.sum(resistance.data(), resistance.size());
    area = processes.sum(area);
    const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> eigen(resistance);
    unsigned                                             n = 0;
    while (n < n_modes && eigen.eigenvalues()(n) < 1e-12 * area)
      ++n;
    return eigen.eigenvectors().leftCols(n);
  }

  template <int dim>
  void StressBalance<dim>::factorise(const FaceTractions<dim> &tractions, const Eigen::MatrixXd &free, const RigidMotions<dim> &body)
  {
    const unsigned         n = motions.size() * n_modes;
    DynamicSparsityPattern pairs(n, n);
    const auto            &members = tractions.members;
    for (const auto &face : tractions.faces)
      for (std::size_t a = face.begin; a < face.end; ++a)
        for (std::size_t b = face.begin; b < face.end; ++b)
          for (unsigned k = 0; k < n_modes; ++k)
            for (unsigned l = 0; l < n_modes; ++l)
              pairs.add(members[a].cell * n_modes + k, members[b].cell * n_modes + l);
    SparsityPattern pattern;
    pattern.copy_from(pairs);
    SparseMatrix<double> matrix(pattern);
    for (std::size_t f = 0; f < tractions.faces.size(); ++f)
    {
      const auto &face = tractions.faces[f];
      for (std::size_t a = face.begin; a < face.end; ++a)
        for (std::size_t b = face.begin; b < face.end; ++b)
          for (unsigned k = 0; k < n_modes; ++k)
            for (unsigned l = 0; l < n_modes; ++l)
            {
              double sum = 0;
              for (unsigned row = 0; row < face.open.size() * dim; ++row)
                sum += coupling(a, row)[k] * coupling(b, row)[l];
              matrix.add(members[a].cell * n_modes + k, members[b].cell * n_modes + l, weights[f] * sum);
            }
    }
    if (free.cols() > 0)
    {
      // One cell is held in these modes of the body: where r is in balance, with no force.
      const Eigen::MatrixXd of_cell = in_terms_of(motions[0], body) * free;
      const Eigen::MatrixXd onto = of_cell * (of_cell.transpose() * of_cell).llt().solve(of_cell.transpose());
      double                size = 0;
      for (unsigned k = 0; k < n_modes; ++k)
        size += matrix(k, k) / n_modes;
      for (unsigned k = 0; k < n_modes; ++k)
        for (unsigned l = 0; l < n_modes; ++l)
          matrix.add(k, l, size * onto(k, l));
    }
    factors.emplace(matrix);
    factors->factorise(matrix);
  }

  template <int dim>
  std::vector<double> StressBalance<dim>::multipliers(const std::vector<double> &r) const
  {
    std::vector<double> mu(r.size());
    factors->forward(r.data(), mu.data());
    factors->backward(mu.data(), mu.data());
    return mu;
  }

  template <int dim>
  void StressBalance<dim>::solve(FaceTractions<dim> &tractions, std::vector<double> &r) const
  {
    const auto &members = tractions.members;
    // Repeated for what rounding has left.
    for (unsigned pass = 0; pass < 3; ++pass)
    {
      const auto mu = multipliers(r);
      for (std::size_t f = 0; f < tractions.faces.size(); ++f)
      {
        const auto &face = tractions.faces[f];
        for (unsigned row = 0; row < face.open.size() * dim; ++row)
        {
          double jump = 0;
          for (std::size_t a = face.begin; a < face.end; ++a)
            for (unsigned k = 0; k < n_modes; ++k)
              jump += coupling(a, row)[k] * mu[members[a].cell * n_modes + k];
          const double amount = weights[f] * jump;
          tractions.add(f, row % dim, amount / std::sqrt(face.geometry.dS) * face.open[row / dim]);
          for (std::size_t a = face.begin; a < face.end; ++a)
            for (unsigned k = 0; k < n_modes; ++k)
              r[members[a].cell * n_modes + k] -= amount * coupling(a, row)[k];
        }
      }
    }
  }

  template class StressBalance<2>;
  template class StressBalance<3>;
} // namespace unilateral
