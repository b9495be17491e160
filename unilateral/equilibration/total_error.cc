#include "unilateral/equilibration/total_error.h"

#include "unilateral/discretisation/cut_faces.h"
#include "unilateral/equilibration/best_flux.h"
#include "unilateral/equilibration/body_error.h"
#include "unilateral/equilibration/face_balance.h"
#include "unilateral/equilibration/feasible_state.h"
#include "unilateral/equilibration/flows_across_cuts.h"
#include "unilateral/equilibration/jumping_values.h"
#include "unilateral/equilibration/reference_fluxes.h"
#include "unilateral/equilibration/sampled_data.h"
#include "unilateral/equilibration/steps_together.h"
#include "unilateral/forms/adapted_face_values.h"
#include "unilateral/forms/elasticity.h"
#include "unilateral/forms/membrane.h"
#include "unilateral/mesh/gauss_rule.h"
#include "unilateral/mesh/subdivided_rule.h"

#include <deal.II/base/quadrature_lib.h>
#include <deal.II/base/symmetric_tensor.h>

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>
#include <optional>

namespace unilateral
{
  using namespace dealii;

  namespace
  {
    /// The fields of moments are dense matrices: too large for high degrees in space.
    constexpr unsigned    largest_space = 1000;
    constexpr std::size_t most_cells = 400000;

    /// Of the square of the load over the domain, from the rule of the cells to one of halved cells. Jumps inside cells come to some
    /// per cent.
    constexpr double largest_load_change = 0.25;

    template <int dim>
    std::string why_no_bound(const Problem<dim> &problem)
    {
      const auto &space = problem.space;
      if (!dynamic_cast<const Membrane<dim> *>(problem.form.get()))
        return "it is offered for membranes and elastic bodies";
      if (!problem.symmetric())
        return "the form has a velocity: its solution minimises no energy";
      if (space.mesh.curved || space.mesh.curved_cells || space.mesh.approximates_curves)
        return "the domain has a curved boundary, which the cells only approximate";
      if (!problem.prescribed.periodic.empty())
        return "parts of the boundary are periodic";
      if (space.processes().max(space.mesh.triangulation->n_active_cells()) > most_cells)
        return fmt::format("the mesh has more than {} cells", most_cells);
      for (const UnilateralCondition &condition : problem.conditions)
        if (condition.bound.sample_spacing() > 0)
          return "a bound is known at samples only";
      if (const std::string data = data_known_at_samples(problem.statement); !data.empty())
        return data;
      if (std::none_of(problem.prescribed.conditions.begin(), problem.prescribed.conditions.end(),
                       [](const auto &c) { return bool(c.value); }))
        return "no part of the boundary has prescribed values";
      return "";
    }

    /// Boundary data jump where no point of a rule on the face lies: the bound would be that of other data.
    template <int dim>
    bool boundary_data_jump_beyond_points(const Problem<dim> &problem)
    {
      std::vector<std::vector<FieldFunction>> functions; // by part
      for (types::boundary_id part = 0; part < problem.space.mesh.part_names.size(); ++part)
        functions.push_back(
          not_constant(problem.form->has_face_terms(part) ? problem.form->face_functions(part) : std::vector<FieldFunction>()));
      if (std::all_of(functions.begin(), functions.end(), [](const auto &of_part) { return of_part.empty(); }))
        return false;
      AdaptedFaceValues<dim> values(*problem.space.mapping, *problem.space.fe, problem.face_quadrature(), update_quadrature_points);
      for (const auto &cell : problem.space.dof_handler.active_cell_iterators())
        for (const auto face : cell->face_indices())
          if (cell->at_boundary(face) && values.jumps_beyond_points(cell, face, functions[cell->face(face)->boundary_id()]))
            return true;
      return false;
    }

    /// The bound, cell by cell.
    template <int dim>
    class Equilibration
    {
    public:
      Equilibration(const Problem<dim> &problem, const Vector &u, const std::vector<Vector> &pressures, const RecoveredFlux<dim> &flux)
        : problem(problem), membrane(dynamic_cast<const Membrane<dim> &>(*problem.form)), flux(flux), state(problem, u, pressures),
          cuts(problem), simplex(problem.space.element.simplex()), triangulation(*problem.space.mesh.triangulation),
          fields(simplex, simplex ? std::min(problem.space.element.degree, 2u) : problem.space.element.degree)
      {
        const unsigned degree = problem.space.element.degree;
        add_rules(gauss_rule<dim>(simplex, degree + 3));
        for (const auto &face : fields.faces)
          at_faces.emplace_back(*problem.space.fe, face.rule);
      }

