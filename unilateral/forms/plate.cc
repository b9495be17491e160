#include "unilateral/forms/plate.h"
#include "unilateral/forms/spring.h"

#include <deal.II/base/symmetric_tensor.h>

#include <fmt/format.h>

#include <algorithm>
#include <array>

namespace unilateral
{
  using namespace dealii;

  namespace
  {
    /// |K| / |F|: the width of the cell across the face, half of it in a triangle. With hanging nodes F is the whole side of the cell.
    double width_across(const FEFaceValuesBase<2> &values)
    {
      const auto cell = values.get_cell();
      return cell->measure() / cell->face(values.get_face_number())->measure();
    }

    /// A point of a face, moved into the cell by so little that only a D or nu that jumps at the face sees it.
    Point<2> inside(const FEFaceValuesBase<2> &values, const unsigned q)
    {
      const Point<2> &x = values.quadrature_point(q);
      return x + 1e-9 * (values.get_cell()->center() - x);
    }

    /// Of the interface DoFs at the points of the first side.
    FaceTraces traces_of(const FEInterfaceValues<2> &values, const std::array<FaceSide<2>, 2> &sides)
    {
      const unsigned n = values.n_current_interface_dofs();
      FaceTraces     traces(n);
      for (const unsigned side : {0, 1})
      {
        std::vector<unsigned> function(sides[side].slope.n(), numbers::invalid_unsigned_int);
        for (unsigned i = 0; i < n; ++i)
          if (const unsigned k = values.interface_dof_to_dof_indices(i)[side]; k != numbers::invalid_unsigned_int)
            function[k] = i;
        traces.add(sides[side], function, matching_points(sides[0].points, sides[side].points));
      }
      return traces;
    }
  } // namespace

  Plate::Law Plate::Region::law(const Point<2> &x) const
  {
    const double nu = poisson.value(x), t = from_thickness ? thickness.value(x) : 0;
    const double D = from_thickness ? young.value(x) * t * t * t / (12 * (1 - nu * nu)) : stiffness.value(x);
    if (!(D > 0))
      throw InputError(from_thickness ? thickness.where() : stiffness.where(),
                       fmt::format("the bending stiffness D must be positive, it is {} at a point of the mesh", D),
                       MessageName("out-of-range"));
    if (!(nu > -1 && nu <= 0.5))
      throw InputError(poisson.where(), fmt::format("Poisson's ratio must lie between -1 and 1/2, it is {} at a point of the mesh", nu),
                       MessageName("out-of-range"));
    return {D, nu};
  }

  Tensor<2, 2> Plate::Law::moments(const Tensor<2, 2> &hessian) const
  {
    Tensor<2, 2> M = D * (1 - nu) * hessian;
    const double isotropic = D * nu * trace(hessian);
    M[0][0] += isotropic;
    M[1][1] += isotropic;
    return M;
  }

  Plate::Plate(const std::vector<Coefficients>  &coefficients,
               const std::vector<PartCondition> &conditions,
               const bool                        interior_penalty,
               const double                      penalty_factor)
    : interior_penalty(interior_penalty), penalty_factor(penalty_factor)
  {
    for (const auto &given : coefficients)
      regions.push_back({first_or(given.stiffness, 1.), given.poisson.value_or(0.3), given.reaction.value_or(0.), first_or(given.load, 0.),
                         given.young.value_or(0.), given.thickness.value_or(0.), given.young && given.thickness && !given.stiffness});
    for (const auto &given : conditions)
    {
      EdgeTerms terms;
      if (!given.value)
      {
        terms.force = given.flux.value_or(0.);
        terms.spring = given.spring.value_or(0.);
      }
      if (given.slope || given.symmetry)
      {
        terms.slope_given = true;
        terms.slope = given.slope.value_or(0.);
      }
      else
      {
        terms.moment = given.moment.value_or(0.);
        terms.slope_spring = given.slope_spring.value_or(0.);
      }
      parts.push_back(terms);
    }
  }

  double Plate::slope_penalty(const unsigned degree, const bool triangles)
  {
    return (triangles ? 1. : 2.) * degree * degree;
  }

  void Plate::add_cell_terms(const FEValues<2> &values, FullMatrix<double> &matrix, dealii::Vector<double> &load) const
  {
    const auto    &region = regions[values.get_cell()->material_id()];
    const unsigned n = values.dofs_per_cell;
    for (const unsigned q : values.quadrature_point_indices())
    {
      const Point<2> &x = values.quadrature_point(q);
      const double    JxW = values.JxW(q);
      const Law       law = region.law(x);
      const double    k = region.foundation.value(x);
      const double    f = region.load.value(x);
      for (unsigned j = 0; j < n; ++j)
      {
        const double       phi_j = values.shape_value(j, q);
        const Tensor<2, 2> M_j = law.moments(values.shape_hessian(j, q));
        for (unsigned i = 0; i < n; ++i)
          matrix(i, j) += (scalar_product(M_j, values.shape_hessian(i, q)) + k * phi_j * values.shape_value(i, q)) * JxW;
        load(j) += f * phi_j * JxW;
      }
    }
  }

