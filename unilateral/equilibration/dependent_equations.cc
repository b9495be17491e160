#include "unilateral/equilibration/dependent_equations.h"

#include "unilateral/equilibration/rigid_motions.h"
#include "unilateral/equilibration/straight_face.h"

#include <array>
#include <cmath>

namespace unilateral
{
  using namespace dealii;

  namespace
  {
    /// The functions by which tractions on facets are tested, and a rule for them.
    struct Tests
    {
      explicit Tests(const unsigned degree) : rule(rule_on_face<2>(true, 2 * degree)), functions(rule, degree) {}

      Quadrature<1>             rule;
      OrthonormalPolynomials<1> functions;
    };

    Point<2> middle_of(const std::array<Point<2>, 3> &corners)
    {
      return Point<2>((corners[0] + Tensor<1, 2>(corners[1]) + Tensor<1, 2>(corners[2])) / 3.);
    }

    /// A rigid body mode v: the sum over all parts of int t.v over their facets - int div tau.v = 0, where inner facets are met from both
    /// sides.
    Eigen::MatrixXd balance(const CompositeStresses<2> &stresses, const Tests &tests, const unsigned n_rows)
    {
      constexpr unsigned    dim = 2, n_modes = RigidMotions<dim>::n;
      const auto           &split = stresses.split;
      const RigidMotions<2> motions{split.centre, split.centre.distance(stresses.corners[0])};
      const Eigen::MatrixXd values = tests.functions.values_at(tests.rule.get_points());
      Eigen::MatrixXd       result = Eigen::MatrixXd::Zero(n_rows, n_modes);
      unsigned              row = 0;
      const auto            add_facet = [&](const std::array<Point<dim>, dim> &facet, const double sign)
      {
        const auto points = points_on_facet<dim>(facet, tests.rule);
        for (unsigned q = 0; q < points.size(); ++q)
        {
          const double w = sign * facet[0].distance(facet[1]) * tests.rule.weight(q);
          const auto   modes = motions.at(points[q]);
          for (unsigned i = 0; i < tests.functions.size(); ++i)
            for (unsigned m = 0; m < n_modes; ++m)
              for (unsigned c = 0; c < dim; ++c)
                result(row + i * dim + c, m) += w * values(q, i) * modes[m][c];
        }
        row += tests.functions.size() * dim;
      };
      for (const auto &facet : split.inner)
        add_facet(facet.corners, facet.normal * (facet.corners[0] - middle_of(split.part(facet.parts[0]))) > 0 ? 1 : -1);
      for (const auto &facet : split.facets)
        add_facet(facet.corners, 1);
      for (unsigned j = 0; j < stresses.n_parts(); ++j)
      {
        const auto            in_part = simplex_rule<dim>(split.part(j), 2 * stresses.degree);
        const Eigen::MatrixXd functions = stresses.on_parts[j].values_at(in_part.get_points());
        for (unsigned q = 0; q < in_part.size(); ++q)
        {
          const auto modes = motions.at(in_part.point(q));
          for (unsigned l = 0; l < stresses.n_divergence; ++l)
            for (unsigned m = 0; m < n_modes; ++m)
              for (unsigned c = 0; c < dim; ++c)
                result(row + l * dim + c, m) -= in_part.weight(q) * functions(q, l) * modes[m][c];
        }
        row += stresses.n_divergence * dim;
      }
      return result;
    }

    /// n1' tau n2 at the crossing, n1 and n2 the normals of the diagonals: its jumps on the way around add up to zero.
    Eigen::VectorXd shear_at_the_crossing(const CompositeStresses<2> &stresses, const Tests &tests, const unsigned n_rows)
    {
      constexpr unsigned   dim = 2;
      const auto          &split = stresses.split;
      const Tensor<1, dim> n1 = split.inner[0].normal;
      Tensor<1, dim>       n2;
      for (const auto &facet : split.inner)
        if (std::abs(facet.normal * n1) < 1 - 1e-9)
          n2 = facet.normal;
      const Eigen::MatrixXd at_crossing = tests.functions.values_at({Point<1>(1.)}); // where inner facets end
      Eigen::VectorXd       result = Eigen::VectorXd::Zero(n_rows);
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
        for (unsigned i = 0; i < tests.functions.size(); ++i)
          for (unsigned c = 0; c < dim; ++c)
            result((f * tests.functions.size() + i) * dim + c) = sign * other[c] * at_crossing(0, i);
      }
      return result;
    }
  } // namespace

  Eigen::MatrixXd dependent_equations(const CompositeStresses<2> &stresses)
  {
    const Tests     tests(stresses.degree);
    const unsigned  n_facets = stresses.split.inner.size() + stresses.split.facets.size();
    const unsigned  n_rows = 2 * (n_facets * tests.functions.size() + stresses.n_parts() * stresses.n_divergence);
    Eigen::MatrixXd result = balance(stresses, tests, n_rows);
    if (!stresses.simplex)
    {
      result.conservativeResize(Eigen::NoChange, result.cols() + 1);
      result.rightCols(1) = shear_at_the_crossing(stresses, tests, n_rows);
    }
    return result;
  }
} // namespace unilateral