      /// Of several processes each has done a step before any goes on to the next: those who find a reason for no bound tell the others.
      TotalError run()
      {
        TotalError       result;
        const Processes &processes = problem.space.processes();
        result.reason = cuts.conform() ? state.obstacle() : "cells of different processes do not conform";
        result.reason = first_reason(result.reason, processes);
        const auto step = [&](const auto &act) { step_together(result.reason, processes, act); };
        step([&] { collect_moments(result); });
        load_square = processes.sum(load_square);
        fine_load_square = processes.sum(fine_load_square);
        result.load_unresolved = std::abs(fine_load_square - load_square) > largest_load_change * fine_load_square;
        if (result.reason.empty() && result.load_unresolved)
          result.reason = "the load varies within cells by more than their rules can follow";
        if (result.reason.empty())
          balance(result); // collective
        result.reason = first_reason(result.reason, processes);
        step([&] { add_up(result); });
        if (result.reason.empty())
          sum_up(result); // collective
        result.available = result.reason.empty();
        return result;
      }

    private:
      using Cell = typename DoFHandler<dim>::active_cell_iterator;

      /// A rule for cells, with what is needed at its points.
      struct CellRule
      {
        CellRule(const Problem<dim> &problem, const ReferenceFluxes<dim> &fields, const Quadrature<dim> &rule)
          : element(*problem.space.fe, rule), fluxes(fields, rule), tests(fields.cell_tests_at(rule.get_points()))
        {
        }
        TabulatedElement<dim> element;
        BestFlux<dim>         fluxes;
        Eigen::MatrixXd       tests; ///< of the divergences
      };

      void add_rules(const Quadrature<dim> &rule)
      {
        plain.emplace(problem, fields, rule);
        fine.emplace(problem, fields, subdivided(rule, simplex, dim == 3 ? 1 : 2));
      }

      /// f + rho - c u at the points: what -div y is to be. rho counts with the sign of the force on u.
      void right_hand_side(const Cell &cell, const typename StraightCell<dim>::AtPoints &at, const typename FeasibleState<dim>::AtPoints &v)
      {
        const auto &coefficients = membrane.coefficients_in(cell->material_id());
        coefficients.load.values(at.x, F);
        coefficients.reaction.values(at.x, reaction);
        data_may_jump = varies_much(F) || varies_much(reaction);
        for (unsigned q = 0; q < F.size(); ++q)
        {
          F[q] -= reaction[q] * v.u[q];
          for (std::size_t b = 0; b < v.pressure.size(); ++b)
            if (!problem.conditions[b].part)
              F[q] += (problem.conditions[b].side == Side::lower ? 1 : -1) * v.pressure[b][q];
        }
      }

      /// By so much that the rule for polynomials may see too little of what k and 1/k do within the cell.
      bool stiffness_varies(const Cell &cell, const std::vector<Point<dim>> &points) const
      {
        constexpr double little = 1.05;
        if (membrane.uniform_in(cell->material_id()))
          return false;
        double least = std::numeric_limits<double>::infinity(), most = 0;
        membrane.prepare(cell->material_id(), points);
        for (const Point<dim> &x : points)
        {
          const double k = trace(membrane.coefficients_in(cell->material_id()).stiffness_tensor(x));
          least = std::min(least, k);
          most = std::max(most, k);
        }
        return most > little * least;
      }

      bool prescribed_on(const types::boundary_id part) const { return bool(problem.prescribed.conditions[part].value); }

      /// g - s u + rho on a part without prescribed values: what y.n is to be there.
      void normal_flux_of_data(const types::boundary_id                     part,
                               const typename StraightCell<dim>::AtPoints  &at,
                               const typename FeasibleState<dim>::AtPoints &v)
      {
        const auto &terms = membrane.terms_on(part);
        terms.flux.values(at.x, G);
        terms.spring.values(at.x, spring);
        for (unsigned q = 0; q < G.size(); ++q)
        {
          G[q] -= spring[q] * v.u[q];
          for (std::size_t b = 0; b < v.pressure.size(); ++b)
            if (problem.conditions[b].part && *problem.conditions[b].part == part)
              G[q] += (problem.conditions[b].side == Side::lower ? 1 : -1) * v.pressure[b][q];
        }
      }

