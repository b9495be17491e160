#include "unilateral/evaluation/estimator.h"

#include "unilateral/discretisation/element_systems.h"
#include "unilateral/discretisation/vertex_volumes.h"
#include "unilateral/evaluation/patch_recovery.h"
#include "unilateral/forms/membrane.h"
#include "unilateral/spaces/hanging_nodes.h"

#include <deal.II/fe/fe_values.h>

#include <Eigen/Cholesky>

#include <algorithm>
#include <cmath>
#include <optional>

namespace unilateral
{
  using namespace dealii;

  namespace
  {
    /// The flux of a function of V_h, cell by cell. On cells of one shape it depends on the unknowns in the same way.
    template <int dim>
    class FluxOnCells
    {
    public:
      FluxOnCells(const Problem<dim> &problem, const Vector &u)
        : problem(problem), u(u), values(*problem.space.mapping, *problem.space.fe, problem.cell_quadrature(), cell_flags(*problem.form)),
          shapes(shapes_for_systems(problem)), n_flux(problem.form->n_flux_components()), n_q(values.n_quadrature_points),
          dofs(problem.space.fe->n_dofs_per_cell()), local_u(dofs.size())
      {
        const auto scalar = problem.space.node_element();
        n = scalar->n_dofs_per_cell();
        node_function.resize(n, n_q);
        for (unsigned i = 0; i < n; ++i)
          for (unsigned q = 0; q < n_q; ++q)
            node_function(i, q) = scalar->shape_value(i, values.get_quadrature().point(q));
        if (VertexVolumes<dim>::any(problem))
          tensions = volumes.emplace(problem).tensions(u);
        scaled_weights.resize(n_q);
        flux_at_points.resize(n_q, n_flux);
        fit.resize(n * n_flux);
      }

      void reinit(const typename DoFHandler<dim>::active_cell_iterator &new_cell)
      {
        cell = new_cell;
        evaluated = fitted = false;
        cell->get_dof_indices(dofs);
        for (unsigned i = 0; i < dofs.size(); ++i)
          local_u(i) = u(dofs[i]);
        const unsigned number = shapes(cell);
        if (number != shapes.none && number == known.size())
        {
          evaluate();
          known.push_back(make_shape());
        }
        shape = number < known.size() ? &known[number] : nullptr;
      }

      double volume()
      {
        if (shape)
          return shape->volume;
        evaluate();
        return weighed_volume;
      }

      /// The polynomial of V_h on the cell alone that fits the flux best, in the norm of L2: n_flux numbers a node.
      const double *best_fit()
      {
        if (!fitted && shape)
          fit.noalias() = shape->best_fit * Eigen::Map<const Eigen::VectorXd>(local_u.begin(), local_u.size());
        else if (!fitted)
        {
          evaluate();
          fit_flux();
        }
        fitted = true;
        return fit.data();
      }

      /// int (G - q) . C^-1 (G - q) over the cell, @p G of the kind of best_fit().
      double distance_square(const double *const G)
      {
        if (shape && shape->is_polynomial)
          return polynomial_energy(*shape, G);
        evaluate();
        double sum = 0;
        for (unsigned q = 0; q < n_q; ++q)
        {
          Flux difference{};
          for (unsigned c = 0; c < n_flux; ++c)
          {
            difference[c] = -flux[q][c];
            for (unsigned i = 0; i < n; ++i)
              difference[c] += node_function(i, q) * G[i * n_flux + c];
          }
          const Point<dim> &x = values.quadrature_point(q);
          sum += problem.form->flux_energy(difference, cell->material_id(), x) * values.JxW(q) * problem.form->measure(x);
        }
        return sum;
      }

      unsigned n_nodes() const { return n; }

    private:
      struct Shape
      {
        double          volume;
        bool            is_polynomial; ///< the flux of any u is that of best_fit
        Eigen::MatrixXd best_fit;      ///< n n_flux x unknowns
        Eigen::MatrixXd mass;          ///< of the node functions, symmetric
        Eigen::MatrixXd energy;        ///< C^-1, symmetric
      };

      /// The flux of local_u at the points of the rule.
      void evaluate()
      {
        if (evaluated)
          return;
        values.reinit(cell);
        problem.form->flux(values, local_u, flux);
        if (problem.form->averages_volume_in(cell->material_id()))
          add_stress_of_vertices();
        weigh();
        evaluated = true;
      }

