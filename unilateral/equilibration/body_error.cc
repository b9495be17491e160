#include "unilateral/equilibration/body_error.h"

#include "unilateral/equilibration/cell_stress.h"
#include "unilateral/equilibration/contact_gap.h"
#include "unilateral/equilibration/equilibrated_tractions.h"
#include "unilateral/equilibration/korn_constant.h"
#include "unilateral/equilibration/sampled_data.h"
#include "unilateral/equilibration/steps_together.h"
#include "unilateral/mesh/congruent_cells.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <deque>
#include <limits>

namespace unilateral
{
  using namespace dealii;

  namespace
  {
    template <int dim>
    std::string why_no_bound_of_body(const Problem<dim> &problem, const Elasticity<dim> &elasticity)
    {
      const auto       &space = problem.space;
      const std::size_t most_cells = dim == 2 ? 200000 : 30000;
      const unsigned    most_degree = dim == 2 ? 4 : space.element.simplex() ? 3 : 2;
      if (problem.axisymmetric())
        return "of bodies of revolution there is none";
      if (space.mesh.curved || space.mesh.curved_cells || space.mesh.approximates_curves)
        return "the domain has a curved boundary, which the cells only approximate";
      if (!problem.prescribed.periodic.empty())
        return "parts of the boundary are periodic";
      if (!space.couplings.rigid_parts.empty())
        return "a part of the boundary is rigid";
      if (space.processes().max(space.mesh.triangulation->n_active_cells()) > most_cells)
        return fmt::format("the mesh has more than {} cells", most_cells);
      if (space.element.degree > most_degree)
        return fmt::format("it is offered for elements of lower degree than {}", space.element.degree);
      for (const UnilateralCondition &condition : problem.conditions)
        if (condition.bound.sample_spacing() > 0)
          return "a gap is known at samples only";
      for (const UnilateralBound &bound : problem.statement.constraints)
        if (bound.surface && bound.surface->kind == SurfaceDescription::Kind::stl)
          return "an obstacle consists of triangles";
      if (const std::string data = data_known_at_samples(problem.statement); !data.empty())
        return data;
      for (const auto &cell : space.dof_handler.active_cell_iterators())
        if (elasticity.lame_parameters(cell->material_id(), cell->center()).reduced)
          return "changes of volume are integrated in a reduced way: of the energy with full integration, in which nearly incompressible "
                 "bodies lock, a bound would say little";
      return "";
    }

    /// That of the displacement; in the plane one more where loads vary, since what they are short of polynomials counts with a large
    /// constant.
    template <int dim>
    unsigned stress_degree(const Problem<dim> &problem, const Elasticity<dim> &elasticity)
    {
      bool varies = false;
      for (std::size_t region = 0; region < problem.space.mesh.region_names.size(); ++region)
        varies = varies || !elasticity.load_uniform_in(region);
      for (std::size_t part = 0; part < problem.space.mesh.part_names.size(); ++part)
        varies = varies || (elasticity.has_face_terms(part) && !elasticity.face_functions(part).empty());
      return problem.space.element.degree + (varies && dim == 2 ? 1 : 0);
    }

    /// Sums of squares and products over a part of the body.
    struct ErrorParts
    {
      double misfit = 0;      ///< ||C^(-1/2) (tau - sigma(v))||^2, and of springs
      double contact = 0;     ///< (rho, s - v.n)
      double distance = 0;    ///< ||v - u_h||_a^2
      double to_midpoint = 0; ///< ||u_h - m||^2, see total_error.h
      double oscillation = 0; ///< the factor of ||eps(u - v)||, not squared
    };

    template <int dim>
    class BodyEquilibration
    {
    public:
      BodyEquilibration(const Problem<dim>        &problem,
                        const Elasticity<dim>     &elasticity,
                        const Vector              &u,
                        const std::vector<Vector> &pressures,
                        const RecoveredFlux<dim>  &flux)
        : problem(problem), elasticity(elasticity), cells(problem, stress_degree(problem, elasticity)), v(problem, u, pressures),
          face_rule(rule_on_face<dim>(problem.space.element.simplex(), 2 * cells.degree + 8)),
          shapes(*problem.space.mesh.triangulation, *problem.space.mapping, uniform_regions())
      {
        reason = v.obstacle();
        if (!reason.empty())
          return;
        balanced.emplace(problem, elasticity, u, pressures, flux, v, cells); // collective
        reason = balanced->obstacle();
        const auto &tractions = balanced->tractions;
        for (unsigned f = 0; f < tractions.n_faces; ++f)
          at_faces.emplace_back(v.scalar(), on_reference_cell<dim>(tractions.simplex, f, face_rule));
        in_faces = tractions.basis.values_at(face_rule.get_points());
        for (std::size_t p = 0; p < balanced->pressure.size(); ++p)
          pressures_on[balanced->pressure[p].face].push_back(p);
      }

