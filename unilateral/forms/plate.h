// A thin plate: a(u, v) = int D [(1 - nu) Hess u : Hess v + nu Lap u Lap v] dx + (k u, v), f(v) = (q, v).
#pragma once

#include "unilateral/forms/bilinear_form.h"
#include "unilateral/forms/model.h"
#include "unilateral/spaces/boundary_condition.h"

#include <vector>

namespace unilateral
{
  /// Kirchhoff's plate on a Winkler foundation: div div M + k u = q, M = D [(1 - nu) Hess u + nu Lap u I], u the deflection in the
  /// direction of q. Units, with u and x in m: D = E t^3 / (12 (1 - nu^2)) in N m, q in N/m^2, k in N/m^3; on the edge forces in N/m,
  /// moments in N m/m, springs in N/m^2, springs that resist turning in N m/m.
  ///
  /// On an edge with outer normal n and tangent t the bending moment is M_nn = n.M n = moment - slope_spring du/dn and Kirchhoff's shear
  /// force is -(div M . n + d M_nt / dt) = flux - spring u: a positive flux pushes in the direction of q. Where u is prescribed, flux and
  /// spring have no say; where du/dn is, moment and slope_spring have none.
  ///   clamped: u = 0, du/dn = 0;   simply supported: u = 0;   free: nothing;   symmetry: du/dn = 0.
  ///
  /// V_h is in H^2 (hermite.h; both u and du/dn are values of unknowns), or it is in H^1 only: continuous Q_p or P_p, p >= 2, with the C0
  /// interior penalty method. There u is given by values of unknowns and du/dn by terms on the edge. With h = |K| / |F| and the jump
  /// [du/dn] of the slope, the faces F between cells K add
  ///   int_F -{M_nn(u)} [dv/dn] - [du/dn] {M_nn(v)} + sigma_p {D / h} [du/dn] [dv/dn] ds,   {.} the mean of both sides,
  /// and an edge with du/dn = g adds
  ///   int_F -M_nn(u) dv/dn - du/dn M_nn(v) + 2 sigma_p D/h du/dn dv/dn ds to a,   int_F -g M_nn(v) + 2 sigma_p D/h g dv/dn ds to f.
  /// Works on quadrilaterals of any shape (curved ones take a mapping of degree p), with hanging nodes, and on straight triangles with
  /// FE_SimplexP(2) and make_simplex_element(2..3). The edge of a simply supported plate must not be replaced by a polygon: the solution
  /// does not tend to that of the curved one (Babuska's paradox). a is consistent: free edges and supports need no further terms, since
  /// M_nn is the moment of the plate and not that of Lap u alone. D and nu may jump between cells. Not in f: forces at corners, which free
  /// edges with a given M_nt would have there, and point loads. References: G. Engel, K. Garikipati, T. J. R. Hughes, M. G. Larson, L.
  /// Mazzei, R. L. Taylor, Comp. Meth. Appl. Mech. Engng 191 (2002) 3669-3750; S. C. Brenner, L.-Y. Sung, J. Sci. Comput. 22-23 (2005)
  /// 83-118; sigma_p: see slope_penalty().
  class Plate : public BilinearForm<2>
  {
  public:
    /// @p regions, @p parts: by material_id and boundary_id, see regions_and_parts.h. D is `stiffness` (1), or comes from young, poisson
    /// and `thickness`, nu `poisson` (0.3), k `reaction` (0), q `load` (0). @p interior_penalty: V_h is not in H^2. @p penalty_factor
    /// multiplies sigma_p.
    Plate(const std::vector<Coefficients>  &coefficients,
          const std::vector<PartCondition> &conditions,
          bool                              interior_penalty,
          double                            penalty_factor = 1);

