#include "unilateral/discretisation/motion_names.h"

#include "unilateral/algebra/dense_solvers.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <utility>

namespace unilateral
{
  using namespace dealii;
  using Eigen::Matrix3d;
  using Eigen::MatrixXd;
  using Eigen::Vector3d;
  using Eigen::VectorXd;

  namespace
  {
    /// Smaller parts are rounding, or not worth a word.
    constexpr double negligible = 1e-4;
    /// A rotation about an axis that is a thousand times the body's size away is a translation.
    constexpr double slow = 1e-3;
    /// Fifty times the body's size away it is named as the translation that it nearly is: who is to hold it has to know the direction.
    constexpr double nearly_a_translation = 0.02;

    /// v(x) = t + w x (X - c) in space, c the centre of the body, and of the modes the origin; a plane lies at z = 0.
    struct Motion
    {
      Vector3d t, w;
    };

    /// Of a mode; nothing where it is no rigid motion of a body: of plates and membranes.
    template <int dim>
    std::optional<Motion> motion_of(const RigidBodyMode<dim> &mode)
    {
      const Tensor<1, dim> at_origin = mode.value(Point<dim>());
      Matrix3d             gradient = Matrix3d::Zero();
      Motion               motion{Vector3d::Zero(), Vector3d::Zero()};
      for (unsigned b = 0; b < dim; ++b)
      {
        const Tensor<1, dim> ahead = mode.value(Point<dim>::unit_vector(b));
        motion.t(b) = at_origin[b];
        for (unsigned a = 0; a < dim; ++a)
          gradient(a, b) = ahead[a] - at_origin[a];
      }
      if ((gradient + gradient.transpose()).cwiseAbs().maxCoeff() > 1e-6 * gradient.cwiseAbs().maxCoeff())
        return {};
      motion.w = {gradient(2, 1), gradient(0, 2), gradient(1, 0)};
      return motion;
    }

    /// The point about which all of the motions turn, if there is one: t = -w x p, to a thousandth of the body's motion.
    std::optional<Vector3d> common_centre(const std::vector<Motion> &turns, const double size)
    {
      MatrixXd matrix(3 * turns.size(), 3);
      VectorXd right(3 * turns.size());
      double   fastest = 0;
      for (std::size_t k = 0; k < turns.size(); ++k)
      {
        const Vector3d &w = turns[k].w;
        matrix.middleRows<3>(3 * k) << 0, w(2), -w(1), -w(2), 0, w(0), w(1), -w(0), 0; // p -> -w x p
        right.segment<3>(3 * k) = turns[k].t;
        fastest = std::max(fastest, w.norm());
      }
      const Vector3d p = matrix.completeOrthogonalDecomposition().solve(right);
      if ((matrix * p - right).norm() > slow * fastest * size)
        return {};
      return p;
    }

    /// A body as its modes show it: rotations are about its centre, scaled to a largest displacement of 1.
    struct Body
    {
      std::vector<Motion> modes; ///< about the centre
      Vector3d            centre = Vector3d::Zero();
      double              size = 0; ///< half of its largest extent
      unsigned            dim = 3;
    };

    /// Nothing where the modes are not those of a body.
    template <int dim>
    std::optional<Body> body_of(const std::vector<RigidBodyMode<dim>> &modes)
    {
      if (dim == 1 || modes.size() != dim * (dim + 1) / 2)
        return {};
      Body                body;
      std::vector<Motion> turns;
      body.dim = dim;
      for (const auto &mode : modes)
      {
        const auto motion = motion_of(mode);
        if (!motion)
          return {};
        body.modes.push_back(*motion);
        if (motion->w.norm() > 0)
        {
          turns.push_back(*motion);
          body.size = std::max(body.size, 1 / motion->w.norm());
        }
      }
      if (turns.empty())
        return {};
      body.centre = common_centre(turns, std::numeric_limits<double>::infinity()).value();
      for (Motion &motion : body.modes)
        motion.t += motion.w.cross(body.centre);
      return body;
    }

