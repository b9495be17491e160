// Functions of V_h on cells, against deal.II's FEValues.
#include "unilateral/spaces/function_on_cells.h"

#include "small_problem.h"

#include <gtest/gtest.h>

#include <deal.II/base/quadrature_lib.h>

#include <random>

using namespace unilateral;

namespace
{
  template <int dim>
  void expect_as_by_deal_ii(const std::string &text, const bool second_derivatives = false)
  {
    SCOPED_TRACE(text);
    const SmallProblem<dim>                            p(text);
    const FunctionSpace<dim>                          &space = p.problem->space;
    const dealii::Quadrature<dim>                      rule = p.problem->cell_quadrature();
    std::mt19937                                       random(1);
    dealii::LinearAlgebra::distributed::Vector<double> u(space.dof_handler.n_dofs());
    for (double &value : u)
      value = std::uniform_real_distribution<>(-1, 1)(random);
    FunctionOnCells<dim> function(space, rule, second_derivatives);
    auto flags = dealii::update_values | dealii::update_gradients | dealii::update_JxW_values | dealii::update_quadrature_points;
    if (second_derivatives)
      flags = flags | dealii::update_hessians;
    dealii::FEValues<dim>                            values(*space.mapping, *space.fe, rule, flags);
    const unsigned                                   n_components = space.fe->n_components();
    std::vector<dealii::Vector<double>>              u_at(rule.size(), dealii::Vector<double>(n_components));
    std::vector<std::vector<dealii::Tensor<1, dim>>> gradient_at(rule.size(), std::vector<dealii::Tensor<1, dim>>(n_components));
    std::vector<std::vector<dealii::Tensor<2, dim>>> hessian_at(rule.size(), std::vector<dealii::Tensor<2, dim>>(n_components));
    for (const auto &cell : space.dof_handler.active_cell_iterators())
    {
      values.reinit(cell);
      function.reinit(cell, u);
      values.get_function_values(u, u_at);
      values.get_function_gradients(u, gradient_at);
      if (second_derivatives)
        values.get_function_hessians(u, hessian_at);
      ASSERT_EQ(function.points().size(), rule.size());
      for (unsigned q = 0; q < rule.size(); ++q)
      {
        EXPECT_LT(function.points()[q].distance(values.quadrature_point(q)), 1e-14);
        EXPECT_NEAR(function.weight(q), values.JxW(q), 1e-14 * values.JxW(q));
        for (unsigned c = 0; c < n_components; ++c)
        {
          EXPECT_NEAR(function.value(q, c), u_at[q](c), 1e-12);
          EXPECT_LT((function.gradient(q, c) - gradient_at[q][c]).norm(), 1e-11 * (1 + gradient_at[q][c].norm()));
          if (second_derivatives)
          {
            EXPECT_LT((function.hessian(q, c) - hessian_at[q][c]).norm(), 1e-10 * (1 + hessian_at[q][c].norm()));
          }
        }
      }
    }
  }

  std::string with(const std::string &mesh, const std::string &model, const std::string &rest)
  {
    return "[mesh]\n" + mesh + "\n[model]\n" + model + "\n" + rest;
  }
} // namespace

TEST(FunctionOnCells, has_the_values_and_derivatives_that_deal_ii_computes)
{
  const std::string square = "box = [[0, 0], [2, 1]]\ncells = [3, 2]", cube = "box = [[0, 0, 0], [1, 1, 2]]\ncells = 2",
                    ball = "ball = { center = [0, 0, 0], radius = 1 }\nrefine = 1",
                    disc = "ball = { center = [0, 0], radius = 1 }\nrefine = 1", bound = "[boundary]\nall = 0\n[constraint]\nupper = 1\n",
                    contact = "[constraint]\non = \"bottom\"\ngap = 1\n";
  for (const std::string element : {"Q1", "Q3", "P1", "P2", "P3"})
    expect_as_by_deal_ii<2>(with(square, "kind = \"membrane\"\nelement = \"" + element + "\"", bound));
  expect_as_by_deal_ii<1>(with("box = [[0], [1]]\ncells = 3", "kind = \"membrane\"\nelement = \"Q2\"", bound));
  expect_as_by_deal_ii<2>(with(disc, "kind = \"membrane\"\nelement = \"Q2\"", bound));
  expect_as_by_deal_ii<3>(with(ball, "kind = \"membrane\"\nelement = \"Q2\"", bound));
  expect_as_by_deal_ii<3>(with(cube, "kind = \"membrane\"\nelement = \"P2\"", bound));
  expect_as_by_deal_ii<3>(
    with(cube, "kind = \"elasticity\"\nelement = \"Q2\"\nyoung = 1\npoisson = 0.3", "[boundary]\ntop = [0, 0, 0]\n" + contact));
  expect_as_by_deal_ii<2>(
    with(square, "kind = \"elasticity\"\nelement = \"Q1\"\nyoung = 1\npoisson = 0.3", "[boundary]\ntop = [0, 0]\n" + contact));
  expect_as_by_deal_ii<2>(with(square, "kind = \"projection\"\nload = 1", "[constraint]\nupper = 1\nquadrature = \"gauss(2)\"\n"));
  for (const std::string element : {"hermite", "c0ip2"})
    expect_as_by_deal_ii<2>(with(square, "kind = \"plate\"\nelement = \"" + element + "\"\nrigidity = 1\nload = 1\npoisson = 0.3", bound),
                            true);
}
