#include "unilateral/inf_sup.h"

#include <deal.II/base/quadrature_lib.h>
#include <deal.II/fe/fe_q.h>
#include <deal.II/numerics/vector_tools_boundary.h>

#include <Eigen/Dense>

#include <fmt/format.h>

#include <cmath>
#include <stdexcept>

namespace unilateral
{
  using namespace dealii;
  using Eigen::MatrixXd;

  namespace
  {
    constexpr double rank_threshold = 1e-9; ///< of the largest singular value

    /// Numbers the unknowns that no Dirichlet data fix.
    class FreeDofs
    {
    public:
      FreeDofs(const types::global_dof_index n_dofs, const AffineConstraints<double> &dirichlet) : number(n_dofs, -1)
      {
        for (types::global_dof_index dof = 0; dof < n_dofs; ++dof)
          if (!dirichlet.is_constrained(dof))
            number[dof] = n_free++;
      }
      int n_free = 0;
      int operator[](const types::global_dof_index dof) const { return number[dof]; }

    private:
      std::vector<int> number;
    };

    /// A Lagrange space on the mesh of a problem with its Dirichlet parts: V_h itself or a richer one.
    template <int dim>
    struct Space
    {
      Space(const Problem<dim> &problem, std::unique_ptr<FiniteElement<dim>> element)
        : fe(std::move(element)), dof_handler(*problem.mesh.triangulation)
      {
        dof_handler.distribute_dofs(*fe);
        for (types::boundary_id part = 0; part < problem.mesh.part_names.size(); ++part)
          if (problem.boundary_condition(part).value)
          {
            std::map<types::global_dof_index, double> values;
            VectorTools::interpolate_boundary_values(*problem.mapping, dof_handler, part, Functions::ZeroFunction<dim>(), values);
            for (const auto &[dof, value] : values)
              dirichlet.add_line(dof);
          }
        dirichlet.close();
      }

      std::unique_ptr<FiniteElement<dim>> fe;
      DoFHandler<dim>                     dof_handler;
      AffineConstraints<double>           dirichlet;
    };

    /// The Gram matrix of the full H^1 inner product on the free unknowns.
    template <int dim>
    MatrixXd gram_matrix(const Problem<dim> &problem, const DoFHandler<dim> &dof_handler, const FreeDofs &free)
    {
      const auto           &fe = dof_handler.get_fe();
      const Quadrature<dim> quadrature =
        problem.element.simplex() ? Quadrature<dim>(QGaussSimplex<dim>(4)) : Quadrature<dim>(QGauss<dim>(fe.degree + 1));
      FEValues<dim>                        values(*problem.mapping, fe, quadrature, update_values | update_gradients | update_JxW_values);
      FullMatrix<double>                   cell_gram(fe.n_dofs_per_cell(), fe.n_dofs_per_cell());
      std::vector<types::global_dof_index> dofs(fe.n_dofs_per_cell());
      MatrixXd                             H = MatrixXd::Zero(free.n_free, free.n_free);
      for (const auto &cell : dof_handler.active_cell_iterators())
      {
        values.reinit(cell);
        cell_gram = 0.;
        add_gram_terms(values, cell_gram);
        cell->get_dof_indices(dofs);
        for (unsigned i = 0; i < dofs.size(); ++i)
          for (unsigned j = 0; j < dofs.size(); ++j)
            if (free[dofs[i]] >= 0 && free[dofs[j]] >= 0)
              H(free[dofs[i]], free[dofs[j]]) += cell_gram(i, j);
      }
      return H;
    }

