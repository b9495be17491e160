// Problems of every kind, drawn by a seed: membranes, bodies, beams, plates, projections; all elements and rules, meshes refined in places,
// both methods, every solver. Small enough for dense matrices.
#pragma once

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <random>
#include <string>
#include <vector>

namespace unilateral
{
  class RandomProblem
  {
  public:
    explicit RandomProblem(const unsigned seed) : random(seed * 0x9e3779b97f4a7c15u)
    {
      switch (seed % 10)
      {
      case 0:
      case 1:
      case 2:
      case 3:
        draw_membrane(1 + seed / 10 % 3);
        break;
      case 4:
      case 5:
      case 6:
        draw_body(seed % 2 + 2);
        break;
      case 7:
        draw_beam();
        break;
      case 8:
        draw_plate();
        break;
      default:
        draw_projection();
      }
    }

    unsigned    dim = 1;
    std::string kind, text;

  private:
    // Not the distributions of the library, which differ between machines.
    double      uniform(const double from, const double to) { return from + (to - from) * (double(random() >> 11) * 0x1p-53); }
    double      decades(const double from, const double to) { return std::pow(10., uniform(from, to)); }
    bool        chance(const double probability) { return uniform(0, 1) < probability; }
    std::size_t below(const std::size_t n) { return std::size_t(random() % n); }
    int         between(const int from, const int to) { return from + int(below(std::size_t(to - from + 1))); }
    template <typename T>
    T one_of(const std::vector<T> &all)
    {
      return all[below(all.size())];
    }

    static std::string list(const std::vector<double> &numbers) { return fmt::format("[{}]", fmt::join(numbers, ", ")); }

    /// A smooth function of the coordinates with values in [-amplitude, amplitude], over a domain of the size @p length.
    std::string waves(const double amplitude, const double length)
    {
      std::string text = fmt::format("{}", amplitude);
      for (unsigned d = 0; d < dim; ++d)
        text += fmt::format("*sin({}*{}{:+})", uniform(1, 7) / length, "xyz"[d], uniform(-3, 3));
      return text;
    }

    /// Uniform cells so that there are at most @p most nodes of degree @p degree: `cells` and `refine`.
    std::string cells(const unsigned degree, const double most, const bool of_box = true)
    {
      const double along = (std::pow(most, 1. / dim) - 1) / degree; // cells in a direction
      const int    refine = of_box ? between(0, std::max(0, std::min(3, int(std::log2(std::max(1., along)))))) : 0;
      const int    coarse = std::max(1, int(along / (1 << refine)));
      std::string  text;
      if (of_box)
      {
        std::vector<double> each(dim);
        for (double &n : each)
          n = between((coarse + 1) / 2, coarse);
        text = fmt::format("cells = {}\n", list(each));
      }
      return text + fmt::format("refine = {}\n", refine);
    }

    std::string local_refinement(const double length)
    {
      std::string distance = "(x-" + fmt::format("{}", uniform(0, 1) * length) + ")^2";
      for (unsigned d = 1; d < dim; ++d)
        distance += fmt::format("+({}-{})^2", "xyz"[d], uniform(0, 1) * length);
      return fmt::format("[[mesh.local]]\nwhere = \"{} < {}\"\n", distance, std::pow(uniform(0.2, 0.5) * length, 2));
    }

    std::string rule(const bool simplex)
    {
      if (chance(0.5))
        return "";
      if (simplex)
        return fmt::format("quadrature = \"{}\"\n",
                           one_of<std::string>({"nodal", "edges", "gauss(1)", "gauss(2)", "trapezoid", "midpoint"}));
      // Fewer points where there are many cells.
      std::vector<std::string> rules = {"nodal", "gauss(1)", "lobatto(2)", "midpoint", "trapezoid"};
      if (dim < 3)
        rules.insert(rules.end(), {"gauss(2)", "lobatto(3)", "simpson"});
      if (dim < 2)
        rules.insert(rules.end(), {"gauss(3)", "lobatto(4)"});
      return fmt::format("quadrature = \"{}\"\n", one_of(rules));
    }

