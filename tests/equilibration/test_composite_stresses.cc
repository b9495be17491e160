// Symmetric stresses on single cells: tractions, divergence, what is left free; polynomials and rules on simplices.
#include "small_problem.h"

#include "unilateral/equilibration/cell_stress.h"
#include "unilateral/equilibration/composite_stresses.h"
#include "unilateral/equilibration/dependent_equations.h"
#include "unilateral/equilibration/straight_face.h"
#include "unilateral/equilibration/stress_basis.h"

#include <gtest/gtest.h>

#include <Eigen/LU>
#include <Eigen/QR>

#include <cmath>
#include <random>
#include <vector>

using namespace unilateral;
using dealii::Point;

namespace
{
  /// A polynomial stress field of degree r is found from its tractions and divergence, up to bubbles; bubbles have neither.
  template <int dim>
  void check_stresses(const std::vector<Point<dim>> &corners, const bool simplex, const unsigned degree, const int n_bubbles)
  {
    const CompositeStresses<dim> stresses(corners, simplex, degree);
    const auto                   rule = rule_on_face<dim>(simplex, 2 * degree);
    const auto                   in_faces = stresses.face_basis.values_at(rule.get_points());
    // A field that is one polynomial on the whole cell, different in every component.
    const auto field = [&](const Point<dim> &x, const unsigned component)
    {
      double value = component + 1;
      for (unsigned d = 0; d < dim; ++d)
        value += std::pow(x[d] + 0.3, degree) * (d + 1) * (component + 2) * (component % 2 ? -1 : 1);
      return value;
    };
    Eigen::VectorXd x = Eigen::VectorXd::Zero(stresses.size()), data = Eigen::VectorXd::Zero(stresses.n_data());
    for (unsigned j = 0; j < stresses.n_parts(); ++j)
    {
      const auto            part = simplex_rule<dim>(stresses.split.part(j), 2 * degree);
      const Eigen::MatrixXd phi = stresses.on_parts[j].values_at(part.get_points());
      for (unsigned q = 0; q < part.size(); ++q)
        for (unsigned k = 0; k < stresses.n_scalar(); ++k)
          for (unsigned s = 0; s < stresses.n_components; ++s)
            x(stresses.index(j, k, s)) += part.weight(q) * phi(q, k) * field(part.point(q), s);
      const auto gradients = stresses.on_parts[j].gradients_at(part.get_points());
      for (unsigned q = 0; q < part.size(); ++q)
        for (unsigned c = 0; c < dim; ++c)
        {
          double divergence = 0;
          for (unsigned k = 0; k < stresses.n_scalar(); ++k)
            for (unsigned e = 0; e < dim; ++e)
              divergence += gradients[e](q, k) * x(stresses.index(j, k, stress_index<dim>(c, e)));
          for (unsigned k = 0; k < stresses.n_divergence; ++k)
            data(stresses.divergence(j, k, c)) += part.weight(q) * phi(q, k) * divergence;
        }
    }
    for (unsigned f = 0; f < stresses.n_faces; ++f)
    {
      const StraightFace<dim> face(corners, simplex, f);
      for (unsigned q = 0; q < rule.size(); ++q)
        for (unsigned c = 0; c < dim; ++c)
          for (unsigned m = 0; m < stresses.face_basis.size(); ++m)
            for (unsigned e = 0; e < dim; ++e)
              data(stresses.traction(f, m, c)) +=
                rule.weight(q) * in_faces(q, m) * field(face.at(rule.point(q)), stress_index<dim>(c, e)) * face.normal[e];
    }
    const StressBasis basis(stresses);
    Eigen::VectorXd   difference = basis.particular * data - x;
    difference -= basis.bubbles * (basis.bubbles.transpose() * difference);
    EXPECT_LT(difference.norm(), 1e-9 * x.norm()) << dim << simplex << degree;
    EXPECT_EQ(basis.bubbles.cols(), n_bubbles) << dim << simplex << degree;
  }
} // namespace

