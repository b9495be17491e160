// Problems whose solution is known: accuracy, orders of convergence, published digits.
#include "run_program.h"

#include <cmath>

namespace
{
  using namespace verification;

  // Paths into results.json.
  const std::string force = "constraint/0/total_contact_force", pressure_norm = "constraint/0/pressure_L2",
                    measure = "constraint/0/contact_measure", energy = "solution/energy", norm = "solution/norm_L2",
                    seminorm = "solution/norm_H1_semi", H1 = "errors/H1_semi", L2 = "errors/L2", largest = "errors/max_nodal",
                    mean = "errors/mean_nodal";

  void expect_relative(const Json &results, const std::string &path, const double value, const double tolerance)
  {
    EXPECT_NEAR(number(results, path) / value, 1, tolerance) << path;
  }

  /// log2 of the error at @p refine over that at @p refine + @p levels, a level.
  double
  order(const std::string &name, const std::string &element, const std::string &path, const unsigned refine, const unsigned levels = 1)
  {
    return std::log2(number(solve_mixed(name, refine, element), path) / number(solve_mixed(name, refine + levels, element), path)) / levels;
  }
} // namespace

// R3

TEST(MembraneOverBall, errors_at_the_nodes_fall_fourfold_a_level)
{
  for (unsigned refine = 3; refine < 6; ++refine)
  {
    const double ratio =
      number(solve_mixed("membrane-over-ball", refine), mean) / number(solve_mixed("membrane-over-ball", refine + 1), mean);
    EXPECT_GT(ratio, 3) << refine;
    EXPECT_LT(ratio, 5) << refine;
  }
  for (unsigned refine = 3; refine < 5; ++refine)
  {
    const double ratio =
      number(solve_mixed("membrane-over-ball", refine), largest) / number(solve_mixed("membrane-over-ball", refine + 2), largest);
    EXPECT_GT(ratio, 10) << refine;
    EXPECT_LT(ratio, 24) << refine;
  }
}

TEST(MembraneOverBall, published_values_of_the_five_point_stencil)
{
  struct Published
  {
    unsigned refine;
    double   mean, largest;
  };
  // P1 on right triangles with the vertex rule is the five-point stencil. 9 x 9, 33 x 33, 129 x 129 and 257 x 257 nodes.
  for (const Published p :
       {Published{0, 3.076e-3, 1.334e-2}, {2, 8.1817e-4, 5.7469e-3}, {4, 3.3344e-5, 2.1544e-4}, {5, 9.3726e-6, 9.3395e-5}})
  {
    const Json &results = solve_mixed("membrane-over-ball", p.refine, "P1");
    expect_relative(results, mean, p.mean, 3e-4);
    expect_relative(results, largest, p.largest, 4e-4); // half a unit in the last of four digits
  }
}

TEST(MembraneOverBall, finest_of_the_default_levels)
{
  const Json &results = solve_mixed("membrane-over-ball", 5);
  EXPECT_EQ(number(results, "space/n_dofs"), 257 * 257);
  EXPECT_LT(number(results, largest), 2e-4);
  expect_relative(results, largest, 9.3395e-5, 1e-3);
  expect_relative(results, force, 4.274195941868662, 2e-3);
  expect_relative(results, energy, 1.974124616396631, 2e-4);
  expect_relative(results, seminorm, 1.987020189327039, 1e-4);
  expect_relative(results, norm, 1.487516081924338, 1e-4);
  expect_relative(results, pressure_norm, 3.530997558405490, 1e-2);
  expect_relative(results, measure, 1.530443662856247, 3e-2); // a ring of width h
  EXPECT_NEAR(number(results, "solution/min"), -0.2357599467010551, 1e-12);
}

TEST(MembraneOverBall, the_example_as_it_stands)
{
  const Json &results = solve_example("membrane-over-ball", {});
  EXPECT_EQ(results["method"]["formulation"], "penalty");
  EXPECT_LT(number(results, largest), 2e-4);
  expect_relative(results, force, 4.274195941868662, 2e-3);
  EXPECT_LT(number(results, H1), 1.1 * number(solve_mixed("membrane-over-ball", 5), H1)); // the penalty adds little to the mesh's error
}

TEST(MembraneOverBall, Q2_is_better_at_equal_unknowns)
{
  const Json &linear = solve_mixed("membrane-over-ball", 5, "Q1"), &quadratic = solve_mixed("membrane-over-ball", 4, "Q2");
  EXPECT_EQ(number(linear, "space/n_dofs"), number(quadratic, "space/n_dofs"));
  EXPECT_LT(number(quadratic, mean), 0.3 * number(linear, mean));
  EXPECT_LT(number(quadratic, L2), 0.3 * number(linear, L2));
  EXPECT_LT(number(quadratic, H1), 0.3 * number(linear, H1));
}

