#include "unilateral/evaluation/contact_components.h"

#include "unilateral/evaluation/contact_pieces.h"

#include <Eigen/Dense>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <set>

namespace unilateral
{
  using namespace dealii;

  namespace
  {
    /// Finds points by their place.
    template <int dim>
    class Grid
    {
    public:
      explicit Grid(const ContactPieces<dim> &points)
        : points(points), spacing(*std::max_element(points.cell_size.begin(), points.cell_size.end()))
      {
        for (std::size_t i = 0; i < points.n_points(); ++i)
          boxes[box_of(points.x[i])].push_back(i);
      }

      /// Calls visit(j) for the points within @p radius of point i, itself included.
      template <typename Visit>
      void for_each_near(const std::size_t i, const double radius, const Visit &visit) const
      {
        const long reach = std::lround(std::ceil(radius / spacing)), width = 2 * reach + 1;
        const auto home = box_of(points.x[i]);
        for (long k = 0; k < Utilities::pow(width, int(dim)); ++k)
        {
          auto box = home;
          long rest = k;
          for (unsigned d = 0; d < dim; ++d, rest /= width)
            box[d] += rest % width - reach;
          if (const auto found = boxes.find(box); found != boxes.end())
            for (const std::size_t j : found->second)
              if (points.x[i].distance_square(points.x[j]) < radius * radius)
                visit(j);
        }
      }

    private:
      using Box = std::array<long, dim>;

      Box box_of(const Point<dim> &x) const
      {
        Box box;
        for (unsigned d = 0; d < dim; ++d)
          box[d] = std::lround(x[d] / spacing);
        return box;
      }

      const ContactPieces<dim>               &points;
      const double                            spacing;
      std::map<Box, std::vector<std::size_t>> boxes;
    };

    /// The polynomial that is closest to the pressure of the members of a piece in the mean with the given weights.
    template <int dim>
    class PressureInside
    {
    public:
      PressureInside(const ContactPieces<dim> &points, const std::vector<std::size_t> &members, const std::vector<double> &weights)
      {
        std::size_t n_inside = 0;
        double      sum = 0;
        for (std::size_t k = 0; k < members.size(); ++k)
        {
          n_inside += weights[k] > 0;
          sum += weights[k];
          centre += weights[k] * points.x[members[k]];
        }
        centre /= sum;
        for (std::size_t k = 0; k < members.size(); ++k)
          if (weights[k] > 0)
            radius = std::max(radius, centre.distance(points.x[members[k]]));
        // Five points a direction tell a slope, twelve a curvature, from what is left of the waves.
        const double across = std::pow(n_inside, 1. / points.dimension);
        degree = across < 5 ? 0 : across < 12 ? 1 : 2;

        Eigen::MatrixXd matrix = Eigen::MatrixXd::Zero(monomials(centre).size(), monomials(centre).size());
        Eigen::VectorXd right = Eigen::VectorXd::Zero(matrix.rows());
        for (std::size_t k = 0; k < members.size(); ++k)
        {
          const Eigen::VectorXd m = monomials(points.x[members[k]]);
          matrix += weights[k] * m * m.transpose();
          right += weights[k] * points.pressure[members[k]] * m;
        }
        Eigen::CompleteOrthogonalDecomposition<Eigen::MatrixXd> decomposition(matrix.rows(), matrix.cols());
        decomposition.setThreshold(1e-10); // points on a line
        coefficients = decomposition.compute(matrix).solve(right);
      }

      double operator()(const Point<dim> &x) const { return std::max(coefficients.dot(monomials(x)), 0.); }

    private:
      Eigen::VectorXd monomials(const Point<dim> &x) const
      {
        const Tensor<1, dim> z = (x - centre) / (radius > 0 ? radius : 1.);
        std::vector<double>  values = {1};
        for (unsigned i = 0; i < dim && degree > 0; ++i)
          values.push_back(z[i]);
        for (unsigned i = 0; i < dim && degree > 1; ++i)
          for (unsigned j = i; j < dim; ++j)
            values.push_back(z[i] * z[j]);
        return Eigen::Map<Eigen::VectorXd>(values.data(), values.size());
      }

      Point<dim>      centre;
      double          radius = 0;
      unsigned        degree = 0;
      Eigen::VectorXd coefficients;
    };