      /// dS of a face in the parameters of its rule.
      static double area_element(const typename StraightCell<dim>::AtPoints &at, const Tensor<1, dim> &normal, const unsigned q)
      {
        return (at.determinant[q] * (transpose(at.inverse[q]) * normal)).norm();
      }

      /// Moments of the recovered flux, or of the data, on faces, and of -F on cells; d = moments of y.
      void collect_moments(TotalError &result)
      {
        const std::size_t n_cells = triangulation.n_active_cells();
        moments = Eigen::MatrixXd::Zero(fields.n_moments(), n_cells);
        imbalance.assign(n_cells, 0.);
        stiffness.assign(n_cells, 1.);
        uses_fine.assign(n_cells, false);
        std::vector<types::global_dof_index> nodes(flux.nodes->get_fe().n_dofs_per_cell());
        for (const auto &cell : problem.space.dof_handler.active_cell_iterators())
        {
          const std::size_t       c = cell->active_cell_index();
          const StraightCell<dim> straight{typename Triangulation<dim>::cell_iterator(cell)};
          if (dim == 3 && !straight.affine())
          {
            result.reason = "some hexahedra are no parallelepipeds";
            return;
          }
          auto at = straight.at(plain->element);
          state.evaluate(cell, straight, plain->element, at, FeasibleState<dim>::Wanted::values, v);
          if (state.bound_jumps(cell, straight, at, v))
          {
            result.reason = "a bound jumps where it is touched, which a bound of the error does not cover";
            return;
          }
          right_hand_side(cell, at, v);
          look_for_detail(cell, straight, at);
          const CellRule *rule = &*plain;
          if (v.kink || v.rough || state.at_free_boundary(cell) || data_may_jump || stiffness_varies(cell, at.x))
          {
            uses_fine[c] = true;
            rule = &*fine;
            at = straight.at(rule->element);
            state.evaluate(cell, straight, rule->element, at, FeasibleState<dim>::Wanted::u_and_pressure, v);
            right_hand_side(cell, at, v);
          }
          double scale = 0;
          for (unsigned q = 0; q < rule->element.size(); ++q)
          {
            const double f = F[q] * rule->element.weights[q] * at.determinant[q];
            scale += std::abs(f);
            for (unsigned i = 0; i < fields.n_cell_tests; ++i)
              moments(fields.cell_moment(i), c) -= f * rule->tests(q, i);
          }
          stiffness[c] =
            std::max(trace(membrane.coefficients_in(cell->material_id()).stiffness_tensor(straight_centre(straight, cell))) / dim, 1e-300);

          typename DoFHandler<dim>::active_cell_iterator(&triangulation, cell->level(), cell->index(), flux.nodes)->get_dof_indices(nodes);
          double outflow = 0;
          for (const unsigned f : cell->face_indices())
          {
            scale += add_moments_of_face(cell, straight, f, nodes);
            outflow += moments(fields.face_moment(f, 0), c);
          }
          imbalance[c] = moments(fields.cell_moment(0), c) - outflow;
          largest_scale = std::max(largest_scale, scale);
        }
      }

      /// The square of the load as two rules see it. Where they differ there may be more than either does: a pole, whose square has no
      /// integral, a peak between points.
      void look_for_detail(const Cell &cell, const StraightCell<dim> &straight, const typename StraightCell<dim>::AtPoints &at)
      {
        const FieldFunction &load = membrane.coefficients_in(cell->material_id()).load;
        if (load.is_constant())
          return;
        load.values(at.x, load_at_points);
        for (unsigned q = 0; q < at.x.size(); ++q)
          load_square += plain->element.weights[q] * at.determinant[q] * load_at_points[q] * load_at_points[q];
        const auto at_more = straight.at(fine->element);
        load.values(at_more.x, load_at_points);
        for (unsigned q = 0; q < at_more.x.size(); ++q)
          fine_load_square += fine->element.weights[q] * at_more.determinant[q] * load_at_points[q] * load_at_points[q];
      }

