// a(.,.), f and the H^m inner product of one kind of problem, cell by cell.
#pragma once

#include "unilateral/base/diagnostics.h"
#include "unilateral/forms/face_side.h"
#include "unilateral/functions/field_function.h"
#include "unilateral/spaces/surface_moments.h"

#include <deal.II/base/point.h>
#include <deal.II/base/tensor.h>
#include <deal.II/base/types.h>
#include <deal.II/fe/fe_interface_values.h>
#include <deal.II/fe/fe_values.h>
#include <deal.II/lac/full_matrix.h>
#include <deal.II/lac/vector.h>

#include <array>
#include <cmath>
#include <functional>
#include <string>
#include <vector>

namespace unilateral
{
  /// What a membrane's k grad u and a body's stress are called when either may be meant: up to six numbers at a point.
  using Flux = std::array<double, 6>;

  /// A function on which a vanishes but for what holds it: 1 for a membrane, the rigid body modes of a body.
  template <int dim>
  struct RigidBodyMode
  {
    std::string                                                       name;  ///< "translation along x"
    std::function<dealii::Tensor<1, dim>(const dealii::Point<dim> &)> value; ///< only the first component counts when u is scalar
  };

  /// a(u, v) and f(v) of a kind of problem: membrane.h, elasticity.h, beam.h, plate.h. The values that boundary conditions prescribe are
  /// none of its business, what they add to a and f is.
  template <int dim>
  class BilinearForm
  {
  public:
    virtual ~BilinearForm() = default;

    virtual unsigned n_components() const = 0; ///< of u: 1 or dim
    virtual unsigned order() const = 0;        ///< m: a is continuous on H^m
    virtual bool     symmetric() const = 0;

    /// Weight of dx: 1, or 2 pi r where the domain is turned about an axis.
    virtual double measure(const dealii::Point<dim> &) const { return 1; }

    /// Adds a(phi_j, phi_i) on a cell to @p matrix and f(phi_i) to @p load; @p values has values, gradients, quadrature points, JxW;
    /// where order() is 2, hessians too, here and in add_gram_terms() and flux().
    virtual void
    add_cell_terms(const dealii::FEValues<dim> &values, dealii::FullMatrix<double> &matrix, dealii::Vector<double> &load) const = 0;

    /// The same f(phi_i) alone.
    virtual void add_cell_load(const dealii::FEValues<dim> &values, dealii::Vector<double> &load) const
    {
      dealii::FullMatrix<double> matrix(values.dofs_per_cell, values.dofs_per_cell);
      add_cell_terms(values, matrix, load);
    }

    /// Adds what of the terms of add_cell_terms() is not symmetric to @p matrix; nothing where symmetric().
    virtual void add_convection_terms(const dealii::FEValues<dim> &, dealii::FullMatrix<double> &) const {}

    /// The part of the boundary has terms in a or f.
    virtual bool has_face_terms(dealii::types::boundary_id part) const = 0;

    /// Adds the terms of a face on @p part; @p values has values, normals, quadrature points, JxW; where order() is 2, gradients too.
    virtual void add_face_terms(const dealii::FEFaceValues<dim> &values,
                                dealii::types::boundary_id       part,
                                dealii::FullMatrix<double>      &matrix,
                                dealii::Vector<double>          &load) const = 0;

    /// Loads are given by their resultants on a part, whatever its size: set_surface_moments() has to be called for every mesh. Throws
    /// InputError where a part cannot bear such a load.
    virtual bool needs_surface_moments() const { return false; }
    virtual void set_surface_moments(const std::vector<SurfaceMoments<dim>> & /*by part*/) {}

    /// What add_face_terms() integrates on the part, as far as it is not constant: where one of them jumps, the face needs more points.
    virtual std::vector<FieldFunction> face_functions(dealii::types::boundary_id) const { return {}; }

    /// The unit l in which the H^m norm measures lengths: ||v||_m^2 = sum over k of l^(2(k - m)) |v|_k^2. 1, the unit of the case, unless
    /// the size of the domain is far from it, see norm_unit().
    double unit_of_length = 1;

    /// Adds the full H^m inner product, component by component.
    virtual void add_gram_terms(const dealii::FEValues<dim> &values, dealii::FullMatrix<double> &matrix) const = 0;

    /// The elements are not in H^m: a and the H^m inner product have terms on the faces between cells.
    virtual bool has_interior_face_terms() const { return false; }

    /// Adds the terms of a face between two cells to @p matrix, whose rows and columns are the interface DoFs of @p values, which has
    /// gradients, hessians, normals, quadrature points, JxW.
    virtual void add_interior_face_terms(const dealii::FEInterfaceValues<dim> &, dealii::FullMatrix<double> &) const {}

    /// What one of the two cells contributes to both, @p values on its side: with the same points as on the other.
    virtual FaceSide<dim> interior_face_side(const dealii::FEFaceValuesBase<dim> &) const { return FaceSide<dim>(); }

    /// What makes add_gram_terms() a norm on elements that are not in H^m: the jumps.
    virtual void add_interior_face_gram(const dealii::FEInterfaceValues<dim> &, dealii::FullMatrix<double> &) const {}