    /// @p natural: a penetration of the size of the solution over a pressure of its size.
    std::string method(const double natural, const std::vector<std::string> &solvers)
    {
      std::string text = fmt::format("[method]\nsolver = \"{}\"\n", one_of(solvers));
      if (chance(0.4))
        return text + "formulation = \"mixed\"\n";
      return chance(0.3) ? text : text + fmt::format("epsilon = {}\n", natural * decades(-7, -1));
    }

    /// Bounds on both sides, above or below of @p around, which they keep @p distance off where it is prescribed.
    std::string bounds(const double around, const double distance, const double length, const bool simplex, const std::string &on = "")
    {
      const int         sides = between(1, 3);
      const std::string ripple = waves(uniform(0, 0.9) * distance, length);
      std::string       text = "[[constraint]]\n" + on;
      if (sides & 1)
        text += fmt::format("lower = \"{} - {} + {}\"\n", around, distance, ripple);
      if (sides & 2)
        text += fmt::format("upper = \"{} + {} + {}\"\n", around, distance * uniform(1, 2), ripple);
      return text + rule(simplex);
    }

    void draw_membrane(const unsigned dimension)
    {
      dim = dimension;
      kind = fmt::format("membrane {}-D", dim);
      const bool     simplex = dim > 1 && chance(0.4);
      const unsigned degree = unsigned(between(1, 3));
      const double   length = decades(-1, 1), k = decades(-2, 2), f = decades(-2, 2);
      const double   deflection = f * length * length / (8 * dim * k), distance = deflection * uniform(0.05, 0.5);
      const double   value = chance(0.5) ? 0. : uniform(-1, 1) * deflection;
      const bool     box = dim == 1 || chance(0.7);
      const double   most = dim == 1 ? 90 : dim == 2 ? 260 : 300;

      std::string mesh;
      if (box)
      {
        std::vector<double> sides(dim);
        for (double &side : sides)
          side = length * uniform(0.6, 1.2);
        mesh = fmt::format("box = [{}, {}]\n", list(std::vector<double>(dim, 0.)), list(sides)) + cells(degree, most);
        if (!simplex && chance(0.3))
          mesh = mesh + local_refinement(length);
      }
      else
      {
        const bool shell = dim == 2 && chance(0.4);
        mesh = shell ? fmt::format("shell = {{ center = {}, inner = {}, outer = {} }}\n", list(std::vector<double>(dim, 0.)), 0.4 * length,
                                   length)
                     : fmt::format("ball = {{ center = {}, radius = {} }}\n", list(std::vector<double>(dim, 0.)), length / 2);
        mesh += fmt::format("refine = {}\n", dim == 3                  ? (degree == 1 && !simplex ? 1 : 0)
                                             : degree == 1 && !simplex ? 2
                                             : degree == 3             ? 0
                                                                       : 1);
      }

      std::string model = fmt::format("[model]\nkind = \"membrane\"\nelement = \"{}{}\"\n", simplex ? "P" : "Q", degree);
      switch (between(0, 3))
      {
      case 0:
        model += fmt::format("stiffness = {}\n", k);
        break;
      case 1: // a full tensor
        if (dim > 1)
        {
          model += dim == 2 ? "stiffness = " + list({k * uniform(1, 5), k * uniform(-0.9, 0.9), k})
                            : "stiffness = " +
                                list({k * uniform(1, 3), k * uniform(-0.4, 0.4), k * uniform(-0.4, 0.4), k, k * uniform(-0.4, 0.4), k});
          model += "\n";
          break;
        }
        [[fallthrough]];
      default:
        model += fmt::format("stiffness = \"{} + {}\"\n", k, waves(0.7 * k, length));
      }
      if (chance(0.2))
      {
        std::vector<double> velocity(dim);
        for (double &v : velocity)
          v = uniform(-6, 6) * k / length;
        model += "velocity = " + list(velocity) + "\n";
        kind += ", velocity";
      }
      const bool reaction = chance(0.3);
      if (reaction)
        model += fmt::format("reaction = {}\n", k / (length * length) * decades(-1, 2));
      const double pull = (chance(0.5) ? 1 : -1) * f;
      model +=
        chance(0.5) ? fmt::format("load = {}\n", pull) : fmt::format("load = \"{} + {}\"\n", pull * uniform(-0.3, 1), waves(2 * f, length));

      std::string boundary = "[boundary]\n", constraint;
      const int   held = box ? between(0, 5) : 0;
      if (held <= 2)
        boundary += fmt::format("all = {}\n", value);
      else if (held == 3)
        boundary +=
          fmt::format("left = {}\nright = {{ flux = {}, spring = {} }}\n", value, uniform(-1, 1) * f * length, k / length * decades(-2, 2));
      else if (held == 4)
        boundary += fmt::format("all = {{ spring = {} }}\n", k / length * decades(-2, 1));
      else if (!reaction) // nothing but the bound holds it, or one side does
        boundary += chance(0.5) ? "" : fmt::format("left = {}\n", value);
      if (held == 3 && chance(0.5))
        constraint = bounds(value, distance, length, simplex, "on = \"right\"\n");
      else
        constraint = bounds(value, distance, length, simplex);
      const std::vector<std::string> solvers = simplex || dim == 1 ? std::vector<std::string>{"auto", "direct", "amg"}
                                                                   : std::vector<std::string>{"direct", "amg", "multigrid", "multigrid"};
      text = "[mesh]\n" + mesh + model + boundary + constraint + method(deflection / f, solvers);
    }