      /// Those of the normal flux, given or recovered at the @p nodes of the cell; returns the integral of its size.
      double add_moments_of_face(const Cell                                 &cell,
                                 const StraightCell<dim>                    &straight,
                                 const unsigned                              f,
                                 const std::vector<types::global_dof_index> &nodes)
      {
        const auto       &face = fields.faces[f];
        const auto        at_face = straight.at(at_faces[f]);
        const bool        given = problem.space.is_outside(cell, f) && !prescribed_on(cell->face(f)->boundary_id());
        std::vector<Flux> nodal(nodes.size());
        if (given)
        {
          state.evaluate(cell, straight, at_faces[f], at_face, FeasibleState<dim>::Wanted::u_and_pressure, v_on_face);
          normal_flux_of_data(cell->face(f)->boundary_id(), at_face, v_on_face);
        }
        else
          for (unsigned i = 0; i < nodes.size(); ++i)
            nodal[i] = between_regions(cuts, cell, f) ? flux.mean_at(nodes[i]) : flux.at(nodes[i], cell->material_id());
        double size = 0;
        for (unsigned q = 0; q < face.rule.size(); ++q)
        {
          double density = 0;
          if (given)
            density = G[q] * area_element(at_face, face.normal, q);
          else
          {
            Tensor<1, dim> recovered;
            for (unsigned i = 0; i < nodes.size(); ++i)
              for (unsigned d = 0; d < dim; ++d)
                recovered[d] += at_faces[f].values(q, i) * nodal[i][d];
            density = at_face.determinant[q] * ((at_face.inverse[q] * recovered) * face.normal);
          }
          density *= face.rule.weight(q);
          size += std::abs(density);
          for (unsigned i = 0; i < fields.n_face_tests; ++i)
            moments(fields.face_moment(f, i), cell->active_cell_index()) += density * face.tests(q, i);
        }
        return size;
      }

      static Point<dim> straight_centre(const StraightCell<dim> &straight, const Cell &cell)
      {
        Point<dim> centre;
        for (const unsigned vertex : cell->vertex_indices())
          centre += straight.vertex(vertex) / cell->n_vertices();
        return centre;
      }

      /// Adds flows through faces until every cell is in balance.
      void balance(TotalError &result)
      {
        std::vector<bool> closed;
        for (const PartCondition &condition : problem.prescribed.conditions)
          closed.push_back(!condition.value);
        FlowsAcrossCuts<dim> across(problem, cuts, closed);
        std::vector<double>  inside(imbalance);
        across.solve(inside);
        largest_scale = problem.space.processes().max(largest_scale);
        FaceBalance<dim> flows(triangulation, closed, stiffness);
        try
        {
          flows.solve(inside);
        }
        catch (const std::runtime_error &)
        {
          result.reason = "the flows between cells could not be balanced";
          return;
        }
        double worst = 0;
        for (const auto &cell : triangulation.active_cell_iterators())
        {
          const std::size_t c = cell->active_cell_index();
          double            rest = imbalance[c];
          for (const unsigned f : cell->face_indices())
          {
            const auto  &face = fields.faces[f];
            const double flow = flows.flow(c, f) + across.flow(c, f);
            rest -= flow;
            double area = 0;
            for (const double weight : face.rule.get_weights())
              area += weight;
            for (unsigned q = 0; q < face.rule.size(); ++q)
              for (unsigned i = 0; i < fields.n_face_tests; ++i)
                moments(fields.face_moment(f, i), c) += flow / area * face.rule.weight(q) * face.tests(q, i);
          }
          worst = std::max(worst, std::abs(rest));
        }
        if (worst > 1e-9 * largest_scale)
          result.reason = "the flows between cells could not be balanced";
      }

      static double least_eigenvalue(const Tensor<2, dim> &k) { return eigenvalues(SymmetricTensor<2, dim>(symmetrize(k)))[dim - 1]; }

      /// k and its inverse at points of a cell.
      struct Stiffness
      {
        std::vector<Tensor<2, dim>> k, inverse;
        double                      least = std::numeric_limits<double>::max(); ///< eigenvalue there and at vertices
        bool                        uniform = true;                             ///< known not to vary
      };