    /// Column per point of the zone: w_i^(1/2) v(x_i), the functional of a q with I_G norm 1.
    template <int dim>
    MatrixXd point_functionals(const ConstraintSet<dim> &set, const std::vector<bool> &zone, const FreeDofs &free)
    {
      MatrixXd P = MatrixXd::Zero(free.n_free, std::count(zone.begin(), zone.end(), true));
      for (std::size_t i = 0, column = 0; i < set.size(); ++i)
        if (zone[i])
        {
          for (std::size_t k = 0; k < set.trace[i].dofs.size(); ++k)
            if (const int row = free[set.trace[i].dofs[k]]; row >= 0)
              P(row, column) += std::sqrt(set.weights[i]) * set.trace[i].values[k];
          ++column;
        }
      return P;
    }

    /// The same with the L2 product of the polynomial that is 1 at its point and 0 at the other points of the cell, for a rule with all
    /// its points inside the cells (cell by cell in the order of the constraint set).
    template <int dim>
    MatrixXd polynomial_functionals(const Problem<dim>       &problem,
                                    const ConstraintSet<dim> &set,
                                    const std::vector<bool>  &zone,
                                    const DoFHandler<dim>    &dof_handler,
                                    const FreeDofs           &free)
    {
      const auto           &fe = dof_handler.get_fe();
      const Quadrature<dim> rule = quadrature_rule<dim>(set.blocks[0].rule, problem.element);
      const unsigned        n = rule.size(), n_1d = std::lround(std::pow(n, 1. / dim));
      const QGauss<dim>     quadrature(fe.degree + n_1d);
      const QGauss<1>       nodes(n_1d);
      // Tensor products of Lagrange polynomials at the Gauss points, in the order of QGauss.
      const auto lagrange = [&](const unsigned point, const Point<dim> &x)
      {
        double   value = 1;
        unsigned index = point;
        for (unsigned d = 0; d < dim; ++d, index /= n_1d)
          for (unsigned other = 0; other < n_1d; ++other)
            if (const unsigned own = index % n_1d; other != own)
              value *= (x[d] - nodes.point(other)[0]) / (nodes.point(own)[0] - nodes.point(other)[0]);
        return value;
      };
      std::vector<int> column(set.size(), -1);
      int              n_columns = 0;
      for (std::size_t i = 0; i < set.size(); ++i)
        if (zone[i])
          column[i] = n_columns++;

      MatrixXd                             P = MatrixXd::Zero(free.n_free, n_columns);
      FEValues<dim>                        values(*problem.mapping, fe, quadrature, update_values | update_JxW_values);
      std::vector<types::global_dof_index> dofs(fe.n_dofs_per_cell());
      std::size_t                          first = 0;
      for (const auto &cell : dof_handler.active_cell_iterators())
      {
        values.reinit(cell);
        cell->get_dof_indices(dofs);
        for (unsigned g = 0; g < n; ++g)
          if (const int c = column[first + g]; c >= 0)
            for (const unsigned q : values.quadrature_point_indices())
            {
              const double factor = lagrange(g, quadrature.point(q)) * values.JxW(q) / std::sqrt(set.weights[first + g]);
              for (unsigned j = 0; j < dofs.size(); ++j)
                if (const int row = free[dofs[j]]; row >= 0)
                  P(row, c) += factor * values.shape_value(j, q);
            }
        first += n;
      }
      return P;
    }

