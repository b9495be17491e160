// Beams: known deflections, slopes and moments for every condition at an end, convergence, energies.
#include "edge_conditions.h"

#include "unilateral/forms/beam.h"
#include "unilateral/spaces/hermite.h"

#include <deal.II/base/quadrature_lib.h>
#include <deal.II/fe/mapping_q.h>
#include <deal.II/grid/grid_generator.h>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>

namespace
{
  using namespace unilateral;
  using namespace dealii;

  using RealVector = dealii::Vector<double>;

  struct BeamData
  {
    Coefficients      coefficients;
    BoundaryCondition left, right;
  };

  /// A beam on (0, length) with cubic Hermite functions; values and slopes that the ends prescribe are zero unless given in `prescribed`.
  struct BeamProblem
  {
    BeamProblem(const BeamData &data, const unsigned n, const double length = 1, const std::array<double, 2> &slopes = {})
      : fe(make_hermite_element<1>()), dof_handler(mesh)
    {
      GridGenerator::subdivided_hyper_cube(mesh, n, 0, length);
      dof_handler.distribute_dofs(*fe);
      std::vector<PartCondition> parts(2);
      static_cast<BoundaryCondition &>(parts[0]) = data.left;
      static_cast<BoundaryCondition &>(parts[1]) = data.right;
      form = std::make_unique<Beam>(std::vector<Coefficients>{data.coefficients}, parts);

      const unsigned n_dofs = dof_handler.n_dofs();
      stiffness.reinit(n_dofs, n_dofs);
      gram.reinit(n_dofs, n_dofs);
      load.reinit(n_dofs);
      FEValues<1>                          values(mapping, *fe, QGauss<1>(6),
                                                  update_values | update_gradients | update_hessians | update_quadrature_points | update_JxW_values);
      FEFaceValues<1>                      end_values(mapping, *fe, QGauss<0>(1),
                                                      update_values | update_gradients | update_normal_vectors | update_quadrature_points | update_JxW_values);
      std::vector<types::global_dof_index> dofs(4);
      for (const auto &cell : dof_handler.active_cell_iterators())
      {
        FullMatrix<double> matrix(4, 4), gram_matrix(4, 4);
        RealVector         rhs(4);
        values.reinit(cell);
        form->add_cell_terms(values, matrix, rhs);
        form->add_gram_terms(values, gram_matrix);
        for (const unsigned f : cell->face_indices())
          if (cell->at_boundary(f) && form->has_face_terms(cell->face(f)->boundary_id()))
          {
            end_values.reinit(cell, f);
            form->add_face_terms(end_values, cell->face(f)->boundary_id(), matrix, rhs);
          }
        cell->get_dof_indices(dofs);
        for (unsigned i = 0; i < 4; ++i)
        {
          load(dofs[i]) += rhs(i);
          for (unsigned j = 0; j < 4; ++j)
          {
            stiffness(dofs[i], dofs[j]) += matrix(i, j);
            gram(dofs[i], dofs[j]) += gram_matrix(i, j);
          }
        }
      }

      // du/dn = g means u' = -g on the left.
      u.reinit(n_dofs);
      std::vector<bool> fixed(n_dofs);
      for (const unsigned id : {0, 1})
      {
        const auto &end = id == 0 ? data.left : data.right;
        for (const unsigned k : {0, 1})
          if (k == 0 ? end.value.has_value() : end.slope.has_value() || end.symmetry)
            for (const auto dof : hermite_boundary_dofs(dof_handler, {id}, k))
            {
              fixed[dof] = true;
              u(dof) = k == 0 ? 0 : (id == 0 ? -1 : 1) * slopes[id];
            }
      }
      std::vector<unsigned> unknown;
      for (unsigned i = 0; i < n_dofs; ++i)
        if (!fixed[i])
          unknown.push_back(i);
      FullMatrix<double> A(unknown.size(), unknown.size());
      RealVector         rhs(unknown.size()), x(unknown.size()), Au(n_dofs);
      stiffness.vmult(Au, u);
      for (unsigned i = 0; i < unknown.size(); ++i)
      {
        rhs(i) = load(unknown[i]) - Au(unknown[i]);
        for (unsigned j = 0; j < unknown.size(); ++j)
          A(i, j) = stiffness(unknown[i], unknown[j]);
      }
      A.gauss_jordan();
      A.vmult(x, rhs);
      for (unsigned i = 0; i < unknown.size(); ++i)
        u(unknown[i]) = x(i);
    }