      Stiffness stiffness_at(const Cell &cell, const std::vector<Point<dim>> &x) const
      {
        const auto &coefficients = membrane.coefficients_in(cell->material_id());
        Stiffness   result;
        for (const FieldFunction &entry : coefficients.stiffness)
        {
          entry.prepare(x);
          result.uniform = result.uniform && entry.is_constant();
        }
        for (const Point<dim> &point : x)
        {
          result.k.push_back(coefficients.stiffness_tensor(point));
          result.inverse.push_back(invert(result.k.back()));
          result.least = std::min(result.least, least_eigenvalue(result.k.back()));
          if (result.uniform)
          {
            result.k.resize(x.size(), result.k.back());
            result.inverse.resize(x.size(), result.inverse.back());
            return result;
          }
        }
        for (unsigned v = 0; v < cell->n_vertices(); ++v)
          result.least = std::min(result.least, least_eigenvalue(coefficients.stiffness_tensor(cell->vertex(v))));
        return result;
      }

      void add_up(TotalError &result)
      {
        of_midpoint.assign(triangulation.n_active_cells(), 0.);
        of_radius = of_oscillation = of_midpoint;
        for (const auto &cell : problem.space.dof_handler.active_cell_iterators())
        {
          const std::size_t       c = cell->active_cell_index();
          const StraightCell<dim> straight{typename Triangulation<dim>::cell_iterator(cell)};
          CellRule               &rule = uses_fine[c] ? *fine : *plain;
          const auto              at = straight.at(rule.element);
          const unsigned          n_q = rule.element.size();
          state.evaluate(cell, straight, rule.element, at, FeasibleState<dim>::Wanted::values_and_gradients, v);
          right_hand_side(cell, at, v);
          const Stiffness stiff = stiffness_at(cell, at.x);
          if (!(stiff.least > 0))
          {
            result.reason = "the stiffness is not positive everywhere";
            return;
          }
          const Eigen::VectorXd coefficients =
            rule.fluxes.coefficients(moments.col(c), straight, at, stiff.inverse, stiff.uniform, v.v_gradient);
          const Eigen::VectorXd y_hat = rule.fluxes.values * coefficients, divergence = rule.fluxes.divergences * coefficients;
          const double          midpoint_before = to_midpoint;
          double                cell_misfit = 0, cell_contact = 0, residual = 0, cell_reaction = 0;
          for (unsigned q = 0; q < n_q; ++q)
          {
            const double   w = rule.element.weights[q] * at.determinant[q];
            Tensor<1, dim> y;
            for (unsigned d = 0; d < dim; ++d)
              y[d] = y_hat(q * dim + d) / at.determinant[q];
            y = at.jacobian[q] * y;
            const Tensor<2, dim> &k = stiff.k[q], &inverse_k = stiff.inverse[q];
            const Tensor<1, dim>  v_minus_u = v.v_gradient[q] - v.u_gradient[q];
            const Tensor<1, dim>  difference = y - k * v.v_gradient[q];
            const Tensor<1, dim>  from_midpoint = k * v.u_gradient[q] - 0.5 * (y + k * v.v_gradient[q]);
            const double          rise = v.v[q] - v.u[q];
            cell_misfit += w * (difference * (inverse_k * difference));
            cell_reaction += w * reaction[q] * rise * rise;
            to_midpoint += w * (from_midpoint * (inverse_k * from_midpoint) + reaction[q] * rise * rise / 4);
            distance += w * (v_minus_u * (k * v_minus_u) + reaction[q] * rise * rise);
            for (std::size_t b = 0; b < v.pressure.size(); ++b)
              if (!problem.conditions[b].part)
                cell_contact += w * v.pressure[b][q] * v.distance[b][q];
            const double osc = F[q] + divergence(q) / at.determinant[q];
            residual += w * osc * osc;
          }
          // By Poincare's inequality, or by the reaction alone where that is more.
          const double least_reaction = *std::min_element(reaction.begin(), reaction.begin() + n_q);
          double       per_residual = straight.diameter() / (std::numbers::pi * std::sqrt(stiff.least));
          if (least_reaction > 0)
            per_residual = std::min(per_residual, 1 / std::sqrt(least_reaction));
          double cell_oscillation = per_residual * std::sqrt(residual);
          for (const unsigned f : cell->face_indices())
            if (problem.space.is_outside(cell, f) && !prescribed_on(cell->face(f)->boundary_id()))
            {
              const double on_face = add_face(cell, straight, f, coefficients, stiff.least, cell_contact, cell_reaction);
              cell_oscillation += on_face;
              if (on_face > 0 && !straight.affine())
              {
                result.reason = "boundary data vary on quadrilaterals that are no parallelograms";
                return;
              }
            }
          misfit += cell_misfit;
          reaction_misfit += cell_reaction;
          contact += cell_contact;
          oscillation += cell_oscillation * cell_oscillation;
          of_midpoint[c] = to_midpoint - midpoint_before;
          of_radius[c] = (cell_misfit + cell_reaction) / 4 + cell_contact;
          of_oscillation[c] = cell_oscillation * cell_oscillation;
        }
      }