    /// sigma_p: 2 p^2 on quadrilaterals, p^2 on triangles. A face takes of the energy of a cell, with D constant there,
    ///   int_F M_nn(u)^2 ds <= c D / h a_K(u, u),   c = (p - 1)^2 + 4 p nu^2 <= p^2 on rectangles (|nu| <= 1/2), c = p (p - 1)/2 on
    ///   triangles,
    /// so that a cell of N sides makes a coercive where sigma_p > N c / 2, whatever the ratio of its sides: 2 p^2 and 3 p (p - 1)/4 < p^2.
    /// (The first: Legendre polynomials in the direction across the face, u_nn of degree p - 2 and u_tt of degree p; the second: T.
    /// Warburton, J. S. Hesthaven, Comp. Meth. Appl. Mech. Engng 192 (2003) 2765-2773.) What is needed, by eigenvalues, with nu up to 1/2:
    /// 0.55 p^2 on rectangles, 0.9 to 1.4 p^2 on the coarsest meshes of a disc, 1.1 p^2 where opposite sides differ by a factor 4, 0.3 p^2
    /// on triangles. The energy error on quadrilaterals does not depend on sigma_p; on triangles it grows with it: 1 % from p^2 to 2 p^2 on
    /// regular meshes, 12 % on distorted ones.
    static double slope_penalty(unsigned degree, bool triangles);

    unsigned n_components() const override { return 1; }
    unsigned order() const override { return 2; }
    bool     symmetric() const override { return true; }

    /// Throws InputError where D is not positive or nu not in (-1, 1/2].
    void add_cell_terms(const dealii::FEValues<2> &, dealii::FullMatrix<double> &, dealii::Vector<double> &) const override;
    bool has_face_terms(dealii::types::boundary_id part) const override;
    void add_face_terms(const dealii::FEFaceValues<2> &,
                        dealii::types::boundary_id,
                        dealii::FullMatrix<double> &,
                        dealii::Vector<double> &) const override;

    /// (Hess u, Hess v) + (grad u, grad v) + (u, v), cell by cell.
    std::vector<FieldFunction> face_functions(dealii::types::boundary_id part) const override;
    void                       add_gram_terms(const dealii::FEValues<2> &, dealii::FullMatrix<double> &) const override;

    /// Hanging nodes may be on the face.
    bool        has_interior_face_terms() const override { return interior_penalty; }
    void        add_interior_face_terms(const dealii::FEInterfaceValues<2> &, dealii::FullMatrix<double> &) const override;
    FaceSide<2> interior_face_side(const dealii::FEFaceValuesBase<2> &) const override;

    /// {1/h} [du/dn] [dv/dn]
    void add_interior_face_gram(const dealii::FEInterfaceValues<2> &, dealii::FullMatrix<double> &) const override;

    /// With the C0 interior penalty method, where the part has a `slope` or is one of symmetry.
    bool has_slope_terms(dealii::types::boundary_id part) const override;
    void add_slope_terms(const dealii::FEFaceValues<2> &,
                         dealii::types::boundary_id,
                         dealii::FullMatrix<double> &,
                         dealii::Vector<double> &) const override;

    /// 1/h du/dn dv/dn
    void add_slope_gram(const dealii::FEFaceValues<2> &, dealii::types::boundary_id, dealii::FullMatrix<double> &) const override;

    /// The moments M_xx, M_yy, M_xy. In books on plates they have the opposite sign.
    unsigned n_flux_components() const override { return 3; }
    void     flux(const dealii::FEValues<2> &, const dealii::Vector<double> &, std::vector<Flux> &) const override;

    /// M : C^-1 M = [(1 + nu) M : M - nu (tr M)^2] / (D (1 - nu^2))
    double flux_energy(const Flux &, dealii::types::material_id, const dealii::Point<2> &) const override;
    void   load_less_reaction(const dealii::FEValues<2> &, const dealii::Vector<double> &, std::vector<double> &) const override;

    bool holds_rigid_body_modes() const override; ///< somewhere there is a foundation

    /// 1, x - centre, y - centre.
    std::vector<RigidBodyMode<2>>     rigid_body_modes(const dealii::Point<2> &centre) const override;
    std::pair<double, SourceLocation> load_samples() const override;

  private:
    struct Law
    {
      double D, nu;

      dealii::Tensor<2, 2> moments(const dealii::Tensor<2, 2> &hessian) const;
    };
    struct Region
    {
      FieldFunction stiffness, poisson, foundation, load, young, thickness;
      bool          from_thickness = false; ///< D = E t^3/(12 (1 - nu^2))

      Law law(const dealii::Point<2> &x) const;
    };
    struct EdgeTerms
    {
      FieldFunction force, spring, moment, slope_spring;
      FieldFunction slope;
      bool          slope_given = false;
    };

    std::vector<Region>    regions;
    std::vector<EdgeTerms> parts;
    bool                   interior_penalty;
    double                 penalty_factor;
  };
} // namespace unilateral