    /// u, u' or the unknown of another derivative at a vertex.
    double at(const double x, const unsigned derivative = 0) const
    {
      const auto nodes = hermite_nodes(dof_handler);
      for (unsigned i = 0; i < u.size(); ++i)
        if (std::abs(nodes[i].location[0] - x) < 1e-12 && nodes[i].derivative[0] == derivative)
          return u(i);
      throw std::logic_error("no vertex");
    }

    /// int M^2 / EI
    double energy_of_moments(std::vector<double> *moments = nullptr) const
    {
      FEValues<1>       values(mapping, *fe, QGauss<1>(6), update_hessians | update_quadrature_points | update_JxW_values);
      RealVector        cell_u(4);
      std::vector<Flux> M;
      double            sum = 0;
      for (const auto &cell : dof_handler.active_cell_iterators())
      {
        values.reinit(cell);
        cell->get_dof_values(u, cell_u);
        form->flux(values, cell_u, M);
        for (const unsigned q : values.quadrature_point_indices())
        {
          sum += form->flux_energy(M[q], 0, values.quadrature_point(q)) * values.JxW(q);
          if (moments)
            moments->push_back(M[q][0]);
        }
      }
      return sum;
    }

    Triangulation<1>                  mesh;
    std::unique_ptr<FiniteElement<1>> fe;
    DoFHandler<1>                     dof_handler;
    MappingQ<1>                       mapping{1};
    std::unique_ptr<Beam>             form;
    FullMatrix<double>                stiffness, gram;
    RealVector                        load, u;
  };
} // namespace

TEST(Beam, cantilever_with_force_and_moment)
{
  // u = F x^2 (3 L - x) / (6 EI) + M x^2 / (2 EI), and q x^2 (6 L^2 - 4 L x + x^2) / (24 EI): values at vertices are exact.
  const double EI = 3, L = 2, F = 5, M = 7, q = 4;
  BeamData     data;
  data.coefficients.stiffness = {number(EI)};
  data.coefficients.load = {number(q)};
  data.left = clamped();
  data.right.flux = number(F);
  data.right.moment = number(M);
  const BeamProblem beam(data, 3, L);
  EXPECT_NEAR(beam.at(L), F * L * L * L / (3 * EI) + M * L * L / (2 * EI) + q * std::pow(L, 4) / (8 * EI), 1e-11);
  EXPECT_NEAR(beam.at(L, 1), F * L * L / (2 * EI) + M * L / EI + q * L * L * L / (6 * EI), 1e-11);
  RealVector Au(beam.u.size());
  beam.stiffness.vmult(Au, beam.u);
  EXPECT_NEAR(beam.energy_of_moments(), Au * beam.u, 1e-11 * (Au * beam.u));
}

TEST(Beam, moments_at_both_ends_have_the_sign_of_the_curvature)
{
  BeamData data;
  data.coefficients.stiffness = {number(2)};
  data.left = data.right = supported();
  data.left.moment = data.right.moment = number(3);
  const BeamProblem   beam(data, 2);
  std::vector<double> M;
  beam.energy_of_moments(&M);
  for (const double moment : M)
    EXPECT_NEAR(moment, 3, 1e-11);
  EXPECT_NEAR(beam.at(0.5), -3. / 2 / 8, 1e-12); // u = M x (x - 1) / (2 EI)
}

