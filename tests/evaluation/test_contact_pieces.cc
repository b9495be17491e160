// Connected pieces of contact, holes in them, and how their force is split, for pressures that are given point by point.
#include "small_problem.h"

#include "unilateral/evaluation/contact_components.h"
#include "unilateral/evaluation/contact_pieces.h"

#include <gtest/gtest.h>

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <string>
#include <vector>

namespace
{
  using namespace unilateral;

  /// A membrane on [0, 20]^2 with cells of size 1.
  std::string square(const std::string &rule = "")
  {
    return fmt::format("[mesh]\nbox = [[0, 0], [20, 20]]\ncells = [20, 20]\n[model]\nkind = \"membrane\"\nelement = \"Q1\"\n"
                       "[boundary]\nall = 0\n[constraint]\nlower = -1\n{}\n",
                       rule);
  }

  template <int dim>
  struct Contact
  {
    using Pressure = std::function<double(const dealii::Point<dim> &)>;

    Contact(const std::string &text, const Pressure &pressure) : small(text), lambda(small.zero_points())
    {
      for (std::size_t i = 0; i < lambda.size(); ++i)
        lambda(i) = pressure(small.constraint_set.points[i].x);
    }

    ContactPieces<dim>            pieces() const { return {*small.problem, small.constraint_set, 0, lambda}; }
    std::vector<ContactComponent> components() const { return contact_components(*small.problem, small.constraint_set, 0, lambda); }

    SmallProblem<dim> small;
    Vector            lambda;
  };

  bool within(const dealii::Point<2> &x, const double left, const double right, const double bottom, const double top)
  {
    return x[0] > left - 0.1 && x[0] < right + 0.1 && x[1] > bottom - 0.1 && x[1] < top + 0.1;
  }

  std::vector<std::size_t> sizes(const ContactPieces<2> &pieces)
  {
    std::vector<std::size_t> sizes;
    for (const auto &members : pieces.members)
      sizes.push_back(members.size());
    std::sort(sizes.begin(), sizes.end());
    return sizes;
  }
} // namespace

TEST(ContactPieces, are_what_hangs_together)
{
  // Two blocks with a row of cells between them, and a point that meets the second at a corner of a cell.
  const Contact<2> contact(square(), [](const auto &x)
                           { return within(x, 2, 6, 2, 6) || within(x, 9, 10, 2, 6) || within(x, 11, 11, 7, 7) ? 2 : 0; });
  const auto       pieces = contact.pieces();
  EXPECT_EQ(sizes(pieces), std::vector<std::size_t>({11, 25}));
  EXPECT_EQ(pieces.dimension, 2u);
  for (std::size_t i = 0; i < pieces.n_points(); ++i)
  {
    EXPECT_EQ(pieces.piece[i] == pieces.none, pieces.pressure[i] == 0);
    EXPECT_NEAR(pieces.cell_size[i], 1, 1e-12);
    if (within(pieces.x[i], 2, 6, 2, 6))
    {
      const auto from_edge = std::min({pieces.x[i][0] - 2, 6 - pieces.x[i][0], pieces.x[i][1] - 2, 6 - pieces.x[i][1]});
      EXPECT_EQ(pieces.depth[i], std::lround(from_edge));
    }
  }
}

TEST(ContactPieces, holes_belong_to_the_piece_around_them)
{
  const auto ring = [](const auto &x) { return within(x, 3, 15, 3, 15) && !within(x, 7, 10, 7, 10) ? 1 : 0; };
  EXPECT_EQ(sizes(Contact<2>(square(), ring).pieces()), std::vector<std::size_t>({13 * 13}));
  const auto open_ring = [&](const auto &x) { return within(x, 7, 10, 3, 10) ? 0 : ring(x); };
  EXPECT_EQ(sizes(Contact<2>(square(), open_ring).pieces()), std::vector<std::size_t>({13 * 13 - 4 * 8}));
}