    void draw_body(const unsigned dimension)
    {
      dim = dimension;
      const bool        simplex = chance(0.4);
      const bool        axisymmetric = dim == 2 && chance(0.3);
      const unsigned    degree = unsigned(dim == 2 ? between(1, 3) : between(1, 2));
      const double      E = decades(-1, 5), p = E * decades(-4, -2), travel = p / E;
      const std::string zero = dim == 2 ? "[0, 0]" : "[0, 0, 0]";
      kind = axisymmetric ? "body, axisymmetric" : fmt::format("body {}-D", dim);
      const auto point = [&](const double x, const double y, const double z)
      { return dim == 2 ? fmt::format("[{}, {}]", x, y) : fmt::format("[{}, {}, {}]", x, y, z); };

      std::string mesh = fmt::format("box = [{}, {}]\n", zero, point(2, 1, 1)) + cells(degree, dim == 2 ? 130 : 100);
      if (!simplex && chance(0.3))
        mesh += local_refinement(1);
      std::string model =
        fmt::format("[model]\nkind = \"elasticity\"\nelement = \"{}{}\"\nyoung = {}\npoisson = {}\n", simplex ? "P" : "Q", degree,
                    chance(0.6) ? fmt::format("{}", E) : fmt::format("\"{} + {}\"", E, waves(0.5 * E, 1)), uniform(0, 0.49));
      if (axisymmetric)
        model += "assumption = \"axisymmetric\"\n";
      else if (dim == 2 && chance(0.4))
        model += "assumption = \"plane stress\"\n";
      if (!simplex && chance(0.2))
        model += "integration = \"reduced\"\n";
      std::string boundary = "[boundary]\n";
      switch (between(0, 4))
      {
      case 0:
        boundary += "top = " + point(0, -travel * uniform(0.2, 2), 0) + "\n";
        break;
      case 1:
        boundary += fmt::format("top = {{ pressure = {} }}\nright = {}\n", p, axisymmetric ? "\"symmetry\"" : "\"clamped\"");
        break;
      case 2:
        boundary +=
          fmt::format("top = {{ x = 0, pressure = \"{} + {}\" }}\n", p, waves(0.5 * p, 1)) + (dim == 3 ? "front = \"symmetry\"\n" : "");
        break;
      case 3:
        boundary += fmt::format("top = {{ spring = {} }}\n", E * decades(-3, 1));
        model += "load = " + point(axisymmetric ? 0 : uniform(-0.5, 0.5) * p, -p, 0) + "\n";
        break;
      default: // contact alone, or nearly
        boundary += fmt::format("left = \"symmetry\"\n{}", dim == 3 ? "front = \"symmetry\"\n" : "");
        model += "load = " + point(0, -p, 0) + "\n";
      }
      const double gap = travel * uniform(-0.3, 0.7), x = uniform(0.5, 1.5), radius = 0.5 / travel * uniform(0.2, 3);
      std::string  surface;
      switch (between(0, dim == 3 ? 3 : 2))
      {
      case 0:
        surface = fmt::format("{{ plane = {{ point = {}, normal = {} }} }}", point(0, -gap, 0),
                              point(axisymmetric ? 0 : uniform(-travel, travel), 1, 0));
        break;
      case 1:
        surface = fmt::format("{{ sphere = {{ center = {}, radius = {} }} }}", point(axisymmetric ? 0 : x, -gap - radius, 0.5), radius);
        break;
      case 2:
        surface = fmt::format("\"{} + {}\"", gap, waves(0.5 * travel, 1));
        break;
      default:
        surface = fmt::format("{{ cylinder = {{ point = {}, axis = [0, 0, 1], radius = {} }} }}", point(x, -gap - radius, 0), radius);
      }
      const std::string constraint = "[[constraint]]\non = \"bottom\"\ngap = " + surface + "\n" + (chance(0.3) ? rule(simplex) : "");
      text =
        "[mesh]\n" + mesh + model + boundary + constraint +
        method(1 / E, simplex ? std::vector<std::string>{"auto", "direct", "amg"} : std::vector<std::string>{"direct", "amg", "multigrid"});
    }