TEST(Beam, springs_at_the_ends)
{
  const double EI = 2, q = 3, k = 7, c = 5;
  BeamData     data;
  data.coefficients.stiffness = {number(EI)};
  data.coefficients.load = {number(q)};
  data.left.spring = data.right.spring = number(k);
  EXPECT_NEAR(BeamProblem(data, 2).at(0.5), q / (2 * k) + 5 * q / (384 * EI), 1e-12);
  EXPECT_NEAR(BeamProblem(data, 2).at(0), q / (2 * k), 1e-12);

  // Supports that resist turning take the moment q L^2 / 12 / (1 + 2 EI / (c L)).
  data.left = data.right = supported();
  data.left.slope_spring = data.right.slope_spring = number(c);
  const double end_moment = q / 12 / (1 + 2 * EI / c);
  EXPECT_NEAR(BeamProblem(data, 2).at(0.5), 5 * q / (384 * EI) - end_moment / (8 * EI), 1e-12);
  EXPECT_NEAR(BeamProblem(data, 2).at(0, 1), end_moment / c, 1e-12);
}

TEST(Beam, prescribed_slopes_are_outward)
{
  // u = x (1 - x): du/dn = -1 at both ends.
  BeamData data;
  data.left = data.right = clamped(number(0), number(-1));
  const BeamProblem beam(data, 2, 1, {-1, -1});
  EXPECT_NEAR(beam.at(0.5), 0.25, 1e-13);
}

TEST(Beam, half_of_a_symmetric_beam_is_the_half)
{
  BeamData data;
  data.coefficients.load = {number(1)};
  data.left = supported();
  data.right = symmetric();
  EXPECT_NEAR(BeamProblem(data, 3, 0.5).at(0.5), 5. / 384, 1e-13);
}

TEST(Beam, variable_stiffness_and_foundation_converge)
{
  // EI = 1 + x under an end moment 1: u = (1 + x) ln(1 + x) - x. On a foundation, supported: u = sin(pi x), q = (pi^4 + k) sin(pi x).
  BeamData tapered, founded;
  tapered.coefficients.stiffness = {text("1+x")};
  tapered.left = clamped();
  tapered.right.moment = number(1);
  founded.coefficients.reaction = number(50);
  founded.coefficients.load = {text(fmt::format("{:.17g}*sin({:.17g}*x)", std::pow(M_PI, 4) + 50, M_PI))};
  founded.left = founded.right = supported();
  std::array<double, 2> before = {};
  for (const unsigned n : {4, 8, 16})
  {
    const std::array<double, 2> error = {std::abs(BeamProblem(tapered, n).at(1) - (2 * std::log(2) - 1)),
                                         std::abs(BeamProblem(founded, n).at(0.5) - 1)};
    fmt::print("  n = {:2}: {:.2e} {:.2e}\n", n, error[0], error[1]);
    for (const unsigned i : {0, 1})
    {
      EXPECT_TRUE(n == 4 || std::log2(before[i] / error[i]) > 3.8);
    }
    before = error;
  }
}

TEST(Beam, gram_is_the_product_of_H2_and_motions_cost_nothing)
{
  BeamData data;
  data.left.value = data.right.value = number(0); // for the solution, which does not matter
  const BeamProblem beam(data, 3);
  const auto        nodes = hermite_nodes(beam.dof_handler);
  const auto        modes = beam.form->rigid_body_modes(Point<1>(0.25));
  ASSERT_EQ(modes.size(), 2);
  RealVector u(beam.u.size()), Au(u.size()), square(u.size());
  for (const auto &mode : modes)
  {
    for (unsigned i = 0; i < u.size(); ++i)
      u(i) = nodes[i].derivative[0] == 0 ? mode.value(nodes[i].location)[0] : mode.value(Point<1>(1))[0] - mode.value(Point<1>(0))[0];
    beam.stiffness.vmult(Au, u);
    EXPECT_LT(Au.linfty_norm(), 1e-11);
  }
  for (unsigned i = 0; i < u.size(); ++i) // x^2: int 4 + 4 x^2 + x^4
    square(i) = nodes[i].derivative[0] == 0 ? std::pow(nodes[i].location[0], 2) : 2 * nodes[i].location[0];
  beam.gram.vmult(Au, square);
  EXPECT_NEAR(Au * square, 4 + 4. / 3 + 0.2, 1e-12);
}
