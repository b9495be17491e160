// Bodies that only contact holds: nothing is called solved that is not in contact and in equilibrium.
#include "random_bodies.h"
#include "solved_case.h"

#include "unilateral/case/problem_of_case.h"
#include "unilateral/inequality/balanced_pressure.h"
#include "unilateral/inequality/rigid_body_step.h"
#include "unilateral/inequality/solution_check.h"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <functional>
#include <numbers>
#include <string>

#include <unistd.h>

using namespace unilateral;

namespace
{
  /// A ring around a pin of radius 1, hanging on it by its weight.
  std::string ring(const double clearance, const std::string &more = "")
  {
    return fmt::format("mesh.shell = {{ center = [0, 0], inner = {}, outer = 1.5 }}\nmesh.refine = 2\n[model]\nkind = \"elasticity\"\n"
                       "young = 1000\npoisson = 0.3\nload = [0, -1]\n{}[constraint]\non = \"inner\"\n"
                       "gap = {{ sphere = {{ center = [0, 0], radius = 1 }} }}\n",
                       1 + clearance, more);
  }

  /// A unit cube pressed by a force of 1 towards a ball of radius 5, at a distance.
  std::string block_above_ball(const double distance)
  {
    return fmt::format("mesh.box = [[0, 0, 0], [1, 1, 1]]\nmesh.cells = 4\n[model]\nkind = \"elasticity\"\nelement = \"Q1\"\nyoung = 1000\n"
                       "poisson = 0.3\n[boundary]\nback = {{ pressure = 1 }}\nleft = \"symmetry\"\nbottom = \"symmetry\"\n[constraint]\n"
                       "on = \"front\"\ngap = {{ sphere = {{ center = [0, 0, {}], radius = 5 }} }}\n",
                       -distance - 5);
  }

  /// A square of side 1 on a plane, which nothing else holds; its weight is 1.
  const std::string square = "mesh.box = [[0, 0], [1, 1]]\nmesh.cells = 4\n[model]\nkind = \"elasticity\"\nyoung = 10\npoisson = 0.3\n"
                             "load = [0, -1]\n[constraint]\non = \"bottom\"\ngap = 0.5\n";
} // namespace

TEST(BodiesHeldByContact, a_ring_hangs_on_its_pin_whatever_the_clearance)
{
  for (const double clearance : {1e-4, 0.01, 0.3})
    for (const char *const element : {"Q1", "Q2"})
    {
      SCOPED_TRACE(clearance);
      const RunResult result = result_of<2>(ring(clearance), {{"model.element", fmt::format("\"{}\"", element)}});
      ASSERT_TRUE(result.converged) << result.reason;
      EXPECT_NEAR(result.balance->contact[1] / -result.balance->load[1], 1, 1e-8);
      EXPECT_LT(result.balance->residual, 1e-8);
      // It turns about the pin as it likes, and nothing has to stop it from that.
      EXPECT_EQ(result.balance->side_conditions_on.size(), 1u);
      EXPECT_LT(result.balance->side_conditions, 1e-8);
    }
}

TEST(BodiesHeldByContact, a_body_moved_as_a_whole_that_touches_nothing_is_in_equilibrium)
{
  for (const char *const element : {"P1", "Q2"})
  {
    SCOPED_TRACE(element);
    const auto result =
      result_of<2>("mesh.box = [[0, 0], [2, 1]]\nmesh.cells = [6, 5]\n[model]\nkind = \"elasticity\"\nyoung = 21124\npoisson = 0.19\n"
                   "[boundary]\ntop = [0, -0.00046]\n[constraint]\non = \"bottom\"\ngap = \"0.0005 + 1e-4*x\"\n",
                   {{"model.element", fmt::format("\"{}\"", element)}});
    EXPECT_TRUE(result.converged) << result.reason;
    EXPECT_EQ(result.constraints[0].n_active, 0u);
  }
}

/// Half a ring on a pin of its own radius, pulled down at its ends, which are held across: where it is thin the pressure is T/R, T the
/// pull. The faces next to the ends are a little inclined to the direction in which these may slide: no wedge on which the ring could rest.
TEST(BodiesHeldByContact, ends_of_a_half_ring_that_are_held_across_bear_nothing)
{
  const std::string ring = "mesh.file = \"" PROJECT_DIR "/tests/data/half-ring.geo\"\n[model]\nkind = \"elasticity\"\nyoung = 1e5\n"
                           "poisson = 0.3\n[boundary]\nends = { x = 0, traction = [0, -10] }\n[constraint]\non = \"inner\"\n"
                           "gap = { sphere = { center = [0, 0], radius = 20 } }\n";
  for (const char *const element : {"Q1", "Q2"})
  {
    SCOPED_TRACE(element);
    const auto result = result_of<2>(ring, {{"model.element", fmt::format("\"{}\"", element)}});
    ASSERT_TRUE(result.converged) << result.reason;
    EXPECT_NEAR(result.balance->contact[1], 20, 0.02);
    EXPECT_NEAR(result.constraints[0].total_contact_force, 10 * dealii::numbers::PI, 1);
    EXPECT_LT(result.constraints[0].max_contact_pressure, 0.7); // T/R = 0.5
  }
}