  bool Plate::has_face_terms(const types::boundary_id part) const
  {
    if (part >= parts.size()) // a cut
      return false;
    const auto &terms = parts[part];
    return !terms.force.is_zero() || !terms.spring.is_zero() || !terms.moment.is_zero() || !terms.slope_spring.is_zero();
  }

  std::vector<FieldFunction> Plate::face_functions(const types::boundary_id part) const
  {
    const auto &terms = parts[part];
    return not_constant({terms.force, terms.spring, terms.moment, terms.slope_spring});
  }

  void Plate::add_face_terms(const FEFaceValues<2>   &values,
                             const types::boundary_id part,
                             FullMatrix<double>      &matrix,
                             dealii::Vector<double>  &load) const
  {
    const auto         &terms = parts[part];
    const unsigned      n = values.dofs_per_cell;
    std::vector<double> slope(n);
    for (const unsigned q : values.quadrature_point_indices())
    {
      const Point<2> &x = values.quadrature_point(q);
      const double    JxW = values.JxW(q);
      const double    force = terms.force.value(x) * JxW, spring = spring_at(terms.spring, x) * JxW;
      const double    moment = terms.moment.value(x) * JxW, slope_spring = spring_at(terms.slope_spring, x) * JxW;
      for (unsigned i = 0; i < n; ++i)
        slope[i] = values.normal_vector(q) * values.shape_grad(i, q);
      for (unsigned i = 0; i < n; ++i)
      {
        const double phi_i = values.shape_value(i, q);
        load(i) += force * phi_i + moment * slope[i];
        if (spring != 0 || slope_spring != 0)
          for (unsigned j = 0; j < n; ++j)
            matrix(i, j) += spring * phi_i * values.shape_value(j, q) + slope_spring * slope[i] * slope[j];
      }
    }
  }

  void Plate::add_gram_terms(const FEValues<2> &values, FullMatrix<double> &matrix) const
  {
    const double l2 = unit_of_length * unit_of_length;
    for (const unsigned q : values.quadrature_point_indices())
      for (unsigned i = 0; i < values.dofs_per_cell; ++i)
        for (unsigned j = 0; j < values.dofs_per_cell; ++j)
          matrix(i, j) +=
            (scalar_product(values.shape_hessian(i, q), values.shape_hessian(j, q)) +
             (values.shape_grad(i, q) * values.shape_grad(j, q) + values.shape_value(i, q) * values.shape_value(j, q) / l2) / l2) *
            values.JxW(q);
  }

  FaceSide<2> Plate::interior_face_side(const FEFaceValuesBase<2> &values) const
  {
    const unsigned n = values.dofs_per_cell, n_points = values.n_quadrature_points;
    const double   sigma = penalty_factor * slope_penalty(values.get_fe().degree, values.get_fe().reference_cell().is_simplex());
    const auto    &region = regions[values.get_cell()->material_id()];
    FaceSide<2>    side;
    side.points = values.get_quadrature_points();
    side.JxW = values.get_JxW_values();
    side.half_inverse_width = 0.5 / width_across(values);
    side.slope.reinit(n_points, n);
    side.moment.reinit(n_points, n);
    for (unsigned q = 0; q < n_points; ++q)
    {
      const Law           law = region.law(inside(values, q));
      const Tensor<1, 2> &normal = values.normal_vector(q);
      side.penalty.push_back(sigma * law.D * side.half_inverse_width);
      for (unsigned k = 0; k < n; ++k)
      {
        side.slope(q, k) = normal * values.shape_grad(k, q);
        side.moment(q, k) = 0.5 * (normal * (law.moments(values.shape_hessian(k, q)) * normal));
      }
    }
    return side;
  }

  void Plate::add_interior_face_terms(const FEInterfaceValues<2> &values, FullMatrix<double> &matrix) const
  {
    traces_of(values, {interior_face_side(values.get_fe_face_values(0)), interior_face_side(values.get_fe_face_values(1))})
      .add_terms(matrix);
  }

  void Plate::add_interior_face_gram(const FEInterfaceValues<2> &values, FullMatrix<double> &matrix) const
  {
    traces_of(values, {interior_face_side(values.get_fe_face_values(0)), interior_face_side(values.get_fe_face_values(1))})
      .add_gram(matrix);
  }

  bool Plate::has_slope_terms(const types::boundary_id part) const
  {
    return interior_penalty && part < parts.size() && parts[part].slope_given; // not on cuts
  }