      TotalError run()
      {
        TotalError              result;
        std::vector<ErrorParts> parts;
        step_together(reason, problem.space.processes(),
                      [&]
                      {
                        for (const auto &cell : problem.space.dof_handler.active_cell_iterators())
                          if (reason.empty())
                            parts.push_back(on_cell(cell));
                      });
        result.reason = reason;
        if (reason.empty())
          add_up(parts, result); // collective
        return result;
      }

    private:
      using Cell = typename BodyCells<dim>::Cell;
      using OnCell = typename BodyCells<dim>::OnCell;
      using Law = ElasticLaw<dim>;

      std::vector<bool> uniform_regions() const
      {
        std::vector<bool> uniform;
        for (std::size_t region = 0; region < problem.space.mesh.region_names.size(); ++region)
          uniform.push_back(elasticity.uniform_in(region));
        return uniform;
      }

      Law law_at(const Cell &cell, const Point<dim> &x) const
      {
        const auto [lambda, mu, reduced] = elasticity.lame_parameters(cell->material_id(), x);
        return Law(lambda, mu);
      }

      /// What the stresses need: tractions on faces and the body load, in the coordinates of the stresses.
      Eigen::VectorXd data_on(const Cell &cell, const OnCell &on, std::vector<Tensor<1, dim>> &load)
      {
        constexpr unsigned n_modes = RigidMotions<dim>::n;
        const auto        &stresses = *on.stresses;
        const auto        &tractions = balanced->tractions;
        const std::size_t  c = cell->active_cell_index();
        const auto        &motions = balanced->motions[c];
        Eigen::VectorXd    data = Eigen::VectorXd::Zero(stresses.n_data());
        Eigen::VectorXd    forces = Eigen::VectorXd::Zero(n_modes); // that the load has to be in balance with
        for (const unsigned f : cell->face_indices())
        {
          const StraightFace<dim> geometry(cell, f);
          tractions.at_points(c, f, geometry, at_points);
          std::vector<Point<dim>> corners;
          for (const unsigned corner : cell->vertex_indices())
            corners.push_back(Point<dim>(on.inverse_J * (cell->vertex(corner) - on.origin)));
          const double growth = geometry.dS / StraightFace<dim>(corners, tractions.simplex, f).dS;
          for (unsigned q = 0; q < at_points.size(); ++q)
          {
            const Tensor<1, dim> in_coordinates = growth * (on.inverse_J * at_points[q]);
            const auto           modes = motions.at(geometry.at(tractions.rule.point(q)));
            for (unsigned k = 0; k < n_modes; ++k)
              forces(k) += tractions.rule.weight(q) * geometry.dS * (at_points[q] * modes[k]);
            for (unsigned m = 0; m < tractions.basis.size(); ++m)
              for (unsigned d = 0; d < dim; ++d)
                data(stresses.traction(f, m, d)) += tractions.rule.weight(q) * tractions.tests(q, m) * in_coordinates[d];
          }
        }
        add_load(cell, on, forces, load, data);
        return data;
      }

