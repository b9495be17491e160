#include "unilateral/equilibration/feasible_state.h"

#include "unilateral/mesh/subdivided_rule.h"

#include <deal.II/grid/reference_cell.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

namespace unilateral
{
  using namespace dealii;

  namespace
  {
    /// Of the change of a bound in a cell, what its interpolant may miss of it for the bound to count as smooth there: less where the
    /// pressure varies much, as it does where a bound oscillates.
    constexpr double largest_share_of_rest = 1e-2, largest_share_under_varying_pressure = 1e-4;

    bool changes_sign(const Eigen::MatrixXd::ConstColXpr &values)
    {
      return values.minCoeff() < 0 && values.maxCoeff() > 0;
    }

    /// Functions of V_h on a cell, one a column, by nodal values.
    class NodalColumns
    {
    public:
      NodalColumns(const std::vector<types::global_dof_index> &dofs, const unsigned n_functions)
        : dofs(dofs), nodal(dofs.size(), n_functions)
      {
      }

      /// The column that @p v has got.
      unsigned add(const Vector &v)
      {
        for (unsigned i = 0; i < dofs.size(); ++i)
          nodal(i, n) = v(dofs[i]);
        return n++;
      }

      unsigned size() const { return n; }

      /// The first @p n_columns; rows: points.
      Eigen::MatrixXd at(const Eigen::MatrixXd &table, const unsigned n_columns) const
      {
        return table.lazyProduct(nodal.leftCols(n_columns)); // too small to be packed for a product by blocks
      }

    private:
      const std::vector<types::global_dof_index> &dofs;
      Eigen::MatrixXd                             nodal;
      unsigned                                    n = 0;
    };

    /// dv/dx from dv/dx^.
    template <int dim>
    Tensor<1, dim> physical(const Tensor<1, dim> &reference, const Tensor<2, dim> &inverse_jacobian)
    {
      return transpose(inverse_jacobian) * reference;
    }
  } // namespace