  void Plate::add_slope_terms(const FEFaceValues<2>   &values,
                              const types::boundary_id part,
                              FullMatrix<double>      &matrix,
                              dealii::Vector<double>  &load) const
  {
    const double sigma =
      2 * penalty_factor * slope_penalty(values.get_fe().degree, values.get_fe().reference_cell().is_simplex()) / width_across(values);
    const auto         &region = regions[values.get_cell()->material_id()];
    const unsigned      n = values.dofs_per_cell;
    std::vector<double> slope(n), moment(n);
    for (const unsigned q : values.quadrature_point_indices())
    {
      const Point<2>     &x = values.quadrature_point(q);
      const Tensor<1, 2> &normal = values.normal_vector(q);
      const double        JxW = values.JxW(q);
      const Law           law = region.law(inside(values, q));
      const double        penalty = sigma * law.D;
      const double        g = parts[part].slope.value(x);
      for (unsigned i = 0; i < n; ++i)
      {
        slope[i] = normal * values.shape_grad(i, q);
        moment[i] = normal * (law.moments(values.shape_hessian(i, q)) * normal);
      }
      for (unsigned i = 0; i < n; ++i)
      {
        load(i) += g * (penalty * slope[i] - moment[i]) * JxW;
        for (unsigned j = 0; j < n; ++j)
          matrix(i, j) += (penalty * slope[i] * slope[j] - moment[j] * slope[i] - slope[j] * moment[i]) * JxW;
      }
    }
  }

  void Plate::add_slope_gram(const FEFaceValues<2> &values, types::boundary_id, FullMatrix<double> &matrix) const
  {
    const double h = width_across(values);
    for (const unsigned q : values.quadrature_point_indices())
      for (unsigned i = 0; i < values.dofs_per_cell; ++i)
        for (unsigned j = 0; j < values.dofs_per_cell; ++j)
          matrix(i, j) +=
            (values.normal_vector(q) * values.shape_grad(i, q)) * (values.normal_vector(q) * values.shape_grad(j, q)) / h * values.JxW(q);
  }

  void Plate::flux(const FEValues<2> &values, const dealii::Vector<double> &u, std::vector<Flux> &at) const
  {
    at.assign(values.n_quadrature_points, Flux{});
    for (const unsigned q : values.quadrature_point_indices())
    {
      Tensor<2, 2> hessian;
      for (unsigned i = 0; i < values.dofs_per_cell; ++i)
        hessian += u(i) * values.shape_hessian(i, q);
      const Tensor<2, 2> M = regions[values.get_cell()->material_id()].law(values.quadrature_point(q)).moments(hessian);
      at[q][0] = M[0][0];
      at[q][1] = M[1][1];
      at[q][2] = M[0][1];
    }
  }

  void Plate::load_less_reaction(const FEValues<2> &values, const dealii::Vector<double> &u, std::vector<double> &at) const
  {
    const auto &region = regions[values.get_cell()->material_id()];
    region.load.values(values.get_quadrature_points(), at);
    for (const unsigned q : values.quadrature_point_indices())
    {
      double u_at = 0;
      for (unsigned i = 0; i < values.dofs_per_cell; ++i)
        u_at += u(i) * values.shape_value(i, q);
      at[q] -= region.foundation.value(values.quadrature_point(q)) * u_at;
    }
  }

  double Plate::flux_energy(const Flux &M, const types::material_id region, const Point<2> &x) const
  {
    const auto [D, nu] = regions[region].law(x);
    const double trace = M[0] + M[1];
    return ((1 + nu) * (M[0] * M[0] + M[1] * M[1] + 2 * M[2] * M[2]) - nu * trace * trace) / (D * (1 - nu * nu));
  }

  bool Plate::holds_rigid_body_modes() const
  {
    return std::any_of(regions.begin(), regions.end(), [](const Region &region) { return !region.foundation.is_zero(); });
  }

  std::vector<RigidBodyMode<2>> Plate::rigid_body_modes(const Point<2> &centre) const
  {
    const auto scalar = [](const double value)
    {
      Tensor<1, 2> u;
      u[0] = value;
      return u;
    };
    return {{"translation", [scalar](const Point<2> &) { return scalar(1); }},
            {"rotation about y", [scalar, centre](const Point<2> &x) { return scalar(x[0] - centre[0]); }},
            {"rotation about x", [scalar, centre](const Point<2> &x) { return scalar(x[1] - centre[1]); }}};
  }

  std::pair<double, SourceLocation> Plate::load_samples() const
  {
    for (const auto &region : regions)
      if (region.load.sample_spacing() > 0)
        return {region.load.sample_spacing(), region.load.where()};
    return {0, {}};
  }
} // namespace unilateral
