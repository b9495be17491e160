#include "unilateral/evaluation/functionals.h"

#include "unilateral/discretisation/regions_and_parts.h"
#include "unilateral/evaluation/solution_quantities.h"
#include "unilateral/forms/elasticity.h"

#include <deal.II/fe/fe_values.h>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <optional>
#include <stdexcept>

namespace unilateral
{
  using namespace dealii;

  namespace
  {
    using Kind = SolutionQuantity::Kind;

    /// The quantities that an integrand uses; those that the problem does not have are left out.
    template <int dim>
    std::vector<SolutionQuantity> used_quantities(const Problem<dim> &problem, const Functional &functional)
    {
      const auto                    all = solution_quantities(problem.form->n_components(), problem.form->order(), dim);
      std::vector<SolutionQuantity> used;
      for (const std::string &name : functional.integrand.quantities)
        for (const SolutionQuantity &quantity : all)
          if (quantity.name == name)
            used.push_back(quantity);
      return used;
    }

    bool at_constraint_points(const std::vector<SolutionQuantity> &quantities)
    {
      return std::any_of(quantities.begin(), quantities.end(), [](const auto &quantity) { return quantity.at_constraint_points_only(); });
    }

    std::optional<types::boundary_id> number_of(const std::vector<std::string> &names, const std::string &name)
    {
      const auto found = std::find(names.begin(), names.end(), name);
      if (found == names.end())
        return {};
      return found - names.begin();
    }

    /// The sum of an integrand over points that come in batches.
    class WeightedSum
    {
    public:
      WeightedSum(const Functional &functional, const std::size_t n_quantities) : functional(functional), columns(n_quantities) {}

      double value = 0;

      /// Room for @p n points: quantities(k)[q], point(q), weight(q) are to be set before add().
      void resize(const std::size_t n)
      {
        points.resize(n);
        weights.resize(n);
        integrand.resize(n);
        for (auto &column : columns)
          column.resize(n);
      }

      void add()
      {
        functional.integrand.values(points, columns, integrand);
        for (std::size_t q = 0; q < points.size(); ++q)
          value += weights[q] * integrand[q];
      }

      std::vector<double> &quantity(const std::size_t k) { return columns[k]; }

      template <int dim>
      void set_point(const std::size_t q, const Point<dim> &x, const double weight)
      {
        points[q] = {};
        for (unsigned d = 0; d < dim; ++d)
          points[q][d] = x[d];
        weights[q] = weight;
      }

    private:
      const Functional                  &functional;
      std::vector<std::array<double, 3>> points;
      std::vector<double>                weights, integrand;
      std::vector<std::vector<double>>   columns;
    };

    /// I_G(g) over the points of the blocks on the part.
    template <int dim>
    void add_constraint_points(const ConstraintSet<dim>            &set,
                               const Vector                        &u,
                               const Vector                        &lambda,
                               const Functional                    &functional,
                               const std::vector<SolutionQuantity> &quantities,
                               WeightedSum                         &sum)
    {
      const std::vector<double> values = set.values_of(u);
      for (const ConstraintBlock &block : set.blocks)
      {
        if (block.on != functional.on)
          continue;
        std::vector<std::size_t> own;
        for (std::size_t i = block.begin; i < block.end; ++i)
          if (set.owns(i))
            own.push_back(i);
        sum.resize(own.size());
        for (std::size_t q = 0; q < own.size(); ++q)
        {
          const ConstraintPoint<dim> &point = set.points[own[q]];
          sum.set_point(q, point.x, point.weight);
          for (std::size_t k = 0; k < quantities.size(); ++k)
            switch (quantities[k].kind)
            {
            case Kind::pressure:
              sum.quantity(k)[q] = lambda(own[q]);
              break;
            case Kind::gap:
              sum.quantity(k)[q] = point.sign * (point.bound - values[own[q]]);
              break;
            case Kind::normal:
              sum.quantity(k)[q] = set.directions[own[q]][quantities[k].i];
              break;
            case Kind::value:
              sum.quantity(k)[q] = values[own[q]];
              break;
            default:
              throw std::logic_error("a quantity that constraint points do not have");
            }
        }
        sum.add();
      }
    }

    /// The quantities at the points of a rule on cells or faces.
    template <int dim>
    class QuantitiesAtPoints
    {
    public:
      QuantitiesAtPoints(const Problem<dim>                  &problem,
                         const Vector                        &u,
                         const RecoveredFlux<dim>            &flux,
                         const std::vector<SolutionQuantity> &quantities)
        : problem(problem), u(u), flux(flux), quantities(quantities), nodes(flux.nodes->get_fe().n_dofs_per_cell())
      {
      }

      bool uses(const Kind kind) const
      {
        return std::any_of(quantities.begin(), quantities.end(), [&](const auto &quantity) { return quantity.kind == kind; });
      }
      bool uses_flux() const { return uses(Kind::flux) || uses(Kind::von_mises); }

