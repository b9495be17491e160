// A linearly elastic body with small strains: a(u, v) = (sigma(u), epsilon(v)), sigma = lambda tr(epsilon) I + 2 mu epsilon.
#pragma once

#include "unilateral/forms/bilinear_form.h"
#include "unilateral/forms/model.h"
#include "unilateral/spaces/boundary_condition.h"

#include <vector>

namespace unilateral
{
  /// sigma_xx, sigma_yy, sigma_zz, sigma_xy, sigma_xz, sigma_yz. In 2-D the third is the stress across the plane, that of the hoop in an
  /// axisymmetric body, and the last two are zero.
  using Stress = Flux;

  /// (3/2 s : s)^1/2, s the deviator.
  double von_mises(const Stress &stress);

  /// The eigenvalues, the largest first.
  std::array<double, 3> principal_stresses(const Stress &stress);

  /// In 2-D a slice of unit thickness in plane strain or plane stress, or a body of revolution: x is the distance r from the axis, y runs
  /// along it, and every integral is over the full circle, 2 pi r dr dy.
  /// On the boundary sigma n = traction - pressure n - springs u. A load may be given by its resultant force F, and moment M about a point
  /// p, on a part of area A and centroid c: the traction is F / A + theta x (x - c), where theta solves the symmetric system
  /// (int |r|^2 I - r r' dA) theta = M + (p - c) x F, r = x - c, with the integrals of the mesh and its quadrature.
  ///
  /// Nearly incompressible regions lock: the divergence of a conforming V_h cannot vanish cell by cell without u vanishing. On
  /// quadrilaterals and hexahedra the divergence in lambda div u div v is replaced, where asked for or nu > 0.45, by its L2 projection onto
  /// the polynomials of degree p - 1 in each coordinate of the cell: on parallelepipeds that is selective reduced integration with p Gauss
  /// points a direction, elsewhere it keeps the patch test. References: T. J. R. Hughes, Int. J. Numer. Meth. Engng 15 (1980) 1413-1418;
  /// D. S. Malkus, T. J. R. Hughes, Comp. Meth. Appl. Mech. Engng 15 (1978) 63-81.
  /// On triangles and tetrahedra of degree 1 and 2 changes of volume are averaged at vertices instead, see VertexVolumes.
  template <int dim>
  class Elasticity : public BilinearForm<dim>
  {
  public:
    /// @p coefficients, @p conditions: by material_id and boundary_id, see regions_and_parts.h. Regions without Young's modulus or
    /// Poisson's ratio are errors, and a warning tells where elements lock.
    Elasticity(const Model                      &model,
               const std::vector<Coefficients>  &coefficients,
               const std::vector<std::string>   &region_names,
               const std::vector<PartCondition> &conditions,
               Diagnostics                      &diagnostics);

    unsigned n_components() const override { return dim; }
    unsigned order() const override { return 1; }
    bool     symmetric() const override { return true; }
    double   measure(const dealii::Point<dim> &x) const override;
    bool     needs_surface_moments() const override;
    void     set_surface_moments(const std::vector<SurfaceMoments<dim>> &moments) override;
    void     add_cell_terms(const dealii::FEValues<dim> &, dealii::FullMatrix<double> &, dealii::Vector<double> &) const override;
    void     add_cell_load(const dealii::FEValues<dim> &, dealii::Vector<double> &) const override;
    bool     has_face_terms(dealii::types::boundary_id part) const override;
    void     add_face_terms(const dealii::FEFaceValues<dim> &,
                            dealii::types::boundary_id,
                            dealii::FullMatrix<double> &,
                            dealii::Vector<double> &) const override;
    std::vector<FieldFunction> face_functions(dealii::types::boundary_id part) const override;
    void                       add_gram_terms(const dealii::FEValues<dim> &, dealii::FullMatrix<double> &) const override;

    bool   averages_volume_in(dealii::types::material_id region) const override;
    double volume_modulus(dealii::types::material_id region, const dealii::Point<dim> &x) const override;
    void   volume_changes(const dealii::FEValues<dim> &values, dealii::FullMatrix<double> &divergence) const override;

    bool projects_volume() const override;
    bool volume_rows(const dealii::FEValues<dim> &, dealii::FullMatrix<double> &rows) const override;
    void add_cell_terms_but_volume(const dealii::FEValues<dim> &, dealii::FullMatrix<double> &, dealii::Vector<double> &) const override;