      /// What the averaged changes of volume cost: the same tension in all directions.
      void add_stress_of_vertices()
      {
        for (const unsigned corner : cell->vertex_indices())
        {
          const double stress = tensions[volumes->patch_at(cell, corner)];
          for (unsigned q = 0; q < n_q; ++q)
            for (unsigned d = 0; d < 3; ++d)
              flux[q][d] += stress * cell->reference_cell().d_linear_shape_function(values.get_quadrature().point(q), corner);
        }
      }

      /// The weights of the points as shares of the volume; affine cells all have the same mass matrix up to their volume.
      void weigh()
      {
        weighed_volume = 0;
        for (unsigned q = 0; q < n_q; ++q)
          weighed_volume += values.JxW(q);
        bool the_same = known_weights.size() == n_q;
        for (unsigned q = 0; q < n_q; ++q)
        {
          scaled_weights(q) = values.JxW(q) / weighed_volume;
          the_same = the_same && std::abs(scaled_weights(q) - known_weights(q)) <= 1e-13;
        }
        if (the_same)
          return;
        known_weights = scaled_weights;
        weighted_function.noalias() = node_function * scaled_weights.asDiagonal();
        mass.noalias() = weighted_function * node_function.transpose();
        mass_factors.compute(mass);
      }

      /// The best fit of what `flux` holds.
      void fit_flux()
      {
        for (unsigned q = 0; q < n_q; ++q)
          for (unsigned c = 0; c < n_flux; ++c)
            flux_at_points(q, c) = flux[q][c];
        moments.noalias() = weighted_function * flux_at_points;
        mass_factors.solveInPlace(moments);
        for (unsigned i = 0; i < n; ++i)
          for (unsigned c = 0; c < n_flux; ++c)
            fit(i * n_flux + c) = moments(i, c);
      }

      Shape make_shape()
      {
        Shape                  result{weighed_volume, true, Eigen::MatrixXd(n * n_flux, dofs.size()), mass * weighed_volume, {}};
        dealii::Vector<double> unit(dofs.size());
        double                 largest = 0, rest = 0;
        for (unsigned j = 0; j < dofs.size(); ++j)
        {
          unit = 0.;
          unit(j) = 1;
          problem.form->flux(values, unit, flux);
          fit_flux();
          result.best_fit.col(j) = fit;
          for (unsigned q = 0; q < n_q; ++q)
            for (unsigned c = 0; c < n_flux; ++c)
            {
              double at_point = 0;
              for (unsigned i = 0; i < n; ++i)
                at_point += node_function(i, q) * fit(i * n_flux + c);
              largest = std::max(largest, std::abs(flux[q][c]));
              rest = std::max(rest, std::abs(flux[q][c] - at_point));
            }
        }
        result.is_polynomial = rest <= 1e-12 * largest;
        // The quadratic form from its values.
        const auto energy = [&](const unsigned a, const unsigned b, const double sign)
        {
          Flux sum{};
          sum[a] += 1;
          sum[b] += sign;
          return problem.form->flux_energy(sum, cell->material_id(), values.quadrature_point(0));
        };
        result.energy.resize(n_flux, n_flux);
        for (unsigned a = 0; a < n_flux; ++a)
          for (unsigned b = 0; b < n_flux; ++b)
            result.energy(a, b) = (energy(a, b, 1) - energy(a, b, -1)) / 4;
        evaluated = false; // flux is that of the last unit vector
        return result;
      }

      double polynomial_energy(const Shape &shape, const double *const G)
      {
        best_fit();
        difference.resize(n * n_flux);
        for (unsigned k = 0; k < n * n_flux; ++k)
          difference[k] = G[k] - fit(k);
        const double *const mass = shape.mass.data(), *const energy = shape.energy.data(), *const d = difference.data();
        double sum = 0;
        for (unsigned i = 0; i < n; ++i)
          for (unsigned a = 0; a < n_flux; ++a)
          {
            double moment = 0, strain = 0;
            for (unsigned j = 0; j < n; ++j)
              moment += mass[i * n + j] * d[j * n_flux + a];
            for (unsigned b = 0; b < n_flux; ++b)
              strain += energy[a * n_flux + b] * d[i * n_flux + b];
            sum += moment * strain;
          }
        return sum;
      }