/// A plane pushes along its normal only, under a round body too; what it cannot hold is refused.
TEST(BodiesHeldByContact, a_plane_without_friction_holds_nothing_along_itself)
{
  const std::string disc = "mesh.ball = { center = [0, 0] }\nmesh.refine = 2\n[model]\nkind = \"elasticity\"\nyoung = 1000\npoisson = 0.3\n"
                           "load = [0, -0.1]\n[constraint]\non = \"surface\"\ngap = { plane = { point = [0, -1.01], normal = [0, 1] } }\n";
  for (const char *const element : {"P1", "Q1", "P2"})
  {
    SCOPED_TRACE(element);
    const std::vector<Override> of_element = {{"model.element", fmt::format("\"{}\"", element)}};
    const auto                  result = result_of<2>(disc, of_element);
    ASSERT_TRUE(result.converged) << result.reason;
    EXPECT_NEAR(result.balance->contact[0], 0, 1e-12);
    EXPECT_NEAR(result.balance->contact[1] / -result.balance->load[1], 1, 1e-8);
    auto pushed = of_element;
    pushed.emplace_back("model.load", "[0.05, -0.1]");
    EXPECT_THROW(result_of<2>(disc, pushed), InputError);
  }
}

/// In a hollow a disc may turn about its own centre: all its points move along lines through it.
TEST(BodiesHeldByContact, a_disc_in_a_hollow_turns_freely_about_its_own_centre)
{
  const auto result = result_of<2>("mesh.ball = { center = [0, 0] }\nmesh.refine = 2\n[model]\nkind = \"elasticity\"\nyoung = 1000\n"
                                   "poisson = 0.3\nload = [0.003, -0.01]\n[constraint]\non = \"surface\"\n"
                                   "gap = { sphere = { center = [0, 0.3], radius = 1.3, inside = true } }\n");
  ASSERT_TRUE(result.converged) << result.reason;
  EXPECT_EQ(result.balance->side_conditions_on.size(), 1u);
  EXPECT_LT(result.balance->side_conditions, 1e-8);
  EXPECT_LT(result.balance->residual, 1e-8);
}

namespace
{
  /// A ring of quadrilaterals around a pin, the radii of its nodes uneven in the angle and its outer side shifted: facets that are not
  /// normal to the radii through their nodes.
  std::string uneven_ring(const std::string &file, const double shift, const std::string &model)
  {
    constexpr unsigned n = 48, layers = 3;
    std::ofstream      out(file);
    out << "$MeshFormat\n2.2 0 8\n$EndMeshFormat\n$PhysicalNames\n2\n1 1 \"hole\"\n2 2 \"body\"\n$EndPhysicalNames\n$Nodes\n"
        << n * (layers + 1) << '\n';
    for (unsigned k = 0; k <= layers; ++k)
      for (unsigned i = 0; i < n; ++i)
      {
        const double angle = 2 * dealii::numbers::PI / n * (i + 0.2 * std::sin(2. * i)), radius = 1 + double(k) / layers;
        out << k * n + i + 1
            << fmt::format(" {:.16g} {:.16g} 0\n", radius * std::cos(angle) + shift * k / layers, radius * std::sin(angle));
      }
    out << "$EndNodes\n$Elements\n" << n * (layers + 1) << '\n';
    for (unsigned i = 0; i < n; ++i)
      out << i + 1 << " 1 2 1 1 " << i + 1 << ' ' << (i + 1) % n + 1 << '\n';
    for (unsigned k = 0; k < layers; ++k)
      for (unsigned i = 0; i < n; ++i)
        out << n + k * n + i + 1 << " 3 2 2 1 " << k * n + i + 1 << ' ' << (k + 1) * n + i + 1 << ' ' << (k + 1) * n + (i + 1) % n + 1
            << ' ' << k * n + (i + 1) % n + 1 << '\n';
    out << "$EndElements\n";
    return "mesh.file = \"" + file + "\"\n[model]\nkind = \"elasticity\"\nyoung = 1000\npoisson = 0.3\nload = [0, -1]\n" + model +
           "[constraint]\non = \"hole\"\ngap = { sphere = { center = [0, 0], radius = 0.98 } }\n";
  }
} // namespace