TEST(MembraneOverBall, few_newton_steps_on_every_level)
{
  EXPECT_LE(most_newton_steps(solve_example("membrane-over-ball", {"mesh.refine=5", "method.solver=direct"})), 6u);
  EXPECT_LE(most_newton_steps(solve_mixed("membrane-over-ball", 5, "P1")), 8u);
  // With multigrid a step is two iterations of conjugate gradients while the active set changes; there are a few more of them.
  EXPECT_LE(most_newton_steps(solve_mixed("membrane-over-ball", 6)), 10u);
  EXPECT_LE(most_newton_steps(solve_mixed("membrane-over-ball", 4, "Q2")), 10u);
  for (const auto &level : solve_mixed("membrane-over-ball", 6).at("solver").at("levels"))
    EXPECT_LE(level.at("linear_iterations").get<unsigned>(), 20u);
}

// R5

TEST(SmoothContact, orders_in_the_plane)
{
  for (const std::string element : {"Q1", "P1"})
    for (const unsigned refine : {3u, 4u})
    {
      EXPECT_GE(order("smooth-contact-2d", element, H1, refine), 0.95) << element;
      EXPECT_GE(order("smooth-contact-2d", element, L2, refine), 1.9) << element;
    }
  for (const std::string element : {"Q2", "P2"})
  {
    EXPECT_GE(order("smooth-contact-2d", element, H1, 2, 2), 1.45) << element;
    EXPECT_GE(order("smooth-contact-2d", element, H1, 3), 1.45) << element;
    EXPECT_GE(order("smooth-contact-2d", element, L2, 2, 2), 2.2) << element;
  }
}

TEST(SmoothContact, values_in_the_plane)
{
  const Json &results = solve_mixed("smooth-contact-2d", 4, "Q2");
  expect_relative(results, force, 7.512792105424017, 2e-4);
  expect_relative(results, energy, 19.5000966939337, 1e-6);
  expect_relative(results, norm, 0.7349235851593636, 1e-4);
  expect_relative(results, seminorm, 3.85522084386741, 1e-5);
  expect_relative(results, pressure_norm, 6.094154774351706, 2e-3);
}

TEST(SmoothContact, orders_in_space)
{
  EXPECT_GE(order("smooth-contact-3d", "Q1", H1, 1), 0.95);
  EXPECT_GE(order("smooth-contact-3d", "Q1", H1, 2), 0.95);
  EXPECT_GE(order("smooth-contact-3d", "P1", H1, 2), 0.95);
  EXPECT_GE(order("smooth-contact-3d", "Q2", H1, 0), 1.45);
  EXPECT_GE(order("smooth-contact-3d", "Q2", H1, 1), 1.45);
  EXPECT_GE(order("smooth-contact-3d", "P2", H1, 0, 2), 1.4);
}

TEST(SmoothContact, values_in_space)
{
  for (const std::string element : {"Q2", "P2"})
  {
    const Json &results = solve_mixed("smooth-contact-3d", 2, element);
    expect_relative(results, force, 6.735967390266117, 2e-3);
    expect_relative(results, energy, 165.6254366234795, 2e-5);
    expect_relative(results, norm, 2.496877340231048, 1e-3);
    expect_relative(results, seminorm, 10.41814098628848, 1e-3);
  }
}

// R1, R2

TEST(DiscUnderCeiling, values_and_orders)
{
  const Json &results = solve_mixed("disc-under-ceiling", 5, "Q2");
  expect_relative(results, force, 0.7853981633974483, 1e-4);
  expect_relative(results, pressure_norm, 0.8862269254527580, 5e-3);
  expect_relative(results, energy, -0.1500529118852832, 1e-7);
  expect_relative(results, seminorm, 0.3764048925565372, 1e-5);
  expect_relative(results, norm, 0.1369547878081292, 1e-5);
  expect_relative(results, "solution/probes/0/value", 0.07341474094352738, 1e-5);
  EXPECT_NEAR(number(results, "solution/max"), 0.1008566024300068, 1e-12);
  EXPECT_GE(order("disc-under-ceiling", "Q1", H1, 3, 2), 0.95);
  EXPECT_GE(order("disc-under-ceiling", "P1", H1, 3, 2), 0.95);
  EXPECT_GE(order("disc-under-ceiling", "Q2", H1, 3, 2), 1.45);
  EXPECT_GE(order("disc-under-ceiling", "P2", H1, 3, 2), 1.4); // straight triangles: the boundary is polygonal
}

