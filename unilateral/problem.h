// The problem in functions: mesh, V_h, a, f, boundary data and constraints, on the current refinement level.
#pragma once

#include "unilateral/bilinear_form.h"
#include "unilateral/case.h"
#include "unilateral/constraint_set.h"
#include "unilateral/field_function.h"
#include "unilateral/mesh.h"

#include <deal.II/dofs/dof_handler.h>
#include <deal.II/fe/fe.h>
#include <deal.II/fe/mapping.h>
#include <deal.II/lac/affine_constraints.h>

#include <memory>
#include <optional>
#include <vector>

namespace unilateral
{
  /// V_h on a mesh with names, the coefficients of a and f, and what bounds u where.
  template <int dim>
  class Problem
  {
  public:
    /// Builds the coarse mesh and everything that lives on it. Mistakes that only the mesh shows (part and region names, a rule that
    /// does not fit the element, a load that nothing holds) are added to @p diagnostics and thrown together as InputError.
    Problem(const Case &request, Diagnostics &diagnostics);

    /// Refines every cell once and rebuilds V_h. Carries the given functions of V_h over by interpolation.
    /// Hypercubes are refined in place; simplices get a triangulation of their own per level, see refine_simplices().
    void refine(std::vector<dealii::LinearAlgebra::distributed::Vector<double>> &functions);

    /// Gauss rule for a and f: exact for constant coefficients on affine cells, with a point a direction to spare for the load.
    dealii::Quadrature<dim>     cell_quadrature() const;
    dealii::Quadrature<dim - 1> face_quadrature() const;

    bool symmetric() const;

    /// No Dirichlet data, spring or reaction: a vanishes on constants, and only the constraint holds the solution.
    bool semicoercive() const;

    const MembraneCoefficients<dim> &coefficients(const typename dealii::DoFHandler<dim>::cell_iterator &cell) const
    {
      return region_coefficients[cell->material_id()];
    }
    const BoundaryCondition &boundary_condition(dealii::types::boundary_id part) const { return part_conditions[part]; }

    /// K_h on the current level. Throws InputError where the boundary data or another constraint violate a bound.
    ConstraintSet<dim> make_constraint_set() const;

    /// Smallest and largest cell diameter.
    std::pair<double, double> cell_sizes() const;

    unsigned                                    level = 0; ///< of refinement
    const Case                                  request;
    const ElementSpec                           element; ///< of V_h; P_p on segments is Q_p
    Mesh<dim>                                   mesh;
    std::unique_ptr<dealii::FiniteElement<dim>> fe;
    std::unique_ptr<dealii::Mapping<dim>>       mapping;
    dealii::DoFHandler<dim>                     dof_handler;
    dealii::AffineConstraints<double>           dirichlet; ///< u = value on the parts that have one
    std::vector<UnilateralCondition>            conditions;

  private:
    void read_coefficients(Diagnostics &diagnostics);
    void read_boundary(Diagnostics &diagnostics);
    void read_constraints(Diagnostics &diagnostics);
    void check_probes(Diagnostics &diagnostics) const;
    void check_semicoercive_load(Diagnostics &diagnostics) const;
    void distribute_dofs();

    std::vector<MembraneCoefficients<dim>> region_coefficients; ///< by material_id
    std::vector<BoundaryCondition>         part_conditions;     ///< by boundary_id
  };

  /// The functions f, s and data are sampled by a mesh of size h; says where a raster or profile is much finer than that.
  template <int dim>
  void warn_about_fine_rasters(const Problem<dim> &problem, Diagnostics &diagnostics);
} // namespace unilateral
