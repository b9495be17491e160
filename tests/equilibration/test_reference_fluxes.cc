// Fields with given moments, composite rules, flows that balance cells.
#include "unilateral/equilibration/face_balance.h"
#include "unilateral/equilibration/reference_fluxes.h"
#include "unilateral/mesh/subdivided_rule.h"

#include <deal.II/base/quadrature_lib.h>
#include <deal.II/grid/grid_generator.h>

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

using namespace unilateral;

namespace
{
  /// Flux through the faces and divergence of a field, against the moments it was made of.
  template <int dim>
  void check_moments(const bool simplex, const unsigned degree)
  {
    const ReferenceFluxes<dim> fields(simplex, degree);
    Eigen::VectorXd            moments = Eigen::VectorXd::Random(fields.n_moments());
    double                     out = 0;
    for (unsigned f = 0; f < fields.faces.size(); ++f)
      out += moments(fields.face_moment(f, 0));
    moments(fields.cell_moment(0)) = out;
    const Eigen::VectorXd bubble =
      fields.bubbles.cols() > 0 ? Eigen::VectorXd(fields.bubbles.rowwise().sum()) : Eigen::VectorXd::Zero(fields.size());
    const Eigen::VectorXd y = fields.particular * moments + bubble;
    for (unsigned f = 0; f < fields.faces.size(); ++f)
    {
      const auto           &face = fields.faces[f];
      const Eigen::VectorXd at = fields.values_at(face.rule.get_points()) * y;
      for (unsigned i = 0; i < fields.n_face_tests; ++i)
      {
        double moment = 0;
        for (unsigned q = 0; q < face.rule.size(); ++q)
          for (unsigned d = 0; d < dim; ++d)
            moment += face.rule.weight(q) * face.tests(q, i) * face.normal[d] * at(q * dim + d);
        EXPECT_NEAR(moment, moments(fields.face_moment(f, i)), 1e-11) << dim << simplex << degree;
      }
    }
  }
} // namespace

TEST(ReferenceFluxes, have_the_moments_they_are_made_of)
{
  for (unsigned degree = 1; degree <= 3; ++degree)
  {
    check_moments<1>(false, degree);
    check_moments<2>(false, degree);
    check_moments<3>(false, degree);
  }
  for (unsigned degree = 1; degree <= 2; ++degree)
  {
    check_moments<2>(true, degree);
    check_moments<3>(true, degree);
  }
}

TEST(ReferenceFluxes, number_of_bubbles)
{
  EXPECT_EQ(ReferenceFluxes<1>(false, 1).bubbles.cols(), 0);
  EXPECT_EQ(ReferenceFluxes<2>(false, 1).bubbles.cols(), 1); // RT_1: 12 functions, 8 fluxes, 3 divergences
  EXPECT_EQ(ReferenceFluxes<3>(false, 1).bubbles.cols(), 5); // 36 functions, 24 fluxes, 7 divergences
  EXPECT_EQ(ReferenceFluxes<2>(true, 1).bubbles.cols(), 1);  // BDM_2: 12 functions, 9 fluxes, 2 divergences
}

TEST(SubdividedRule, integrates_what_the_rule_does)
{
  for (const bool simplex : {false, true})
  {
    const auto rule =
      subdivided<3>(simplex ? dealii::Quadrature<3>(dealii::QGaussSimplex<3>(3)) : dealii::Quadrature<3>(dealii::QGauss<3>(3)), simplex, 2);
    double volume = 0, moment = 0;
    for (unsigned q = 0; q < rule.size(); ++q)
    {
      volume += rule.weight(q);
      moment += rule.weight(q) * rule.point(q)[0] * rule.point(q)[1] * rule.point(q)[2];
    }
    EXPECT_NEAR(volume, simplex ? 1. / 6 : 1., 1e-13);
    EXPECT_NEAR(moment, simplex ? 1. / 720 : 1. / 8, 1e-14);
  }
}

TEST(FaceBalance, balances_cells_of_a_mesh_refined_in_places)
{
  dealii::Triangulation<2> mesh;
  dealii::GridGenerator::subdivided_hyper_cube(mesh, 3);
  mesh.begin_active()->set_refine_flag();
  mesh.execute_coarsening_and_refinement();
  const std::size_t   n = mesh.n_active_cells();
  FaceBalance<2>      balance(mesh, {false}, std::vector<double>(n, 1.));
  std::vector<double> r(n);
  for (std::size_t c = 0; c < n; ++c)
    r[c] = std::sin(3. * c);
  balance.solve(r);
  for (const auto &cell : mesh.active_cell_iterators())
  {
    double out = 0;
    for (const unsigned f : cell->face_indices())
      out += balance.flow(cell->active_cell_index(), f);
    EXPECT_NEAR(out, r[cell->active_cell_index()], 1e-13);
  }
}
