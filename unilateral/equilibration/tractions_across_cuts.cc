#include "unilateral/equilibration/tractions_across_cuts.h"

#include <map>

namespace unilateral
{
  using namespace dealii;

  template <int dim>
  TractionsAcrossCuts<dim>::TractionsAcrossCuts(const CutFaces<dim>                  &cuts,
                                                const FaceTractions<dim>             &tractions,
                                                const StressBalance<dim>             &within,
                                                const std::vector<RigidMotions<dim>> &motions,
                                                const RigidMotions<dim>              &body,
                                                const Processes                      &processes)
    : cuts(cuts), tractions(tractions), within(within), body(body), processes(processes)
  {
    const auto                      &rule = tractions.rule;
    std::vector<std::vector<double>> yields;
    for (const auto &cut : cuts.faces())
    {
      CutFace     face{.face = tractions.face_of(cut.cell, cut.face), .cell = cut.cell, .beyond = cuts.find(cut.cell, cut.face)->process};
      const auto &geometry = tractions.faces[face.face].geometry;
      double      area = 0;
      for (unsigned q = 0; q < rule.size(); ++q)
      {
        area += rule.weight(q);
        face.frame.centre += rule.weight(q) * geometry.at(rule.point(q));
      }
      face.frame.centre /= area;
      face.frame.size = motions[cut.cell].size;
      face.products.setZero();
      for (unsigned q = 0; q < rule.size(); ++q)
      {
        const auto modes = face.frame.at(geometry.at(rule.point(q)));
        for (unsigned k = 0; k < n_modes; ++k)
          for (unsigned l = 0; l < n_modes; ++l)
            face.products(k, l) += rule.weight(q) * geometry.dS * (modes[k] * modes[l]);
      }
      face.of_cell = in_terms_of(face.frame, motions[cut.cell]);
      face.of_body = in_terms_of(face.frame, body);
      cut_faces.push_back(face);
      yields.push_back({1 / within.weight(face.face)});
    }
    const auto beyond = cuts.exchange(yields);
    for (std::size_t k = 0; k < cut_faces.size(); ++k)
      cut_faces[k].weight = 1 / (yields[k][0] + beyond[k][0]);

    std::map<unsigned, Eigen::MatrixXd> products; // on common cuts; with the own process: on open directions of the boundary
    const auto                          of = [&](const unsigned process) -> Eigen::MatrixXd &
    { return products.try_emplace(process, Eigen::MatrixXd::Zero(n_modes, n_modes)).first->second; };
    for (const CutFace &face : cut_faces)
      of(face.beyond) += face.weight * face.of_body.transpose() * face.products * face.of_body;
    for (std::size_t f = 0; f < tractions.faces.size(); ++f)
    {
      const auto &face = tractions.faces[f];
      const auto &owner = tractions.members[face.begin];
      if (!tractions.cell(owner.cell)->at_boundary(owner.face))
        continue;
      for (unsigned q = 0; q < rule.size(); ++q)
      {
        const auto modes = body.at(face.geometry.at(rule.point(q)));
        for (const auto &direction : face.open) // none on cuts
          for (unsigned k = 0; k < n_modes; ++k)
            for (unsigned l = 0; l < n_modes; ++l)
              of(processes.rank())(k, l) +=
                within.weight(f) * rule.weight(q) * face.geometry.dS * (direction * modes[k]) * (direction * modes[l]);
      }
    }
    system = std::make_unique<SystemOfParts>(processes, n_modes, products);
  }

  template <int dim>
  typename TractionsAcrossCuts<dim>::OnCuts TractionsAcrossCuts<dim>::jumps(const std::vector<double> &mu) const
  {
    OnCuts                           own(n_modes, cut_faces.size());
    std::vector<std::vector<double>> sent;
    for (std::size_t k = 0; k < cut_faces.size(); ++k)
    {
      const Eigen::Map<const Eigen::VectorXd> of_cell(&mu[cut_faces[k].cell * n_modes], n_modes);
      own.col(k) = cut_faces[k].of_cell * of_cell;
      sent.emplace_back(own.col(k).begin(), own.col(k).end());
      for (unsigned l = dim; l < n_modes; ++l) // by length 1, not by the size of a cell, which is another beyond the cut
        sent[k][l] /= cut_faces[k].frame.size;
    }
    const auto beyond = cuts.exchange(sent);
    for (std::size_t k = 0; k < cut_faces.size(); ++k)
      for (unsigned l = 0; l < n_modes; ++l)
        own(l, k) -= beyond[k][l] * (l < dim ? 1. : cut_faces[k].frame.size);
    return own;
  }