  template <int dim>
  void FeasibleState<dim>::add_boundary_values(const Cell                                 &cell,
                                               const StraightCell<dim>                    &straight,
                                               const TabulatedElement<dim>                &tabulated,
                                               const typename StraightCell<dim>::AtPoints &at,
                                               AtPoints                                   &state) const
  {
    if constexpr (dim == 2)
    {
      const bool                           simplex = problem.space.element.simplex();
      const unsigned                       n = tabulated.size();
      std::vector<types::global_dof_index> dofs(problem.space.fe->n_dofs_per_cell());
      cell->get_dof_indices(dofs);
      for (const unsigned f : cell->face_indices())
      {
        if (!cell->at_boundary(f) || !lifted[cell->face(f)->boundary_id()])
          continue;
        // Where the lines that leave the face, or end in the opposite corner, meet it.
        std::vector<Point<dim>>     feet(n);
        std::vector<double>         fading(n);
        std::vector<Tensor<1, dim>> fading_gradient(n),
          foot_speed(n); // d(foot)/dx^ is edge x speed, without the factor 1 / fading on triangles
        Tensor<1, dim> edge;
        if (!simplex)
        {
          const unsigned direction = f / 2;
          const double   end = f % 2;
          edge[1 - direction] = 1;
          for (unsigned q = 0; q < n; ++q)
          {
            feet[q] = tabulated.points[q];
            feet[q][direction] = end;
            fading[q] = 1 - std::abs(tabulated.points[q][direction] - end);
            fading_gradient[q][direction] = end > 0 ? 1 : -1;
            foot_speed[q][1 - direction] = fading[q];
          }
        }
        else
        {
          const auto     reference = ReferenceCells::Triangle;
          const unsigned b = reference.face_to_cell_vertices(f, 0, 1), c = reference.face_to_cell_vertices(f, 1, 1), a = 3 - b - c;
          const auto     corner = [](const unsigned v) { return v == 0 ? Point<dim>() : Point<dim>(Point<dim>::unit_vector(v - 1)); };
          edge = corner(c) - corner(b);
          for (unsigned q = 0; q < n; ++q)
          {
            const Point<dim> &x = tabulated.points[q];
            const auto        gradient = [&](const unsigned v) { return reference.d_linear_shape_function_gradient<dim>(x, v); };
            fading[q] = 1 - reference.d_linear_shape_function<dim>(x, a);
            const double along = fading[q] > 0 ? reference.d_linear_shape_function<dim>(x, c) / fading[q] : 0.;
            feet[q] = corner(b) + along * edge;
            fading_gradient[q] = -gradient(a);
            foot_speed[q] = gradient(c) + along * gradient(a); // times fading, divided by it
          }
        }
        const TabulatedElement<dim> at_feet(*problem.space.fe, Quadrature<dim>(feet));
        const auto                  where = straight.at(at_feet);
        NodalColumns                function(dofs, 1);
        const unsigned              of_u = function.add(u);
        const Eigen::MatrixXd       u_at = function.at(at_feet.values, 1);
        Eigen::VectorXd             along_edge = Eigen::VectorXd::Zero(n);
        for (unsigned d = 0; d < dim; ++d)
          along_edge += edge[d] * function.at(at_feet.gradients[d], 1).col(of_u);
        std::vector<double>         values;
        std::vector<Tensor<1, dim>> gradients;
        problem.prescribed.conditions[cell->face(f)->boundary_id()].value->values_and_gradients(where.x, values, gradients);
        for (unsigned q = 0; q < n; ++q)
        {
          const double difference = values[q] - u_at(q, of_u);
          const double slope = gradients[q] * (where.jacobian[q] * edge) - along_edge(q);
          state.v[q] += fading[q] * difference;
          if (!state.v_gradient.empty())
            state.v_gradient[q] += physical<dim>(difference * fading_gradient[q] + slope * foot_speed[q], at.inverse[q]);
        }
      }
    }
    else
      (void)cell, (void)straight, (void)tabulated, (void)at, (void)state;
  }

  template <int dim>
  bool FeasibleState<dim>::Bound::in_contact_at(const std::vector<types::global_dof_index> &dofs) const
  {
    return std::any_of(dofs.begin(), dofs.end(), [&](const auto dof) { return contact(dof) > 0; });
  }

  /// The functions of V_h that v is made of, at the points of a cell.
  template <int dim>
  struct FeasibleState<dim>::OnCell
  {
    OnCell(const FeasibleState                        &state,
           const Cell                                 &cell,
           const TabulatedElement<dim>                &tabulated,
           const typename StraightCell<dim>::AtPoints &at,
           const bool                                  with_gradients)
      : at(at)
    {
      std::vector<types::global_dof_index> dofs(state.problem.space.fe->n_dofs_per_cell());
      cell->get_dof_indices(dofs);
      NodalColumns functions(dofs, 2 + 3 * state.bounds.size());
      u = functions.add(state.u);
      moved = state.moves ? functions.add(state.moved) : u;
      pressure.assign(state.bounds.size(), u);
      contact = interpolant = pressure;
      in_contact.assign(state.bounds.size(), false);
      const auto in_domain = [&](const std::size_t b) { return !state.bounds[b].condition->part; };
      for (std::size_t b = 0; b < state.bounds.size(); ++b)
        if (in_domain(b) && state.bounds[b].in_contact_at(dofs))
        {
          in_contact[b] = true;
          contact[b] = functions.add(state.bounds[b].contact);
          interpolant[b] = functions.add(state.bounds[b].interpolant);
        }
      const unsigned with_slope = functions.size();
      for (std::size_t b = 0; b < state.bounds.size(); ++b)
      {
        pressure[b] = functions.add(state.bounds[b].pressure);
        if (in_domain(b) && !in_contact[b])
          interpolant[b] = functions.add(state.bounds[b].interpolant);
      }
      values = functions.at(tabulated.values, functions.size());
      for (unsigned d = 0; d < dim && with_gradients; ++d)
        reference_gradients[d] = functions.at(tabulated.gradients[d], with_slope);
    }

