#include "unilateral/inequality/rigid_body_step.h"

#include "unilateral/algebra/dense_solvers.h"
#include "unilateral/inequality/line_search.h"

#include <cmath>
#include <cstdint>

namespace unilateral
{
  using Eigen::MatrixXd;
  using Eigen::VectorXd;

  namespace
  {
    /// A mode whose stiffness is less than this fraction of what it is with every point in contact is not stopped.
    constexpr double not_stopped = 1e-10;

    /// Newton's step along modes that the points in contact do not feel: long enough to reach others, whatever the line search makes of it.
    constexpr double least_stiffness = 1e-6;

    constexpr unsigned most_steps = 200;
  } // namespace

  RigidBodyStep::RigidBodyStep(const AugmentedProblem &augmented, const Vector &penalty)
    : augmented(augmented), problem(augmented.problem), penalty(penalty)
  {
    const auto        &modes = problem.rigid_body_modes();
    const Eigen::Index k = modes.size();
    if (k == 0 || !problem.symmetric())
      return;
    // A mode of the null space has no stiffness, not even that of rounding.
    const bool have_stiffness = modes.size() > problem.null_space().size();
    MatrixXd   stiffness = MatrixXd::Zero(k, k);
    for (const Vector &mode : modes)
    {
      problem.initialize_point_vector(traces.emplace_back());
      problem.apply_trace(traces.back(), mode);
      if (have_stiffness)
      {
        problem.initialize_dof_vector(A_modes.emplace_back());
        problem.apply_stiffness(A_modes.back(), mode);
      }
    }
    for (Eigen::Index a = 0; a < k && have_stiffness; ++a)
      for (Eigen::Index b = 0; b <= a; ++b)
        stiffness(a, b) = stiffness(b, a) = problem.dot(modes[a], A_modes[b]);
    const MatrixXd all = stiffness + contact_stiffness(traces, PointSet(penalty.locally_owned_size(), 1));

    // Translations and rotations have different units: scaled to a unit diagonal first.
    VectorXd scale(k);
    for (Eigen::Index a = 0; a < k; ++a)
      scale(a) = all(a, a) > 0 ? 1 / std::sqrt(all(a, a)) : 0;
    const Eigen::SelfAdjointEigenSolver<MatrixXd> eigen(scale.asDiagonal() * all * scale.asDiagonal());
    Eigen::Index                                  unfelt = 0;
    while (unfelt < k && eigen.eigenvalues()(unfelt) <= 1e-13)
      ++unfelt;
    const Eigen::Index m = k - unfelt;
    basis = scale.asDiagonal() * eigen.eigenvectors().rightCols(m) *
            eigen.eigenvalues().tail(m).cwiseSqrt().cwiseInverse().asDiagonal().toDenseMatrix();
    springs = basis.transpose() * stiffness * basis;

    std::vector<Vector> of_basis(m, penalty);
    for (Eigen::Index b = 0; b < m; ++b)
    {
      of_basis[b] = 0.;
      for (Eigen::Index a = 0; a < k; ++a)
        of_basis[b].add(basis(a, b), traces[a]);
    }
    traces = std::move(of_basis);
  }

  MatrixXd RigidBodyStep::contact_stiffness(const std::vector<Vector> &columns, const PointSet &set) const
  {
    const Eigen::Index m = columns.size();
    MatrixXd           sum = MatrixXd::Zero(m, m);
    VectorXd           row(m);
    for (std::size_t i = 0; i < set.size(); ++i)
    {
      if (!set[i] || !problem.owns_point(i))
        continue;
      for (Eigen::Index a = 0; a < m; ++a)
        row(a) = columns[a].begin()[i];
      sum.noalias() += penalty.begin()[i] * row * row.transpose();
    }
    problem.processes().sum(sum.data(), sum.size());
    return sum;
  }