/// Contact with a round pin acts along the radii of the pin: facets that are a little inclined to them would turn the body, and bear any
/// moment. What the unevenness of a mesh makes of a load without moment is no reason to refuse it.
TEST(BodiesHeldByContact, a_disc_in_a_wider_hollow_does_not_slide_along_it)
{
  // It touches where the load points to, between nodes, and contact on both sides of that place stops it across the load, too. Turning
  // about the centre of the hollow is no motion that contact does not feel.
  for (const double angle : {0., 0.1, 0.7})
    for (const char *const element : {"Q1", "Q2"})
    {
      SCOPED_TRACE(angle);
      const double x = std::sin(angle), y = -std::cos(angle);
      const auto   result = result_of<2>(
        fmt::format("mesh.ball = {{ center = [0, 0], radius = 1 }}\nmesh.refine = 3\n[model]\nkind = \"elasticity\"\nelement = \"{}\"\n"
                        "young = 1000\npoisson = 0.3\nload = [{}, {}]\n[constraint]\non = \"surface\"\n"
                        "gap = {{ sphere = {{ center = [{}, {}], radius = 1.1, inside = true }} }}\n",
                      element, x, y, -0.1 * x, -0.1 * y));
      ASSERT_TRUE(result.converged) << result.reason;
      const auto &contact = result.balance->contact;
      EXPECT_NEAR(-(contact[0] * x + contact[1] * y), std::numbers::pi, 0.05);
      EXPECT_NEAR(contact[0] * y - contact[1] * x, 0, 1e-7);
      EXPECT_LT(result.balance->side_conditions, 1e-8);
    }
}

TEST(BodiesHeldByContact, a_load_that_drives_off_a_wall_by_little_is_refused)
{
  const auto in_corner = [](const double away, const std::string &element)
  {
    return fmt::format("mesh.box = [[0, 0], [1, 1]]\nmesh.cells = 4\n[model]\nkind = \"elasticity\"\nelement = \"{}\"\nyoung = 1000\n"
                       "poisson = 0.3\nload = [{}, -1]\n[[constraint]]\non = \"bottom\"\ngap = 0\n[[constraint]]\non = \"left\"\ngap = 0\n",
                       element, away);
  };
  for (const std::string element : {"Q1", "Q2", "P1", "P2"})
  {
    for (const double away : {1e-9, 3e-9, 1e-8, 1e-6})
      EXPECT_THROW(result_of<2>(in_corner(away, element)), InputError) << element << ' ' << away;
    for (const double away : {0., -1e-9, -1e-3})
      EXPECT_TRUE(result_of<2>(in_corner(away, element)).converged) << element << ' ' << away;
  }
}

TEST(BodiesHeldByContact, a_trough_without_friction_bears_nothing_along_its_axis)
{
  const auto in_trough = [](const std::string &load)
  {
    return "mesh.ball = { center = [5, 5, 5], radius = 1 }\nmesh.refine = 1\n[model]\nkind = \"elasticity\"\nyoung = 1000\npoisson = 0.3\n"
           "load = " +
           load +
           "\n[constraint]\non = \"surface\"\n"
           "gap = { cylinder = { point = [5, 0, 5.5], axis = [0, 1, 0], radius = 1.5, inside = true } }\n";
  };
  EXPECT_THROW(result_of<3>(in_trough("[0, 0.3, -1]")), InputError);
  const auto across = result_of<3>(in_trough("[0.2, 0, -1]"));
  ASSERT_TRUE(across.converged) << across.reason;
  EXPECT_NEAR(across.balance->contact[0] / across.balance->load[0], -1, 1e-7);
  EXPECT_NEAR(across.balance->contact[1], 0, 1e-7);
  // It slides along the trough, and turns about its centre.
  EXPECT_EQ(across.balance->side_conditions_on.size(), 4u);
  EXPECT_LT(across.balance->side_conditions, 1e-8);
}

TEST(BodiesHeldByContact, uneven_facets_of_a_round_hole_bear_no_moment)
{
  for (const char *const element : {"Q1", "Q2"})
  {
    SCOPED_TRACE(element);
    const std::vector<Override> of_element = {{"model.element", fmt::format("\"{}\"", element)}};
    const auto                  hangs = result_of<2>(uneven_ring("uneven-ring.msh", 0, ""), of_element);
    ASSERT_TRUE(hangs.converged) << hangs.reason;
    EXPECT_NEAR(hangs.balance->contact[1] / -hangs.balance->load[1], 1, 1e-4);
    EXPECT_LT(hangs.balance->side_conditions, 1e-3);
    EXPECT_LT(hangs.constraints[0].total_contact_force, 2 * hangs.balance->contact[1]);

    const std::string lever = uneven_ring("uneven-lever.msh", 0.5, "");
    try
    {
      result_of<2>(lever, of_element);
      ADD_FAILURE() << "nothing bears its moment";
    }
    catch (const InputError &error)
    {
      EXPECT_NE(std::string(error.what()).find("nothing stops a rotation"), std::string::npos) << error.what();
    }
    EXPECT_TRUE(result_of<2>(uneven_ring("uneven-lever.msh", 0.5, "[boundary]\nboundary = { spring = 1e-2 }\n"), of_element).converged);
  }
}