    void   prepare(dealii::types::material_id region, const std::vector<dealii::Point<dim>> &points) const override;
    bool   uniform_in(dealii::types::material_id region) const override;
    bool   load_uniform_in(dealii::types::material_id region) const override;
    void   load_density(unsigned                               component,
                        dealii::types::material_id             region,
                        const std::vector<dealii::Point<dim>> &points,
                        std::vector<double>                   &at) const override;
    double volume_to_shape_stiffness() const override; ///< of regions with a constant nu

    /// The stress.
    unsigned n_flux_components() const override { return 6; }
    void     flux(const dealii::FEValues<dim> &, const dealii::Vector<double> &, std::vector<Flux> &) const override;
    double   flux_energy(const Flux &, dealii::types::material_id, const dealii::Point<dim> &) const override;

    /// The rigid body modes: 3 in the plane, 6 in space, 1 along an axis.
    std::vector<RigidBodyMode<dim>>   rigid_body_modes(const dealii::Point<dim> &centre) const override;
    std::pair<double, SourceLocation> load_samples() const override;

    /// sigma = lambda tr(eps) I + 2 mu eps at a point; plane stress has a lambda of its own. `reduced`: lambda (div u)^2 is not integrated
    /// as it is.
    struct LameParameters
    {
      double lambda, mu;
      bool   reduced;
    };
    LameParameters lame_parameters(dealii::types::material_id region, const dealii::Point<dim> &x) const;

    /// f at many points.
    void load_densities(dealii::types::material_id             region,
                        const std::vector<dealii::Point<dim>> &points,
                        std::vector<dealii::Tensor<1, dim>>   &load) const;

    /// traction - pressure n, and the springs along the axes, on a part.
    dealii::Tensor<1, dim>
    surface_load(dealii::types::boundary_id part, const dealii::Point<dim> &x, const dealii::Tensor<1, dim> &normal) const;
    dealii::Tensor<1, dim> springs(dealii::types::boundary_id part, const dealii::Point<dim> &x) const;

  private:
    /// Of Poisson: above it full integration is taken to lock, lambda is 9 times mu.
    static constexpr double largest_locking_free_ratio = 0.45;

    struct Material
    {
      FieldFunction              young, poisson;
      std::vector<FieldFunction> load; ///< none, or dim entries
    };
    struct FaceTerms
    {
      std::vector<FieldFunction> traction; ///< none, or dim entries
      FieldFunction              pressure;
      std::vector<FieldFunction> springs; ///< none, one, or dim entries
      bool                       traction_is_total = false;
      std::vector<FieldFunction> moments; ///< none, or 1 in 2-D, 3 in 3-D
      std::vector<double>        about;   ///< none, or dim entries
      std::string                part;
      SourceLocation             where;
      double                     share = 1; ///< of the traction: 1 over the measure of the part where it is a total

      /// The traction W (x - centroid), W skew, that makes the moment.
      dealii::Tensor<2, dim> spin;
      dealii::Point<dim>     centroid;

      bool has_moment() const { return !moments.empty() || !about.empty(); }
    };
    void set_spin(FaceTerms &terms, const SurfaceMoments<dim> &moments) const;

    struct Moduli
    {
      double lambda, mu; ///< of the in-plane problem: plane stress has a lambda of its own
      bool   projected;  ///< the divergence
    };
    Moduli moduli(const Material &material, const dealii::Point<dim> &x) const;

    /// The divergence of each shape function at each point, row by row (points x unknowns), projected where the cell asks for it.
    void divergences(const dealii::FEValues<dim> &values, bool projected, dealii::FullMatrix<double> &result) const;

    /// Of a projection: the polynomials at the points, and their coefficients for the divergence of each unknown.
    struct ProjectedDivergence
    {
      dealii::FullMatrix<double> polynomials, coefficients;
    };
    ProjectedDivergence project(const dealii::FEValues<dim> &values, const dealii::FullMatrix<double> &divergence) const;

    static bool         has_stiff_volume(const std::vector<Moduli> &at);
    std::vector<Moduli> moduli_at_points(const dealii::FEValues<dim> &values, bool &projected) const;
    void add_cell_terms(const dealii::FEValues<dim> &, bool with_volume, dealii::FullMatrix<double> &, dealii::Vector<double> &) const;

    ModelChoices::Assumption  assumption;
    ModelChoices::Integration integration;
    bool                      simplex;
    unsigned                  degree;
    std::vector<Material>     regions;
    std::vector<FaceTerms>    parts;
  };
} // namespace unilateral
