// Random elastic bodies that supports hold in part or not at all, and the proof that what comes out is the solution.
#pragma once

#include "elastic_block.h"

#include "unilateral/case/problem_of_case.h"
#include "unilateral/case/read_case.h"
#include "unilateral/discretisation/assembled.h"
#include "unilateral/discretisation/rigid_body_modes.h"
#include "unilateral/solve.h"

#include <Eigen/Cholesky>

#include <gtest/gtest.h>

#include <cstdlib>
#include <filesystem>
#include <random>
#include <string>
#include <vector>

#include <unistd.h>

namespace unilateral
{
  /// A case as text, with the mesh file that it needs, drawn by a seed: boxes, rings, blocks of distorted hexahedra or tetrahedra, wedges;
  /// planes, spheres, cylinders, several obstacles at once; clearances from none to the size of the body; supports that leave all modes
  /// free, some or none.
  class RandomBody
  {
  public:
    explicit RandomBody(const unsigned seed) : random(seed) { draw(seed); }

    unsigned    dim = 2;
    std::string text;

  private:
    double uniform(const double from, const double to) { return std::uniform_real_distribution<double>(from, to)(random); }
    bool   chance(const double probability) { return uniform(0, 1) < probability; }
    template <typename T>
    T one_of(const std::vector<T> &all)
    {
      return all[std::uniform_int_distribution<std::size_t>(0, all.size() - 1)(random)];
    }

    void draw(const unsigned seed)
    {
      dim = chance(0.6) ? 2 : 3;
      const double E = std::pow(10., uniform(0, 5)), pressure = E * std::pow(10., uniform(-5, -3));
      const double clearance = chance(0.25) ? 0. : std::pow(10., uniform(-4, 0.3));
      const int    shape = std::uniform_int_distribution<int>(0, 3)(random);
      const bool   simplex = shape >= 2 && chance(0.5);
      const bool   second_order = chance(0.3);
      std::string  mesh, boundary, constraints;
      const auto   vector = [&](const double x, const double y)
      { return dim == 2 ? fmt::format("[{}, {}]", x, y) : fmt::format("[{}, {}, {}]", x, y, chance(0.5) ? 0. : uniform(-0.2, 0.2) * y); };
      std::string load = "[0, 0]";

      if (shape == 1)
      {
        // A ring, or a hollow ball, around a pin or a ball with clearance; the load drives it against the pin.
        const double inner = 1 + 0.3 * clearance;
        mesh = fmt::format("shell = {{ center = {}, inner = {}, outer = {} }}\nrefine = {}\n", dim == 2 ? "[0, 0]" : "[0, 0, 0]", inner,
                           inner + uniform(0.3, 0.8),
                           dim == 2       ? one_of<int>(second_order ? std::vector<int>{1, 2} : std::vector<int>{2, 3})
                           : second_order ? 0
                                          : 1);
        constraints = fmt::format("[[constraint]]\non = \"inner\"\ngap = {{ sphere = {{ center = {}, radius = 1 }} }}\n",
                                  dim == 2 ? "[0, 0]" : "[0, 0, 0]");
        load = vector(uniform(-1, 1) * pressure, -pressure);
        if (chance(0.3))
          boundary += fmt::format("outer = {{ spring = {} }}\n",
                                  dim == 2 ? fmt::format("[{}, 0]", 1e-6 * E) : fmt::format("[{0}, 0, {0}]", 1e-6 * E));
      }
      else
      {
        // A block of length 2 over a plane, a ball or a pin, pressed down; against walls as well.
        if (shape == 0)
          mesh = dim == 2 ? fmt::format("box = [[0, 0], [2, 1]]\ncells = [{0}, {0}]\nrefine = {1}\n", one_of<int>({2, 3, 4}),
                                        one_of<int>({0, 1, 2}))
                          : fmt::format("box = [[0, 0, 0], [2, 1, 1]]\ncells = [4, 2, 2]\nrefine = {}\n", chance(0.7) ? 0 : 1);
        else
        {
          ElasticBlock block;
          block.dim = dim;
          block.n = dim == 2 ? 3 : 2;
          block.simplex = simplex;
          block.distorted = chance(0.5);
          const auto folder = std::filesystem::temp_directory_path() / fmt::format("unilateral-random-bodies-{}", getpid());
          std::filesystem::create_directories(folder);
          const std::string file = (folder / fmt::format("{}.msh", seed)).string();
          block.write(file);
          mesh = fmt::format("file = \"{}\"\nrefine = {}\n", file, chance(0.7) ? 0 : 1);
        }
        const double x = uniform(0.6, 1.4), z = uniform(0.3, 0.7);
        const auto   point = [&](const double px, const double py, const double pz)
        { return dim == 2 ? fmt::format("[{}, {}]", px, py) : fmt::format("[{}, {}, {}]", px, py, pz); };
        const auto plane = [&](const std::string &on, const std::string &at, const std::string &normal)
        { constraints += fmt::format("[[constraint]]\non = \"{}\"\ngap = {{ plane = {{ point = {}, normal = {} }} }}\n", on, at, normal); };
        switch (std::uniform_int_distribution<int>(0, 3)(random))
        {
        case 0:
          plane("bottom", point(0, -clearance, 0), point(chance(0.5) ? 0 : uniform(-0.1, 0.1), 1, 0));
          break;
        case 1:
        {
          const double radius = uniform(1, 20);
          constraints = fmt::format("[[constraint]]\non = \"bottom\"\ngap = {{ sphere = {{ center = {}, radius = {} }} }}\n",
                                    point(x, -clearance - radius, z), radius);
          break;
        }
        case 2:
          // A corner: a wedge of two planes below, whatever the direction of the load between them.
          plane("bottom", point(0, -clearance, 0), point(0, 1, 0));
          plane("left", point(-0.5 * clearance, 0, 0), point(1, 0, 0));
          break;
        default:
          if (dim == 3)
            constraints =
              fmt::format("[[constraint]]\non = \"bottom\"\ngap = {{ cylinder = {{ point = {}, axis = [0, 0, 1], radius = 3 }} }}\n",
                          point(x, -clearance - 3, 0));
          else
            constraints = fmt::format("[[constraint]]\non = \"bottom\"\ngap = \"{} + 0.1 * (x - {})^2\"\n", clearance, x);
        }
        if (constraints.find("\"left\"") == std::string::npos && chance(0.5))
          boundary += "left = \"symmetry\"\n";
        if (dim == 3 && chance(0.6))
          boundary += "front = \"symmetry\"\n";
        if (chance(0.15))
          boundary += fmt::format("right = {{ spring = {} }}\n",
                                  dim == 2 ? fmt::format("[{0}, {0}]", 1e-4 * E) : fmt::format("[{0}, {0}, {0}]", 1e-4 * E));
        else if (chance(0.1))
          boundary += dim == 2 ? "right = [0, 0]\n" : "right = [0, 0, 0]\n";
        if (chance(0.5))
          boundary += fmt::format("top = {{ pressure = {} }}\n", pressure);
        else
          load = vector(chance(0.5) ? 0 : -uniform(0, 0.3) * pressure, -pressure);
      }
      if (load == "[0, 0]" && dim == 3)
        load = "[0, 0, 0]";
      const std::string element = fmt::format("{}{}", simplex ? "P" : "Q", second_order ? 2 : 1);
      text =
        fmt::format("[mesh]\n{}[model]\nkind = \"elasticity\"\nelement = \"{}\"\nyoung = {}\npoisson = {}\nload = {}\n[boundary]\n{}{}",
                    mesh, element, E, uniform(0, 0.4), load, boundary, constraints);
      text += fmt::format("[method]\nformulation = \"{}\"\nsolver = \"{}\"\n", one_of<std::string>({"mixed", "penalty"}),
                          one_of<std::string>({"auto", "direct", "amg"}));
    }