/// Rigid body modes are those of the mesh as a whole: of two blocks on a plane each would need its own.
TEST(BodiesHeldByContact, a_piece_that_nothing_holds_is_named)
{
  std::ofstream out("two-blocks.msh");
  out
    << "$MeshFormat\n2.2 0 8\n$EndMeshFormat\n$PhysicalNames\n3\n1 1 \"floor\"\n1 2 \"side\"\n2 3 \"body\"\n$EndPhysicalNames\n$Nodes\n8\n"
       "1 0 0 0\n2 1 0 0\n3 1 1 0\n4 0 1 0\n5 2 0 0\n6 3 0 0\n7 3 1 0\n8 2 1 0\n$EndNodes\n$Elements\n6\n1 1 2 1 1 1 2\n2 1 2 1 2 5 6\n"
       "3 1 2 2 3 4 1\n4 1 2 2 4 8 5\n5 3 2 3 1 1 2 3 4\n6 3 2 3 2 5 6 7 8\n$EndElements\n";
  out.close();
  const std::string blocks = "mesh.file = \"two-blocks.msh\"\n[model]\nkind = \"elasticity\"\nyoung = 1000\npoisson = 0.3\nload = [0, -1]\n"
                             "[constraint]\non = \"floor\"\ngap = 0\n";
  try
  {
    result_of<2>(blocks);
    ADD_FAILURE();
  }
  catch (const InputError &error)
  {
    EXPECT_NE(std::string(error.what()).find("2 pieces"), std::string::npos) << error.what();
  }
  const auto held = result_of<2>(blocks + "[boundary]\nside = { x = 0, spring = [0, 1e-3] }\n");
  EXPECT_TRUE(held.converged) << held.reason;
  EXPECT_NEAR(held.balance->contact[1], 2, 1e-2);

  // What contact alone can hold is warned of; here the solver finds it.
  const auto on_the_floor =
    result_of<2>("mesh.file = \"two-blocks.msh\"\n[model]\nkind = \"membrane\"\nload = -5\n"
                 "[[part]]\nname = \"left\"\nwhere = \"x < 1e-6\"\n[boundary]\nleft = 0\n[constraint]\nlower = -0.1\n");
  EXPECT_TRUE(std::any_of(on_the_floor.warnings.begin(), on_the_floor.warnings.end(),
                          [](const Diagnostic &warning)
                          { return warning.message.find("nothing but contact can hold the one at") != std::string::npos; }));
  EXPECT_TRUE(on_the_floor.converged) << on_the_floor.reason;
  // The load of the block on the right, and of that on the left what its left side does not bear: 2.5 less the tension of its slope, 0.1.
  EXPECT_NEAR(on_the_floor.constraints[0].total_contact_force, 5 + 2.5 - 0.1, 1e-6);
}

/// It touches at two nodes, and is nearly free to turn about the line through them: too few digits for a factorisation of so stiff a
/// volume, which Newton's method would follow into nothing. An iterative solver, from the start, takes over.
TEST(BodiesHeldByContact, a_rubber_ball_lies_on_a_plane)
{
  for (const char *const nu : {"0.3", "0.499", "0.4999"})
  {
    SCOPED_TRACE(nu);
    const auto result =
      result_of<3>("mesh.file = \"" PROJECT_DIR "/tests/data/ball.geo\"\n[model]\nkind = \"elasticity\"\nelement = \"P1\"\n"
                   "young = 1\nload = [0, 0, -1e-4]\npoisson = " +
                   std::string(nu) +
                   "\n[constraint]\non = \"rim\"\n"
                   "gap = { plane = { point = [0, 0, -1], normal = [0, 0, 1] } }\n");
    ASSERT_TRUE(result.converged) << result.reason;
    EXPECT_NEAR(result.balance->contact[2] / -result.balance->load[2], 1, 1e-6);
  }
}