      UpdateFlags flags() const
      {
        UpdateFlags needed = update_values | update_quadrature_points | update_JxW_values;
        if (uses(Kind::gradient))
          needed |= update_gradients;
        if (uses(Kind::hessian))
          needed |= update_hessians;
        if (uses(Kind::normal))
          needed |= update_normal_vectors;
        return needed;
      }

      /// @p values on a cell or face, @p node_values of the nodes of the flux there.
      void add(const FEValuesBase<dim>                              &values,
               const FEValuesBase<dim>                              *node_values,
               const typename DoFHandler<dim>::active_cell_iterator &cell,
               WeightedSum                                          &sum)
      {
        const unsigned n = values.n_quadrature_points, n_components = problem.form->n_components();
        sum.resize(n);
        for (unsigned q = 0; q < n; ++q)
          sum.set_point(q, values.quadrature_point(q), values.JxW(q) * problem.form->measure(values.quadrature_point(q)));
        if (uses(Kind::value))
        {
          at_values.assign(n, dealii::Vector<double>(n_components));
          values.get_function_values(u, at_values);
        }
        if (uses(Kind::gradient))
        {
          at_gradients.assign(n, std::vector<Tensor<1, dim>>(n_components));
          values.get_function_gradients(u, at_gradients);
        }
        if (uses(Kind::hessian))
        {
          at_hessians.assign(n, std::vector<Tensor<2, dim>>(n_components));
          values.get_function_hessians(u, at_hessians);
        }
        if (uses(Kind::normal))
          at_normals = values.get_normal_vectors();
        if (node_values)
          evaluate_flux(*node_values, cell);
        for (std::size_t k = 0; k < quantities.size(); ++k)
          for (unsigned q = 0; q < n; ++q)
            sum.quantity(k)[q] = value(quantities[k], q);
        sum.add();
      }

    private:
      void evaluate_flux(const FEValuesBase<dim> &node_values, const typename DoFHandler<dim>::active_cell_iterator &cell)
      {
        typename DoFHandler<dim>::active_cell_iterator(&*problem.space.mesh.triangulation, cell->level(), cell->index(), &*flux.nodes)
          ->get_dof_indices(nodes);
        fluxes.assign(node_values.n_quadrature_points, Flux{});
        for (unsigned i = 0; i < nodes.size(); ++i)
        {
          const Flux at_node = flux.at(nodes[i], cell->material_id());
          for (unsigned q = 0; q < fluxes.size(); ++q)
            for (std::size_t c = 0; c < at_node.size(); ++c)
              fluxes[q][c] += node_values.shape_value(i, q) * at_node[c];
        }
      }

      double value(const SolutionQuantity &quantity, const unsigned q) const
      {
        switch (quantity.kind)
        {
        case Kind::value:
          return at_values[q](quantity.i);
        case Kind::gradient:
          return at_gradients[q][quantity.i][quantity.j];
        case Kind::hessian:
          return at_hessians[q][0][quantity.i][quantity.j];
        case Kind::flux:
          return fluxes[q][quantity.i];
        case Kind::von_mises:
          return von_mises(fluxes[q]);
        case Kind::normal:
          return at_normals[q][quantity.i];
        default:
          throw std::logic_error("a quantity of constraint points on a cell");
        }
      }

      const Problem<dim>                      &problem;
      const Vector                            &u;
      const RecoveredFlux<dim>                &flux;
      const std::vector<SolutionQuantity>     &quantities;
      std::vector<types::global_dof_index>     nodes;
      std::vector<dealii::Vector<double>>      at_values;
      std::vector<std::vector<Tensor<1, dim>>> at_gradients;
      std::vector<std::vector<Tensor<2, dim>>> at_hessians;
      std::vector<Tensor<1, dim>>              at_normals;
      std::vector<Flux>                        fluxes;
    };

    /// The integral over cells (Values = FEValues) or faces (FEFaceValues) that are added one by one.
    template <int dim, typename Values>
    class Integral
    {
    public:
      template <typename Rule>
      Integral(
        const Problem<dim> &problem, const Rule &rule, QuantitiesAtPoints<dim> &quantities, WeightedSum &sum, const DoFHandler<dim> &nodes)
        : quantities(quantities), sum(sum), values(*problem.space.mapping, *problem.space.fe, rule, quantities.flags())
      {
        if (quantities.uses_flux())
          node_values.emplace(*problem.space.mapping, nodes.get_fe(), rule, update_values);
      }

      template <typename... Face>
      void add(const typename DoFHandler<dim>::active_cell_iterator &cell, const Face... face)
      {
        values.reinit(cell, face...);
        if (node_values)
          node_values->reinit(typename Triangulation<dim>::cell_iterator(cell), face...);
        quantities.add(values, node_values ? &*node_values : nullptr, cell, sum);
      }

    private:
      QuantitiesAtPoints<dim> &quantities;
      WeightedSum             &sum;
      Values                   values;
      std::optional<Values>    node_values; ///< of the recovered flux
    };