      /// The load as polynomials on the parts, with the moments that the tractions are in balance with.
      void
      add_load(const Cell &cell, const OnCell &on, const Eigen::VectorXd &forces, std::vector<Tensor<1, dim>> &load, Eigen::VectorXd &data)
      {
        constexpr unsigned n_modes = RigidMotions<dim>::n;
        const auto        &stresses = *on.stresses;
        const unsigned     n_q = on.rule->element.size(), n_k = stresses.n_divergence;
        const auto        &motions = balanced->motions[cell->active_cell_index()];
        Eigen::MatrixXd    modes = Eigen::MatrixXd::Zero(stresses.n_parts() * n_k * dim, n_modes);
        Eigen::VectorXd    moments = Eigen::VectorXd::Zero(modes.rows());
        elasticity.load_densities(cell->material_id(), on.at.x, load);
        size_of_load = 0;
        for (unsigned q = 0; q < n_q; ++q)
        {
          const double w = on.rule->element.weights[q];
          const auto   at = motions.at(on.at.x[q]);
          size_of_load += w * on.det * load[q].norm_square();
          for (unsigned k = 0; k < n_k; ++k)
            for (unsigned d = 0; d < dim; ++d)
            {
              const unsigned row = (on.rule->part[q] * n_k + k) * dim + d;
              moments(row) += w * on.rule->functions(q, k) * load[q][d];
              for (unsigned m = 0; m < n_modes; ++m)
                modes(row, m) += w * on.rule->functions(q, k) * at[m][d];
            }
        }
        // As seen by polynomials the load has moments about the cell that differ a little where it is none.
        const Eigen::VectorXd missing = -forces / on.det - modes.transpose() * moments;
        moments += modes * (modes.transpose() * modes).llt().solve(missing);
        for (unsigned j = 0; j < stresses.n_parts(); ++j)
          for (unsigned k = 0; k < n_k; ++k)
          {
            Tensor<1, dim> f;
            for (unsigned d = 0; d < dim; ++d)
              f[d] = moments((j * n_k + k) * dim + d);
            const Tensor<1, dim> in_coordinates = on.det * (on.inverse_J * f);
            for (unsigned d = 0; d < dim; ++d)
              data(stresses.divergence(j, k, d)) = -in_coordinates[d];
          }
        for (unsigned q = 0; q < n_q; ++q)
          for (unsigned k = 0; k < n_k; ++k)
            for (unsigned d = 0; d < dim; ++d)
              load[q][d] -= on.rule->functions(q, k) * moments((on.rule->part[q] * n_k + k) * dim + d);
      }

      const CellStress<dim> &stress_of(const Cell &cell, const OnCell &on, const Law &law)
      {
        const unsigned number = on.affine ? shapes(cell) : shapes.none;
        if (number != shapes.none)
        {
          if (number == known.size())
            known.emplace_back(on, law.compliance);
          return known[number];
        }
        own.emplace(on, law.compliance);
        return *own;
      }

      ErrorParts on_cell(const Cell &cell)
      {
        ErrorParts  parts;
        const bool  uniform = elasticity.uniform_in(cell->material_id()), varies = balanced->load_varies(cell);
        const auto  on = cells.on(cell, varies || !uniform || v.is_lifted(cell));
        const auto &rule = *on.rule;
        const auto &stresses = *on.stresses;
        const Law   law = law_at(cell, cell->center());
        v.evaluate(cell, rule.element, on.at, state);
        const Eigen::VectorXd  data = data_on(cell, on, load_rest);
        const CellStress<dim> &stress = stress_of(cell, on, law);
        Eigen::VectorXd        moments = Eigen::VectorXd::Zero(stresses.size());
        for (unsigned q = 0; q < rule.element.size(); ++q)
        {
          const StressVector<dim> strain = strain_of<dim>(transpose(on.J) * state.v_gradient[q] * on.J) * rule.element.weights[q];
          for (unsigned k = 0; k < stresses.n_scalar(); ++k)
            moments.template segment<Law::n>(stresses.index(rule.part[q], k, 0)) += rule.functions(q, k) * strain;
        }
        const Eigen::VectorXd coefficients = stress.closest(data, moments);
        double                rest = 0, least = std::numeric_limits<double>::max();
        for (unsigned q = 0; q < rule.element.size(); ++q)
        {
          const double            w = rule.element.weights[q] * on.det;
          const Law               here = uniform ? law : law_at(cell, on.at.x[q]);
          const StressVector<dim> in_u = strain_of<dim>(state.u_gradient[q]), in_v = strain_of<dim>(state.v_gradient[q]);
          StressVector<dim>       tau = StressVector<dim>::Zero();
          for (unsigned k = 0; k < stresses.n_scalar(); ++k)
            tau += rule.functions(q, k) * coefficients.template segment<Law::n>(stresses.index(rule.part[q], k, 0));
          tau = stress.to_stress * tau;
          const StressVector<dim> of_v = here.stiffness * in_v, difference = tau - of_v;
          const StressVector<dim> from_midpoint = here.stiffness * in_u - 0.5 * (tau + of_v);
          parts.misfit += w * difference.dot(here.compliance * difference);
          parts.to_midpoint += w * from_midpoint.dot(here.compliance * from_midpoint);
          parts.distance += w * (in_v - in_u).dot(here.stiffness * (in_v - in_u));
          least = std::min(least, here.least);
          if (varies)
            rest += w * load_rest[q].norm_square();
        }
        if (rest > 1e-24 * size_of_load)
          add_oscillation(cell, std::sqrt(rest / least), parts);
        for (const unsigned f : cell->face_indices())
          if (problem.space.is_outside(cell, f))
            on_face(cell, f, on, least, parts);
        return parts;
      }