    std::mt19937 random;
  };

  /// What came of one.
  enum class Ending
  {
    solved,        ///< and proved to be the solution
    refused,       ///< InputError: nothing holds it, or it has no load
    not_converged, ///< said so
    wrong          ///< "solved", and it is not
  };

  /// Solves it and, where the program calls it solved, proves it by what makes (u, lambda) the minimiser of a convex problem and no other:
  /// with A, B, W, f, s assembled anew,
  ///     lambda >= 0,  Bu - s - eps lambda <= 0,  lambda.(Bu - s - eps lambda) = 0,  and A u + B'W lambda = f,
  /// the last by its energy norm, by a dense factorisation that knows nothing of the solver, and by its work on every rigid body mode.
  template <int dim>
  Ending solve_and_prove(const RandomBody &body, std::string &what)
  {
    Diagnostics   diagnostics;
    Progress      quiet;
    const Case    request = parse_case(body.text, "random.toml", {}, diagnostics);
    Solution<dim> solution;
    try
    {
      solution = solve<dim>(problem_of(request), diagnostics, quiet);
    }
    catch (const InputError &error)
    {
      what = error.what();
      return Ending::refused;
    }
    const RunResult &result = solution.result;
    what = result.reason;
    if (!result.converged)
      return Ending::not_converged;

    const Problem<dim>       &problem = *solution.problem;
    const ConstraintSet<dim> &set = solution.constraint_set;
    const auto                discrete = assemble(problem, set, {.solver = Method::Solver::direct}, /*with_gram=*/false);
    const std::size_t         n = problem.space.dof_handler.n_dofs(), n_points = set.size();
    Vector                    u(solution.displacement), Bu(n_points), Au(n), contact(n);
    const Vector             &lambda = solution.contact_pressure;
    problem.space.dirichlet.set_zero(u);
    discrete->apply_trace(Bu, u);
    discrete->apply_stiffness(Au, u);
    discrete->apply_trace_transpose(contact, lambda);

    // The conditions at the points, in the unit of a pressure.
    const double largest_pressure = std::max(lambda.linfty_norm(), 1e-300);
    double       violation = 0;
    for (std::size_t i = 0; i < n_points; ++i)
    {
      const double open = (Bu(i) - discrete->obstacle()(i) - result.epsilon * lambda(i)) / discrete->compliance()(i);
      const double rounding = 1e-13 * (std::abs(Bu(i)) + std::abs(discrete->obstacle()(i))) / discrete->compliance()(i);
      violation = std::max(violation, std::max(0., std::abs(lambda(i) - std::max(lambda(i) + open, 0.)) - rounding) / largest_pressure);
    }
    // The residual by unknowns that nothing fixes, and its work on the rigid body modes.
    double load_size = 0, contact_size = 0;
    for (std::size_t j = 0; j < n; ++j)
    {
      load_size += std::abs(discrete->load()(j));
      contact_size += std::abs(contact(j));
    }
    Vector residual(discrete->load());
    residual -= Au;
    residual -= contact;
    problem.space.dirichlet.set_zero(residual);
    double imbalance = 0;
    for (const Vector &mode : discrete->null_space())
      imbalance = std::max(imbalance, std::abs(residual * mode) / std::max(load_size, contact_size));

    // Its energy norm: A and the rigid body modes, which it has no work on, by a dense factorisation.
    Eigen::MatrixXd A = Eigen::MatrixXd::Zero(n, n);
    for (std::size_t row = 0; row < n; ++row)
      for (auto entry = discrete->stiffness_matrix().begin(row); entry != discrete->stiffness_matrix().end(row); ++entry)
        A(row, entry->column()) = entry->value();
    const double size_of_A = A.diagonal().mean();
    for (const Vector &mode : discrete->null_space())
    {
      const Eigen::Map<const Eigen::VectorXd> r(mode.begin(), n);
      A += size_of_A * r * r.transpose() / r.squaredNorm();
    }
    const Eigen::Map<const Eigen::VectorXd> r(residual.begin(), n);
    const double                            residual_norm = std::sqrt(std::abs(r.dot(A.ldlt().solve(r))));
    const double                            energy_norm = std::sqrt(std::abs(u * Au));

    what = fmt::format("solved; conditions at the points to {:.1e}, imbalance {:.1e}, reported {:.1e}, residual {:.1e} of the energy norm, "
                       "load {:.3g}, contact {:.3g}",
                       violation, imbalance, result.balance->residual, residual_norm / energy_norm, load_size, contact_size);
    const bool proved = violation <= 1e-5 && imbalance <= 1e-8 && result.balance->residual <= 1e-6 && residual_norm <= 1e-6 * energy_norm;
    return proved ? Ending::solved : Ending::wrong;
  }