    /// L^-1 P for the functionals w_i^(1/2) v(x_i) over all of H^1 in 1-D: the hats between the points, the vertices and the ends reach
    /// the supremum up to the L2 part of the norm, a relative O(h^2).
    MatrixXd dual_of_point_masses(const Problem<1> &problem, const ConstraintSet<1> &set, const std::vector<bool> &zone)
    {
      std::map<double, int> nodes; // coordinate -> row, -1 where Dirichlet data hold
      for (const auto &cell : problem.dof_handler.active_cell_iterators())
        for (const unsigned v : {0u, 1u})
          if (!cell->at_boundary(v) || !problem.boundary_condition(cell->face(v)->boundary_id()).value)
            nodes.emplace(cell->vertex(v)[0], 0);
          else
            nodes.emplace(cell->vertex(v)[0], -1);
      const double tolerance = 1e-10 * (nodes.rbegin()->first - nodes.begin()->first);
      const auto   find = [&](const double x)
      {
        const auto it = nodes.lower_bound(x - tolerance);
        return it != nodes.end() && it->first < x + tolerance ? it : nodes.end();
      };
      for (std::size_t i = 0; i < set.size(); ++i)
        if (find(set.points[i][0]) == nodes.end())
          nodes.emplace(set.points[i][0], 0);
      int n = 0;
      for (auto &[x, row] : nodes)
        if (row == 0)
          row = n++;
      MatrixXd H = MatrixXd::Zero(n, n);
      for (auto a = nodes.begin(), b = std::next(a); b != nodes.end(); ++a, ++b)
      {
        const double h = b->first - a->first;
        for (const int row : {a->second, b->second})
          for (const int column : {a->second, b->second})
            if (row >= 0 && column >= 0)
              H(row, column) += row == column ? 1 / h + h / 3 : -1 / h + h / 6;
      }
      MatrixXd P = MatrixXd::Zero(n, std::count(zone.begin(), zone.end(), true));
      for (std::size_t i = 0, column = 0; i < set.size(); ++i)
        if (zone[i])
          P(find(set.points[i][0])->second, column++) = std::sqrt(set.weights[i]);
      return H.llt().matrixL().solve(P);
    }

    /// L^-1 P with H = L L': then P'H^-1 P = (L^-1 P)'(L^-1 P).
    MatrixXd whiten(const MatrixXd &H, const MatrixXd &P)
    {
      return H.llt().matrixL().solve(P);
    }

    /// R of a QR factorisation: the N x N (or shorter) matrix with the same singular values and right vectors.
    Eigen::BDCSVD<MatrixXd> decompose(const MatrixXd &M)
    {
      return Eigen::BDCSVD<MatrixXd>(M, Eigen::ComputeThinV);
    }

    std::size_t count_rank(const Eigen::VectorXd &sigma)
    {
      std::size_t rank = 0;
      while (rank < std::size_t(sigma.size()) && sigma(rank) > rank_threshold * sigma(0))
        ++rank;
      return rank;
    }
  } // namespace

  template <int dim>
  InfSup inf_sup(const Problem<dim> &problem, const ConstraintSet<dim> &set, const std::vector<bool> &zone, const bool with_dual_norm)
  {
    const FreeDofs free(problem.dof_handler.n_dofs(), problem.dirichlet);
    InfSup         result;
    result.n_dofs = free.n_free;
    result.n_points = std::count(zone.begin(), zone.end(), true);
    if (result.n_dofs > largest_dense_inf_sup)
      throw std::invalid_argument(
        fmt::format("{} free unknowns are too many for dense matrices, which take {}", result.n_dofs, largest_dense_inf_sup));
    if (result.n_points == 0 || result.n_dofs == 0)
      return result;

    const MatrixXd M = whiten(gram_matrix(problem, problem.dof_handler, free), point_functionals(set, zone, free));
    const auto     svd = decompose(M);
    result.rank = count_rank(svd.singularValues());
    result.nullity = result.n_points - result.rank;
    result.C_h_nonzero = result.rank > 0 ? svd.singularValues()(result.rank - 1) : 0.;
    result.C_h = result.nullity > 0 ? 0. : result.C_h_nonzero;
    if (result.rank > 0)
      for (Eigen::Index i = 0; i < svd.matrixV().rows(); ++i)
        result.lowest_mode.push_back(svd.matrixV()(i, svd.matrixV().cols() - 1));

    if constexpr (dim <= 2)
      if (with_dual_norm && !problem.element.simplex())
      {
        const bool by_L2 = set.blocks.size() == 1 && set.blocks[0].exact_pairing && !problem.conditions[0].part;
        MatrixXd   dual;
        if constexpr (dim == 1)
          if (!by_L2)
            dual = dual_of_point_masses(problem, set, zone);
        if (dual.size() == 0)
        {
          const Space<dim> rich(problem, std::make_unique<FE_Q<dim>>(problem.element.degree + (dim == 1 ? 6 : 3)));
          const FreeDofs   rich_free(rich.dof_handler.n_dofs(), rich.dirichlet);
          if (rich_free.n_free > 3 * int(largest_dense_inf_sup))
            return result;
          const MatrixXd P = by_L2 ? polynomial_functionals(problem, set, zone, rich.dof_handler, rich_free)
                                   : point_functionals(make_constraint_set(problem.conditions, problem.element, *problem.mapping,
                                                                           rich.dof_handler, rich.dirichlet),
                                                       zone, rich_free);
          dual = whiten(gram_matrix(problem, rich.dof_handler, rich_free), P);
        }
        // beta^2 = min q'M'Mq / q'D'Dq. With D = Q R it is the smallest singular value of M R^-1, squared.
        Eigen::HouseholderQR<MatrixXd> qr(dual);
        const MatrixXd                 R = qr.matrixQR().topRows(dual.cols()).template triangularView<Eigen::Upper>();
        const MatrixXd                 relative = R.transpose().template triangularView<Eigen::Lower>().solve(M.transpose());
        const Eigen::VectorXd          beta = Eigen::BDCSVD<MatrixXd>(relative).singularValues();
        result.beta_h_nonzero = beta(result.rank - 1);
        result.beta_h = result.nullity > 0 ? 0. : *result.beta_h_nonzero;
      }
    return result;
  }