      void add_oscillation(const Cell &cell, const double size, ErrorParts &parts)
      {
        if constexpr (dim == 2)
        {
          std::vector<Point<2>> ring = {cell->vertex(0), cell->vertex(1), cell->vertex(2)};
          if (cell->n_vertices() == 4)
            ring = {cell->vertex(0), cell->vertex(1), cell->vertex(3), cell->vertex(2)};
          parts.oscillation += korn_constant(ring).of_value * size;
        }
        else
          reason = "the load is no polynomial of the degree that the stresses have, which only plane meshes can take into account";
      }

      /// What a side has of data that are no polynomials, seen from the part of the split that it belongs to: with z = w - r, E the side
      /// and T the triangle, |T| the corner across taking part, 2 |T|/|E| ||z||_E^2 = int_T div(z^2 (x - corner)) <= 2 ||z||_T^2 + 2 h
      /// ||z||_T ||grad z||_T.
      void add_oscillation_of_face(const OnCell &on, const unsigned f, const double size, ErrorParts &parts)
      {
        if constexpr (dim == 2)
        {
          for (unsigned j = 0; j < on.stresses->n_parts(); ++j)
          {
            if (on.stresses->split.facets[j].face != f)
              continue;
            std::vector<Point<2>> ring;
            for (const auto &corner : on.stresses->split.part(j))
              ring.push_back(on.place(corner));
            const KornConstant C = korn_constant(ring);
            const double       height = 2 * on.stresses->split.volume(j) * on.det / ring[0].distance(ring[1]);
            parts.oscillation += size * std::sqrt((2 * C.of_value * C.of_value + 2 * C.diameter * C.of_value * C.of_gradient) / height);
          }
        }
        else
          reason =
            "the load on the boundary is no polynomial of the degree that the stresses have, which only plane meshes can take into account";
      }

      void on_face(const Cell &cell, const unsigned f, const OnCell &on, const double least, ErrorParts &parts)
      {
        const auto       &tractions = balanced->tractions;
        const std::size_t number = tractions.face_of(cell->active_cell_index(), f);
        const auto       &face = tractions.faces[number];
        const auto       &n = face.geometry.normal;
        if (face.open.size() == dim)
          return;
        const auto part = cell->face(f)->boundary_id();
        v.evaluate(cell, at_faces[f], on.straight.at(at_faces[f]), state);
        const auto own_pressures = pressures_on.find(number);
        double     rest = 0, size = 0;
        for (unsigned q = 0; q < face_rule.size(); ++q)
        {
          const double     w = face_rule.weight(q) * face.geometry.dS;
          const Point<dim> x = face.geometry.at(face_rule.point(q));
          Tensor<1, dim>   t, data = elasticity.surface_load(part, x, n);
          // The forces of springs are those of u + r.
          const Tensor<1, dim> springs = elasticity.springs(part, x), moved = state.u[q] + balanced->spring_shift(x),
                               rise = state.v[q] - moved, distance = state.v[q] - state.u[q],
                               from_midpoint = state.u[q] - 0.5 * (state.v[q] + moved);
          for (unsigned d = 0; d < dim; ++d)
          {
            data[d] -= springs[d] * moved[d];
            parts.misfit += w * springs[d] * rise[d] * rise[d];
            parts.distance += w * springs[d] * distance[d] * distance[d];
            parts.to_midpoint += w * springs[d] * from_midpoint[d] * from_midpoint[d];
          }
          if (own_pressures != pressures_on.end())
            for (const std::size_t p : own_pressures->second)
            {
              const auto  &pressure = balanced->pressure[p];
              const double rho = in_faces.row(q).dot(pressure.coefficients);
              data -= rho * n;
              if (const auto gap = contact_gap<dim>(problem.conditions[pressure.condition], x, n))
                parts.contact += w * std::max(rho, 0.) * std::max(0., *gap - state.v[q] * n);
              else
                reason = "there is contact pressure where no obstacle is";
            }
          for (unsigned m = 0; m < tractions.basis.size(); ++m)
            t += in_faces(q, m) * tractions.polynomial(number)[m];
          Tensor<1, dim> difference = data - t;
          for (const auto &direction : face.open)
            difference -= (difference * direction) * direction;
          rest += w * difference.norm_square();
          size += w * (data.norm_square() + t.norm_square());
        }
        if (rest > 1e-24 * size)
          add_oscillation_of_face(on, f, std::sqrt(rest / least), parts);
      }