      /// The bound from the sums over the cells of all processes, and its part in each cell.
      void sum_up(TotalError &result)
      {
        std::array<double *, 6> sums = {&misfit, &reaction_misfit, &contact, &oscillation, &distance, &to_midpoint};
        for (double *const sum : sums)
          *sum = problem.space.processes().sum(*sum);
        result.flux_misfit = std::sqrt(misfit);
        result.contact_misfit = contact;
        result.data_oscillation = std::sqrt(oscillation);
        const double N = misfit + reaction_misfit, Q = N / 2 + contact, O = result.data_oscillation;
        const double to_v = O + std::sqrt(2 * Q + oscillation);
        const double radius = std::sqrt(std::max(0., N / 4 + contact + O * to_v));
        result.bound = std::min(std::sqrt(distance) + to_v, std::sqrt(to_midpoint) + radius);
        // (a + r)^2 = (1 + r/a) a^2 + (1 + a/r) r^2, and a^2, r^2 are sums over cells.
        const double a = std::sqrt(to_midpoint);
        for (std::size_t c = 0; c < of_midpoint.size(); ++c)
          result.cell_squares.push_back((a > 0 ? 1 + radius / a : 0.) * of_midpoint[c] +
                                        (radius > 0 ? 1 + a / radius : 0.) * (of_radius[c] + (O > 0 ? to_v / O : 0.) * of_oscillation[c]));
      }

      /// What a face with given flux adds; returns the weight of its oscillation: C ||k^(-1/2) (G - y.n)||,
      /// ||w||_E <= C ||grad w||_K for w of mean zero on K, C^2 = |E|/|K| h/pi (h/pi + 2 h).
      double add_face(const Cell              &cell,
                      const StraightCell<dim> &straight,
                      const unsigned           f,
                      const Eigen::VectorXd   &coefficients,
                      const double             least,
                      double                  &cell_contact,
                      double                  &cell_misfit)
      {
        const auto  part = cell->face(f)->boundary_id();
        const auto &face = fields.faces[f];
        const auto  at = straight.at(at_faces[f]);
        state.evaluate(cell, straight, at_faces[f], at, FeasibleState<dim>::Wanted::values, v_on_face);
        normal_flux_of_data(part, at, v_on_face);
        const Eigen::VectorXd y = fields.values_at(face.rule.get_points()) * coefficients;
        double                residual = 0, size = 0, area = 0;
        for (unsigned q = 0; q < face.rule.size(); ++q)
        {
          const double dS = area_element(at, face.normal, q), w = dS * face.rule.weight(q);
          double       normal_flux = 0;
          for (unsigned d = 0; d < dim; ++d)
            normal_flux += face.normal[d] * y(q * dim + d) / dS;
          const double rise = v_on_face.v[q] - v_on_face.u[q];
          residual += w * std::pow(G[q] - normal_flux, 2);
          size += w * G[q] * G[q];
          area += w;
          cell_misfit += w * spring[q] * rise * rise;
          to_midpoint += w * spring[q] * rise * rise / 4;
          distance += w * spring[q] * rise * rise;
          for (std::size_t b = 0; b < v_on_face.pressure.size(); ++b)
            if (problem.conditions[b].part && *problem.conditions[b].part == part)
              cell_contact += w * v_on_face.pressure[b][q] * v_on_face.distance[b][q];
        }
        if (residual <= 1e-24 * size)
          return 0;
        const double h = straight.diameter(), volume = cell->measure();
        return std::sqrt(area / volume * h / std::numbers::pi * (h / std::numbers::pi + 2 * h) * residual / least);
      }

