// Rigid motions in words: the same whatever the basis, and where it is, where a rotation is about.

#include "unilateral/discretisation/motion_names.h"

#include <gtest/gtest.h>

#include <random>

using namespace unilateral;
using dealii::Point;
using dealii::Tensor;
using Eigen::MatrixXd;
using Eigen::VectorXd;

namespace
{
  /// As elastic bodies of that size have them: translations, then rotations about the centre, scaled to a largest displacement of 1.
  template <int dim>
  std::vector<RigidBodyMode<dim>> modes_of_body(const Point<dim> &centre, const double size)
  {
    std::vector<RigidBodyMode<dim>> modes;
    for (unsigned c = 0; c < dim; ++c)
      modes.push_back({"", [c](const Point<dim> &) { return Tensor<1, dim>(Point<dim>::unit_vector(c)); }});
    const auto rotation = [&](const unsigned a, const unsigned b)
    {
      modes.push_back({"", [=](const Point<dim> &x)
                       {
                         Tensor<1, dim> v;
                         v[a] = -(x[b] - centre[b]) / size;
                         v[b] = (x[a] - centre[a]) / size;
                         return v;
                       }});
    };
    if (dim == 3)
    {
      rotation(1, 2 % dim);
      rotation(2 % dim, 0);
    }
    rotation(0, 1);
    return modes;
  }

  /// The coefficients of v(x) = t + w x (X - p).
  VectorXd turn(const Eigen::Vector3d &w, const Eigen::Vector3d &p, const Point<3> &centre, const double size, const double along = 0)
  {
    VectorXd result(6);
    result << w.cross(Eigen::Vector3d(centre[0], centre[1], centre[2]) - p) + along * w, w * size;
    return result;
  }

  /// Another basis of the same motions.
  MatrixXd mixed(const MatrixXd &columns, const unsigned seed)
  {
    std::mt19937                     random(seed);
    std::uniform_real_distribution<> any(-1, 1);
    MatrixXd                         by(columns.cols(), columns.cols());
    for (double &entry : by.reshaped())
      entry = any(random);
    return columns * (by + 2 * MatrixXd::Identity(columns.cols(), columns.cols()));
  }

  const Point<3>              centre(1, 2, 0.5);
  const double                size = 3;
  const auto                  in_space = modes_of_body<3>(centre, size);
  const std::vector<VectorXd> translations = {VectorXd::Unit(6, 0), VectorXd::Unit(6, 1), VectorXd::Unit(6, 2)};
} // namespace

TEST(MotionNames, Translations)
{
  EXPECT_EQ(motion_name<3>(translations[0], in_space), "translation along x");
  EXPECT_EQ(motion_name<3>(-2 * translations[1], in_space), "translation along -y");
  EXPECT_EQ(motion_name<3>(3 * translations[0] - 4 * translations[2], in_space), "translation along (0.6, 0, -0.8)");
  EXPECT_EQ(motion_name<2>(Eigen::Vector3d(0, -1, 1e-6), modes_of_body<2>({0, 0}, 1)), "translation along -y");
}

TEST(MotionNames, RotationsAreAboutTheirAxis)
{
  EXPECT_EQ(motion_name<3>(turn({0, 0, -2}, {5, 0.25, 7}, centre, size), in_space), "rotation about z through (5, 0.25, 0)");
  EXPECT_EQ(motion_name<3>(turn({3, 0, 4}, {0, 1, 0}, centre, size), in_space), "rotation about (0.6, 0, 0.8) through (0, 1, 0)");
  EXPECT_EQ(motion_name<3>(turn({1, 0, 0}, {0, 1, 0}, centre, size, 0.5), in_space),
            "rotation about x through (0, 1, 0) with a translation along it");
  // v = (-(y - 0.5), x - 2): about the centre (1, 1), and a translation by (-0.5, -1).
  EXPECT_EQ(motion_name<2>(Eigen::Vector3d(-0.5, -1, 2), modes_of_body<2>({1, 1}, 2)), "rotation in the plane about (2, 0.5)");
}

