#include "unilateral/inequality/support_points.h"

#include <cmath>
#include <utility>

namespace unilateral
{
  namespace
  {
    /// Relative to w |b|^2, b the row of B at a point: the same row of another process differs by rounding.
    constexpr double same_row = 1e-8;

    /// Where this process has point @p i of process @p owner. The rows of other points have another product with the row of that point.
    std::vector<std::size_t> places_of(const DiscreteProblem &problem, const std::size_t i, const unsigned owner)
    {
      const Processes         &processes = problem.processes();
      std::vector<std::size_t> places;
      if (processes.rank() == owner)
        places.push_back(i);
      if (processes.alone())
        return places;
      Vector at_points, force, trace;
      problem.initialize_point_vector(at_points);
      problem.initialize_point_vector(trace);
      problem.initialize_dof_vector(force);
      if (processes.rank() == owner)
        at_points(i) = 1;
      problem.apply_trace_transpose(force, at_points);
      problem.apply_trace(trace, force);
      double of_owner = processes.rank() == owner ? trace(i) : 0.;
      processes.broadcast(&of_owner, 1, owner);
      for (std::size_t j = 0; j < trace.locally_owned_size(); ++j)
        if (!problem.owns_point(j) && std::abs(trace(j) - of_owner) <= same_row * of_owner)
          places.push_back(j);
      return places;
    }
  } // namespace

  std::vector<SupportPoint>
  choose_support_points(const DiscreteProblem &problem, Eigen::MatrixXd effects, const std::size_t n, const double negligible)
  {
    const Processes &processes = problem.processes();
    for (Eigen::Index i = 0; i < effects.cols(); ++i)
      if (!problem.owns_point(i))
        effects.col(i).setZero();
    std::vector<SupportPoint> points;
    double                    threshold = 0;
    while (points.size() < n)
    {
      Eigen::Index i = 0;
      const double largest_here = effects.cols() > 0 ? effects.colwise().norm().maxCoeff(&i) : -1.;
      const double largest = processes.max(largest_here);
      if (points.empty())
        threshold = negligible * largest;
      if (!(largest > 0) || !(largest > threshold))
        break;
      const unsigned  owner = unsigned(processes.min(double(largest_here == largest ? processes.rank() : processes.size())));
      Eigen::VectorXd direction = Eigen::VectorXd::Zero(effects.rows());
      if (processes.rank() == owner)
        direction = effects.col(i).normalized();
      processes.broadcast(direction.data(), direction.size(), owner);
      effects -= direction * (direction.transpose() * effects).eval();
      points.push_back({places_of(problem, i, owner)});
    }
    return points;
  }
} // namespace unilateral
