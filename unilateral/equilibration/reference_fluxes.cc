#include "unilateral/equilibration/reference_fluxes.h"

#include "unilateral/algebra/dense_solvers.h"
#include "unilateral/mesh/gauss_rule.h"

#include <deal.II/base/geometry_info.h>
#include <deal.II/base/quadrature_lib.h>
#include <deal.II/grid/reference_cell.h>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <utility>

namespace unilateral
{
  using namespace dealii;

  namespace
  {
    /// The Legendre polynomial of degree @p n on [0, 1] and its derivative.
    std::pair<double, double> legendre(const unsigned n, const double x)
    {
      const double t = 2 * x - 1;
      double       previous = 0, value = 1, previous_slope = 0, slope = 0;
      for (unsigned k = 0; k < n; ++k)
      {
        const double next = ((2 * k + 1) * t * value - k * previous) / (k + 1);
        const double next_slope = ((2 * k + 1) * (2 * value + t * slope) - k * previous_slope) / (k + 1);
        previous = std::exchange(value, next);
        previous_slope = std::exchange(slope, next_slope);
      }
      return {value, slope};
    }

    /// Products of Legendre polynomials, one in each coordinate.
    template <int n>
    double legendre_product(const std::array<unsigned, n> &degrees, const std::array<double, n> &x)
    {
      double product = 1;
      for (unsigned d = 0; d < n; ++d)
        product *= legendre(degrees[d], x[d]).first;
      return product;
    }

    /// All degrees up to @p largest in each coordinate; together at most @p total.
    template <int n>
    std::vector<std::array<unsigned, n>> all_degrees(const std::array<unsigned, n> &largest, const unsigned total)
    {
      std::vector<std::array<unsigned, n>> result;
      std::array<unsigned, n>              degrees{};
      while (true)
      {
        if (std::accumulate(degrees.begin(), degrees.end(), 0u) <= total)
          result.push_back(degrees);
        unsigned d = 0;
        while (d < n && degrees[d] == largest[d])
          degrees[d++] = 0;
        if (d == n)
          return result;
        ++degrees[d];
      }
    }

    template <int dim>
    std::array<unsigned, dim> in_all(const unsigned degree)
    {
      std::array<unsigned, dim> degrees;
      degrees.fill(degree);
      return degrees;
    }

    template <int dim>
    std::array<double, dim> coordinates(const Point<dim> &p)
    {
      std::array<double, dim> x;
      for (unsigned d = 0; d < dim; ++d)
        x[d] = p[d];
      return x;
    }

    template <int dim>
    Point<dim> reference_vertex(const bool simplex, const unsigned v)
    {
      if (!simplex)
        return GeometryInfo<dim>::unit_cell_vertex(v);
      return v == 0 ? Point<dim>() : Point<dim>(Point<dim>::unit_vector(v - 1));
    }
  } // namespace

  template <int dim>
  ReferenceFluxes<dim>::ReferenceFluxes(const bool simplex, const unsigned degree) : degree(degree)
  {
    constexpr unsigned any = dim * 100;
    for (unsigned component = 0; component < dim; ++component)
    {
      auto largest = in_all<dim>(simplex ? degree + 1 : degree);
      largest[component] = degree + 1;
      for (const auto &degrees : all_degrees<dim>(largest, simplex ? degree + 1 : any))
        functions.push_back({component, degrees});
    }
    cell_degrees = all_degrees<dim>(in_all<dim>(degree), simplex ? degree : any);
    n_cell_tests = cell_degrees.size();
    add_faces(simplex);

    const Quadrature<dim>                   rule = gauss_rule<dim>(simplex, simplex ? 4 : degree + 2);
    const Eigen::MatrixXd                   divergences = divergences_at(rule.get_points()), tests = cell_tests_at(rule.get_points());
    const Eigen::Map<const Eigen::VectorXd> weights(rule.get_weights().data(), rule.size());
    Eigen::MatrixXd                         moments(n_moments(), size());
    moments.bottomRows(n_cell_tests).noalias() = tests.transpose() * weights.asDiagonal() * divergences;
    for (unsigned f = 0; f < faces.size(); ++f)
    {
      const Face           &face = faces[f];
      const Eigen::MatrixXd values = values_at(face.rule.get_points());
      Eigen::MatrixXd       normal_parts = Eigen::MatrixXd::Zero(face.rule.size(), size());
      for (unsigned q = 0; q < face.rule.size(); ++q)
        for (unsigned d = 0; d < dim; ++d)
          normal_parts.row(q) += face.rule.weight(q) * face.normal[d] * values.row(q * dim + d);
      moments.middleRows(f * n_face_tests, n_face_tests).noalias() = face.tests.transpose() * normal_parts;
    }

    Eigen::CompleteOrthogonalDecomposition<Eigen::MatrixXd> decomposition(size(), size());
    decomposition.setThreshold(1e-11);
    decomposition.compute(moments);
    particular = decomposition.pseudoInverse();
    // I - C^+ C projects onto the fields without moments; pivoted QR picks a basis of them.
    const unsigned                                    n_bubbles = size() - decomposition.rank();
    const Eigen::MatrixXd                             projector = Eigen::MatrixXd::Identity(size(), size()) - particular * moments;
    const Eigen::ColPivHouseholderQR<Eigen::MatrixXd> qr(projector);
    bubbles = Eigen::MatrixXd(qr.householderQ()).leftCols(n_bubbles);
  }