TEST(BallUnderCeiling, values_and_orders)
{
  const Json &results = solve_mixed("ball-under-ceiling", 2, "Q2");
  expect_relative(results, force, 3.141592653589793, 2e-3);
  expect_relative(results, pressure_norm, 4.341607527349606, 4e-2);
  expect_relative(results, energy, -4.476769531365455, 1e-5);
  expect_relative(results, seminorm, 2.410797878118594, 1e-4);
  expect_relative(results, norm, 0.6871491074374159, 5e-4);
  expect_relative(results, "solution/probes/0/value", 0.3541666666666667, 1e-3);
  EXPECT_GE(order("ball-under-ceiling", "Q1", H1, 2), 0.95);
  EXPECT_GE(order("ball-under-ceiling", "Q1", L2, 2), 1.9);
}

// T1

TEST(TorsionOfABar, values_and_orders)
{
  const Json &results = solve_mixed("torsion-of-a-bar", 5, "Q2");
  expect_relative(results, energy, -2.683443724941282, 1e-6);
  expect_relative(results, seminorm, 1.657978760989136, 1e-5);
  expect_relative(results, norm, 0.6888478717292798, 1e-5);
  expect_relative(results, pressure_norm, 4.113580289111467, 2e-2);
  // The pressure reaches up to the boundary, whose points are fixed: their share, a ring of half a node, is not in the sum.
  EXPECT_LT(number(results, force), 2 * M_PI);
  expect_relative(results, force, 2 * M_PI, 2e-2);
  EXPECT_GE(order("torsion-of-a-bar", "Q1", H1, 3, 2), 0.95);
  EXPECT_GE(order("torsion-of-a-bar", "Q2", H1, 3, 2), 1.45);
  EXPECT_GE(order("torsion-of-a-bar", "Q1", L2, 3, 2), 1.9);
}

// J1

TEST(JournalBearing, three_eccentricities)
{
  struct Known
  {
    std::string eccentricity;
    double      theta2, largest_pressure, p_sin, multiplier;
  };
  for (const Known &known : {Known{"0.1", 4.349748935194337, 0.1330603947829547, 0.2051555838532701, 0.1354743812666355},
                             {"0.5", 3.834383928529627, 0.7458313666207846, 0.9153721941870304, 0.8847331312745787},
                             {"0.8", 3.493687736811705, 2.522386877203678, 1.688006001527629, 1.550921801841211}})
  {
    const double e = std::stod(known.eccentricity);
    const Json  &results = solve_mixed("journal-bearing", 6, "Q2", {"parameters.eccentricity=" + known.eccentricity});
    const double h = number(results, "mesh/h_max");
    expect_relative(results, force, known.multiplier, 2e-6);
    expect_relative(results, "solution/max", known.largest_pressure, 2e-6);
    expect_relative(results, energy, -e / 2 * known.p_sin, 1e-8);
    EXPECT_NEAR(number(results, measure), 2 * M_PI - known.theta2, h) << e; // the cavitated part of the film
    // Q1 converges in the energy with h^2.
    const double exact = -e / 2 * known.p_sin;
    const double coarse =
      number(solve_mixed("journal-bearing", 4, "Q1", {"parameters.eccentricity=" + known.eccentricity}), energy) - exact;
    const double fine = number(solve_mixed("journal-bearing", 6, "Q1", {"parameters.eccentricity=" + known.eccentricity}), energy) - exact;
    EXPECT_GT(fine, 0) << "the discrete minimum lies above";
    EXPECT_NEAR(coarse / fine, 16, 3) << e;
  }
}

// A1

TEST(AmericanPut, option_values)
{
  for (const std::string element : {"Q1", "Q2"})
  {
    const Json &results = solve_mixed("american-put", 5, element);
    expect_relative(results, "solution/probes/0/value", 21.52221170105385, 1e-5);
    expect_relative(results, "solution/probes/1/value", 12.32003286776263, 1e-5);
    expect_relative(results, "solution/probes/2/value", 7.810138785739184, 1e-5);
    EXPECT_NEAR(20 + number(results, measure), 71.42857142857143, 0.4) << "the price below which it is exercised";
  }
  EXPECT_GE(order("american-put", "Q1", H1, 3, 2), 0.95);
  EXPECT_GE(order("american-put", "Q2", H1, 3, 2), 1.45);
}

TEST(AmericanPut, with_a_dividend)
{
  const Json &results = solve_mixed(
    "american-put", 5, "Q2",
    {"parameters.S=61.25741132772069", "model.velocity=[\"(sigma^2 - r + 0.03)*x\"]", "boundary.right=(K - S)*(x/S)^(-1.58113883008419)"});
  expect_relative(results, "solution/probes/1/value", 17.85076763698098, 1e-5);
  EXPECT_NEAR(20 + number(results, measure), 61.25741132772069, 0.4);
}