    Tensor<1, dim> gradient(const unsigned function, const unsigned q) const
    {
      Tensor<1, dim> reference;
      for (unsigned d = 0; d < dim; ++d)
        reference[d] = reference_gradients[d](q, function);
      return physical<dim>(reference, at.inverse[q]);
    }

    unsigned                                    u, moved; ///< columns of the functions
    std::vector<unsigned>                       pressure, contact, interpolant;
    std::vector<bool>                           in_contact;          ///< by bound in the domain: there is pressure at a node
    Eigen::MatrixXd                             values;              ///< rows: points
    std::array<Eigen::MatrixXd, dim>            reference_gradients; ///< of u, what has been moved, and bounds in contact
    const typename StraightCell<dim>::AtPoints &at;
  };

  template <int dim>
  void FeasibleState<dim>::evaluate(const Cell                                 &cell,
                                    const StraightCell<dim>                    &straight,
                                    const TabulatedElement<dim>                &tabulated,
                                    const typename StraightCell<dim>::AtPoints &at,
                                    const Wanted                                wanted,
                                    AtPoints                                   &state) const
  {
    const unsigned n = tabulated.size();
    const bool     with_gradients = wanted == Wanted::values_and_gradients;
    const OnCell   functions(*this, cell, tabulated, at, with_gradients);
    state.u.resize(n);
    state.v.resize(n);
    state.u_gradient.assign(with_gradients ? n : 0, Tensor<1, dim>());
    state.v_gradient.assign(with_gradients ? n : 0, Tensor<1, dim>());
    for (unsigned q = 0; q < n; ++q)
    {
      state.u[q] = functions.values(q, functions.u);
      state.v[q] = functions.values(q, functions.moved);
      if (with_gradients)
      {
        state.u_gradient[q] = functions.gradient(functions.u, q);
        state.v_gradient[q] = moves ? functions.gradient(functions.moved, q) : state.u_gradient[q];
      }
    }
    if (wanted != Wanted::u_and_pressure)
      add_boundary_values(cell, straight, tabulated, at, state);

    state.pressure.assign(bounds.size(), std::vector<double>(n, 0.));
    state.distance.assign(bounds.size(), std::vector<double>(n, 0.));
    state.kink = state.rough = false;
    std::vector<Psi> psi(bounds.size());
    for (std::size_t b = 0; b < bounds.size(); ++b)
    {
      const bool   ends = changes_sign(functions.values.col(functions.pressure[b]));
      const double share = ends && !bounds[b].condition->part ? kept_share(b, cell, straight) : 1;
      for (unsigned q = 0; q < n; ++q)
        state.pressure[b][q] = share * std::max(0., functions.values(q, functions.pressure[b]));
      state.kink |= ends;
      if (wanted == Wanted::u_and_pressure)
        continue;
      if (functions.in_contact[b])
        follow_bound(b, functions, psi[b], state);
      else
        bounds[b].condition->bound.values(at.x, psi[b].values);
    }
    if (wanted == Wanted::u_and_pressure)
      return;
    for (std::size_t b = 0; b < bounds.size(); ++b)
      if (!bounds[b].condition->part)
        cut_off_at_bound(b, functions, psi[b], state);
    for (std::size_t b = 0; b < bounds.size(); ++b)
      for (unsigned q = 0; q < n; ++q)
        state.distance[b][q] = std::abs(state.v[q] - psi[b].values[q]);
  }