    /// du/dn is prescribed on the part, and not by values of unknowns but by terms in a and f.
    virtual bool has_slope_terms(dealii::types::boundary_id) const { return false; }

    /// Adds the terms of a face on a part with has_slope_terms(); @p values has gradients, hessians, normals, quadrature points, JxW.
    virtual void add_slope_terms(const dealii::FEFaceValues<dim> &,
                                 dealii::types::boundary_id,
                                 dealii::FullMatrix<double> &,
                                 dealii::Vector<double> &) const
    {
    }

    /// The same for the inner product.
    virtual void add_slope_gram(const dealii::FEFaceValues<dim> &, dealii::types::boundary_id, dealii::FullMatrix<double> &) const {}

    /// In the region changes of volume are averaged at vertices, see VertexVolumes: neither add_cell_terms() nor flux() contain what they
    /// cost.
    virtual bool averages_volume_in(dealii::types::material_id) const { return false; }

    /// There: lambda at a point, and div phi_i at each point of a cell (points x unknowns).
    virtual double volume_modulus(dealii::types::material_id, const dealii::Point<dim> &) const { return 0; }
    virtual void   volume_changes(const dealii::FEValues<dim> &, dealii::FullMatrix<double> &) const {}

    /// Some cells have an energy of changes of volume that iterative solvers take as a term of its own, see MixedSolver.
    virtual bool projects_volume() const { return false; }

    /// Twice that energy of a cell is |C u|^2, C = @p rows, rows x unknowns of the cell. False: the cell has none.
    virtual bool volume_rows(const dealii::FEValues<dim> &, dealii::FullMatrix<double> & /*rows*/) const { return false; }

    /// What add_cell_terms() adds, without |C u|^2.
    virtual void
    add_cell_terms_but_volume(const dealii::FEValues<dim> &values, dealii::FullMatrix<double> &matrix, dealii::Vector<double> &load) const
    {
      add_cell_terms(values, matrix, load);
    }

    virtual unsigned n_flux_components() const = 0;

    /// The flux at every quadrature point of the cell; @p u holds the cell's unknowns.
    virtual void flux(const dealii::FEValues<dim> &values, const dealii::Vector<double> &u, std::vector<Flux> &at) const = 0;

    /// Twice the energy density of a flux, q.k^-1 q or sigma : C^-1 sigma: what a(v, v) integrates when the flux is that of v.
    virtual double flux_energy(const Flux &flux, dealii::types::material_id region, const dealii::Point<dim> &x) const = 0;

    /// flux_energy() is wanted at these points next.
    virtual void prepare(dealii::types::material_id /*region*/, const std::vector<dealii::Point<dim>> & /*points*/) const {}

    /// In the region all coefficients of a are constants: cells that are shifts of each other have equal matrices.
    virtual bool uniform_in(dealii::types::material_id) const { return false; }

    /// In a region that is uniform: the coefficients of f are constants, too. Else f(v) = int f_c v_c on cells, with these f_c.
    virtual bool load_uniform_in(dealii::types::material_id) const { return true; }
    virtual void load_density(unsigned /*component*/,
                              dealii::types::material_id,
                              const std::vector<dealii::Point<dim>> &points,
                              std::vector<double>                   &at) const
    {
      at.assign(points.size(), 0.);
    }

    /// Of order 4: f - c u at the points of the cell; @p u holds the cell's unknowns.
    virtual void
    load_less_reaction(const dealii::FEValues<dim> & /*values*/, const dealii::Vector<double> & /*u*/, std::vector<double> &at) const
    {
      at.clear();
    }

    /// How much dearer changes of volume are than changes of shape, lambda/mu where that is largest. Where it is large, functions
    /// without divergence are nearly free and all others dear, which smoothing point by point makes slow.
    virtual double volume_to_shape_stiffness() const { return 0; }

    /// How much stronger convection is than diffusion over a unit of length at a point, |b| divided by the least eigenvalue of k.
    virtual double convection_to_diffusion(dealii::types::material_id, const dealii::Point<dim> &) const { return 0; }

    /// a has a term (c u, v), so that it vanishes on none of the modes.
    virtual bool holds_rigid_body_modes() const { return false; }

    /// The functions on which a may vanish. Rotations turn about @p centre.
    virtual std::vector<RigidBodyMode<dim>> rigid_body_modes(const dealii::Point<dim> &centre) const = 0;

    /// Distance between the samples of f, 0 where it is no raster or profile, and where f stands in the case.
    virtual std::pair<double, SourceLocation> load_samples() const = 0;
  };

  /// l of the norm of H^@p m on a domain of diameter @p diameter. In a unit in which the diameter is 1e-7, the terms of the norm differ by
  /// fourteen digits (m = 1) or 28 (m = 2): what only contact holds then has a norm of nothing but round-off. Where diameter^2m leaves
  /// [1e-8, 1e8] lengths are measured in diameters; between, in the unit of the case.
  inline double norm_unit(const double diameter, const unsigned m)
  {
    const double ratio = std::pow(diameter, 2. * m);
    return ratio < 1e-8 || ratio > 1e8 ? diameter : 1.;
  }
} // namespace unilateral