  template <int dim>
  typename TractionsAcrossCuts<dim>::OnCuts TractionsAcrossCuts<dim>::weighted(OnCuts motions) const
  {
    for (std::size_t k = 0; k < cut_faces.size(); ++k)
      motions.col(k) *= cut_faces[k].weight;
    return motions;
  }

  template <int dim>
  typename TractionsAcrossCuts<dim>::OnCuts TractionsAcrossCuts<dim>::between_parts(const Eigen::VectorXd &alpha) const
  {
    OnCuts result(n_modes, cut_faces.size());
    for (std::size_t k = 0; k < cut_faces.size(); ++k)
      result.col(k) =
        cut_faces[k].of_body * (alpha.segment(processes.rank() * n_modes, n_modes) - alpha.segment(cut_faces[k].beyond * n_modes, n_modes));
    return weighted(std::move(result));
  }

  template <int dim>
  Eigen::VectorXd TractionsAcrossCuts<dim>::force_on_part(const OnCuts &t) const
  {
    Eigen::VectorXd sum = Eigen::VectorXd::Zero(n_modes);
    for (std::size_t k = 0; k < cut_faces.size(); ++k)
      sum += cut_faces[k].of_body.transpose() * (cut_faces[k].products * t.col(k));
    return sum;
  }

  template <int dim>
  typename TractionsAcrossCuts<dim>::OnCuts TractionsAcrossCuts<dim>::with_parts_in_balance(const OnCuts &t) const
  {
    return t - between_parts(system->solve(force_on_part(t)));
  }

  template <int dim>
  double TractionsAcrossCuts<dim>::product(const OnCuts &a, const OnCuts &b) const
  {
    double sum = 0;
    for (std::size_t k = 0; k < cut_faces.size(); ++k)
      sum += a.col(k).dot(cut_faces[k].products * b.col(k)) / cut_faces[k].weight;
    return processes.sum(sum);
  }

  template <int dim>
  void TractionsAcrossCuts<dim>::take_off(const OnCuts &t, std::vector<double> &r) const
  {
    for (std::size_t k = 0; k < cut_faces.size(); ++k)
      Eigen::Map<Eigen::VectorXd>(&r[cut_faces[k].cell * n_modes], n_modes) -=
        cut_faces[k].of_cell.transpose() * (cut_faces[k].products * t.col(k));
  }

  template <int dim>
  std::vector<typename TractionsAcrossCuts<dim>::OnFace> TractionsAcrossCuts<dim>::solve(std::vector<double>    r,
                                                                                         const Eigen::VectorXd &r_of_part) const
  {
    constexpr double   tolerance = 0.01; // of the gradient
    constexpr unsigned most_steps = 20;
    OnCuts             t = between_parts(system->solve(r_of_part));
    take_off(t, r);
    OnCuts       gradient = t - weighted(jumps(within.multipliers(r)));
    OnCuts       descent = with_parts_in_balance(gradient), direction = -descent;
    double       square = product(gradient, descent);
    const double first = square;
    for (unsigned step = 0; step < most_steps && square > tolerance * tolerance * first; ++step)
    {
      std::vector<double> short_of(r.size(), 0.);
      take_off(direction, short_of);
      const OnCuts change = direction - weighted(jumps(within.multipliers(short_of)));
      const double curvature = product(direction, change);
      if (!(curvature > 0))
        break;
      t += square / curvature * direction;
      gradient += square / curvature * change;
      descent = with_parts_in_balance(gradient);
      const double next = product(gradient, descent);
      direction = next / square * direction - descent;
      square = next;
    }

    const auto                             &rule = tractions.rule;
    const Eigen::Map<const Eigen::VectorXd> weights(rule.get_weights().data(), rule.size());
    std::vector<OnFace>                     result;
    for (std::size_t k = 0; k < cut_faces.size(); ++k)
    {
      Eigen::MatrixXd values = Eigen::MatrixXd::Zero(rule.size(), dim);
      for (unsigned q = 0; q < rule.size(); ++q)
      {
        const auto modes = cut_faces[k].frame.at(tractions.faces[cut_faces[k].face].geometry.at(rule.point(q)));
        for (unsigned l = 0; l < n_modes; ++l)
          for (unsigned d = 0; d < dim; ++d)
            values(q, d) += t(l, k) * modes[l][d];
      }
      result.push_back({cut_faces[k].face, tractions.tests.transpose() * weights.asDiagonal() * values});
    }
    return result;
  }

  template class TractionsAcrossCuts<2>;
  template class TractionsAcrossCuts<3>;
} // namespace unilateral