      const Problem<dim>                            &problem;
      const Vector                                  &u;
      FEValues<dim>                                  values;
      CellShapes<dim>                                shapes;
      const unsigned                                 n_flux, n_q;
      unsigned                                       n; ///< nodes of a cell
      std::vector<types::global_dof_index>           dofs;
      dealii::Vector<double>                         local_u;
      Eigen::MatrixXd                                node_function; ///< nodes x points
      std::vector<Shape>                             known;         ///< by number
      std::optional<VertexVolumes<dim>>              volumes;
      std::vector<double>                            tensions; ///< of their patches
      const Shape                                   *shape = nullptr;
      typename DoFHandler<dim>::active_cell_iterator cell;
      bool                                           evaluated = false, fitted = false; ///< for this cell
      std::vector<Flux>                              flux;                              ///< at the points
      double                                         weighed_volume = 0;
      Eigen::VectorXd                                scaled_weights, known_weights;
      Eigen::MatrixXd                                weighted_function, mass; ///< those that known_weights belong to
      Eigen::LLT<Eigen::MatrixXd>                    mass_factors;
      Eigen::MatrixXd                                flux_at_points, moments;
      Eigen::VectorXd                                fit; ///< n_flux numbers a node
      std::vector<double>                            difference;
    };

    /// The numbers of the nodes of one cell after another.
    template <int dim>
    struct NodesOfCells
    {
      NodesOfCells(const Problem<dim> &problem, const DoFHandler<dim> &nodes)
        : problem(problem), nodes(nodes), numbers(nodes.get_fe().n_dofs_per_cell())
      {
      }

      const std::vector<types::global_dof_index> &on(const typename DoFHandler<dim>::active_cell_iterator &cell)
      {
        typename DoFHandler<dim>::active_cell_iterator(&*problem.space.mesh.triangulation, cell->level(), cell->index(), &nodes)
          ->get_dof_indices(numbers);
        return numbers;
      }

      const Problem<dim>                  &problem;
      const DoFHandler<dim>               &nodes;
      std::vector<types::global_dof_index> numbers;
    };
  } // namespace

  template <int dim>
  RecoveredFlux<dim>::RecoveredFlux(const Problem<dim> &problem, const Vector &u, const FluxFor purpose)
    : n_regions(problem.space.mesh.region_names.size()), n_flux(problem.form->n_flux_components())
  {
    if (problem.form->n_components() == 1 &&
        (problem.space.element.family == ElementName::Family::Q || problem.space.element.family == ElementName::Family::P))
      nodes = &problem.space.dof_handler;
    else
    {
      own_nodes = problem.space.nodes();
      nodes = own_nodes.get();
    }
    n_nodes = nodes->n_dofs();
    values.resize(n_nodes * n_regions * n_flux);
    std::vector<double>               weights(n_nodes * n_regions, 0.);
    FluxOnCells<dim>                  on_cells(problem, u);
    NodesOfCells<dim>                 nodes_of_cells(problem, *nodes);
    const unsigned                    n = on_cells.n_nodes();
    std::optional<PatchRecovery<dim>> patches;
    if (PatchRecovery<dim>::is_better_than_means(problem, purpose == FluxFor::indicator))
      patches.emplace(problem, n_flux);
    for (const auto &cell : problem.space.dof_handler.active_cell_iterators())
    {
      on_cells.reinit(cell);
      const auto         &cell_nodes = nodes_of_cells.on(cell);
      const double *const best_fit = on_cells.best_fit();
      if (patches)
        patches->add_cell(cell, best_fit, cell_nodes);
      for (unsigned i = 0; i < n; ++i)
        add(values, weights, place(cell_nodes[i], cell->material_id()), on_cells.volume(), best_fit + i * n_flux);
    }
    share(problem, values, weights);
    used.resize(weights.size());
    for (std::size_t k = 0; k < weights.size(); ++k)
      if (weights[k] > 0)
      {
        used[k] = true;
        for (unsigned c = 0; c < n_flux; ++c)
          values[k * n_flux + c] /= weights[k];
      }
    if (patches)
      take_from_patches(problem, *patches);
    if (own_nodes)
      make_continuous(constraints_at_hanging_nodes(*own_nodes));
    else
      make_continuous(problem.space.hanging_nodes);
  }