    /// The force of the pressure that is spread out over a piece that has points inside. The letters are those of the header.
    template <int dim>
    double distributed_force(const ContactPieces<dim> &points, const Grid<dim> &grid, const std::size_t piece)
    {
      const auto &members = points.members[piece];
      const auto &w = points.weight;
      unsigned    deepest = 0;
      double      h = 0, force = 0;
      for (const std::size_t i : members)
      {
        deepest = std::max(deepest, points.depth[i]);
        h += points.cell_size[i] / members.size();
        force += w[i] * points.pressure[i];
      }
      if (deepest == points.no_edge)
        return force;
      const double delta = h * std::sqrt(2. * (deepest + 1));

      // How far beyond delta, in layers of cells.
      const double waves = std::min(delta / h - 1, deepest - 1.);
      const auto   beyond = [&](const std::size_t i) { return std::max(points.depth[i] - waves, 0.); };

      std::vector<double> inside(members.size());
      for (std::size_t k = 0; k < members.size(); ++k)
        inside[k] = w[members[k]] * std::pow(beyond(members[k]), 2);
      const PressureInside<dim> pressure_inside(points, members, inside);
      const auto                p = [&](const std::size_t i)
      {
        const double s = std::min(beyond(i) / 3, 1.), settled = s * s * (3 - 2 * s);
        return settled * points.pressure[i] + (1 - settled) * pressure_inside(points.x[i]);
      };

      // The points about the edge; farther inside d = delta.
      std::set<std::size_t> about_edge;
      for (const std::size_t i : members)
      {
        if (points.depth[i] == 0)
          grid.for_each_near(i, delta, [&](const std::size_t j) { about_edge.insert(j); });
        if (points.depth[i] < 2 * delta / h)
          about_edge.insert(i);
      }
      std::map<std::size_t, double> d;
      double                        length = 0, excess = 0, p_edge = 0;
      for (const std::size_t i : about_edge)
      {
        double in = 0, all = 0;
        grid.for_each_near(i, delta,
                           [&](const std::size_t j)
                           {
                             const double distance = points.x[i].distance_square(points.x[j]) / (delta * delta);
                             const double weight = w[j] * std::pow(1 - distance, (3. - points.dimension) / 2);
                             all += weight;
                             in += points.piece[j] == piece ? weight : 0;
                           });
        const double chi = in / all;
        d[i] = 2 * delta * std::sin(std::asin(std::clamp(2 * chi - 1, -1., 1.)) / 3);
        length += w[i] * chi * (1 - chi);
        p_edge += w[i] * chi * (1 - chi) * pressure_inside(points.x[i]);
        excess += w[i] * ((1 + d[i] / delta) / 2 - (points.piece[i] == piece));
      }
      p_edge /= length;
      length *= 35 / (9 * delta);

      double spread = 0, R = 0, T = 0;
      for (const std::size_t i : members)
      {
        const double rest = w[i] * (points.pressure[i] - p(i));
        const auto   place = d.find(i);
        spread += w[i] * p(i);
        R += rest;
        T += rest * (place == d.end() ? delta : place->second + 1.5 * excess / length * (1 - std::pow(place->second / delta, 2)));
      }
      const double pL = p_edge * length;
      const double t = R > 0 ? 2 * T / (R + std::sqrt(std::max(R * R + 2 * pL * T, 0.))) : 0.;
      return spread - pL * std::clamp(t, -delta, delta);
    }
  } // namespace

  template <int dim>
  std::vector<ContactComponent>
  contact_components(const Problem<dim> &problem, const ConstraintSet<dim> &set, const std::size_t block, const Vector &lambda)
  {
    const ContactPieces<dim> points(problem, set, block, lambda);
    if (points.n_points() == 0)
      return {};
    const Grid<dim> grid(points);

    std::vector<ContactComponent> result;
    for (std::size_t p = 0; p < points.members.size(); ++p)
    {
      ContactComponent piece;
      unsigned         deepest = 0;
      const auto      &x = points.x[points.members[p][0]];
      piece.lower.assign(x.begin_raw(), x.end_raw());
      piece.upper = piece.lower;
      for (const std::size_t i : points.members[p])
      {
        for (unsigned d = 0; d < dim; ++d)
        {
          piece.lower[d] = std::min(piece.lower[d], points.x[i][d]);
          piece.upper[d] = std::max(piece.upper[d], points.x[i][d]);
        }
        piece.n_points += points.pressure[i] > 0;
        piece.measure += points.pressure[i] > 0 ? points.weight[i] : 0.;
        piece.force += points.weight[i] * points.pressure[i];
        deepest = std::max(deepest, points.depth[i]);
      }
      piece.resolved = deepest > 2;
      piece.distributed = deepest > 0 ? std::clamp(distributed_force(points, grid, p), 0., piece.force) : 0.;
      piece.concentrated = piece.force - piece.distributed;
      result.push_back(std::move(piece));
    }
    std::sort(result.begin(), result.end(), [](const auto &a, const auto &b) { return a.lower < b.lower; });
    return result;
  }

  template std::vector<ContactComponent> contact_components(const Problem<1> &, const ConstraintSet<1> &, std::size_t, const Vector &);
  template std::vector<ContactComponent> contact_components(const Problem<2> &, const ConstraintSet<2> &, std::size_t, const Vector &);
  template std::vector<ContactComponent> contact_components(const Problem<3> &, const ConstraintSet<3> &, std::size_t, const Vector &);
} // namespace unilateral
