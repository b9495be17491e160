#include "unilateral/forms/beam.h"
#include "unilateral/forms/spring.h"

#include <fmt/format.h>

#include <algorithm>

namespace unilateral
{
  using namespace dealii;

  double Beam::Section::stiffness_at(const Point<1> &x) const
  {
    const double EI = stiffness.value(x);
    if (!(EI > 0))
      throw InputError(stiffness.where(), fmt::format("the bending stiffness EI must be positive, it is {} at a point of the mesh", EI),
                       MessageName("out-of-range"));
    return EI;
  }

  Beam::Beam(const std::vector<Coefficients> &coefficients, const std::vector<PartCondition> &conditions)
  {
    for (const auto &given : coefficients)
      regions.push_back({first_or(given.stiffness, 1.), given.reaction.value_or(0.), first_or(given.load, 0.)});
    for (const auto &given : conditions)
    {
      EndTerms terms;
      if (!given.value)
      {
        terms.force = given.flux.value_or(0.);
        terms.spring = given.spring.value_or(0.);
      }
      if (!given.slope && !given.symmetry)
      {
        terms.moment = given.moment.value_or(0.);
        terms.slope_spring = given.slope_spring.value_or(0.);
      }
      parts.push_back(terms);
    }
  }

  void Beam::add_cell_terms(const FEValues<1> &values, FullMatrix<double> &matrix, dealii::Vector<double> &load) const
  {
    const auto    &section = regions[values.get_cell()->material_id()];
    const unsigned n = values.dofs_per_cell;
    for (const unsigned q : values.quadrature_point_indices())
    {
      const Point<1> &x = values.quadrature_point(q);
      const double    JxW = values.JxW(q);
      const double    EI = section.stiffness_at(x);
      const double    k = section.foundation.value(x);
      const double    f = section.load.value(x);
      for (unsigned j = 0; j < n; ++j)
      {
        const double phi_j = values.shape_value(j, q);
        const double M_j = EI * values.shape_hessian(j, q)[0][0];
        for (unsigned i = 0; i < n; ++i)
          matrix(i, j) += (M_j * values.shape_hessian(i, q)[0][0] + k * phi_j * values.shape_value(i, q)) * JxW;
        load(j) += f * phi_j * JxW;
      }
    }
  }

  bool Beam::has_face_terms(const types::boundary_id part) const
  {
    if (part >= parts.size()) // a cut
      return false;
    const auto &terms = parts[part];
    return !terms.force.is_zero() || !terms.spring.is_zero() || !terms.moment.is_zero() || !terms.slope_spring.is_zero();
  }

  void Beam::add_face_terms(const FEFaceValues<1>   &values,
                            const types::boundary_id part,
                            FullMatrix<double>      &matrix,
                            dealii::Vector<double>  &load) const
  {
    const auto     &terms = parts[part];
    const Point<1> &x = values.quadrature_point(0);
    const double    n = values.normal_vector(0)[0];
    const double    force = terms.force.value(x), spring = spring_at(terms.spring, x);
    const double    moment = terms.moment.value(x), slope_spring = spring_at(terms.slope_spring, x);
    for (unsigned i = 0; i < values.dofs_per_cell; ++i)
    {
      const double phi_i = values.shape_value(i, 0), slope_i = n * values.shape_grad(i, 0)[0];
      load(i) += force * phi_i + moment * slope_i;
      for (unsigned j = 0; j < values.dofs_per_cell; ++j)
        matrix(i, j) += spring * phi_i * values.shape_value(j, 0) + slope_spring * slope_i * n * values.shape_grad(j, 0)[0];
    }
  }

  void Beam::add_gram_terms(const FEValues<1> &values, FullMatrix<double> &matrix) const
  {
    const double l2 = unit_of_length * unit_of_length;
    for (const unsigned q : values.quadrature_point_indices())
      for (unsigned i = 0; i < values.dofs_per_cell; ++i)
        for (unsigned j = 0; j < values.dofs_per_cell; ++j)
          matrix(i, j) +=
            (values.shape_hessian(i, q)[0][0] * values.shape_hessian(j, q)[0][0] +
             (values.shape_grad(i, q) * values.shape_grad(j, q) + values.shape_value(i, q) * values.shape_value(j, q) / l2) / l2) *
            values.JxW(q);
  }

  void Beam::flux(const FEValues<1> &values, const dealii::Vector<double> &u, std::vector<Flux> &at) const
  {
    at.assign(values.n_quadrature_points, Flux{});
    for (const unsigned q : values.quadrature_point_indices())
    {
      double curvature = 0;
      for (unsigned i = 0; i < values.dofs_per_cell; ++i)
        curvature += u(i) * values.shape_hessian(i, q)[0][0];
      at[q][0] = regions[values.get_cell()->material_id()].stiffness_at(values.quadrature_point(q)) * curvature;
    }
  }

  void Beam::load_less_reaction(const FEValues<1> &values, const dealii::Vector<double> &u, std::vector<double> &at) const
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

  double Beam::flux_energy(const Flux &flux, const types::material_id region, const Point<1> &x) const
  {
    return flux[0] * flux[0] / regions[region].stiffness_at(x);
  }

  bool Beam::holds_rigid_body_modes() const
  {
    return std::any_of(regions.begin(), regions.end(), [](const Section &section) { return !section.foundation.is_zero(); });
  }

  std::vector<RigidBodyMode<1>> Beam::rigid_body_modes(const Point<1> &centre) const
  {
    return {{"translation", [](const Point<1> &) { return Point<1>(1); }},
            {"rotation", [centre](const Point<1> &x) { return x - centre; }}};
  }

  std::pair<double, SourceLocation> Beam::load_samples() const
  {
    for (const auto &section : regions)
      if (section.load.sample_spacing() > 0)
        return {section.load.sample_spacing(), section.load.where()};
    return {0, {}};
  }
} // namespace unilateral