  std::string to_string(const Stability stability)
  {
    switch (stability)
    {
    case Stability::stable:
      return "stable";
    case Stability::weakly_unstable:
      return "weakly unstable";
    case Stability::kernel:
      return "kernel";
    }
    return "";
  }

  StabilityVerdict judge_stability(const std::vector<InfSup> &levels, const double best_rate, const std::string &stable_rule)
  {
    StabilityVerdict verdict;
    const InfSup    &fine = levels.back(), &coarse = levels[levels.size() - 2];
    verdict.rate = std::log2(coarse.C_h_nonzero / fine.C_h_nonzero);
    // A kernel that grows like the number of points is one of every cell; a few vectors, or one a row of cells, come from the boundary.
    const double growth = coarse.nullity > 0 && fine.nullity > 0
                            ? std::log(double(fine.nullity) / coarse.nullity) / std::log(double(fine.n_points) / coarse.n_points)
                            : 0.;
    if (fine.nullity > 0.02 * fine.n_points && growth > 0.75)
    {
      verdict.stability = Stability::kernel;
      verdict.advice =
        fmt::format("{} of {} pressure modes do not act on V_h: the contact force is right, the pressure is not unique; for a "
                    "smooth pressure use the rule '{}'",
                    fine.nullity, fine.n_points, stable_rule);
    }
    else if (verdict.rate > best_rate + 0.3)
    {
      verdict.stability = Stability::weakly_unstable;
      verdict.advice =
        fmt::format("C_h falls like h^{:.1f}, faster than the h^{:.1g} of a stable pair: pressures may oscillate from point to "
                    "point; use the rule '{}'",
                    verdict.rate, best_rate, stable_rule);
    }
    else
      verdict.advice = fmt::format("C_h falls like h^{:.1f}, as well as any pair can do in the L2 norm of (20): the pressure is unique and "
                                   "does not oscillate",
                                   verdict.rate);
    return verdict;
  }

  template InfSup inf_sup(const Problem<1> &, const ConstraintSet<1> &, const std::vector<bool> &, bool);
  template InfSup inf_sup(const Problem<2> &, const ConstraintSet<2> &, const std::vector<bool> &, bool);
  template InfSup inf_sup(const Problem<3> &, const ConstraintSet<3> &, const std::vector<bool> &, bool);
} // namespace unilateral