/// What a motion of 10 leaves of the digits of a strain of 1e-8 is rounding, and no lack of balance.
TEST(BodiesHeldByContact, digits_that_a_long_way_takes_are_restored_from_the_balance)
{
  const std::string cube = "mesh.box = [[0, 0, 0], [100, 100, 100]]\nmesh.cells = 4\nmesh.refine = 1\n[model]\nkind = \"elasticity\"\n"
                           "young = 210000\npoisson = 0.3\nload = [0, 0, -7.7e-5]\n[constraint]\non = \"front\"\n"
                           "gap = { plane = { point = [0, 0, -10], normal = [0, 0, 1] } }\n";
  for (const char *const solver : {"direct", "amg", "multigrid"})
  {
    SCOPED_TRACE(solver);
    const auto result = result_of<3>(cube, {{"method.solver", fmt::format("\"{}\"", solver)}, {"model.element", "\"Q1\""}});
    EXPECT_TRUE(result.converged) << result.reason;
    EXPECT_NEAR(result.constraints[0].total_contact_force, 77, 77e-6);
  }
}

/// Its resultant goes down, but beside all contact.
TEST(BodiesHeldByContact, a_beam_that_tips_is_not_said_to_move_upward)
{
  try
  {
    result_of<1>(
      "mesh.box = [[0], [1]]\nmesh.cells = 8\n[model]\nkind = \"beam\"\nload = \"-1 + 20*(x - 0.5)\"\n[boundary]\nall = \"free\"\n"
      "[constraint]\nlower = 0\n");
    ADD_FAILURE();
  }
  catch (const InputError &error)
  {
    EXPECT_NE(std::string(error.what()).find("tips it off"), std::string::npos) << error.what();
  }
}

TEST(BodiesHeldByContact, springs_that_rounding_hides_are_named)
{
  const auto warnings = [](const std::string &spring)
  {
    Diagnostics      diagnostics;
    const Problem<2> problem(problem_of(case_of(square + "[boundary]\nleft = { spring = " + spring + " }\n")), diagnostics);
    std::string      names;
    for (const Diagnostic &message : diagnostics.all())
      names += message.name.text + ' ';
    return names;
  };
  EXPECT_EQ(warnings("1e-12"), "hardly-held ");
  EXPECT_EQ(warnings("[1e-13, 0]"), "hardly-held ");
  EXPECT_EQ(warnings("1e-6"), "");
}

TEST(BodiesHeldByContact, soft_springs_beside_contact_change_little)
{
  const double free = result_of<2>(ring(0.01)).energy;
  const auto   held = result_of<2>(ring(0.01, "[boundary]\nouter = { spring = [1e-3, 0] }\n"));
  ASSERT_TRUE(held.converged);
  EXPECT_NEAR(held.energy / free, 1, 1e-4);
  EXPECT_LT(held.balance->residual, 1e-8);
}

TEST(BodiesHeldByContact, the_distance_to_the_obstacle_does_not_matter)
{
  for (const char *const solver : {"direct", "amg"})
  {
    const auto near = result_of<3>(block_above_ball(0), {{"method.solver", fmt::format("\"{}\"", solver)}});
    for (const double distance : {0.2, 1e3})
    {
      SCOPED_TRACE(distance);
      const auto far = result_of<3>(block_above_ball(distance), {{"method.solver", fmt::format("\"{}\"", solver)}});
      ASSERT_TRUE(far.converged) << far.reason;
      EXPECT_NEAR(far.constraints[0].total_contact_force, near.constraints[0].total_contact_force, 1e-6);
      // Each unit of the way gains as much energy as the load works.
      EXPECT_NEAR(far.energy + distance, near.energy, 1e-7 * (1 + distance));
    }
  }
}

TEST(RigidBodyStep, brings_a_body_into_contact_and_balances_it)
{
  const SmallProblem<2>  p(square);
  auto                  &discrete = *p.discrete;
  const AugmentedProblem augmented{discrete, 1e-3, p.zero_points(), p.zero_points()};
  const Vector           penalty = augmented.penalty();
  const RigidBodyStep    step(augmented, penalty);
  ASSERT_TRUE(step.has_modes());

  Vector u = p.zero_dofs(), Au = p.zero_dofs(), gap = p.zero_points(), lambda = p.zero_points();
  augmented.shifted_gap(gap, u);
  step.minimise(u, Au, gap);
  augmented.next_multiplier(lambda, u);
  EXPECT_NEAR(contact_force(discrete, lambda), 1, 1e-10);
  EXPECT_LT(imbalance_of_rigid_body_modes(discrete, u, lambda), 1e-12);
  discrete.apply_stiffness(Au, u);
  EXPECT_LT(std::abs(u * Au), 1e-12);
}

TEST(RigidBodyStep, supports_stop_what_a_set_leaves_free)
{
  const SmallProblem<2>  p(square);
  const AugmentedProblem augmented{*p.discrete, 1e-3, p.zero_points(), p.zero_points()};
  const Vector           penalty = augmented.penalty();
  const RigidBodyStep    step(augmented, penalty);
  const std::size_t      n = p.constraint_set.size();
  // What contact feels: up and down, and the rotation. The third mode is along the plane.
  EXPECT_EQ(step.supports(PointSet(n, 0)).size(), 2u);
  PointSet one(n, 0);
  one[0] = 1;
  EXPECT_EQ(step.supports(one).size(), 1u);
  one[n - 1] = 1;
  EXPECT_EQ(step.supports(one).size(), 0u);
}