  /// Seeds @p first to @p last - 1, or only the one in the environment's UNILATERAL_SEED: none may end wrong, and few may end without a
  /// solution.
  inline void expect_proved_solutions(const unsigned first, const unsigned last)
  {
    unsigned          count[4] = {0, 0, 0, 0};
    const char *const only = std::getenv("UNILATERAL_SEED");
    for (unsigned seed = first; seed < last; ++seed)
    {
      if (only && seed != static_cast<unsigned>(std::atoi(only)))
        continue;
      const RandomBody body(seed);
      std::string      what;
      const Ending     ending = body.dim == 2 ? solve_and_prove<2>(body, what) : solve_and_prove<3>(body, what);
      ++count[unsigned(ending)];
      EXPECT_NE(ending, Ending::wrong) << "seed " << seed << ": " << what << "\n" << body.text;
      if (std::getenv("UNILATERAL_SHOW"))
        fmt::print("{} {} {}\n", seed, unsigned(ending), what);
      if (ending == Ending::not_converged)
        fmt::print("seed {} not converged: {}\n", seed, what);
    }
    fmt::print("{} proved, {} refused, {} not converged, {} wrong\n", count[0], count[1], count[2], count[3]);
    EXPECT_GE(count[0], (last - first) / 2);
    EXPECT_LE(count[2], (last - first) / 50);
  }
} // namespace unilateral