      const Problem<dim>                   &problem;
      const Membrane<dim>                  &membrane;
      const RecoveredFlux<dim>             &flux;
      FeasibleState<dim>                    state;
      const CutFaces<dim>                   cuts;
      const bool                            simplex;
      const Triangulation<dim>             &triangulation;
      const ReferenceFluxes<dim>            fields;
      std::optional<CellRule>               plain, fine; ///< the latter where v or the pressure has a kink
      std::vector<TabulatedElement<dim>>    at_faces;
      Eigen::MatrixXd                       moments; ///< columns: active cells
      std::vector<double>                   imbalance, stiffness;
      std::vector<bool>                     uses_fine;
      double                                largest_scale = 0;
      typename FeasibleState<dim>::AtPoints v, v_on_face; ///< on the current cell, face
      std::vector<double>                   F, reaction, G, spring;
      std::vector<double>                   load_at_points;
      double                                load_square = 0, fine_load_square = 0; ///< see look_for_detail()
      double              misfit = 0, reaction_misfit = 0, contact = 0, oscillation = 0, distance = 0, to_midpoint = 0; ///< sums over cells
      std::vector<double> of_midpoint, of_radius, of_oscillation;                                                       ///< by active cell
      bool                data_may_jump = false; ///< f or c in the current cell, as far as its points show
    };
  } // namespace

  template <int dim>
  TotalError total_error(const Problem<dim> &problem, const Vector &u, const std::vector<Vector> &pressures, const RecoveredFlux<dim> &flux)
  {
    TotalError result;
    const bool body = dim > 1 && dynamic_cast<const Elasticity<dim> *>(problem.form.get());
    if (!body)
      result.reason = why_no_bound(problem);
    const unsigned p = problem.space.element.degree;
    if (!body && result.reason.empty() && !problem.space.element.simplex() && dim * (p + 2) * std::pow(p + 1, dim - 1) > largest_space)
      result.reason = fmt::format("it is offered for elements of lower degree than {}", p);
    if (!result.reason.empty())
      return result;
    if constexpr (dim > 1)
    {
      const std::string jump = reason_from(
        [&]
        {
          if (prescribed_values_jump(problem))
            result.reason = "the prescribed values jump: no function of finite energy has them";
          else if (boundary_data_jump_beyond_points(problem))
            result.reason = "what [boundary] says jumps or bends next to the end of a face, where no point of its rule lies";
        });
      result.reason = first_reason(jump.empty() ? result.reason : jump, problem.space.processes());
      if (!result.reason.empty())
        return result;
    }
    const std::string reason = reason_from(
      [&]
      {
        if constexpr (dim > 1)
          if (body)
            result = body_error(problem, u, pressures, flux);
        if (!body)
          result = Equilibration<dim>(problem, u, pressures, flux).run();
      });
    if (!reason.empty())
      result.reason = reason;
    if (result.available && !std::isfinite(result.bound))
    {
      result = {};
      result.reason = "the load or a coefficient is too large somewhere for a number: the energy may be infinite";
    }
    return result;
  }

  Estimate estimate_of(const TotalError &total, const Certificate &certificate, const double discretisation_indicator, const double epsilon)
  {
    Estimate estimate;
    if (certificate.available)
    {
      estimate.algebraic =
        epsilon > 0 ? std::min(certificate.algebraic_error, certificate.penalty_error_bound) : certificate.penalty_error_bound;
      estimate.penalty = certificate.penalty_error_bound - estimate.algebraic;
    }
    estimate.guaranteed = total.available;
    estimate.reason = total.reason;
    estimate.load_unresolved = total.load_unresolved;
    estimate.discretisation =
      total.available ? std::max(0., total.bound - estimate.penalty - estimate.algebraic) : discretisation_indicator;
    estimate.total = total.available ? total.bound : estimate.discretisation + estimate.penalty + estimate.algebraic;
    // Each of the other two is bounded by itself as well, which may be less sharp than the bound of all.
    if (const double others = estimate.penalty + estimate.algebraic; others > estimate.total)
      for (double *const part : {&estimate.penalty, &estimate.algebraic})
        *part *= estimate.total / others;
    return estimate;
  }

#define INSTANTIATE(dim)                                                                                                                   \
  template TotalError total_error(const Problem<dim> &, const Vector &, const std::vector<Vector> &, const RecoveredFlux<dim> &);
  INSTANTIATE(1)
  INSTANTIATE(2)
  INSTANTIATE(3)
#undef INSTANTIATE
} // namespace unilateral