TEST(SolutionCheck, objects_to_what_is_no_solution)
{
  const SmallProblem<2> p(square);
  auto                 &discrete = *p.discrete;
  Vector                u = p.zero_dofs(), lambda = p.zero_points();
  EXPECT_NE(objection_to_solution(discrete, 0, 1e-6, u, lambda), ""); // a weight, and nothing that bears it
  Progress               quiet;
  const MultiplierResult result = method_of_multipliers(discrete, {}, {}, u, lambda, quiet);
  ASSERT_TRUE(result.converged) << result.reason;
  EXPECT_EQ(objection_to_solution(discrete, 0, 1e-6, u, lambda), "");
  u *= -1; // as far away, and of more energy than u = 0
  EXPECT_NE(objection_to_solution(discrete, 0, 1e-6, u, lambda), "");
}

TEST(BalancedPressure, restores_digits_and_no_more)
{
  const SmallProblem<2> p(square);
  auto                 &discrete = *p.discrete;
  Vector                u = p.zero_dofs(), exact = p.zero_points();
  Progress              quiet;
  ASSERT_TRUE(method_of_multipliers(discrete, {}, {}, u, exact, quiet).converged);
  exact(1) = 0; // an open point stays open
  const auto disturbed = [&](const double size)
  {
    Vector lambda = exact;
    for (std::size_t i = 0; i < lambda.size(); ++i)
      lambda(i) *= 1 + size * std::cos(3. * double(i));
    return lambda;
  };

  Vector lambda = disturbed(0.1);
  EXPECT_GT(restore_balance(discrete, 1, u, lambda), 0.);
  EXPECT_LT(imbalance_of_rigid_body_modes(discrete, u, lambda), 1e-14);
  EXPECT_EQ(lambda(1), 0.);
  for (std::size_t i = 0; i < lambda.size(); ++i)
    EXPECT_GE(lambda(i), 0.);

  // What is larger than rounding is left for the checks to find.
  lambda = disturbed(0.1);
  const Vector before = lambda;
  EXPECT_EQ(restore_balance(discrete, 1e-6, u, lambda), 0.);
  lambda -= before;
  EXPECT_EQ(lambda.linfty_norm(), 0.);
}

namespace
{
  /// The unit square of n x n cells as @p image has it, in a file of Gmsh that goes with it; parts bottom, right, top, left.
  struct MeshFile
  {
    MeshFile(const unsigned n, const std::function<dealii::Point<2>(double, double)> &image)
      : name((std::filesystem::temp_directory_path() / "unilateral-block-XXXXXX.msh").string())
    {
      const int handle = mkstemps(name.data(), 4);
      EXPECT_GE(handle, 0);
      close(handle);
      std::ofstream file(name);
      file << "$MeshFormat\n2.2 0 8\n$EndMeshFormat\n$PhysicalNames\n5\n1 1 \"bottom\"\n1 2 \"right\"\n1 3 \"top\"\n1 4 \"left\"\n"
              "2 5 \"body\"\n$EndPhysicalNames\n$Nodes\n"
           << (n + 1) * (n + 1) << '\n';
      for (unsigned j = 0; j <= n; ++j)
        for (unsigned i = 0; i <= n; ++i)
        {
          const auto x = image(double(i) / n, double(j) / n);
          file << fmt::format("{} {:.17g} {:.17g} 0\n", j * (n + 1) + i + 1, x[0], x[1]);
        }
      file << "$EndNodes\n$Elements\n" << n * n + 4 * n << '\n';
      unsigned   number = 0;
      const auto node = [&](const unsigned i, const unsigned j) { return j * (n + 1) + i + 1; };
      for (unsigned k = 0; k < n; ++k)
        file << fmt::format("{} 1 2 1 1 {} {}\n{} 1 2 2 2 {} {}\n{} 1 2 3 3 {} {}\n{} 1 2 4 4 {} {}\n", number + 1, node(k, 0),
                            node(k + 1, 0), number + 2, node(n, k), node(n, k + 1), number + 3, node(k + 1, n), node(k, n), number + 4,
                            node(0, k + 1), node(0, k)),
          number += 4;
      for (unsigned j = 0; j < n; ++j)
        for (unsigned i = 0; i < n; ++i)
          file << fmt::format("{} 3 2 5 5 {} {} {} {}\n", ++number, node(i, j), node(i + 1, j), node(i + 1, j + 1), node(i, j + 1));
      file << "$EndElements\n";
    }
    ~MeshFile() { std::filesystem::remove(name); }

