// A beam: a(u, v) = (EI u'', v'') + (k u, v), f(v) = (q, v).
#pragma once

#include "unilateral/forms/bilinear_form.h"
#include "unilateral/forms/model.h"
#include "unilateral/spaces/boundary_condition.h"

#include <vector>

namespace unilateral
{
  /// The Euler-Bernoulli beam on a Winkler foundation: (EI u'')'' + k u = q, u the deflection in the direction of q. Units, with u and x
  /// in m: EI in N m^2, q in N/m, k in N/m^2, forces in N, moments in N m; a spring at an end in N/m, one that resists turning in N m.
  ///
  /// At an end with outer normal n = -1 or 1 the bending moment is M = EI u'' = moment - slope_spring du/dn and the shear force is
  /// -n M' = flux - spring u: a positive flux pushes in the direction of q. Where u is prescribed, flux and spring have no say; where du/dn
  /// is, moment and slope_spring have none. Prescribed values are those of unknowns, so V_h must be in H^2: hermite.h.
  class Beam : public BilinearForm<1>
  {
  public:
    /// @p regions, @p parts: by material_id and boundary_id, see regions_and_parts.h. EI is `stiffness` (1), k `reaction` (0), q `load`
    /// (0).
    Beam(const std::vector<Coefficients> &coefficients, const std::vector<PartCondition> &conditions);

    unsigned n_components() const override { return 1; }
    unsigned order() const override { return 2; }
    bool     symmetric() const override { return true; }

    /// Throws InputError where EI is not positive.
    void add_cell_terms(const dealii::FEValues<1> &, dealii::FullMatrix<double> &, dealii::Vector<double> &) const override;
    bool has_face_terms(dealii::types::boundary_id part) const override;
    void add_face_terms(const dealii::FEFaceValues<1> &,
                        dealii::types::boundary_id,
                        dealii::FullMatrix<double> &,
                        dealii::Vector<double> &) const override;

    /// (u'', v'') + (u', v') + (u, v)
    void add_gram_terms(const dealii::FEValues<1> &, dealii::FullMatrix<double> &) const override;

    /// The bending moment M = EI u'', and M^2 / EI. M is positive where u is convex.
    unsigned n_flux_components() const override { return 1; }
    void     flux(const dealii::FEValues<1> &, const dealii::Vector<double> &, std::vector<Flux> &) const override;
    double   flux_energy(const Flux &, dealii::types::material_id, const dealii::Point<1> &) const override;
    void     load_less_reaction(const dealii::FEValues<1> &, const dealii::Vector<double> &, std::vector<double> &) const override;

    bool holds_rigid_body_modes() const override; ///< somewhere there is a foundation

    /// 1 and x - centre.
    std::vector<RigidBodyMode<1>>     rigid_body_modes(const dealii::Point<1> &centre) const override;
    std::pair<double, SourceLocation> load_samples() const override;

  private:
    struct Section
    {
      FieldFunction stiffness, foundation, load;

      double stiffness_at(const dealii::Point<1> &x) const;
    };
    struct EndTerms
    {
      FieldFunction force, spring, moment, slope_spring;
    };
    std::vector<Section>  regions;
    std::vector<EndTerms> parts;
  };
} // namespace unilateral