  template <int dim>
  void ReferenceFluxes<dim>::add_faces(const bool simplex)
  {
    const ReferenceCell cell = simplex ? ReferenceCells::get_simplex<dim>() : ReferenceCells::get_hypercube<dim>();
    const unsigned      n_faces = simplex ? dim + 1 : 2 * dim;
    Point<dim>          centre;
    for (unsigned v = 0; v < cell.n_vertices(); ++v)
      centre += reference_vertex<dim>(simplex, v) / cell.n_vertices();
    for (unsigned f = 0; f < n_faces; ++f)
    {
      std::array<Point<dim>, dim> corners; // enough to span it
      for (unsigned v = 0; v < dim; ++v)
        corners[v] = reference_vertex<dim>(simplex, dim == 1 ? f : cell.face_to_cell_vertices(f, v, 1));
      Face                    face;
      std::vector<Point<dim>> points;
      std::vector<double>     weights;
      if constexpr (dim == 1)
      {
        points = {corners[0]};
        weights = {1.};
        face.normal[0] = f == 0 ? -1 : 1;
        n_face_tests = 1;
        face.tests = Eigen::MatrixXd::Ones(1, 1);
      }
      else
      {
        const unsigned                      highest = simplex ? degree + 1 : degree;
        const Quadrature<dim - 1>           rule = gauss_rule<dim - 1>(simplex, simplex && dim == 3 ? 4 : degree + 3);
        std::array<Tensor<1, dim>, dim - 1> edges;
        for (unsigned k = 0; k + 1 < dim; ++k)
          edges[k] = corners[k + 1] - corners[0];
        if constexpr (dim == 2)
          face.normal = cross_product_2d(edges[0]);
        else
          face.normal = cross_product_3d(edges[0], edges[1]);
        if (face.normal * (corners[0] - centre) < 0)
          face.normal *= -1.;
        const auto degrees = all_degrees<dim - 1>(in_all<dim - 1>(highest), simplex ? highest : 100 * dim);
        n_face_tests = degrees.size();
        // Polynomials of the coordinates of the cell but the one that the normal is closest to: they do not depend on how the face is
        // turned.
        unsigned left_out = 0;
        for (unsigned d = 1; d < dim; ++d)
          if (std::abs(face.normal[d]) > std::abs(face.normal[left_out]))
            left_out = d;
        face.tests.resize(rule.size(), n_face_tests);
        for (unsigned q = 0; q < rule.size(); ++q)
        {
          Point<dim> x = corners[0];
          for (unsigned k = 0; k + 1 < dim; ++k)
            x += rule.point(q)[k] * edges[k];
          points.push_back(x);
          weights.push_back(rule.weight(q));
          std::array<double, dim - 1> on_face;
          for (unsigned d = 0, k = 0; d < dim; ++d)
            if (d != left_out)
              on_face[k++] = x[d];
          for (unsigned i = 0; i < n_face_tests; ++i)
            face.tests(q, i) = legendre_product<dim - 1>(degrees[i], on_face);
        }
      }
      face.rule = Quadrature<dim>(points, weights);
      faces.push_back(face);
    }
  }

  template <int dim>
  Eigen::MatrixXd ReferenceFluxes<dim>::values_at(const std::vector<Point<dim>> &points) const
  {
    Eigen::MatrixXd values = Eigen::MatrixXd::Zero(points.size() * dim, size());
    for (std::size_t q = 0; q < points.size(); ++q)
      for (unsigned j = 0; j < size(); ++j)
        values(q * dim + functions[j].component, j) = legendre_product<dim>(functions[j].degrees, coordinates(points[q]));
    return values;
  }

  template <int dim>
  Eigen::MatrixXd ReferenceFluxes<dim>::divergences_at(const std::vector<Point<dim>> &points) const
  {
    Eigen::MatrixXd divergences(points.size(), size());
    for (std::size_t q = 0; q < points.size(); ++q)
      for (unsigned j = 0; j < size(); ++j)
      {
        double product = 1;
        for (unsigned d = 0; d < dim; ++d)
        {
          const auto [value, slope] = legendre(functions[j].degrees[d], points[q][d]);
          product *= d == functions[j].component ? slope : value;
        }
        divergences(q, j) = product;
      }
    return divergences;
  }

  template <int dim>
  Eigen::MatrixXd ReferenceFluxes<dim>::cell_tests_at(const std::vector<Point<dim>> &points) const
  {
    Eigen::MatrixXd tests(points.size(), n_cell_tests);
    for (std::size_t q = 0; q < points.size(); ++q)
      for (unsigned i = 0; i < n_cell_tests; ++i)
        tests(q, i) = legendre_product<dim>(cell_degrees[i], coordinates(points[q]));
    return tests;
  }

  template class ReferenceFluxes<1>;
  template class ReferenceFluxes<2>;
  template class ReferenceFluxes<3>;
} // namespace unilateral
