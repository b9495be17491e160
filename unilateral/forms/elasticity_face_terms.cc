// What boundary faces add to the form of an elastic body: loads and springs.
#include "unilateral/forms/elasticity.h"
#include "unilateral/forms/spring.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace unilateral
{
  using namespace dealii;

  namespace
  {
    bool given_and_not_zero(const std::vector<FieldFunction> &functions)
    {
      return std::any_of(functions.begin(), functions.end(), [](const FieldFunction &function) { return !function.is_zero(); });
    }
  } // namespace

  template <int dim>
  bool Elasticity<dim>::has_face_terms(const types::boundary_id part) const
  {
    return part < parts.size() && (given_and_not_zero(parts[part].traction) || !parts[part].pressure.is_zero() ||
                                   given_and_not_zero(parts[part].springs) || parts[part].has_moment());
  }

  template <int dim>
  bool Elasticity<dim>::needs_surface_moments() const
  {
    return std::any_of(parts.begin(), parts.end(), [](const auto &part) { return part.traction_is_total || part.has_moment(); });
  }

  template <int dim>
  void Elasticity<dim>::set_surface_moments(const std::vector<SurfaceMoments<dim>> &moments)
  {
    for (std::size_t part = 0; part < parts.size(); ++part)
    {
      if (parts[part].traction_is_total && moments[part].measure > 0)
        parts[part].share = 1 / moments[part].measure;
      if (parts[part].has_moment() && moments[part].measure > 0)
        set_spin(parts[part], moments[part]);
    }
  }

  template <int dim>
  void Elasticity<dim>::set_spin(FaceTerms &terms, const SurfaceMoments<dim> &surface) const
  {
    terms.centroid = surface.centroid;
    Tensor<1, dim> arm, force;
    for (unsigned d = 0; d < dim; ++d)
    {
      arm[d] = terms.about.empty() ? 0. : terms.about[d] - surface.centroid[d];
      force[d] = terms.traction_is_total ? terms.traction[d].value(Point<dim>()) : 0.;
    }
    const auto moment = [&](const unsigned k) { return terms.moments.empty() ? 0. : terms.moments[k].value(Point<dim>()); };
    if constexpr (dim == 2)
    {
      const double theta = (moment(0) + arm[0] * force[1] - arm[1] * force[0]) / trace(surface.second);
      terms.spin[0][1] = -theta;
      terms.spin[1][0] = theta;
    }
    if constexpr (dim == 3)
    {
      const Tensor<1, 3> couple = Tensor<1, 3>({moment(0), moment(1), moment(2)}) + cross_product_3d(arm, force);
      const Tensor<2, 3> of_turns(trace(surface.second) * unit_symmetric_tensor<3>() - surface.second);
      const Tensor<1, 3> theta = invert(of_turns) * couple;
      for (unsigned c = 0; c < 3; ++c)
      {
        terms.spin[c][(c + 1) % 3] = -theta[(c + 2) % 3];
        terms.spin[(c + 1) % 3][c] = theta[(c + 2) % 3];
      }
      // A strip without width bears no moment about its own line.
      if (!(determinant(of_turns) > 1e-18 * std::pow(trace(surface.second), 3)))
        throw InputError(terms.where,
                         fmt::format("the part '{}' is as good as a line: a traction on it has no moment about that line", terms.part),
                         MessageName("part-bears-no-moment"));
    }
  }

  template <int dim>
  void Elasticity<dim>::add_face_terms(const FEFaceValues<dim> &values,
                                       const types::boundary_id part,
                                       FullMatrix<double>      &matrix,
                                       dealii::Vector<double>  &load) const
  {
    const auto    &terms = parts[part];
    const auto    &fe = values.get_fe();
    const unsigned n = values.dofs_per_cell;
    for (const unsigned q : values.quadrature_point_indices())
    {
      const Point<dim>    &x = values.quadrature_point(q);
      const double         w = values.JxW(q) * measure(x);
      const Tensor<1, dim> normal = values.normal_vector(q);
      const double         pressure = terms.pressure.value(x);
      const Tensor<1, dim> turning = terms.has_moment() ? terms.spin * (x - terms.centroid) : Tensor<1, dim>();
      for (unsigned c = 0; c < dim; ++c)
      {
        const double t = w * ((terms.traction.empty() ? 0. : terms.share * terms.traction[c].value(x)) + turning[c] - pressure * normal[c]);
        const double spring = terms.springs.empty() ? 0. : w * spring_at(terms.springs[terms.springs.size() == 1 ? 0 : c], x);
        if (t == 0 && spring == 0)
          continue;
        for (unsigned i = 0; i < n; ++i)
          if (fe.system_to_component_index(i).first == c)
          {
            load(i) += t * values.shape_value(i, q);
            if (spring != 0)
              for (unsigned j = 0; j < n; ++j)
                if (fe.system_to_component_index(j).first == c)
                  matrix(i, j) += spring * values.shape_value(i, q) * values.shape_value(j, q);
          }
      }
    }
  }

  template <int dim>
  std::vector<FieldFunction> Elasticity<dim>::face_functions(const types::boundary_id part) const
  {
    std::vector<FieldFunction> functions = parts[part].traction;
    functions.insert(functions.end(), parts[part].springs.begin(), parts[part].springs.end());
    functions.push_back(parts[part].pressure);
    return not_constant(functions);
  }

#define INSTANTIATE(dim)                                                                                                                   \
  template bool                       Elasticity<dim>::has_face_terms(types::boundary_id) const;                                           \
  template bool                       Elasticity<dim>::needs_surface_moments() const;                                                      \
  template void                       Elasticity<dim>::set_surface_moments(const std::vector<SurfaceMoments<dim>> &);                      \
  template void                       Elasticity<dim>::set_spin(FaceTerms &, const SurfaceMoments<dim> &) const;                           \
  template std::vector<FieldFunction> Elasticity<dim>::face_functions(types::boundary_id) const;                                           \
  template void                       Elasticity<dim>::add_face_terms(const FEFaceValues<dim> &, types::boundary_id, FullMatrix<double> &, \
                                                                      dealii::Vector<double> &) const;
  INSTANTIATE(1)
  INSTANTIATE(2)
  INSTANTIATE(3)
#undef INSTANTIATE
} // namespace unilateral
