// Random elastic bodies in contact with known exact solutions, and the bound of the error of what the program makes of them.
#pragma once

#include "solved_case.h"

#include <fmt/format.h>

#include <gtest/gtest.h>

#include <random>
#include <string>

namespace unilateral
{
  /// A block [0, 1] x [0, 1] in contact below where x is between 0 and c: the displacement
  ///     u = (a1 y^2 (1 - y) sin(b1 x + e1) + k x (1 - x) y^2, -d + q(x) y + a2 y^2 cos(b2 x + e2)),
  /// has no shear stress on y = 0 where du_y/dx = 0 and du_x/dy = 0 there; its pressure there is -(lambda + 2 mu) q(x), q <= 0, and the gap
  /// is what u leaves: d where q < 0, more elsewhere. The load is what makes it the solution.
  struct RandomElasticBody
  {
    std::string text;

    RandomElasticBody(std::mt19937 &random, const std::string &element, const std::string &extra)
    {
      std::uniform_real_distribution<> any(-1, 1), positive(0.3, 2);
      const double                     a1 = any(random), b1 = 3 * any(random), e1 = 3 * any(random), a2 = any(random), b2 = 3 * any(random),
                   e2 = 3 * any(random);
      const double k = any(random), d = 0.1 * any(random), c = 0.3 + 0.4 * std::abs(any(random)), s = positive(random);
      const double E = std::pow(10., 3 * any(random)), nu = 0.2 + 0.2 * any(random);
      const bool   plane_stress = any(random) > 0;
      const double mu = E / (2 * (1 + nu)), lambda = plane_stress ? E * nu / (1 - nu * nu) : E * nu / ((1 + nu) * (1 - 2 * nu));
      // q = -s t^3, t = (c - x)+: its derivatives, and those of u by hand.
      text = fmt::format(
               "[parameters]\nlam = {}\nmu = {}\nc = {}\ns = {}\na1 = {}\nb1 = {}\nf1 = {}\na2 = {}\nb2 = {}\nf2 = {}\nk = {}\nd = {}\n",
               lambda, mu, c, s, a1, b1, e1, a2, b2, e2, k, d) +
             "t = \"max(c - x, 0)\"\nq = \"-s*t^3\"\nq1 = \"3*s*t^2\"\nq2 = \"-6*s*t\"\n"
             "S = \"a1*sin(b1*x + f1)\"\nS1 = \"a1*b1*cos(b1*x + f1)\"\nS2 = \"-a1*b1^2*sin(b1*x + f1)\"\n"
             "C = \"a2*cos(b2*x + f2)\"\nC1 = \"-a2*b2*sin(b2*x + f2)\"\nC2 = \"-a2*b2^2*cos(b2*x + f2)\"\n"
             "p = \"y^2*(1 - y)\"\np1 = \"2*y - 3*y^2\"\np2 = \"2 - 6*y\"\n"
             "ux = \"S*p + k*x*(1 - x)*y^2\"\nuy = \"-d + q*y + C*y^2\"\n"
             "uxx = \"S1*p + k*(1 - 2*x)*y^2\"\nuxy = \"S*p1 + 2*k*x*(1 - x)*y\"\nuyx = \"q1*y + C1*y^2\"\nuyy = \"q + 2*C*y\"\n"
             "uxxx = \"S2*p - 2*k*y^2\"\nuxxy = \"S1*p1 + 2*k*(1 - 2*x)*y\"\nuxyy = \"S*p2 + 2*k*x*(1 - x)\"\n"
             "uyxx = \"q2*y + C2*y^2\"\nuyxy = \"q1 + 2*C1*y\"\nuyyy = \"2*C\"\n"
             "sxx = \"(lam + 2*mu)*uxx + lam*uyy\"\nsyy = \"lam*uxx + (lam + 2*mu)*uyy\"\nsxy = \"mu*(uxy + uyx)\"\n";
      const bool held = any(random) > -0.3;
      text += fmt::format(
        "[mesh]\nbox = [[0, 0], [1, 1]]\ncells = 4\nrefine = 1\n{}[model]\nkind = \"elasticity\"\nelement = \"{}\"\n"
        "young = {}\npoisson = {}\nassumption = \"plane {}\"\n"
        "load = [\"-((lam + 2*mu)*uxxx + lam*uyxy + mu*(uxyy + uyxy))\", \"-(mu*(uxxy + uyxx) + lam*uxxy + (lam + 2*mu)*uyyy)\"]\n"
        "[boundary]\nleft = [\"ux\", \"uy\"]\nright = {}\ntop = {{ traction = [\"sxy\", \"syy\"] }}\n"
        "[constraint]\non = \"bottom\"\ngap = \"if(x < {}, {}, {} + 0.5*(x - {})^2)\"\n[exact]\nu = [\"ux\", \"uy\"]\n",
        extra, element, E, nu, plane_stress ? "stress" : "strain", held ? "[\"ux\", \"uy\"]" : "{ traction = [\"sxx\", \"sxy\"] }", c, d, d,
        c);
    }
  };
} // namespace unilateral