  template <int dim>
  double FeasibleState<dim>::kept_share(const std::size_t b, const Cell &cell, const StraightCell<dim> &straight) const
  {
    float &share = bounds[b].kept_shares[cell->active_cell_index()];
    if (share >= 0)
      return share;
    std::vector<types::global_dof_index> dofs(problem.space.fe->n_dofs_per_cell());
    cell->get_dof_indices(dofs);
    NodalColumns function(dofs, 1);
    function.add(bounds[b].pressure);
    const Eigen::MatrixXd pressure = function.at(fine.values, 1);
    const auto            at = straight.at(fine);
    double                force = 0, of_positive_part = 0;
    for (unsigned q = 0; q < fine.size(); ++q)
    {
      const double w = fine.weights[q] * at.determinant[q];
      force += w * pressure(q, 0);
      of_positive_part += w * std::max(0., pressure(q, 0));
    }
    share = float(of_positive_part > 0 ? std::max(0., force / of_positive_part) : 0.);
    return share;
  }

  template <int dim>
  void FeasibleState<dim>::follow_bound(const std::size_t b, const OnCell &functions, Psi &psi, AtPoints &state) const
  {
    const bool with_gradients = !state.v_gradient.empty();
    if (with_gradients)
      bounds[b].condition->bound.values_and_gradients(functions.at.x, psi.values, psi.gradients);
    else
      bounds[b].condition->bound.values(functions.at.x, psi.values);
    double largest_rest = 0;
    for (unsigned q = 0; q < psi.values.size(); ++q)
    {
      const double chi = functions.values(q, functions.contact[b]), rest = psi.values[q] - functions.values(q, functions.interpolant[b]);
      largest_rest = std::max(largest_rest, std::abs(rest));
      state.v[q] += chi * rest;
      if (with_gradients)
        state.v_gradient[q] +=
          chi * (psi.gradients[q] - functions.gradient(functions.interpolant[b], q)) + rest * functions.gradient(functions.contact[b], q);
    }
    const auto [least, most] = std::minmax_element(psi.values.begin(), psi.values.end());
    const double share = varies_much(state.pressure[b]) ? largest_share_under_varying_pressure : largest_share_of_rest;
    state.rough |= largest_rest > share * (*most - *least);
  }

  template <int dim>
  void FeasibleState<dim>::cut_off_at_bound(const std::size_t b, const OnCell &functions, Psi &psi, AtPoints &state) const
  {
    const double sign = bounds[b].condition->side == Side::lower ? 1 : -1;
    double       largest = 0;
    unsigned     crossing = 0;
    for (unsigned q = 0; q < psi.values.size(); ++q)
      if (const double overlap = sign * (psi.values[q] - state.v[q]); overlap > 0)
      {
        ++crossing;
        if (!state.v_gradient.empty() && psi.gradients.empty())
          bounds[b].condition->bound.values_and_gradients(functions.at.x, psi.values, psi.gradients);
        largest = std::max(largest, overlap);
        state.v[q] = psi.values[q];
        if (!state.v_gradient.empty())
          state.v_gradient[q] = psi.gradients[q];
      }
    state.kink |= crossing < psi.values.size() && largest > 1e-10 * size;
    if (crossing > 0)
      return;
    // Between the points the bound may be farther from its interpolant than at them, by about as much again, and v not keep it there.
    double largest_rest = 0, least_distance = std::numeric_limits<double>::max();
    for (unsigned q = 0; q < psi.values.size(); ++q)
    {
      largest_rest = std::max(largest_rest, std::abs(psi.values[q] - functions.values(q, functions.interpolant[b])));
      least_distance = std::min(least_distance, std::abs(psi.values[q] - state.v[q]));
    }
    state.kink |= least_distance < 2 * largest_rest;
  }

#define INSTANTIATE(dim)                                                                                                                   \
  template void FeasibleState<dim>::evaluate(const Cell &, const StraightCell<dim> &, const TabulatedElement<dim> &,                       \
                                             const StraightCell<dim>::AtPoints &, Wanted, AtPoints &) const;                               \
  template bool FeasibleState<dim>::Bound::in_contact_at(const std::vector<types::global_dof_index> &) const;
  INSTANTIATE(1)
  INSTANTIATE(2)
  INSTANTIATE(3)
#undef INSTANTIATE
} // namespace unilateral