    /// "(1, 0.5, 0)", with so many coordinates, to a ten-thousandth of @p size.
    std::string in_brackets(const Vector3d &x, const unsigned dim, const double size)
    {
      std::vector<std::string> numbers;
      for (unsigned d = 0; d < dim; ++d)
      {
        const double ratio = std::abs(x(d)) / size;
        const int    digits = 4 + int(std::clamp(std::floor(std::log10(std::max(ratio, 1.))), 0., 8.));
        numbers.push_back(ratio > negligible ? fmt::format("{:.{}g}", x(d), digits) : "0");
      }
      return fmt::format("({})", fmt::join(numbers, ", "));
    }

    /// "-y", or "(0.6, 0.8, 0)".
    std::string along(const Vector3d &direction, const unsigned dim, const bool with_sign)
    {
      for (unsigned d = 0; d < dim; ++d)
        if (direction.norm() - std::abs(direction(d)) < negligible * negligible * direction.norm())
          return (with_sign && direction(d) < 0 ? "-" : "") + std::string(1, "xyz"[d]);
      return in_brackets(direction.normalized(), dim, 1);
    }

    /// @p placed: it matters where the axis of a rotation is. Of an axis the point nearest to the origin is named.
    std::string name_of(const Motion &motion, const Body &body, const bool placed = true)
    {
      if (motion.w.norm() * body.size <= nearly_a_translation * motion.t.norm())
      {
        Vector3d direction = motion.t;
        if (motion.w.norm() * body.size > slow * motion.t.norm())
          direction = (direction.array().abs() > nearly_a_translation * direction.norm()).select(direction, 0);
        return "translation along " + along(direction, body.dim, true);
      }
      const Vector3d axis = motion.w.normalized(), point = body.centre + motion.w.cross(motion.t) / motion.w.squaredNorm();
      const double   pitch = axis.dot(motion.t) / motion.w.norm();
      const auto     where = in_brackets(point - axis * axis.dot(point), body.dim, body.size);
      if (body.dim == 2)
        return placed ? "rotation in the plane about " + where : "rotation in the plane";
      std::string name = "rotation about " + along(axis, body.dim, false) + (placed ? " through " + where : "");
      if (std::abs(pitch) > slow * body.size)
        name += " with a translation along it";
      return name;
    }

    /// The names of its modes, of those with the largest part first: where they are not those of a body.
    template <int dim>
    std::string names_of_parts(const VectorXd &coefficients, const std::vector<RigidBodyMode<dim>> &modes)
    {
      std::vector<std::pair<double, std::string>> parts;
      for (Eigen::Index k = 0; k < coefficients.size(); ++k)
        if (std::abs(coefficients(k)) > 0.05 * coefficients.cwiseAbs().maxCoeff())
        {
          std::string name = modes[k].name;
          if (coefficients(k) < 0 && name.rfind("translation along", 0) == 0)
            name.insert(name.size() - 1, "-");
          parts.emplace_back(-std::abs(coefficients(k)), name);
        }
      std::sort(parts.begin(), parts.end());
      std::vector<std::string> names;
      for (const auto &part : parts)
        names.push_back(part.second);
      return fmt::format("{}", fmt::join(names, " with "));
    }

    Motion combination(const VectorXd &coefficients, const std::vector<Motion> &motions)
    {
      Motion sum{Vector3d::Zero(), Vector3d::Zero()};
      for (std::size_t k = 0; k < motions.size(); ++k)
      {
        sum.t += coefficients(k) * motions[k].t;
        sum.w += coefficients(k) * motions[k].w;
      }
      return sum;
    }

