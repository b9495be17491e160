// Pointwise projection, m = 0: a(u, v) = (alpha u, v), f(v) = (f, v): K takes f/alpha to the nearest function between the bounds.
#pragma once

#include "unilateral/forms/bilinear_form.h"
#include "unilateral/forms/model.h"

#include <vector>

namespace unilateral
{
  /// In discontinuous V_h whose functions are given by their values at the points of I_G, and with a and f integrated by I_G, the problem
  /// falls apart into its points: u = min(max(f/alpha, lower), upper) there, Q_h = V_h, C_h = 1.
  template <int dim>
  class Projection : public BilinearForm<dim>
  {
  public:
    /// @p regions: by material_id, see regions_and_parts.h; alpha is their stiffness.
    explicit Projection(const std::vector<Coefficients> &coefficients);

    unsigned n_components() const override { return 1; }
    unsigned order() const override { return 0; }
    bool     symmetric() const override { return true; }
    void     add_cell_terms(const dealii::FEValues<dim> &, dealii::FullMatrix<double> &, dealii::Vector<double> &) const override;
    bool     has_face_terms(dealii::types::boundary_id) const override { return false; }
    void     add_face_terms(const dealii::FEFaceValues<dim> &,
                            dealii::types::boundary_id,
                            dealii::FullMatrix<double> &,
                            dealii::Vector<double> &) const override
    {
    }
    void add_gram_terms(const dealii::FEValues<dim> &, dealii::FullMatrix<double> &) const override; ///< (u, v)

    /// alpha u
    unsigned n_flux_components() const override { return 1; }
    void     flux(const dealii::FEValues<dim> &, const dealii::Vector<double> &, std::vector<Flux> &) const override;
    double   flux_energy(const Flux &, dealii::types::material_id, const dealii::Point<dim> &) const override;

    std::vector<RigidBodyMode<dim>>   rigid_body_modes(const dealii::Point<dim> &) const override { return {}; }
    std::pair<double, SourceLocation> load_samples() const override;

  private:
    struct Region
    {
      FieldFunction alpha, load;
    };
    double alpha(const Region &region, const dealii::Point<dim> &x) const; ///< Throws InputError where it is not positive.

    std::vector<Region> regions;
  };
} // namespace unilateral