TEST(CompositeStresses, have_the_tractions_and_the_divergence_they_are_made_of)
{
  const std::vector<Point<2>> triangle = {{0, 0}, {1, 0}, {0, 1}}, quadrilateral = {{0, 0}, {1.1, 0.1}, {-0.2, 0.9}, {0.8, 1.2}};
  // In the plane the bubbles are the stresses of Airy functions of degree r + 2 in C1 that vanish with their gradients at the boundary.
  check_stresses<2>(triangle, true, 1, 0);
  check_stresses<2>(triangle, true, 2, 3);
  check_stresses<2>(triangle, true, 3, 9);
  check_stresses<2>(reference_corners<2>(false), false, 1, 0);
  check_stresses<2>(reference_corners<2>(false), false, 2, 4);
  check_stresses<2>(quadrilateral, false, 1, 0);
  check_stresses<2>(quadrilateral, false, 2, 4);
}

TEST(CompositeStresses, in_space)
{
  check_stresses<3>(reference_corners<3>(true), true, 1, 0);
  check_stresses<3>(reference_corners<3>(true), true, 2, 18);
  check_stresses<3>(reference_corners<3>(false), false, 1, 30);
}

TEST(CompositeStresses, equations_depend_on_each_other_as_far_as_is_said)
{
  for (unsigned degree = 1; degree < 5; ++degree)
    for (const bool simplex : {true, false})
    {
      const std::vector<Point<2>> triangle = {{0.2, 0}, {1, 0.1}, {-0.3, 1}}, quadrilateral = {{0, 0}, {1.1, 0.1}, {-0.2, 0.9}, {0.8, 1.2}};
      const CompositeStresses<2>  stresses(simplex ? triangle : quadrilateral, simplex, degree);
      const Eigen::MatrixXd       E = stresses.equations().matrix, N = dependent_equations(stresses);
      EXPECT_LT((N.transpose() * E).norm(), 1e-11 * N.norm() * E.norm()) << simplex << degree;
      EXPECT_EQ(Eigen::FullPivLU<Eigen::MatrixXd>(N).rank(), N.cols());
      const StressBasis basis(stresses);
      EXPECT_EQ(E.rows() - N.cols(), E.cols() - basis.bubbles.cols()) << simplex << degree; // the rank
    }
}

TEST(CellStress, is_the_same_by_multipliers_and_among_bubbles)
{
  // Cells of a disc; data and moments of random stresses, so that they agree.
  Diagnostics      diagnostics;
  const Problem<2> problem(problem_of(case_of("[mesh]\nball = { center = [0, 0], radius = 1 }\nrefine = 1\n[model]\nkind = \"elasticity\"\n"
                                              "young = 1\npoisson = 0.3\nelement = \"Q2\"\n[boundary]\nall = \"clamped\"\n")),
                           diagnostics);
  std::mt19937     random(7);
  std::normal_distribution<double> normal;
  for (const unsigned degree : {1, 2, 3})
  {
    const BodyCells<2> cells(problem, degree);
    unsigned           n_compared = 0;
    for (const auto &cell : problem.space.dof_handler.active_cell_iterators())
    {
      auto on = cells.on(cell, false);
      if (on.basis)
        continue; // a parallelogram
      ++n_compared;
      const auto          compliance = ElasticLaw<2>(0.7, 0.4).compliance;
      const CellStress<2> by_multipliers(on, compliance);
      const auto          equations = on.stresses->equations();
      const StressBasis   basis(*on.stresses);
      on.basis = &basis;
      const CellStress<2> among_bubbles(on, compliance);
      Eigen::VectorXd     moments(on.stresses->size()), data(on.stresses->n_data());
      for (double &entry : moments)
        entry = normal(random);
      for (double &entry : data)
        entry = normal(random);
      const Eigen::MatrixXd conditions = dependent_equations(*on.stresses).transpose() * equations.data; // forces and moments
      data -= conditions.completeOrthogonalDecomposition().solve(conditions * data);
      const Eigen::VectorXd x = among_bubbles.closest(data, moments), y = by_multipliers.closest(data, moments);
      EXPECT_LT((x - y).norm(), 1e-9 * x.norm()) << degree;
    }
    EXPECT_GT(n_compared, 8u);
  }
}

TEST(SimplexRule, is_exact)
{
  for (unsigned degree = 0; degree < 8; ++degree)
  {
    const auto rule = simplex_rule<3>({Point<3>(), Point<3>(1, 0, 0), Point<3>(0, 1, 0), Point<3>(0, 0, 1)}, degree);
    double     integral = 0;
    for (unsigned q = 0; q < rule.size(); ++q)
      integral += rule.weight(q) * std::pow(rule.point(q)[1], degree);
    EXPECT_NEAR(integral, 1. / ((degree + 1) * (degree + 2) * (degree + 3)), 1e-14) << degree;
  }
}