    std::string name;
  };
} // namespace

TEST(BodiesHeldByContact, a_weak_spring_across_serves_whichever_way_the_body_is_turned)
{
  for (const double angle : {0., 0.3, 0.5, 0.8, 1.2, 2.})
  {
    SCOPED_TRACE(angle);
    const double   c = std::cos(angle), s = std::sin(angle);
    const MeshFile block(8, [&](const double x, const double y) { return dealii::Point<2>(2 * c * x - s * y, 2 * s * x + c * y); });
    const auto     text =
      fmt::format("mesh.file = \"{}\"\n[model]\nkind = \"elasticity\"\nelement = \"Q1\"\nyoung = 1e6\npoisson = 0.3\nload = [{}, {}]\n"
                  "[boundary]\nright = {{ spring = 1 }}\n[constraint]\non = \"bottom\"\n"
                  "gap = {{ plane = {{ point = [0, 0], normal = [{}, {}] }} }}\n",
                  block.name, c + 10 * s, s - 10 * c, -s, c);
    for (const char *const formulation : {"\"mixed\"", "\"penalty\""})
    {
      const RunResult result = result_of<2>(text, {{"method.formulation", formulation}});
      EXPECT_TRUE(result.converged) << result.reason;
      EXPECT_NEAR(std::hypot(result.balance->contact[0], result.balance->contact[1]), 20, 1e-4);
    }
  }
}

TEST(BodiesHeldByContact, what_rounding_may_hide_most_of_is_not_called_solved)
{
  // The spring lets the body go a million times its size, where its deformation has no digits left.
  const std::string text =
    "mesh.box = [[0, 0], [2, 1]]\nmesh.cells = 8\n[model]\nkind = \"elasticity\"\nelement = \"Q2\"\nyoung = 1000\npoisson = 0.3\n"
    "load = [1, -10]\n[constraint]\non = \"bottom\"\ngap = 0\n[method]\nformulation = \"mixed\"\n";
  const RunResult firm = result_of<2>(text, {{"boundary.right", "{ spring = 1 }"}});
  EXPECT_TRUE(firm.converged) << firm.reason;
  const RunResult weak = result_of<2>(text, {{"boundary.right", "{ spring = 1e-6 }"}});
  EXPECT_FALSE(weak.converged);
  EXPECT_NE(weak.reason.find("% of the energy norm"), std::string::npos) << weak.reason;
}

TEST(BodiesHeldByContact, faces_that_meet_at_an_acute_angle_have_a_bound)
{
  // A wedge of 60 degrees between two walls, pressed into their corner.
  const MeshFile    wedge(6, [](const double x, const double y) { return dealii::Point<2>(x + 0.5 * y, std::sqrt(0.75) * y); });
  const std::string text =
    fmt::format("mesh.file = \"{}\"\nmesh.refine = 1\n[model]\nkind = \"elasticity\"\nelement = \"Q1\"\nyoung = 1000\npoisson "
                "= 0.3\nload = [-0.3, -1]\n"
                "[[constraint]]\non = \"bottom\"\ngap = {{ plane = {{ point = [0, 0], normal = [0, 1] }} }}\n"
                "[[constraint]]\non = \"left\"\ngap = {{ plane = {{ point = [0, 0], normal = [{}, -0.5] }} }}\n",
                wedge.name, std::sqrt(0.75));
  const RunResult result = result_of<2>(text);
  ASSERT_TRUE(result.converged) << result.reason;
  ASSERT_TRUE(result.estimate->guaranteed) << result.estimate->reason;
  // Of the energy of a finer mesh, which is nearer to that of the exact solution, the bound is no less than what the mesh lacks.
  const RunResult finer = result_of<2>(text, {{"mesh.refine", "4"}});
  EXPECT_GE(result.estimate->total, std::sqrt(2 * (result.energy - finer.energy)));
}