    template <int dim>
    void add_cells(const Problem<dim> &problem, const Functional &functional, Integral<dim, FEValues<dim>> &&integral)
    {
      const auto region = number_of(problem.space.mesh.region_names, functional.region);
      for (const auto &cell : problem.space.dof_handler.active_cell_iterators())
        if (functional.region.empty() || cell->material_id() == region)
          integral.add(cell);
    }

    template <int dim>
    void add_faces(const Problem<dim> &problem, const Functional &functional, Integral<dim, FEFaceValues<dim>> &&integral)
    {
      const auto part = number_of(problem.space.mesh.part_names, functional.on);
      for (const auto &cell : problem.space.dof_handler.active_cell_iterators())
        for (const auto face : cell->face_indices())
          if (cell->at_boundary(face) && cell->face(face)->boundary_id() == part)
            integral.add(cell, face);
    }

    /// Why the functional cannot be computed; empty: it can.
    template <int dim>
    std::string objection(const Problem<dim> &problem, const Functional &functional)
    {
      const auto &mesh = problem.space.mesh;
      const bool  in_domain = functional.on == "domain";
      if (std::string reason = why_no_such_place(functional.on, functional.region, mesh.part_names, mesh.region_names); !reason.empty())
        return reason;
      const auto used = used_quantities(problem, functional);
      if (used.size() < functional.integrand.quantities.size())
        return fmt::format("the integrand uses {}, not all of which this problem has: {}", fmt::join(functional.integrand.quantities, ", "),
                           fmt::join(names_of(solution_quantities(problem.form->n_components(), problem.form->order(), dim)), ", "));
      if (!at_constraint_points(used))
      {
        for (const SolutionQuantity &quantity : used)
          if (quantity.kind == Kind::normal && in_domain)
            return fmt::format("'{}' is a component of the normal: it needs a part of the boundary, on = \"...\"", quantity.name);
        return "";
      }
      if (!functional.region.empty())
        return "an integrand with pressure or gap is summed over the points of a constraint and takes no 'region'";
      if (std::none_of(problem.conditions.begin(), problem.conditions.end(),
                       [&](const UnilateralCondition &condition)
                       { return in_domain ? condition.on.empty() : condition.on == functional.on; }))
        return fmt::format("there is no pressure and no gap {}: no constraint acts there{}",
                           in_domain ? "in the domain" : "on '" + functional.on + "'",
                           in_domain ? "; name the part of the boundary, on = \"...\"" : "");
      const bool body = problem.form->n_components() > 1;
      for (const SolutionQuantity &quantity : used)
        if (!quantity.at_constraint_points_only() && quantity.kind != (body ? Kind::normal : Kind::value))
          return fmt::format(
            "'{}' is not known at the points of a constraint, where pressure and gap are; beside these an integrand can use "
            "{} there",
            quantity.name, body ? "the direction nx, ny, .." : "u");
      return "";
    }
  } // namespace

  template <int dim>
  void check_functionals(const Problem<dim> &problem)
  {
    Diagnostics diagnostics;
    for (const Functional &functional : problem.statement.functionals)
      if (const std::string message = objection(problem, functional); !message.empty())
        diagnostics.error(functional.where, fmt::format("functional '{}': {}", functional.name, message),
                          MessageName("functional-undefined"));
    diagnostics.throw_if_errors();
  }

  template <int dim>
  std::vector<FunctionalResult> functional_values(const Problem<dim>       &problem,
                                                  const ConstraintSet<dim> &constraint_set,
                                                  const Vector             &u,
                                                  const Vector             &lambda,
                                                  const RecoveredFlux<dim> &flux)
  {
    std::vector<FunctionalResult> results;
    for (const Functional &functional : problem.statement.functionals)
    {
      const auto              running = problem.time_by_part.run("functionals");
      const auto              used = used_quantities(problem, functional);
      QuantitiesAtPoints<dim> quantities(problem, u, flux, used);
      WeightedSum             sum(functional, used.size());
      if (at_constraint_points(used))
        add_constraint_points(constraint_set, u, lambda, functional, used, sum);
      else if (functional.on == "domain")
        add_cells(problem, functional, {problem, problem.cell_quadrature(), quantities, sum, *flux.nodes});
      else
        add_faces(problem, functional, {problem, problem.face_quadrature(), quantities, sum, *flux.nodes});
      results.push_back({functional.name, problem.space.processes().sum(sum.value)});
    }
    return results;
  }

#define INSTANTIATE(dim)                                                                                                                   \
  template void                          check_functionals(const Problem<dim> &);                                                          \
  template std::vector<FunctionalResult> functional_values(const Problem<dim> &, const ConstraintSet<dim> &, const Vector &,               \
                                                           const Vector &, const RecoveredFlux<dim> &);
  INSTANTIATE(1)
  INSTANTIATE(2)
  INSTANTIATE(3)
#undef INSTANTIATE
} // namespace unilateral