    void draw_beam()
    {
      dim = 1;
      kind = "beam";
      const double length = decades(-1, 1), EI = decades(-2, 2), q = decades(-2, 2);
      const double deflection = 0.01 * q * std::pow(length, 4) / EI, distance = deflection * uniform(0.05, 0.5);
      const int    n = between(4, 40);
      std::string  model = fmt::format("[model]\nkind = \"beam\"\nrigidity = {}\nload = \"{} + {}\"\n",
                                      chance(0.5) ? fmt::format("{}", EI) : fmt::format("\"{} + {}\"", EI, waves(0.6 * EI, length)),
                                       uniform(-1, 1) * q, waves(uniform(0, 2) * q, length));
      std::string  more;
      if (chance(0.3))
        model += fmt::format("reaction = {}\n", EI / std::pow(length, 4) * decades(0, 4));
      const auto end = [&](const bool may_be_free)
      {
        switch (between(0, may_be_free ? 5 : 2))
        {
        case 0:
          return std::string("\"clamped\"");
        case 1:
          return std::string("\"simply supported\"");
        case 2:
          return fmt::format("{{ value = 0, slope = {} }}", uniform(-1, 1) * deflection / length);
        case 3:
          return std::string("\"symmetry\"");
        case 4:
          return fmt::format("{{ force = {}, spring = {} }}", uniform(-0.3, 0.3) * q * length, EI / std::pow(length, 3) * decades(0, 3));
        default:
          return std::string("\"free\"");
        }
      };
      const std::string boundary = fmt::format("[boundary]\nleft = {}\nright = {}\n", end(false), end(true));
      if (chance(0.3))
        more += fmt::format("[[support]]\nat = {}\n{} = {}\n", length * between(1, n - 1) / n, "spring",
                            EI / std::pow(length, 3) * decades(-1, 3));
      if (chance(0.3))
        more += fmt::format("[[point_load]]\nat = {}\nforce = {}\n", uniform(0, 1) * length, uniform(-1, 1) * q * length);
      std::string constraint = bounds(0, distance, length, false);
      if (constraint.find("quadrature") != std::string::npos && chance(0.5))
        constraint = constraint.substr(0, constraint.find("quadrature"));
      text = fmt::format("[mesh]\nbox = [[0], [{}]]\ncells = {}\nrefine = {}\n", length, n, between(0, 1)) + model + boundary + more +
             constraint + method(deflection / q, {"auto", "direct"});
    }

