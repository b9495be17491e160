#include "unilateral/equilibration/composite_stresses.h"

#include "unilateral/equilibration/rigid_motions.h"
#include "unilateral/equilibration/straight_face.h"

#include <deal.II/base/quadrature_lib.h>

#include <cmath>

namespace unilateral
{
  using namespace dealii;

  namespace
  {
    /// The points of a rule on a facet.
    template <int dim>
    std::vector<Point<dim>> points_on(const std::array<Point<dim>, dim> &corners, const Quadrature<dim - 1> &rule)
    {
      std::vector<Point<dim>> points;
      for (const auto &xi : rule.get_points())
      {
        Point<dim> x = corners[0];
        for (unsigned k = 0; k + 1 < dim; ++k)
          x += xi[k] * (corners[k + 1] - corners[0]);
        points.push_back(x);
      }
      return points;
    }

    template <int dim>
    Point<dim> middle_of(const std::array<Point<dim>, dim + 1> &corners)
    {
      Point<dim> middle;
      for (const auto &corner : corners)
        middle += corner / double(dim + 1);
      return middle;
    }
  } // namespace

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
      const Eigen::MatrixXd moments = weighted.transpose() * on_parts[part].values_at(points_on<dim>(facet, rule));
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
      for (const auto &x : points_on<dim>(facet.corners, rule))
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

  /// n1' tau n2 in the middle, n1 and n2 the normals of the diagonals: its jumps on the way around add up to zero.
  template <int dim>
  Eigen::VectorXd CompositeStresses<dim>::shear_in_the_middle(const unsigned n_rows, const OrthonormalPolynomials<dim - 1> &tests) const
  {
    Eigen::VectorXd      result = Eigen::VectorXd::Zero(n_rows);
    const Tensor<1, dim> n1 = split.inner[0].normal;
    Tensor<1, dim>       n2;
    for (const auto &facet : split.inner)
      if (std::abs(facet.normal * n1) < 1 - 1e-9)
        n2 = facet.normal;
    Point<dim - 1> last; // an inner facet ends in the middle
    last[0] = 1;
    const Eigen::MatrixXd in_middle = tests.values_at({last});
    for (unsigned f = 0; f < split.inner.size(); ++f)
    {
      const auto          &facet = split.inner[f];
      const bool           along_first = std::abs(facet.normal * n1) > std::abs(facet.normal * n2);
      const Tensor<1, dim> same = along_first ? n1 : n2, other = along_first ? n2 : n1;
      // From the first to the second of its parts the way around goes to the left or to the right.
      const Tensor<1, dim> outwards = facet.corners[0] - split.centre,
                           across = middle_of(split.part(facet.parts[1])) - middle_of(split.part(facet.parts[0]));
      const double turn = outwards[0] * across[1] - outwards[1] * across[0];
      const double sign = (turn > 0 ? 1 : -1) * (facet.normal * same > 0 ? 1 : -1);
      for (unsigned i = 0; i < tests.size(); ++i)
        for (unsigned c = 0; c < dim; ++c)
          result((f * tests.size() + i) * dim + c) = sign * other[c] * in_middle(0, i);
    }
    return result;
  }

  template <int dim>
  Eigen::MatrixXd CompositeStresses<dim>::dependencies() const
  {
    constexpr unsigned                    n_modes = RigidMotions<dim>::n;
    const RigidMotions<dim>               motions{split.centre, split.centre.distance(corners[0])};
    const Quadrature<dim - 1>             rule = rule_on_face<dim>(true, 2 * degree);
    const OrthonormalPolynomials<dim - 1> tests(rule, degree);
    const Eigen::MatrixXd                 test_values = tests.values_at(rule.get_points());
    const unsigned  n_facet_rows = tests.size() * dim, n_outer = (split.inner.size() + split.facets.size()) * n_facet_rows;
    const bool      crossing = dim == 2 && !simplex;
    Eigen::MatrixXd result = Eigen::MatrixXd::Zero(n_outer + n_parts() * n_divergence * dim, n_modes + (crossing ? 1 : 0));

    // A motion v: sum over all parts of int t.v over their facets - int div tau.v = 0, where inner facets are met from both sides.
    unsigned   row = 0;
    const auto add_facet = [&](const std::array<Point<dim>, dim> &facet, const double sign)
    {
      const auto   points = points_on<dim>(facet, rule);
      const double size = sign * (dim == 2 ? facet[0].distance(facet[1]) : 1.);
      for (unsigned q = 0; q < rule.size(); ++q)
      {
        const auto modes = motions.at(points[q]);
        for (unsigned i = 0; i < tests.size(); ++i)
          for (unsigned m = 0; m < n_modes; ++m)
            for (unsigned c = 0; c < dim; ++c)
              result(row + i * dim + c, m) += size * rule.weight(q) * test_values(q, i) * modes[m][c];
      }
      row += n_facet_rows;
    };
    for (const auto &facet : split.inner)
      add_facet(facet.corners, facet.normal * (facet.corners[0] - middle_of(split.part(facet.parts[0]))) > 0 ? 1 : -1);
    for (const auto &facet : split.facets)
      add_facet(facet.corners, 1);
    for (unsigned j = 0; j < n_parts(); ++j)
    {
      const auto            in_part = simplex_rule<dim>(split.part(j), 2 * degree);
      const Eigen::MatrixXd values = on_parts[j].values_at(in_part.get_points());
      for (unsigned q = 0; q < in_part.size(); ++q)
      {
        const auto modes = motions.at(in_part.point(q));
        for (unsigned l = 0; l < n_divergence; ++l)
          for (unsigned m = 0; m < n_modes; ++m)
            for (unsigned c = 0; c < dim; ++c)
              result(row + l * dim + c, m) -= in_part.weight(q) * values(q, l) * modes[m][c];
      }
      row += n_divergence * dim;
    }

    if constexpr (dim == 2)
      if (crossing)
        result.col(n_modes) = shear_in_the_middle(result.rows(), tests);
    return result;
  }

  template class CompositeStresses<2>;
  template class CompositeStresses<3>;
} // namespace unilateral
