#include "unilateral/evaluation/patch_recovery.h"

#include "unilateral/mesh/gauss_rule.h"

#include <deal.II/base/quadrature_lib.h>

#include <Eigen/Cholesky>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <utility>

namespace unilateral
{
  using namespace dealii;

  namespace
  {
    /// A vertex on the boundary may have too few cells: its nodes take the polynomials of the other vertices of their cells.
    constexpr double weight_of_others = 1e-6;

    /// The least square of a pivot of the scaled normal equations that is no rounding.
    constexpr double smallest_pivot = 1e-9;

    /// By the square of this much a polynomial at a node may depend on errors of the samples, all of one size and independent. Patches that
    /// determine their polynomials have less than 15; cells in one layer, warped a little, which nearly leave powers across the layer open,
    /// have 1e6 and more.
    constexpr double largest_growth = 100;

    template <int dim>
    Quadrature<dim> sample_points(const ElementName &element)
    {
      return gauss_rule<dim>(element.simplex(), element.simplex() ? 2 : element.degree);
    }

    template <int dim>
    Quadrature<dim> samples_and_nodes(const Problem<dim> &problem)
    {
      std::vector<Point<dim>> points = sample_points<dim>(problem.space.element).get_points();
      const auto              element = problem.space.node_element();
      const auto             &nodes = element->get_unit_support_points();
      points.insert(points.end(), nodes.begin(), nodes.end());
      return Quadrature<dim>(points);
    }
  } // namespace

  template <int dim>
  PatchRecovery<dim>::PatchRecovery(const Problem<dim> &problem, const unsigned n_flux)
    : problem(problem), n_flux(n_flux), degree(problem.space.element.degree), rule(samples_and_nodes(problem)),
      places(*problem.space.mapping, *problem.space.fe, rule, update_quadrature_points)
  {
    const auto scalar = problem.space.node_element();
    n_nodes = scalar->n_dofs_per_cell();
    n_samples = rule.size() - n_nodes;
    n_coefficients = 1;
    for (unsigned d = 1; d <= dim; ++d) // binomial coefficient
      n_coefficients = n_coefficients * (degree + d) / d;
    node_functions.resize(n_samples, n_nodes);
    for (unsigned q = 0; q < n_samples; ++q)
      for (unsigned i = 0; i < n_nodes; ++i)
        node_functions(q, i) = scalar->shape_value(i, rule.point(q));
    const ReferenceCell cell = scalar->reference_cell();
    hats.resize(n_nodes);
    for (unsigned i = 0; i < n_nodes; ++i)
      for (unsigned v = 0; v < cell.n_vertices(); ++v)
        hats[i][v] = std::max(0., cell.d_linear_shape_function(rule.point(n_samples + i), v));
    const std::size_t n_cells = problem.space.mesh.triangulation->n_active_cells();
    points.reserve(n_cells * rule.size());
    samples.reserve(n_cells * n_samples * n_flux);
    nodes.reserve(n_cells * n_nodes);
  }

  template <int dim>
  bool PatchRecovery<dim>::is_better_than_means(const Problem<dim> &problem, const bool for_indicator)
  {
    const auto     family = problem.space.element.family;
    const unsigned degree = problem.space.element.degree;
    return problem.form->order() == 1 && (degree % 2 == 0 || (for_indicator && degree > 1)) &&
           (family == ElementName::Family::Q || family == ElementName::Family::P);
  }

  template <int dim>
  void PatchRecovery<dim>::add_cell(const typename DoFHandler<dim>::active_cell_iterator &cell,
                                    const double *const                                   flux,
                                    const std::vector<types::global_dof_index>           &nodes_of_cell)
  {
    const unsigned number = regions.size();
    regions.push_back(cell->material_id());
    for (const unsigned v : cell->vertex_indices())
      at_vertices.push_back({cell->vertex_index(v), number, v, unsigned(cell->vertex_dof_index(v, 0))});
    nodes.insert(nodes.end(), nodes_of_cell.begin(), nodes_of_cell.end());
    places.reinit(cell);
    points.insert(points.end(), places.get_quadrature_points().begin(), places.get_quadrature_points().end());
    for (unsigned q = 0; q < n_samples; ++q)
      for (unsigned c = 0; c < n_flux; ++c)
      {
        double value = 0;
        for (unsigned i = 0; i < n_nodes; ++i)
          value += node_functions(q, i) * flux[i * n_flux + c];
        samples.push_back(value);
      }
  }

  template <int dim>
  void PatchRecovery<dim>::powers(const Point<dim> &x, Eigen::VectorXd &result) const
  {
    constexpr unsigned                             highest = 8;
    std::array<std::array<double, highest + 1>, 3> power;
    for (unsigned d = 0; d < 3; ++d)
    {
      power[d][0] = 1;
      for (unsigned k = 1; k <= degree; ++k)
        power[d][k] = d < dim ? power[d][k - 1] * x[d < dim ? d : 0] : 0;
    }
    unsigned k = 0;
    for (unsigned a = 0; a <= degree; ++a)
      for (unsigned b = 0; a + b <= (dim > 1 ? degree : a); ++b)
        for (unsigned c = 0; a + b + c <= (dim > 2 ? degree : a + b); ++c)
          result(k++) = power[0][a] * power[1][b] * power[2][c];
  }