TEST(ContactPieces, single_points_stay_apart)
{
  const auto posts = [](const auto &x) { return within(x, 5, 5, 5, 5) || within(x, 7, 7, 5, 5) ? 1 : 0; };
  EXPECT_EQ(sizes(Contact<2>(square(), posts).pieces()), std::vector<std::size_t>({1, 1}));
}

TEST(ContactPieces, with_a_gauss_rule_all_points_of_a_cell_are_in_contact)
{
  const Contact<2> contact(square("quadrature = \"gauss(2)\""), [](const auto &x) { return within(x, 4.2, 4.2, 6.2, 6.2) ? 1 : 0; });
  EXPECT_EQ(contact.lambda.l1_norm(), 1);
  EXPECT_EQ(sizes(contact.pieces()), std::vector<std::size_t>({4}));
}

TEST(ContactPieces, a_part_that_is_in_contact_altogether_has_no_edge)
{
  const Contact<2> contact("[mesh]\nbox = [[0, 0], [2, 1]]\ncells = [8, 2]\n[model]\nkind = \"elasticity\"\nyoung = 1\npoisson = 0.3\n"
                           "[boundary]\ntop = [0, -0.01]\n[constraint]\non = \"bottom\"\ngap = 0\n",
                           [](const auto &) { return 1; });
  const auto       pieces = contact.pieces();
  EXPECT_EQ(pieces.dimension, 1u);
  EXPECT_EQ(sizes(pieces), std::vector<std::size_t>({9}));
  EXPECT_EQ(pieces.depth, std::vector<unsigned>(9, pieces.no_edge));
  EXPECT_NEAR(contact.components().at(0).distributed, 2, 1e-12); // all of it
}

TEST(ContactComponents, go_from_left_to_right_and_a_point_is_a_concentrated_force)
{
  const Contact<2> contact(square(), [](const auto &x) { return within(x, 12, 12, 4, 4) ? 3 : within(x, 2, 3, 6, 8) ? 1 : 0; });
  const auto       found = contact.components();
  ASSERT_EQ(found.size(), 2u);
  EXPECT_EQ(found[0].n_points, 6u);
  EXPECT_LT(std::abs(found[0].lower[0] - 2) + std::abs(found[0].lower[1] - 6), 1e-12);
  EXPECT_LT(std::abs(found[0].upper[0] - 3) + std::abs(found[0].upper[1] - 8), 1e-12);
  EXPECT_NEAR(found[0].force, 6, 1e-12);
  EXPECT_FALSE(found[0].resolved);
  EXPECT_NEAR(found[1].force, 3, 1e-12);
  EXPECT_NEAR(found[1].measure, 1, 1e-12);
  EXPECT_EQ(found[1].distributed, 0);
  EXPECT_EQ(found[1].concentrated, found[1].force);
}

TEST(ContactComponents, tell_forces_at_the_edge_from_the_pressure_between_them)
{
  constexpr double h = 0.01;
  for (const double force : {0., 0.02, 0.2})
  {
    const auto pressure = [&](const auto &x) {
      return x[0] < 0.295 || x[0] > 0.705 ? 0 : x[0] < 0.305 || x[0] > 0.695 ? 0.5 + force / h : 1;
    };
    const Contact<1> contact("[mesh]\nbox = [[0], [1]]\ncells = 100\n[model]\nkind = \"beam\"\nload = 1\n[boundary]\nall = "
                             "\"clamped\"\n[constraint]\nupper = 1\n",
                             pressure);
    const auto       found = contact.components();
    ASSERT_EQ(found.size(), 1u);
    EXPECT_TRUE(found[0].resolved);
    EXPECT_NEAR(found[0].force, 0.4 + 2 * force, 1e-12);
    EXPECT_NEAR(found[0].distributed, 0.4, 0.2 * h);
    EXPECT_NEAR(found[0].concentrated, 2 * force, 0.2 * h);
  }
}
