// The problem in functions: mesh, V_h, a, f, boundary data and constraints, on the current refinement level.
#pragma once

#include "unilateral/forms/bilinear_form.h"
#include "unilateral/discretisation/problem_statement.h"
#include "unilateral/spaces/interpolation_to_refined_cells.h"
#include "unilateral/constraints/constraint_set.h"
#include "unilateral/functions/field_function.h"
#include "unilateral/mesh/mesh.h"
#include "unilateral/base/time_by_part.h"
#include "unilateral/base/shared_unknowns.h"
#include "unilateral/mesh/subdomain.h"
#include "unilateral/spaces/dirichlet_conditions.h"

#include <deal.II/dofs/dof_handler.h>
#include <deal.II/fe/fe.h>
#include <deal.II/fe/mapping.h>
#include <deal.II/lac/affine_constraints.h>

#include <memory>
#include <optional>
#include <vector>

namespace unilateral
{
  /// No point is left where a constraint could act: the mesh is too coarse, or everything is fixed.
  class NoPoints : public InputError
  {
    using InputError::InputError;
  };

  /// V_h on a mesh with names, the coefficients of a and f, and what bounds u where.
  template <int dim>
  class Problem
  {
  public:
    /// Builds the coarse mesh and everything that lives on it. Mistakes that only the mesh shows (part and region names, a rule that
    /// does not fit the element, a load that nothing holds) are added to @p diagnostics and thrown together as InputError.
    Problem(const ProblemStatement &statement, Diagnostics &diagnostics);

    /// Refines every cell once, or those of the next local refinement that the case asks for, and rebuilds V_h. Carries the given functions
    /// of V_h over by interpolation; @p smoothly: as good a guess as their smoothness allows, see InterpolationToRefinedCells. Hypercubes
    /// are refined in place; simplices get a triangulation of their own per level, see refine_simplices().
    void refine(std::vector<dealii::LinearAlgebra::distributed::Vector<double>> &functions, bool smoothly = false);

    /// Leaves this process a part of the mesh; other processes get the rest. From here on everything in this class is that of the part, and
    /// shared() says which unknowns others have too. To be followed by refine(), which carries @p functions of the whole over.
    void keep_own_part(const Processes &processes, const std::vector<dealii::LinearAlgebra::distributed::Vector<double>> &functions);

    /// The unknowns on cuts of V_h, or of the scalar functions nodes(). Nothing is shared by a process that has the whole mesh.
    const SharedUnknowns &shared() const { return shared_unknowns; }
    SharedUnknowns        shared(const dealii::DoFHandler<dim> &nodes) const;
    const Processes      &processes() const { return shared_unknowns.processes(); }

    /// How many times more cells the local refinements to come make: about, going by a few points of each cell there is.
    double growth_in_places() const;

    std::uint64_t n_cells() const;    ///< on all processes
    std::uint64_t n_unknowns() const; ///< of V_h, on all processes

    /// Gauss rule for a and f: exact for constant coefficients on affine cells, with a point a direction to spare for the load. For m = 0
    /// it is I_G itself where the points of I_G are the nodes of V_h.
    dealii::Quadrature<dim>     cell_quadrature() const;
    dealii::Quadrature<dim - 1> face_quadrature() const;

    bool symmetric() const { return form->symmetric(); }

    /// [boundary] and the coefficients leave a motion free, a constant or that of a rigid body: only the constraint holds the solution.
    bool semicoercive() const { return !kernel.empty(); }

    /// Scalar continuous functions of the same degree on the same mesh: its unknowns are the nodes of V_h. Built anew for each call.
    std::unique_ptr<dealii::DoFHandler<dim>>    nodes() const;
    std::unique_ptr<dealii::FiniteElement<dim>> node_element() const;   ///< that of nodes()
    std::unique_ptr<dealii::FiniteElement<dim>> scalar_element() const; ///< V_h itself when u is scalar

    /// An unknown that is a value of u at a point; those of Hermite elements that are derivatives are none.
    struct NodalValue
    {
      dealii::types::global_dof_index dof;
      dealii::Point<dim>              x;
      unsigned                        component;
    };
    std::vector<NodalValue> nodal_values() const;
    std::vector<bool>       values_among_unknowns() const; ///< which those are

    bool axisymmetric() const; ///< a body of revolution about x = 0
    bool hermite() const { return element.family == ElementName::Family::hermite; }

    /// K_h on the current level. Throws InputError where the boundary data or another constraint violate a bound.
    ConstraintSet<dim> make_constraint_set() const;

    /// Smallest and largest cell diameter.
    std::pair<double, double> cell_sizes() const;

    unsigned                                    level = 0; ///< of refinement
    const ProblemStatement                      statement;
    const ElementName                           element; ///< of V_h; P_p on segments is Q_p
    Mesh<dim>                                   mesh;
    std::unique_ptr<dealii::FiniteElement<dim>> fe; ///< scalar, or a system of dim equal ones
    std::unique_ptr<dealii::Mapping<dim>>       mapping;
    dealii::DoFHandler<dim>                     dof_handler;
    dealii::AffineConstraints<double>           hanging_nodes; ///< of functions of V_h, in terms of their neighbours
    dealii::AffineConstraints<double>           dirichlet;     ///< what [boundary] prescribes of u, and those
    std::unique_ptr<BilinearForm<dim>>          form;
    std::vector<DroppedValue<dim>>              dropped_values;  ///< what [boundary] prescribes and `dirichlet` leaves out
    std::vector<PartCondition>                  part_conditions; ///< by boundary_id
    std::vector<UnilateralCondition>            conditions;
    std::vector<Motion<dim>>                    kernel;      ///< of a: what only contact holds
    std::vector<Motion<dim>>                    unsupported; ///< what Dirichlet data leave free: the kernel and what springs alone hold
    std::unique_ptr<Subdomain<dim>>             subdomain;   ///< none: the mesh is the whole one

    bool has_pins() const { return !pins.empty(); }

    /// The values that stop motions which neither contact nor load knows of, and the names of these motions.
    const std::vector<Pin<dim>>    &pinned_values() const { return pins; }
    const std::vector<std::string> &pinned_motions() const { return names_of_pinned; }

    /// What is done with the problem counts here: whatever takes long is given the problem, and what it does not change is const to it.
    mutable PartTimes part_times;

  private:
    void make_form(Diagnostics &diagnostics);
    void read_constraints(Diagnostics &diagnostics);
    void read_surface(const UnilateralBound &spec, UnilateralCondition &condition, Diagnostics &diagnostics) const;
    void check_probes(Diagnostics &diagnostics) const;
    void hold_free_motions(Diagnostics *diagnostics = nullptr);
    void refine_in_place(const FieldFunction &chosen);
    void distribute_dofs();

    std::unique_ptr<InterpolationToRefinedCells<dim>> carried_to_part; ///< by keep_own_part() for refine()

    SharedUnknowns        shared_unknowns;
    std::vector<Pin<dim>> pins; ///< against motions that neither contact nor load knows of

    std::vector<std::string> names_of_pinned;
  };

  /// The functions f, s and data are sampled by a mesh of size h; says where a raster or profile is much finer than that.
  template <int dim>
  void warn_about_fine_rasters(const Problem<dim> &problem, Diagnostics &diagnostics);
} // namespace unilateral