    /// Reduced echelon form of the first three columns: as many zeros as there can be, so that directions along axes are seen as such.
    void eliminate(MatrixXd &rows)
    {
      Eigen::Index done = 0;
      for (Eigen::Index column = 0; column < 3 && done < rows.rows(); ++column)
      {
        Eigen::Index pivot = 0;
        const double largest = rows.col(column).tail(rows.rows() - done).cwiseAbs().maxCoeff(&pivot);
        if (largest <= negligible)
          continue;
        rows.row(done).swap(rows.row(done + pivot));
        rows.row(done) /= rows(done, column);
        for (Eigen::Index other = 0; other < rows.rows(); ++other)
          if (other != done)
            rows.row(other) -= rows(other, column) * rows.row(done);
        ++done;
      }
    }
  } // namespace

  template <int dim>
  std::string motion_name(const VectorXd &coefficients, const std::vector<RigidBodyMode<dim>> &modes)
  {
    const std::optional<Body> body = body_of(modes);
    return body ? name_of(combination(coefficients, body->modes), *body) : names_of_parts(coefficients, modes);
  }

  template <int dim>
  std::vector<std::string> motion_names(const MatrixXd &coefficients, const std::vector<RigidBodyMode<dim>> &modes)
  {
    std::vector<std::string>  names;
    const std::optional<Body> body = body_of(modes);
    if (!body)
    {
      for (Eigen::Index j = 0; j < coefficients.cols(); ++j)
        names.push_back(names_of_parts<dim>(coefficients.col(j), modes));
      return names;
    }
    // The motions as rows (w size, t): after elimination those without rotation come last.
    const double size = body->size;
    MatrixXd     rows(coefficients.cols(), 6);
    for (Eigen::Index j = 0; j < coefficients.cols(); ++j)
    {
      const Motion motion = combination(coefficients.col(j), body->modes);
      rows.row(j) << size * motion.w.transpose(), motion.t.transpose();
    }
    eliminate(rows);
    Eigen::Index n_turns = 0;
    while (n_turns < rows.rows() && rows.row(n_turns).head<3>().norm() > negligible)
      ++n_turns;
    MatrixXd translations = rows.bottomRightCorner(rows.rows() - n_turns, 3);
    eliminate(translations);
    for (Eigen::Index j = 0; j < translations.rows(); ++j)
      names.push_back(name_of({translations.row(j), Vector3d::Zero()}, *body));
    std::vector<Motion> turns;
    for (Eigen::Index j = 0; j < n_turns; ++j)
      turns.push_back({rows.row(j).tail<3>(), rows.row(j).head<3>() / size});
    if (n_turns == 3 && translations.rows() == 0)
      if (const auto centre = common_centre(turns, size))
      {
        names.push_back("rotation about any axis through " + in_brackets(body->centre + *centre, 3, size));
        return names;
      }
    // With the translations that are free as well its axis may be moved: of those the one nearest to the centre is named.
    MatrixXd free(3, 0);
    if (translations.rows() > 0)
      free = Eigen::HouseholderQR<MatrixXd>(translations.transpose()).householderQ() * MatrixXd::Identity(3, translations.rows());
    for (Motion &turn : turns)
    {
      turn.t -= free * (free.transpose() * turn.t);
      const MatrixXd across = free - turn.w * (turn.w.transpose() * free) / turn.w.squaredNorm();
      const bool     anywhere = across.cols() > 0 && Eigen::ColPivHouseholderQR<MatrixXd>(across).setThreshold(1e-3).rank() == 2;
      names.push_back(name_of(turn, *body, !anywhere));
    }
    return names;
  }

#define INSTANTIATE(dim)                                                                                                                   \
  template std::string              motion_name(const VectorXd &, const std::vector<RigidBodyMode<dim>> &);                                \
  template std::vector<std::string> motion_names(const MatrixXd &, const std::vector<RigidBodyMode<dim>> &);
  INSTANTIATE(1)
  INSTANTIATE(2)
  INSTANTIATE(3)
#undef INSTANTIATE
} // namespace unilateral