// M1

TEST(StringUnderCeiling, values_and_orders)
{
  const Json &linear = solve_mixed("string-under-ceiling", 7, "Q1", {"method.tolerance=1e-12"});
  EXPECT_NEAR(number(linear, force), 0.3333330151, 1e-10);
  EXPECT_NEAR(number(linear, energy), -0.030864171054, 1e-12);
  const Json &results = solve_mixed("string-under-ceiling", 7, "Q2");
  expect_relative(results, force, 1. / 3, 2e-6);
  expect_relative(results, pressure_norm, 0.5773502691896258, 1e-3);
  expect_relative(results, energy, -5. / 162, 1e-8);
  expect_relative(results, seminorm, 0.1571348402636772, 5e-7);
  expect_relative(results, norm, 0.04611073925181012, 1e-6);
  EXPECT_GE(order("string-under-ceiling", "Q1", H1, 4, 3), 0.97);
  EXPECT_GE(order("string-under-ceiling", "Q2", H1, 3, 4), 1.4); // u has 5/2 derivatives: 3/2 and no more
  EXPECT_LE(order("string-under-ceiling", "Q2", H1, 3, 4), 1.8);
}

// M3

TEST(StringOverParabola, values_and_orders)
{
  const Json &results = solve_mixed("string-over-parabola", 7, "Q2");
  expect_relative(results, force, 1.071796769724491, 1e-5);
  expect_relative(results, pressure_norm, 2.070552360820166, 5e-3);
  expect_relative(results, energy, 0.2615365636088425, 1e-7);
  expect_relative(results, seminorm, 0.7232379464724490, 1e-6);
  expect_relative(results, norm, 0.4338268059767791, 1e-5);
  EXPECT_GE(order("string-over-parabola", "Q1", H1, 4, 3), 0.97);
  EXPECT_GE(order("string-over-parabola", "Q2", H1, 3, 4), 1.3);
}

// M2: the penalised problem has an exact solution of its own: u - s = eps (1 - cosh((x - 1/2)/r) / cosh((1/2 - b)/r)), r = sqrt(eps).
TEST(PenalisedString, the_continuous_penalty_solution)
{
  struct Known
  {
    std::string epsilon;
    double      b, force, p_distance, u_distance;
  };
  for (const Known &known : {Known{"1e-1", 0.16774753177615, 0.169881404193, 0.391455946538, 0.0793031753757},
                             {"1e-2", 0.24894666347506, 0.304728370526, 0.209853757545, 0.0186582694385},
                             {"1e-3", 0.3032074220525, 0.330340100106, 0.119058633850, 0.00289899170791},
                             {"1e-4", 0.32348329959851, 0.333033400803, 0.0680998249306, 0.000466803815182},
                             {"1e-5", 0.33018605533568, 0.333303334008, 0.0385122768625, 7.9999338288e-5},
                             {"1e-6", 0.33233483332996, 0.333330333340, 0.0216962369870, 1.40513332116e-5}})
  {
    // The edge 1/3 of the contact zone of the unpenalised string is a node here.
    const Json &results =
      solve_example("string-under-ceiling", {"mesh.cells=3", "mesh.refine=10", "model.element=Q2", "constraint.0.quadrature=gauss(2)",
                                             "method.formulation=penalty", "method.epsilon=" + known.epsilon});
    const double epsilon = std::stod(known.epsilon), r = std::sqrt(epsilon), h = number(results, "mesh/h_max");
    EXPECT_EQ(number(results, "method/epsilon"), epsilon);
    expect_relative(results, force, known.force, 2e-7);
    expect_relative(results, "errors/pressure_L2", known.p_distance, 5e-4);
    expect_relative(results, H1, known.u_distance, 5e-4);
    EXPECT_NEAR((1 - number(results, measure)) / 2, known.b, h) << known.epsilon;
    expect_relative(results, "constraint/0/max_penetration", epsilon * (1 - 1 / std::cosh((0.5 - known.b) / r)), 1e-6);
  }
}

TEST(Verification, a_direct_solver_takes_over_where_multigrid_comes_to_no_rest)
{
  const Json &results = solve_example("membrane-over-ball",
                                      {"mesh.cells=10", "mesh.refine=4", "constraint.quadrature=\"gauss(1)\"", "method.max_iterations=12"});
  EXPECT_EQ(results["method"]["solver"], "direct");
  const std::string reason = results["method"]["solver_reason"];
  EXPECT_EQ(reason.find("geometric multigrid"), 0u) << reason;
  EXPECT_NE(reason.find("from there on a direct solver"), std::string::npos) << reason;
}