  template <int dim>
  void PatchRecovery<dim>::append_samples(const CellAtVertex &cell, std::vector<Sample> &result) const
  {
    for (unsigned q = 0; q < n_samples; ++q)
    {
      Sample &sample = result.emplace_back();
      sample.rank = problem.space.processes().rank();
      sample.region = regions[cell.cell];
      for (unsigned d = 0; d < dim; ++d)
        sample.x[d] = points[std::size_t(cell.cell) * rule.size() + q][d];
      std::copy_n(samples.begin() + (std::size_t(cell.cell) * n_samples + q) * n_flux, n_flux, sample.flux.begin());
    }
  }

  template <int dim>
  typename PatchRecovery<dim>::SamplesByDof PatchRecovery<dim>::samples_of_others() const
  {
    const SharedUnknowns                    &shared = problem.space.shared();
    std::vector<std::pair<unsigned, Sample>> records;
    std::vector<Sample>                      of_cell;
    for (const CellAtVertex &cell : at_vertices)
      if (shared.shares(cell.dof))
      {
        of_cell.clear();
        append_samples(cell, of_cell);
        for (const Sample &sample : of_cell)
          records.emplace_back(cell.dof, sample);
      }
    shared.share(records);
    SamplesByDof result;
    for (const auto &[dof, sample] : records)
      if (sample.rank != shared.processes().rank())
        result[dof].push_back(sample);
    return result;
  }

  template <int dim>
  typename PatchRecovery<dim>::Polynomial
  PatchRecovery<dim>::fit(const CellAtVertex *const first, const CellAtVertex *const last, const SamplesByDof &of_others) const
  {
    std::vector<Sample> of_patch;
    for (const CellAtVertex *at = first; at != last; ++at)
      append_samples(*at, of_patch);
    if (const auto others = of_others.find(first->dof); others != of_others.end())
      std::copy_if(others->second.begin(), others->second.end(), std::back_inserter(of_patch),
                   [&](const Sample &sample) { return sample.region == regions[first->cell]; });

    Polynomial polynomial;
    if (2 * of_patch.size() < 3 * n_coefficients)
      return polynomial;
    polynomial.center = problem.space.mesh.triangulation->get_vertices()[first->vertex];
    const auto offset = [&](const Sample &sample)
    {
      Point<dim> x;
      for (unsigned d = 0; d < dim; ++d)
        x[d] = sample.x[d] - polynomial.center[d];
      return x;
    };
    for (const Sample &sample : of_patch)
      polynomial.size = std::max(polynomial.size, offset(sample).norm());
    Eigen::MatrixXd matrix = Eigen::MatrixXd::Zero(n_coefficients, n_coefficients), right = Eigen::MatrixXd::Zero(n_coefficients, n_flux);
    Eigen::VectorXd at_point(n_coefficients);
    for (const Sample &sample : of_patch)
    {
      powers(Point<dim>(offset(sample) / polynomial.size), at_point);
      matrix.selfadjointView<Eigen::Lower>().rankUpdate(at_point);
      right.noalias() += at_point * Eigen::Map<const Eigen::RowVectorXd>(sample.flux.data(), n_flux);
    }
    const Eigen::VectorXd scale = matrix.diagonal().cwiseSqrt().cwiseInverse();
    matrix = scale.asDiagonal() * matrix * scale.asDiagonal();
    const Eigen::LLT<Eigen::MatrixXd> factors(matrix);
    if (factors.info() != Eigen::Success || !(factors.matrixLLT().diagonal().array().square().minCoeff() > smallest_pivot))
      return polynomial;
    for (const CellAtVertex *at = first; at != last; ++at)
      for (unsigned i = 0; i < n_nodes; ++i)
      {
        powers(Point<dim>((node_of(*at, i) - polynomial.center) / polynomial.size), at_point);
        if (!(factors.matrixL().solve(scale.asDiagonal() * at_point).squaredNorm() < largest_growth))
          return polynomial;
      }
    polynomial.coefficients = scale.asDiagonal() * factors.solve(scale.asDiagonal() * right);
    polynomial.determined = true;
    return polynomial;
  }

  template <int dim>
  void PatchRecovery<dim>::for_each_value(const Take &take)
  {
    std::sort(at_vertices.begin(), at_vertices.end(),
              [&](const CellAtVertex &a, const CellAtVertex &b) {
                return a.vertex != b.vertex ? a.vertex < b.vertex : std::pair(regions[a.cell], a.cell) < std::pair(regions[b.cell], b.cell);
              });
    const SamplesByDof        of_others = problem.space.subdomain ? samples_of_others() : SamplesByDof();
    Eigen::VectorXd           at_node(n_coefficients);
    Eigen::RowVectorXd        flux(n_flux);
    const CellAtVertex *const end = at_vertices.data() + at_vertices.size();
    for (const CellAtVertex *first = at_vertices.data(), *last; first != end; first = last)
    {
      last = std::find_if(first, end,
                          [&](const CellAtVertex &other)
                          { return other.vertex != first->vertex || regions[other.cell] != regions[first->cell]; });
      const Polynomial polynomial = fit(first, last, of_others);
      if (!polynomial.determined)
        continue;
      for (const CellAtVertex *at = first; at != last; ++at)
        for (unsigned i = 0; i < n_nodes; ++i)
        {
          powers(Point<dim>((node_of(*at, i) - polynomial.center) / polynomial.size), at_node);
          flux.noalias() = at_node.transpose() * polynomial.coefficients;
          take(nodes[std::size_t(at->cell) * n_nodes + i], regions[at->cell], hats[i][at->corner] + weight_of_others, flux.data());
        }
    }
  }

  template class PatchRecovery<1>;
  template class PatchRecovery<2>;
  template class PatchRecovery<3>;
} // namespace unilateral