      /// As of membranes: with X = ||u - v||, Y = ||sigma(u) - tau||, X^2 + Y^2 <= N^2 + 2 P + 2 O X.
      void add_up(const std::vector<ErrorParts> &parts, TotalError &result) const
      {
        ErrorParts sum;
        for (const ErrorParts &part : parts)
        {
          sum.misfit += part.misfit;
          sum.contact += part.contact;
          sum.distance += part.distance;
          sum.to_midpoint += part.to_midpoint;
          sum.oscillation += part.oscillation * part.oscillation;
        }
        for (double *const of_parts : {&sum.misfit, &sum.contact, &sum.distance, &sum.to_midpoint, &sum.oscillation})
          *of_parts = problem.space.processes().sum(*of_parts);
        const double O = std::sqrt(sum.oscillation), to_v = O + std::sqrt(sum.misfit + 2 * sum.contact + sum.oscillation);
        const double radius = std::sqrt(sum.misfit / 4 + sum.contact + O * to_v), a = std::sqrt(sum.to_midpoint);
        result.flux_misfit = std::sqrt(sum.misfit);
        result.contact_misfit = sum.contact;
        result.data_oscillation = O;
        result.bound = std::min(std::sqrt(sum.distance) + to_v, a + radius);
        result.available = std::isfinite(result.bound);
        if (!result.available)
          result.reason = "it is not finite";
        for (const ErrorParts &part : parts)
          result.cell_squares.push_back((a > 0 ? 1 + radius / a : 0.) * part.to_midpoint +
                                        (radius > 0 ? 1 + a / radius : 0.) *
                                          (part.misfit / 4 + part.contact + (O > 0 ? to_v / O : 0.) * part.oscillation * part.oscillation));
      }

      const Problem<dim>                             &problem;
      const Elasticity<dim>                          &elasticity;
      const BodyCells<dim>                            cells;
      const FeasibleDisplacement<dim>                 v;
      std::optional<EquilibratedTractions<dim>>       balanced;
      const Quadrature<dim - 1>                       face_rule; ///< finer than that of the tractions
      CellShapes<dim>                                 shapes;
      std::deque<CellStress<dim>>                     known; ///< by number of the shape
      std::optional<CellStress<dim>>                  own;   ///< of a cell that is like no other
      std::vector<TabulatedElement<dim>>              at_faces;
      Eigen::MatrixXd                                 in_faces;
      std::map<std::size_t, std::vector<std::size_t>> pressures_on; ///< by face
      typename FeasibleDisplacement<dim>::AtPoints    state;
      std::vector<Tensor<1, dim>>                     load_rest, at_points;
      double                                          size_of_load = 0; ///< its square on the cell
      std::string                                     reason;
    };
  } // namespace

  template <int dim>
  TotalError body_error(const Problem<dim> &problem, const Vector &u, const std::vector<Vector> &pressures, const RecoveredFlux<dim> &flux)
  {
    TotalError  result;
    const auto &elasticity = dynamic_cast<const Elasticity<dim> &>(*problem.form);
    result.reason = first_reason(why_no_bound_of_body(problem, elasticity), problem.space.processes());
    return result.reason.empty() ? BodyEquilibration<dim>(problem, elasticity, u, pressures, flux).run() : result;
  }

#define INSTANTIATE(dim)                                                                                                                   \
  template TotalError body_error(const Problem<dim> &, const Vector &, const std::vector<Vector> &, const RecoveredFlux<dim> &);
  INSTANTIATE(2)
  INSTANTIATE(3)
#undef INSTANTIATE
} // namespace unilateral