TEST(MotionNames, AboutAnAxisFarAwayTheyAreTranslations)
{
  const Point<3>  centre(0, 1, 0);
  const auto      modes = modes_of_body(centre, 1);
  Eigen::Vector3d far(150, 1, 0);
  EXPECT_EQ(motion_name<3>(turn({0, 0, -1}, far, centre, 1), modes), "translation along y");
}

TEST(MotionNames, OfSeveralDoNotDependOnTheBasis)
{
  using Names = std::vector<std::string>;
  const Eigen::Vector3d p(0.25, -1, 2);
  for (unsigned seed = 0; seed < 20; ++seed)
  {
    MatrixXd about_point(6, 3);
    for (unsigned d = 0; d < 3; ++d)
      about_point.col(d) = turn(Eigen::Vector3d::Unit(d), p, centre, size);
    EXPECT_EQ(motion_names<3>(mixed(about_point, seed), in_space), (Names{"rotation about any axis through (0.25, -1, 2)"}));
    EXPECT_EQ(motion_names<3>(mixed(about_point.leftCols(2), seed), in_space),
              (Names{"rotation about x through (0, -1, 2)", "rotation about y through (0.25, 0, 2)"}));

    // A plane floor: the axis can be anywhere.
    MatrixXd on_plane(6, 3);
    on_plane << translations[0], translations[1], turn({0, 0, 1}, p, centre, size);
    EXPECT_EQ(motion_names<3>(mixed(on_plane, seed), in_space), (Names{"translation along x", "translation along y", "rotation about z"}));

    // A shaft along x.
    MatrixXd on_shaft(6, 2);
    on_shaft << translations[0], turn({1, 0, 0}, p, centre, size);
    EXPECT_EQ(motion_names<3>(mixed(on_shaft, seed), in_space), (Names{"translation along x", "rotation about x through (0, -1, 2)"}));

    EXPECT_EQ(motion_names<3>(mixed(MatrixXd::Identity(6, 6), seed), in_space).size(), 6u);
    EXPECT_EQ(motion_names<2>(mixed(MatrixXd::Identity(3, 3), seed), modes_of_body<2>({1, 1}, 2)),
              (Names{"translation along x", "translation along y", "rotation in the plane"}));
  }
}

TEST(MotionNames, FarFromTheOriginAreTheSame)
{
  EXPECT_EQ(motion_name<2>(Eigen::Vector3d(0, 0, 1), modes_of_body<2>({5000, 0}, 1)), "rotation in the plane about (5000, 0)");
  const Point<3> far(5e5, 4e6, 0);
  EXPECT_EQ(motion_name<3>(turn({0, 0, 1}, {5e5 + 25, 4e6, 0}, far, 100), modes_of_body<3>(far, 100)),
            "rotation about z through (500025, 4000000, 0)");
  MatrixXd about_two(6, 3); // axes that do not meet
  for (unsigned d = 0; d < 3; ++d)
    about_two.col(d) = turn(Eigen::Vector3d::Unit(d), {900, d == 2 ? 0.8 : 0, 0}, Point<3>(900, 0, 0), 1);
  EXPECT_EQ(motion_names<3>(about_two, modes_of_body<3>(Point<3>(900, 0, 0), 1)).size(), 3u);
}

TEST(MotionNames, OfWhatIsNoBodyAreThoseOfItsModes)
{
  // A plate: w = 1, x, y.
  const auto only_first = [](const double value)
  {
    Tensor<1, 2> v;
    v[0] = value;
    return v;
  };
  const std::vector<RigidBodyMode<2>> plate = {{"translation", [=](const Point<2> &) { return only_first(1); }},
                                               {"rotation about y", [=](const Point<2> &x) { return only_first(x[0]); }},
                                               {"rotation about x", [=](const Point<2> &x) { return only_first(x[1]); }}};
  EXPECT_EQ(motion_name<2>(Eigen::Vector3d(0.5, 0, -1), plate), "rotation about x with translation");
  EXPECT_EQ(motion_names<2>(MatrixXd(Eigen::Vector3d(1, 0, 0)), plate), (std::vector<std::string>{"translation"}));
}
