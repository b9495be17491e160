// A membrane: a(u, v) = (k grad u, grad v) + (b . grad u, v) + (c u, v), f(v) = (f, v), and k du/dn = flux - spring u on the boundary.
#pragma once

#include "unilateral/forms/bilinear_form.h"
#include "unilateral/forms/model.h"
#include "unilateral/spaces/boundary_condition.h"

#include <vector>

namespace unilateral
{
  /// The coefficients that hold in one region of the mesh.
  template <int dim>
  struct MembraneCoefficients
  {
    std::vector<FieldFunction> stiffness; ///< k: 1 entry, or the upper triangle of a symmetric tensor, row by row
    std::vector<FieldFunction> velocity;  ///< b: none, or dim entries
    FieldFunction              reaction;  ///< c
    FieldFunction              load;      ///< f

    dealii::Tensor<2, dim> stiffness_tensor(const dealii::Point<dim> &p) const;
    dealii::Tensor<1, dim> velocity_vector(const dealii::Point<dim> &p) const;
    bool                   symmetric() const; ///< no velocity, or a zero one
  };

  template <int dim>
  class Membrane : public BilinearForm<dim>
  {
  public:
    /// @p coefficients, @p conditions: by material_id and boundary_id, see regions_and_parts.h.
    Membrane(const std::vector<Coefficients> &coefficients, const std::vector<PartCondition> &conditions);

    unsigned n_components() const override { return 1; }
    unsigned order() const override { return 1; }
    bool     symmetric() const override;
    void     add_cell_terms(const dealii::FEValues<dim> &, dealii::FullMatrix<double> &, dealii::Vector<double> &) const override;
    void     add_convection_terms(const dealii::FEValues<dim> &, dealii::FullMatrix<double> &) const override; ///< (b . grad u, v)
    bool     has_face_terms(dealii::types::boundary_id part) const override;
    void     add_face_terms(const dealii::FEFaceValues<dim> &,
                            dealii::types::boundary_id,
                            dealii::FullMatrix<double> &,
                            dealii::Vector<double> &) const override;
    std::vector<FieldFunction> face_functions(dealii::types::boundary_id part) const override;
    void                       add_gram_terms(const dealii::FEValues<dim> &, dealii::FullMatrix<double> &) const override;

    /// k grad u
    unsigned n_flux_components() const override { return dim; }
    void     flux(const dealii::FEValues<dim> &, const dealii::Vector<double> &, std::vector<Flux> &) const override;
    double   flux_energy(const Flux &, dealii::types::material_id, const dealii::Point<dim> &) const override;

    void   prepare(dealii::types::material_id region, const std::vector<dealii::Point<dim>> &points) const override;
    bool   uniform_in(dealii::types::material_id region) const override;
    bool   load_uniform_in(dealii::types::material_id region) const override;
    void   load_density(unsigned                               component,
                        dealii::types::material_id             region,
                        const std::vector<dealii::Point<dim>> &points,
                        std::vector<double>                   &at) const override;
    double convection_to_diffusion(dealii::types::material_id region, const dealii::Point<dim> &x) const override;
    bool   holds_rigid_body_modes() const override; ///< somewhere there is a reaction

    /// The constants.
    std::vector<RigidBodyMode<dim>>   rigid_body_modes(const dealii::Point<dim> &centre) const override;
    std::pair<double, SourceLocation> load_samples() const override;

    /// k du/dn = flux - spring u on a part.
    struct FaceTerms
    {
      FieldFunction flux, spring;
    };

    const MembraneCoefficients<dim> &coefficients_in(const dealii::types::material_id region) const { return regions[region]; }
    const FaceTerms                 &terms_on(const dealii::types::boundary_id part) const { return parts[part]; }

  private:
    std::vector<MembraneCoefficients<dim>> regions;
    std::vector<FaceTerms>                 parts;
  };
} // namespace unilateral