    void draw_plate()
    {
      dim = 2;
      kind = "plate";
      const double      length = decades(-1, 1), D = decades(-2, 2), q = decades(-2, 2);
      const double      deflection = 0.004 * q * std::pow(length, 4) / D, distance = deflection * uniform(0.05, 0.5);
      const std::string element = one_of<std::string>({"hermite", "c0ip2", "c0ip3", "c0ip2-triangles", "c0ip3-triangles"});
      const bool        simplex = element.ends_with("triangles"), ball = element != "hermite" && chance(0.3);
      std::string       mesh =
        ball ? fmt::format("ball = {{ center = [0, 0], radius = {} }}\nrefine = {}\n", length / 2, simplex ? 0 : 1)
                   : fmt::format("box = [[0, 0], [{}, {}]]\n", length, length * uniform(0.6, 1.2)) + cells(element == "hermite" ? 1
                                                                                                           : element[4] == '2'  ? 2
                                                                                                                                : 3,
                                                                                                     element == "hermite" ? 64 : 200);
      if (!ball && element != "hermite" && !simplex && chance(0.3))
        mesh += local_refinement(length);
      std::string model = fmt::format("[model]\nkind = \"plate\"\nelement = \"{}\"\nrigidity = {}\npoisson = {}\nload = \"{} + {}\"\n",
                                      element, D, uniform(0, 0.45), uniform(-1, 1) * q, waves(uniform(0, 2) * q, length));
      if (chance(0.3))
        model += fmt::format("reaction = {}\n", D / std::pow(length, 4) * decades(1, 4));
      std::string boundary = "[boundary]\n";
      switch (ball ? between(0, 1) : between(0, 4))
      {
      case 0:
        boundary += "all = \"clamped\"\n";
        break;
      case 1:
        boundary += ball && simplex ? "all = \"clamped\"\n" : "all = \"simply supported\"\n";
        break;
      case 2:
        boundary += "left = \"clamped\"\nright = \"free\"\nbottom = \"symmetry\"\n";
        break;
      case 3:
        boundary += fmt::format("left = \"simply supported\"\nright = {{ force = {}, spring = {} }}\ntop = \"clamped\"\n", 0.1 * q * length,
                                D / std::pow(length, 3) * decades(0, 2));
        break;
      default:
        boundary += fmt::format("left = {{ value = 0, slope = {} }}\nall = \"simply supported\"\n", deflection / length);
      }
      text = "[mesh]\n" + mesh + model + boundary + bounds(0, distance, length, simplex) + method(deflection / q, {"auto", "direct"});
    }

    void draw_projection()
    {
      dim = unsigned(between(1, 3));
      kind = "projection";
      const double        length = decades(-1, 1), alpha = decades(-2, 2), f = decades(-2, 2);
      const bool          discontinuous = chance(0.4), simplex = !discontinuous && dim > 1 && chance(0.4);
      const unsigned      degree = unsigned(between(1, 3));
      std::vector<double> sides(dim, length);
      const std::string   mesh = fmt::format("box = [{}, {}]\n", list(std::vector<double>(dim, 0.)), list(sides)) +
                               cells(discontinuous ? 3 : degree, dim == 1 ? 80 : 250);
      const std::string model = fmt::format("[model]\nkind = \"projection\"\n{}stiffness = \"{} + {}\"\nload = \"{}\"\n",
                                            discontinuous ? "" : fmt::format("element = \"{}{}\"\n", simplex ? "P" : "Q", degree), alpha,
                                            waves(0.5 * alpha, length), waves(f, length));
      text = "[mesh]\n" + mesh + model + bounds(0, 0.4 * f / alpha, length, simplex) + method(1 / alpha, {"auto", "direct", "amg"});
    }

    std::mt19937_64 random;
  };
} // namespace unilateral