  template <int dim>
  void RecoveredFlux<dim>::add(
    std::vector<double> &sums, std::vector<double> &weights, const std::size_t at, const double weight, const double *const flux) const
  {
    weights[at] += weight;
    for (unsigned c = 0; c < n_flux; ++c)
      sums[at * n_flux + c] += weight * flux[c];
  }

  /// What all processes have added at nodes on cuts.
  template <int dim>
  void RecoveredFlux<dim>::share(const Problem<dim> &problem, std::vector<double> &sums, std::vector<double> &weights) const
  {
    if (!problem.space.subdomain)
      return;
    const SharedUnknowns shared = own_nodes ? problem.space.shared(*nodes) : problem.space.shared();
    std::vector<double>  column(n_nodes);
    for (unsigned region = 0; region < n_regions; ++region)
    {
      shared.add(weights.data() + place(0, region));
      for (unsigned c = 0; c < n_flux; ++c)
      {
        for (std::size_t node = 0; node < n_nodes; ++node)
          column[node] = sums[place(node, region) * n_flux + c];
        shared.add(column.data());
        for (std::size_t node = 0; node < n_nodes; ++node)
          sums[place(node, region) * n_flux + c] = column[node];
      }
    }
  }

  template <int dim>
  void RecoveredFlux<dim>::take_from_patches(const Problem<dim> &problem, PatchRecovery<dim> &patches)
  {
    std::vector<double> sums(values.size(), 0.), weights(used.size(), 0.);
    patches.for_each_value([&](const types::global_dof_index node, const types::material_id region, const double weight, const double *flux)
                           { add(sums, weights, place(node, region), weight, flux); });
    share(problem, sums, weights);
    for (std::size_t k = 0; k < weights.size(); ++k)
      if (weights[k] > 0)
        for (unsigned c = 0; c < n_flux; ++c)
          values[k * n_flux + c] = sums[k * n_flux + c] / weights[k];
  }

  template <int dim>
  void RecoveredFlux<dim>::make_continuous(const AffineConstraints<double> &hanging_nodes)
  {
    for (const auto &line : hanging_nodes.get_lines())
      for (unsigned region = 0; region < n_regions; ++region)
      {
        const std::size_t at = place(line.index, region);
        if (std::any_of(line.entries.begin(), line.entries.end(), [&](const auto &entry) { return !used[place(entry.first, region)]; }))
          continue; // where regions meet
        Flux sum{};
        for (const auto &[node, weight] : line.entries)
          for (unsigned c = 0; c < n_flux; ++c)
            sum[c] += weight * values[place(node, region) * n_flux + c];
        used[at] = true;
        std::copy_n(sum.begin(), n_flux, values.begin() + at * n_flux);
      }
  }

  template <int dim>
  Flux RecoveredFlux<dim>::at(const types::global_dof_index node, const types::material_id region) const
  {
    Flux flux{};
    std::copy_n(values.begin() + place(node, region) * n_flux, n_flux, flux.begin());
    return flux;
  }

  template <int dim>
  Flux RecoveredFlux<dim>::mean_at(const types::global_dof_index node) const
  {
    Flux     mean{};
    unsigned n = 0;
    for (unsigned region = 0; region < n_regions; ++region)
      if (const std::size_t k = place(node, region); used[k])
      {
        ++n;
        for (unsigned c = 0; c < n_flux; ++c)
          mean[c] += values[k * n_flux + c];
      }
    for (double &component : mean)
      component /= std::max(n, 1u);
    return mean;
  }

  namespace
  {
    /// Where the moment of a beam jumps by what acts there: moments, and supports that hold the slope. No mean of both sides is closer.
    template <int dim>
    std::vector<double> places_of_moments(const Problem<dim> &problem)
    {
      std::vector<double> places;
      if (dim > 1 || problem.form->order() < 2)
        return places;
      for (const PointLoad &load : problem.statement.point_loads)
        if (load.moment != 0)
          places.push_back(load.at[0]);
      for (const auto &support : problem.prescribed.supports)
        if (support.slope)
          places.push_back(support.at[0]);
      return places;
    }

    /// Node @p i of the cell is at one of them.
    template <int dim>
    bool is_at(const std::vector<double> &places, const typename DoFHandler<dim>::active_cell_iterator &cell, const Point<dim> &unit)
    {
      const double x = (1 - unit[0]) * cell->vertex(0)[0] + unit[0] * cell->vertex(1)[0];
      return std::any_of(places.begin(), places.end(), [&](const double at) { return std::abs(x - at) <= 1e-9 * cell->diameter(); });
    }
  } // namespace

