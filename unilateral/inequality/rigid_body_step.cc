#include "unilateral/inequality/rigid_body_step.h"

#include "unilateral/algebra/dense_solvers.h"
#include "unilateral/inequality/line_search.h"
#include "unilateral/inequality/support_points.h"

#include <cmath>
#include <cstdint>
#include <utility>

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

    PointSet points_with_positive(const Vector &gap)
    {
      PointSet            active(gap.locally_owned_size());
      const double *const g = gap.begin();
      for (std::size_t i = 0; i < active.size(); ++i)
        active[i] = g[i] > 0;
      return active;
    }

    /// -H^-1 gradient, H a little stiffer where it is singular.
    VectorXd newton_direction(const MatrixXd &H, const VectorXd &gradient)
    {
      const Eigen::SelfAdjointEigenSolver<MatrixXd> tangent(H);
      return -tangent.eigenvectors() *
             (tangent.eigenvectors().transpose() * gradient).cwiseQuotient(tangent.eigenvalues().cwiseMax(least_stiffness));
    }

    /// gap += t change; returns how many of the points change sides.
    std::uint64_t move_gap(Vector &gap, const double t, const Vector &change, const PointSet &active)
    {
      double *const       g = gap.begin();
      const double *const dg = change.begin();
      std::uint64_t       n_flipped = 0;
      for (std::size_t i = 0; i < active.size(); ++i)
      {
        g[i] += t * dg[i];
        n_flipped += (g[i] > 0) != bool(active[i]);
      }
      return n_flipped;
    }
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

  VectorXd RigidBodyStep::contact_gradient(const std::vector<Vector> &columns,
                                           const Vector              &stiffness,
                                           const Vector              &gap,
                                           const PointSet            &active) const
  {
    const Eigen::Index  n = columns.size();
    const double *const g = gap.begin();
    VectorXd            sum = VectorXd::Zero(n);
    for (std::size_t i = 0; i < active.size(); ++i)
      if (active[i])
        for (Eigen::Index a = 0; a < n; ++a)
          sum(a) += stiffness.begin()[i] * g[i] * columns[a].begin()[i];
    problem.processes().sum(sum.data(), n);
    return sum;
  }

  /// E(y) = 1/2 y'Ky + b'y + 1/2 sum_i c_i ((g + C y)_i^+)^2 + const: the energy at u + sum_a y_a q_a for a few functions q_a, the
  /// columns of R Y and, last, a direction besides where there is one.
  struct RigidBodyStep::ReducedEnergy
  {
    MatrixXd            stiffness; ///< K = q'A q
    VectorXd            slope;     ///< b = q'(A u - f)
    std::vector<Vector> columns;   ///< C = B q

    /// The last of the q is (p - R Y alpha) / size, p the direction besides the modes.
    VectorXd alpha;
    double   size = 0;
  };

  RigidBodyStep::ReducedEnergy RigidBodyStep::energy_along_modes(const Vector &u) const
  {
    const auto        &modes = problem.rigid_body_modes();
    const Eigen::Index k = modes.size();
    // The derivative of 1/2 v'Av - f'v at u. Where A vanishes on a mode, A u does no work on it but that of rounding.
    VectorXd work(k);
    for (Eigen::Index a = 0; a < k; ++a)
      work(a) = (A_modes.empty() ? 0. : problem.dot(u, A_modes[a])) - problem.dot(modes[a], problem.load());
    return {springs, basis.transpose() * work, traces, VectorXd::Zero(basis.cols()), 0.};
  }

  bool RigidBodyStep::add_direction(ReducedEnergy &energy, const Direction &besides) const
  {
    const Eigen::Index k = problem.rigid_body_modes().size(), m = basis.cols();
    const PointSet     all(penalty.locally_owned_size(), 1);
    VectorXd           with_springs = VectorXd::Zero(k);
    for (Eigen::Index a = 0; a < k && !A_modes.empty(); ++a)
      with_springs(a) = problem.dot(A_modes[a], besides.p);
    const VectorXd of_springs = basis.transpose() * with_springs;

    // Made orthonormal to the modes in the stiffness with every point in contact.
    auto &[stiffness, slope, columns, alpha, size] = energy;
    columns.push_back(besides.Bp);
    const MatrixXd products = contact_stiffness(columns, all);
    alpha = products.col(m).head(m) + of_springs;
    for (Eigen::Index a = 0; a < m; ++a)
      columns[m].add(-alpha(a), traces[a]);
    const VectorXd mixed = of_springs - springs * alpha;
    const double   curvature = std::max(0., besides.curvature - 2 * alpha.dot(of_springs) + alpha.dot(springs * alpha));
    size = std::sqrt(curvature + contact_stiffness(columns, all)(m, m));
    if (!(size > 0) || !std::isfinite(size))
      return false;
    columns[m] *= 1 / size;
    stiffness.conservativeResize(m + 1, m + 1);
    stiffness.col(m).head(m) = mixed / size;
    stiffness.row(m).head(m) = mixed.transpose() / size;
    stiffness(m, m) = curvature / (size * size);
    slope.conservativeResize(m + 1);
    slope(m) = (besides.slope - alpha.dot(slope.head(m))) / size;
    return true;
  }

  VectorXd RigidBodyStep::minimum_of(const ReducedEnergy &energy, const Vector &gap) const
  {
    const MatrixXd            &stiffness = energy.stiffness;
    const std::vector<Vector> &columns = energy.columns;
    const Eigen::Index         n = energy.slope.size();
    const std::size_t          n_points = gap.locally_owned_size();
    Vector                     only_counted(penalty), change(gap), moved(gap);
    for (std::size_t i = 0; i < n_points; ++i)
      if (!problem.owns_point(i))
        only_counted(i) = 0;

    VectorXd y = VectorXd::Zero(n);
    for (unsigned step = 0; step < most_steps; ++step)
    {
      const PointSet active = points_with_positive(moved);
      const VectorXd without_contact = energy.slope + stiffness * y;
      const VectorXd gradient = contact_gradient(columns, only_counted, moved, active) + without_contact;
      const VectorXd direction = newton_direction(stiffness + contact_stiffness(columns, active), gradient);
      change = 0.;
      for (Eigen::Index a = 0; a < n; ++a)
        change.add(direction(a), columns[a]);
      const double t = exact_line_search(without_contact.dot(direction), direction.dot(stiffness * direction), only_counted, moved, change,
                                         problem.processes());
      if (!(t < 1e30) || !(gradient.dot(direction) < 0))
        break;
      y += t * direction;
      const std::uint64_t n_flipped = move_gap(moved, t, change, active);
      // The energy is quadratic there: a whole Newton step ends at the minimum.
      if (problem.processes().sum(n_flipped) == 0 && std::abs(t - 1) < 1e-6)
        break;
    }
    return y;
  }

  double RigidBodyStep::minimise(Vector &u, Vector &Au, Vector &gap, const Direction *const besides) const
  {
    if (!has_modes())
      return 0;
    ReducedEnergy energy = energy_along_modes(u);
    if (besides && !add_direction(energy, *besides))
      return minimise(u, Au, gap);
    const VectorXd y = minimum_of(energy, gap);
    if (!y.allFinite())
      return 0;

    const auto        &modes = problem.rigid_body_modes();
    const Eigen::Index m = basis.cols();
    const double       t = besides ? y(m) / energy.size : 0;
    const VectorXd     z = basis * (y.head(m) - t * energy.alpha);
    for (std::size_t a = 0; a < modes.size(); ++a)
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

  MatrixXd RigidBodyStep::modes_not_stopped_by(const PointSet &set) const
  {
    const Eigen::Index m = basis.cols();
    if (m == 0)
      return MatrixXd(0, 0);
    const Eigen::SelfAdjointEigenSolver<MatrixXd> stiffness(springs + contact_stiffness(traces, set));
    Eigen::Index                                  n = 0;
    while (n < m && stiffness.eigenvalues()(n) < not_stopped)
      ++n;
    return stiffness.eigenvectors().leftCols(n);
  }

  std::vector<std::size_t> RigidBodyStep::supports(const PointSet &set) const
  {
    std::vector<std::size_t> points;
    const MatrixXd           left = modes_not_stopped_by(set);
    const Eigen::Index       m = left.rows(), n = left.cols();
    if (n == 0)
      return points;
    MatrixXd effects(n, set.size());
    VectorXd trace(m);
    for (std::size_t i = 0; i < set.size(); ++i)
    {
      for (Eigen::Index a = 0; a < m; ++a)
        trace(a) = traces[a].begin()[i];
      effects.col(i) = std::sqrt(penalty.begin()[i]) * (left.transpose() * trace);
    }
    for (const SupportPoint &support : choose_support_points(problem, std::move(effects), n, 0))
      points.insert(points.end(), support.places.begin(), support.places.end());
    return points;
  }
} // namespace unilateral
