#include "unilateral/equilibration/composite_stresses.h"

#include "unilateral/equilibration/straight_face.h"

#include <deal.II/base/quadrature_lib.h>

namespace unilateral
{
  using namespace dealii;

  template <int dim>
  CompositeStresses<dim>::CompositeStresses(const std::vector<Point<dim>> &corners, const bool simplex, const unsigned degree)
    : corners(corners), simplex(simplex), degree(degree), split(corners, simplex), n_faces(simplex ? dim + 1 : 2 * dim),
      face_basis(rule_on_face<dim>(simplex, 2 * degree), degree), n_divergence(OrthonormalPolynomials<dim>::size_of(degree - 1))
  {
    for (unsigned j = 0; j < n_parts(); ++j)
      on_parts.emplace_back(simplex_rule<dim>(split.part(j), 2 * degree), degree);
  }

  template <int dim>
  typename CompositeStresses<dim>::Equations CompositeStresses<dim>::equations() const
  {
    const Quadrature<dim - 1>             rule = rule_on_face<dim>(true, 2 * degree);
    const OrthonormalPolynomials<dim - 1> tests(rule, degree);
    const Eigen::MatrixXd                 weighted =
      Eigen::Map<const Eigen::VectorXd>(rule.get_weights().data(), rule.size()).asDiagonal() * tests.values_at(rule.get_points());
    const unsigned n_facet_rows = tests.size() * dim;
    Equations      result;
    const unsigned n_rows = (split.inner.size() + split.facets.size()) * n_facet_rows + n_parts() * n_divergence * dim;
    result.matrix = Eigen::MatrixXd::Zero(n_rows, size());
    result.data = Eigen::MatrixXd::Zero(n_rows, n_data());
    unsigned row = 0;

    // The moments of the traction of a part on a facet.
    const auto add_traction = [&](const unsigned part, const std::array<Point<dim>, dim> &facet, const Tensor<1, dim> &normal)
    {
      const Eigen::MatrixXd moments = weighted.transpose() * on_parts[part].values_at(points_on_facet<dim>(facet, rule));
      for (unsigned i = 0; i < tests.size(); ++i)
        for (unsigned c = 0; c < dim; ++c)
          for (unsigned k = 0; k < n_scalar(); ++k)
            for (unsigned e = 0; e < dim; ++e)
              result.matrix(row + i * dim + c, index(part, k, stress_index<dim>(c, e))) += moments(i, k) * normal[e];
    };
    for (const auto &facet : split.inner)
    {
      add_traction(facet.parts[0], facet.corners, facet.normal);
      add_traction(facet.parts[1], facet.corners, -facet.normal);
      row += n_facet_rows;
    }
    for (unsigned j = 0; j < n_parts(); ++j)
    {
      const auto &facet = split.facets[j];
      add_traction(j, facet.corners, facet.normal);
      const StraightFace<dim>     face(corners, simplex, facet.face);
      std::vector<Point<dim - 1>> parameters;
      for (const auto &x : points_on_facet<dim>(facet.corners, rule))
        parameters.push_back(face.parameters(x));
      const Eigen::MatrixXd moments = weighted.transpose() * face_basis.values_at(parameters);
      for (unsigned i = 0; i < tests.size(); ++i)
        for (unsigned c = 0; c < dim; ++c)
          for (unsigned m = 0; m < face_basis.size(); ++m)
            result.data(row + i * dim + c, traction(facet.face, m, c)) = moments(i, m);
      row += n_facet_rows;
    }
    for (unsigned j = 0; j < n_parts(); ++j)
    {
      const auto                              in_part = simplex_rule<dim>(split.part(j), 2 * degree);
      const Eigen::MatrixXd                   values = on_parts[j].values_at(in_part.get_points());
      const auto                              gradients = on_parts[j].gradients_at(in_part.get_points());
      const Eigen::Map<const Eigen::VectorXd> weights(in_part.get_weights().data(), in_part.size());
      const Eigen::MatrixXd                   test = weights.asDiagonal() * values.leftCols(n_divergence);
      for (unsigned e = 0; e < dim; ++e)
      {
        const Eigen::MatrixXd products = test.transpose() * gradients[e];
        for (unsigned l = 0; l < n_divergence; ++l)
          for (unsigned c = 0; c < dim; ++c)
            for (unsigned k = 0; k < n_scalar(); ++k)
              result.matrix(row + l * dim + c, index(j, k, stress_index<dim>(c, e))) += products(l, k);
      }
      for (unsigned l = 0; l < n_divergence; ++l)
        for (unsigned c = 0; c < dim; ++c)
          result.data(row + l * dim + c, divergence(j, l, c)) = 1;
      row += n_divergence * dim;
    }
    return result;
  }

  template class CompositeStresses<2>;
  template class CompositeStresses<3>;
} // namespace unilateral