  double RigidBodyStep::minimise(Vector &u, Vector &Au, Vector &gap, const Direction *const besides) const
  {
    if (!has_modes())
      return 0;
    const auto        &modes = problem.rigid_body_modes();
    const Eigen::Index k = modes.size(), m = basis.cols();
    const std::size_t  n_points = gap.locally_owned_size();
    const PointSet     all(n_points, 1);

    // The derivative of 1/2 v'Av - f'v at u. Where A vanishes on a mode, A u does no work on it but that of rounding.
    VectorXd work(k);
    for (Eigen::Index a = 0; a < k; ++a)
      work(a) = (A_modes.empty() ? 0. : problem.dot(u, A_modes[a])) - problem.dot(modes[a], problem.load());

    // Coordinates y along R Y and, last, along p - R Y alpha: orthonormal in the stiffness with every point in contact.
    std::vector<Vector> columns = traces;
    MatrixXd            stiffness = springs;
    VectorXd            at_u = basis.transpose() * work, alpha = VectorXd::Zero(m);
    double              size = 0;
    if (besides)
    {
      VectorXd with_springs = VectorXd::Zero(k);
      for (Eigen::Index a = 0; a < k && !A_modes.empty(); ++a)
        with_springs(a) = problem.dot(A_modes[a], besides->p);
      const VectorXd of_springs = basis.transpose() * with_springs;
      columns.push_back(besides->Bp);
      const MatrixXd products = contact_stiffness(columns, all);
      alpha = products.col(m).head(m) + of_springs;
      for (Eigen::Index a = 0; a < m; ++a)
        columns[m].add(-alpha(a), traces[a]);
      const VectorXd mixed = of_springs - springs * alpha;
      const double   curvature = std::max(0., besides->curvature - 2 * alpha.dot(of_springs) + alpha.dot(springs * alpha));
      size = std::sqrt(curvature + contact_stiffness(columns, all)(m, m));
      if (!(size > 0) || !std::isfinite(size))
        return minimise(u, Au, gap);
      columns[m] *= 1 / size;
      stiffness.conservativeResize(m + 1, m + 1);
      stiffness.col(m).head(m) = mixed / size;
      stiffness.row(m).head(m) = mixed.transpose() / size;
      stiffness(m, m) = curvature / (size * size);
      at_u.conservativeResize(m + 1);
      at_u(m) = (besides->slope - alpha.dot(at_u.head(m))) / size;
    }
    const Eigen::Index n = at_u.size();

    Vector only_counted(penalty), change(gap), moved(gap);
    for (std::size_t i = 0; i < n_points; ++i)
      if (!problem.owns_point(i))
        only_counted(i) = 0;
    double *const g = moved.begin(), *const dg = change.begin();
    VectorXd y = VectorXd::Zero(n);
    PointSet active(n_points);
    for (unsigned step = 0; step < most_steps; ++step)
    {
      VectorXd gradient = VectorXd::Zero(n);
      for (std::size_t i = 0; i < n_points; ++i)
      {
        active[i] = g[i] > 0;
        if (active[i])
          for (Eigen::Index a = 0; a < n; ++a)
            gradient(a) += only_counted.begin()[i] * g[i] * columns[a].begin()[i];
      }
      problem.processes().sum(gradient.data(), n);
      const VectorXd without_contact = at_u + stiffness * y;
      gradient += without_contact;

      const Eigen::SelfAdjointEigenSolver<MatrixXd> tangent(stiffness + contact_stiffness(columns, active));
      const VectorXd                                direction =
        -tangent.eigenvectors() *
        (tangent.eigenvectors().transpose() * gradient).cwiseQuotient(tangent.eigenvalues().cwiseMax(least_stiffness));
      change = 0.;
      for (Eigen::Index a = 0; a < n; ++a)
        change.add(direction(a), columns[a]);
      const double t = exact_line_search(without_contact.dot(direction), direction.dot(stiffness * direction), only_counted, moved, change,
                                         problem.processes());
      if (!(t < 1e30) || !(gradient.dot(direction) < 0))
        break;
      y += t * direction;
      std::uint64_t n_flipped = 0;
      for (std::size_t i = 0; i < n_points; ++i)
      {
        g[i] += t * dg[i];
        n_flipped += (g[i] > 0) != bool(active[i]);
      }
      // The energy is quadratic there: a whole Newton step ends at the minimum.
      if (problem.processes().sum(n_flipped) == 0 && std::abs(t - 1) < 1e-6)
        break;
    }
    if (!y.allFinite())
      return 0;
    const double   t = besides ? y(m) / size : 0;
    const VectorXd z = basis * (y.head(m) - t * alpha);
    for (Eigen::Index a = 0; a < k; ++a)
    {
      u.add(z(a), modes[a]);
      if (!A_modes.empty())
        Au.add(z(a), A_modes[a]);
    }
    if (besides)
    {
      u.add(t, besides->p);
      Au.add(t, besides->Ap);
    }
    augmented.shifted_gap(gap, u);
    return t;
  }

  std::vector<std::size_t> RigidBodyStep::supports(const PointSet &set) const
  {
    std::vector<std::size_t> points;
    if (!has_modes() || !problem.processes().alone())
      return points;
    const Eigen::Index                            m = basis.cols();
    const Eigen::SelfAdjointEigenSolver<MatrixXd> stiffness(springs + contact_stiffness(traces, set));
    Eigen::Index                                  n = 0;
    while (n < m && stiffness.eigenvalues()(n) < not_stopped)
      ++n;
    if (n == 0)
      return points;
    // Greedy: the point that stops most of what those before it leave.
    const MatrixXd left = stiffness.eigenvectors().leftCols(n);
    MatrixXd       rest(n, set.size());
    VectorXd       trace(m);
    for (std::size_t i = 0; i < set.size(); ++i)
    {
      for (Eigen::Index a = 0; a < m; ++a)
        trace(a) = traces[a].begin()[i];
      rest.col(i) = std::sqrt(penalty.begin()[i]) * (left.transpose() * trace);
    }
    for (Eigen::Index j = 0; j < n && rest.cols() > 0; ++j)
    {
      Eigen::Index i = 0;
      if (!(rest.colwise().squaredNorm().maxCoeff(&i) > 0))
        break;
      const VectorXd direction = rest.col(i).normalized();
      rest -= direction * (direction.transpose() * rest).eval();
      points.push_back(i);
    }
    return points;
  }
} // namespace unilateral
