#include "unilateral/equilibration/body_cells.h"

#include "unilateral/equilibration/straight_face.h"

#include <deal.II/base/geometry_info.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <utility>

namespace unilateral
{
  using namespace dealii;

  namespace
  {
    /// More than for polynomials, where data are none.
    constexpr unsigned further_degrees = 4;

    /// The point of the reference square that a multilinear map takes to @p x, by Newton's method.
    template <int dim>
    Point<dim> preimage(const std::vector<Point<dim>> &corners, const Point<dim> &x)
    {
      Point<dim> xi;
      for (unsigned d = 0; d < dim; ++d)
        xi[d] = 0.5;
      for (unsigned step = 0; step < 30; ++step)
      {
        Tensor<1, dim> rest = x;
        Tensor<2, dim> jacobian;
        for (unsigned v = 0; v < corners.size(); ++v)
        {
          rest -= GeometryInfo<dim>::d_linear_shape_function(xi, v) * corners[v];
          jacobian += outer_product(Tensor<1, dim>(corners[v]), GeometryInfo<dim>::d_linear_shape_function_gradient(xi, v));
        }
        const Tensor<1, dim> change = invert(jacobian) * rest;
        xi += change;
        if (change.norm() < 1e-14)
          break;
      }
      return xi;
    }
  } // namespace

  template <int dim>
  struct BodyCells<dim>::Reference
  {
    Reference(const bool simplex, const unsigned degree) : stresses(reference_corners<dim>(simplex), simplex, degree), basis(stresses) {}

    /// Made once: in space that takes up to seconds.
    static const Reference &with(const bool simplex, const unsigned degree)
    {
      static std::map<std::pair<bool, unsigned>, Reference> known;
      return known.try_emplace({simplex, degree}, simplex, degree).first->second;
    }

    const CompositeStresses<dim> stresses;
    const StressBasis            basis;
  };

  template <int dim>
  BodyCells<dim>::BodyCells(const Problem<dim> &problem, const unsigned stress_degree)
    : degree(stress_degree), problem(problem), simplex(problem.space.element.simplex()),
      plain_degree(2 * std::max(stress_degree, simplex ? stress_degree - 1 : dim * problem.space.element.degree - 1)),
      reference(Reference::with(simplex, stress_degree)),
      plain(make_rule(reference.stresses, problem.space.fe->base_element(0), plain_degree, nullptr)),
      fine(make_rule(reference.stresses, problem.space.fe->base_element(0), plain_degree + further_degrees, nullptr))
  {
  }

  template <int dim>
  typename BodyCells<dim>::Rule BodyCells<dim>::make_rule(const CompositeStresses<dim>  &stresses,
                                                          const FiniteElement<dim>      &element,
                                                          const unsigned                 degree,
                                                          const std::vector<Point<dim>> *corners)
  {
    std::vector<Point<dim>>      points;
    std::vector<double>          weights;
    std::vector<unsigned>        part;
    std::vector<Eigen::MatrixXd> functions;
    for (unsigned j = 0; j < stresses.n_parts(); ++j)
    {
      const auto rule = simplex_rule<dim>(stresses.split.part(j), degree);
      functions.push_back(stresses.on_parts[j].values_at(rule.get_points()));
      for (unsigned q = 0; q < rule.size(); ++q)
      {
        points.push_back(corners ? preimage(*corners, rule.point(q)) : rule.point(q));
        weights.push_back(rule.weight(q));
        part.push_back(j);
      }
    }
    Rule     result{TabulatedElement<dim>(element, Quadrature<dim>(points, weights)), Eigen::MatrixXd(points.size(), stresses.n_scalar()),
                part};
    unsigned row = 0;
    for (const auto &block : functions)
    {
      result.functions.middleRows(row, block.rows()) = block;
      row += block.rows();
    }
    return result;
  }

  template <int dim>
  typename BodyCells<dim>::OnCell BodyCells<dim>::on(const Cell &cell, const bool with_fine) const
  {
    OnCell result{StraightCell<dim>(cell), &reference.stresses, &reference.basis, with_fine ? &fine : &plain, {}, {}, 0, {}, {}, true, {}};
    result.affine = result.straight.affine();
    if (result.affine)
    {
      result.origin = cell->vertex(0);
      for (unsigned d = 0; d < dim; ++d)
        for (unsigned i = 0; i < dim; ++i)
          result.J[i][d] = cell->vertex(simplex ? d + 1 : 1u << d)[i] - cell->vertex(0)[i];
    }
    else
    {
      if (dim == 3)
        throw std::domain_error("some hexahedra are no parallelepipeds");
      std::vector<Point<dim>> corners;
      for (const unsigned v : cell->vertex_indices())
        result.origin += cell->vertex(v) / double(cell->n_vertices());
      const double size = result.straight.diameter();
      for (const unsigned v : cell->vertex_indices())
        corners.push_back(Point<dim>((cell->vertex(v) - result.origin) / size));
      for (unsigned d = 0; d < dim; ++d)
        result.J[d][d] = size;
      const auto stresses = std::make_shared<const CompositeStresses<dim>>(corners, simplex, degree);
      const auto rule = std::make_shared<const Rule>(
        make_rule(*stresses, problem.space.fe->base_element(0), plain_degree + (with_fine ? further_degrees : 2), &corners));
      result.stresses = stresses.get();
      result.basis = nullptr;
      result.rule = rule.get();
      result.own[0] = stresses;
      result.own[1] = rule;
    }
    result.det = std::abs(determinant(result.J));
    if (!(result.det > 0))
      throw std::domain_error("a cell is folded");
    result.inverse_J = invert(result.J);
    result.at = result.straight.at(result.rule->element);
    return result;
  }

  template class BodyCells<2>;
  template class BodyCells<3>;
} // namespace unilateral