TEST(BodiesHeldByContact, meshes_on_which_the_points_of_the_rule_reach_too_little_are_refined)
{
  // The load presses in a corner, which midpoints of edges cut off on the coarse mesh.
  const std::string corner = "mesh.box = [[0, 0, 0], [2, 1, 1]]\nmesh.cells = [2, 2, 2]\nmodel = { kind = \"elasticity\", element = "
                             "\"P2\", young = 1000, poisson = 0.3 }\n"
                             "boundary.back = { force = [0, 0, -1], about = [0.2, 0.1, 1] }\nconstraint.on = \"front\"\n"
                             "constraint.gap = { plane = { point = [0, 0, 0], normal = [0, 0, 1] } }\n";
  const RunResult   refined = result_of<3>(corner, {{"mesh.refine", "1"}});
  ASSERT_TRUE(refined.converged) << refined.reason;
  EXPECT_NEAR(refined.balance->contact[2], 1, 1e-8);
  const RunResult adapted = result_of<3>(corner, {{"mesh.adapt", "{ tolerance = 0.5, max_unknowns = 4000 }"}});
  ASSERT_TRUE(adapted.converged) << adapted.reason;
  EXPECT_NEAR(adapted.balance->contact[2], 1, 1e-8);
  try
  {
    result_of<3>(corner);
    FAIL();
  }
  catch (const InputError &e)
  {
    EXPECT_NE(std::string(e.what()).find("points of the rule 'edges'"), std::string::npos) << e.what();
  }
  EXPECT_THROW(result_of<3>(corner, {{"boundary.back.about", "[2.2, 0.1, 1]"}, {"mesh.refine", "1"}}), InputError);

  const std::string plane =
    "mesh.box = [[0, 0], [2, 1]]\nmesh.cells = [2, 1]\nmodel = { kind = \"elasticity\", young = 1000, poisson = 0.3 }\n"
    "boundary.top = { force = [0, -1], about = [0.3, 1] }\nconstraint.on = \"bottom\"\n"
    "constraint.gap = { plane = { point = [0, 0], normal = [0, 1] } }\nconstraint.quadrature = \"gauss(1)\"\n";
  for (const char *const solver : {"\"direct\"", "\"multigrid\"", "\"amg\""})
  {
    const RunResult solved = result_of<2>(plane, {{"mesh.refine", "4"}, {"method.solver", solver}});
    ASSERT_TRUE(solved.converged) << solved.reason;
    EXPECT_NEAR(solved.balance->contact[1], 1, 1e-8);
  }
}

TEST(BodiesHeldByContact, the_size_of_a_ring_does_not_matter)
{
  const auto of_size = [](const double size)
  {
    return result_of<2>(
      fmt::format("mesh.shell = {{ center = [0, 0], inner = {}, outer = {} }}\nmesh.refine = 3\n[model]\nkind = \"elasticity\"\n"
                  "element = \"Q2\"\nyoung = 1000\npoisson = 0.3\nload = [0, {}]\n[constraint]\non = \"inner\"\n"
                  "gap = {{ sphere = {{ center = [0, 0], radius = {} }} }}\n",
                  1.01 * size, 1.5 * size, -1 / size, size));
  };
  const RunResult one = of_size(1), tiny = of_size(1e-9);
  ASSERT_TRUE(one.converged && tiny.converged) << tiny.reason;
  EXPECT_EQ(tiny.constraints[0].n_points, one.constraints[0].n_points);
  EXPECT_EQ(tiny.constraints[0].n_active, one.constraints[0].n_active);
  EXPECT_NEAR(tiny.constraints[0].max_contact_pressure / one.constraints[0].max_contact_pressure, 1, 1e-6);
}

TEST(BodiesHeldByContact, what_a_side_condition_bears_is_said)
{
  const auto with_load_across = [](const double load)
  {
    Diagnostics diagnostics;
    Progress    quiet;
    return solve<2>(problem_of(case_of(square, {{"model.load", fmt::format("[{}, -1]", load)}})), diagnostics, quiet).result.warnings;
  };
  EXPECT_TRUE(with_load_across(0).empty());
  const auto warnings = with_load_across(1e-5);
  ASSERT_EQ(warnings.size(), 1u);
  EXPECT_EQ(std::string(warnings[0].name.text), "slight-resistance");
}

TEST(BodiesHeldByContact, forces_that_meet_their_reactions_deform_nothing)
{
  const std::string beam = "mesh.box = [[0], [1]]\nmesh.cells = 20\nmesh.refine = 2\nmodel = { kind = \"beam\", rigidity = 1, load = 0 }\n"
                           "constraint.lower = 0\n";
  for (const char *const formulation : {"\"mixed\"", "\"penalty\""})
  {
    const RunResult at_end = result_of<1>(beam + "[[point_load]]\nat = 0.0\nforce = -1\n", {{"method.formulation", formulation}});
    EXPECT_TRUE(at_end.converged) << at_end.reason;
    EXPECT_NEAR(at_end.constraints[0].total_contact_force, 1, 1e-6);
    const RunResult two = result_of<1>(
      beam + "[[support]]\nat = 0.5\nspring = 1e-9\n[[point_load]]\nat = 0.2\nforce = -1\n[[point_load]]\nat = 0.8\nforce = -1\n",
      {{"method.formulation", formulation}});
    EXPECT_TRUE(two.converged) << two.reason;
    EXPECT_NEAR(two.constraints[0].total_contact_force, 2, 1e-6);
  }
}

TEST(BodiesHeldByContact, fifty_random_ones_are_proved_or_refused)
{
  expect_proved_solutions(0, 50);
}