  template <int dim>
  double discretisation_indicator(const Problem<dim>        &problem,
                                  const Vector              &u,
                                  const RecoveredFlux<dim>  &recovered_for_values,
                                  std::vector<double> *const cell_squares)
  {
    std::optional<RecoveredFlux<dim>> for_indicator;
    if (PatchRecovery<dim>::is_better_than_means(problem, /*for_indicator=*/true) !=
        PatchRecovery<dim>::is_better_than_means(problem, /*for_indicator=*/false))
      for_indicator.emplace(problem, u, FluxFor::indicator);
    const RecoveredFlux<dim> &recovered = for_indicator ? *for_indicator : recovered_for_values;

    FluxOnCells<dim>    on_cells(problem, u);
    NodesOfCells<dim>   nodes_of_cells(problem, *recovered.nodes);
    const unsigned      n_flux = recovered.n_flux;
    std::vector<double> G(on_cells.n_nodes() * n_flux);
    double              eta = 0;
    const auto          places = places_of_moments(problem);
    if (cell_squares)
      cell_squares->clear();
    for (const auto &cell : problem.space.dof_handler.active_cell_iterators())
    {
      on_cells.reinit(cell);
      const auto &cell_nodes = nodes_of_cells.on(cell);
      for (unsigned i = 0; i < cell_nodes.size(); ++i)
        if (!places.empty() && is_at<dim>(places, cell, recovered.nodes->get_fe().unit_support_point(i)))
          std::copy_n(on_cells.best_fit() + i * n_flux, n_flux, G.begin() + i * n_flux);
        else
          std::copy_n(recovered.values.begin() + recovered.place(cell_nodes[i], cell->material_id()) * n_flux, n_flux,
                      G.begin() + i * n_flux);
      const double square = on_cells.distance_square(G.data());
      eta += square;
      if (cell_squares)
        cell_squares->push_back(square);
    }
    return std::sqrt(std::max(problem.space.processes().sum(eta), 0.));
  }

  namespace
  {
    /// int c u^2 of a membrane with a reaction c.
    template <int dim>
    double energy_of_reaction(const Problem<dim> &problem, const Vector &u)
    {
      const auto *const membrane = dynamic_cast<const Membrane<dim> *>(problem.form.get());
      if (!membrane || !membrane->holds_rigid_body_modes())
        return 0;
      FEValues<dim>       values(*problem.space.mapping, *problem.space.fe, problem.cell_quadrature(),
                                 update_values | update_quadrature_points | update_JxW_values);
      std::vector<double> u_at(values.n_quadrature_points), c(u_at.size());
      double              sum = 0;
      for (const auto &cell : problem.space.dof_handler.active_cell_iterators())
      {
        values.reinit(cell);
        values.get_function_values(u, u_at);
        membrane->coefficients_in(cell->material_id()).reaction.values(values.get_quadrature_points(), c);
        for (const unsigned q : values.quadrature_point_indices())
          sum += c[q] * u_at[q] * u_at[q] * values.JxW(q);
      }
      return sum;
    }
  } // namespace

  template <int dim>
  double energy_norm(const Problem<dim> &problem, const Vector &u)
  {
    FluxOnCells<dim>          on_cells(problem, u);
    const std::vector<double> zero(on_cells.n_nodes() * problem.form->n_flux_components(), 0.);
    double                    square = energy_of_reaction(problem, u);
    for (const auto &cell : problem.space.dof_handler.active_cell_iterators())
    {
      on_cells.reinit(cell);
      square += on_cells.distance_square(zero.data());
    }
    return std::sqrt(std::max(problem.space.processes().sum(square), 0.));
  }

#define INSTANTIATE(dim)                                                                                                                   \
  template class RecoveredFlux<dim>;                                                                                                       \
  template double discretisation_indicator(const Problem<dim> &, const Vector &, const RecoveredFlux<dim> &, std::vector<double> *);       \
  template double energy_norm(const Problem<dim> &, const Vector &);
  INSTANTIATE(1)
  INSTANTIATE(2)
  INSTANTIATE(3)
#undef INSTANTIATE
} // namespace unilateral
