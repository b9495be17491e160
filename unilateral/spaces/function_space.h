// V_h: mesh, element, mapping, numbering and Dirichlet conditions, and the way to the next finer one.
#pragma once

#include "unilateral/base/shared_unknowns.h"
#include "unilateral/base/time_by_part.h"
#include "unilateral/mesh/mesh.h"
#include "unilateral/mesh/simplex_refinement.h"
#include "unilateral/mesh/subdomain.h"
#include "unilateral/spaces/boundary_condition.h"
#include "unilateral/spaces/dirichlet_conditions.h"
#include "unilateral/spaces/element.h"
#include "unilateral/spaces/interpolation_to_refined_cells.h"
#include "unilateral/spaces/node_couplings.h"

#include <deal.II/base/quadrature.h>
#include <deal.II/dofs/dof_handler.h>
#include <deal.II/fe/fe.h>
#include <deal.II/fe/mapping.h>
#include <deal.II/lac/affine_constraints.h>
#include <deal.II/lac/la_parallel_vector.h>

#include <cstdint>
#include <memory>
#include <optional>
#include <utility>
#include <vector>

namespace unilateral
{
  /// What fixes values of V_h: conditions on the boundary and at nodes inside.
  template <int dim>
  struct DirichletData
  {
    std::vector<PartCondition> conditions;      ///< by boundary_id
    std::vector<InnerSupport>  supports;        ///< of beams
    bool                       on_axis = false; ///< u_x = 0 where x = 0, as in a body of revolution
    std::vector<Pin<dim>>      pins;            ///< side conditions on rigid body modes that nothing else determines
    std::vector<PeriodicPair>  periodic;        ///< parts of which one repeats the other
  };

  /// Finite element functions, scalar or with dim components, on a mesh with named parts that can be refined.
  template <int dim>
  class FunctionSpace
  {
  public:
    using Functions = std::vector<dealii::LinearAlgebra::distributed::Vector<double>>;

    /// @p mesh: the coarse one. @p element: P_p on segments is Q_p. @p points_1d: of a discontinuous element, whose functions are given
    /// by their values at the tensor points. @p where: what the message points at where 'hermite' meets a mesh that is not made of
    /// rectangles along the axes (InputError). Has no unknowns before distribute_dofs().
    FunctionSpace(Mesh<dim>                    mesh,
                  const ElementName           &element,
                  unsigned                     n_components,
                  const dealii::Quadrature<1> &points_1d,
                  const SourceLocation        &where,
                  TimeByPart                  &time);

    /// Numbers the unknowns and resolves hanging nodes and the Dirichlet conditions.
    void distribute_dofs(const DirichletData<dim> &data);

    /// Resolves the Dirichlet conditions alone: mesh and numbering stay as they are.
    void fix_values(const DirichletData<dim> &data);

    /// Refines the mesh, as a whole or, with @p chosen, those active cells; meshes for Hermite elements always as a whole. In a part of a
    /// mesh cells at cuts are refined where other processes refine theirs, see flag_alike_at_cuts().
    /// Rebuilds V_h. Carries @p functions over by interpolation; @p smoothly: as good a guess as their smoothness allows, see
    /// InterpolationToRefinedCells. Hypercubes are refined in place; simplices get a triangulation of their own per level, see
    /// refine_simplices().
    void refine(const DirichletData<dim> &data, Functions &functions, bool smoothly, const std::vector<bool> *chosen);

    /// The active cells where @p place is not zero at the centre or a corner. Throws InputError where there are none.
    std::vector<bool> cells_at(const FieldFunction &place) const;

    /// The mesh can be refined in places.
    bool refines_in_places() const { return !hermite(); }

    /// Leaves this process a part of the mesh; other processes get the rest. From here on everything in this class is that of the part, and
    /// shared() says which unknowns others have too. @p functions become those on the part; but those on hypercubes that are refined
    /// everywhere, and next (@p refined_next), are carried over by refine(), smoothly across cuts.
    /// A part that @p n_alike processes have each may be divided among them later, when cells are those of one refinement of the whole.
    void keep_own_part(
      DirichletData<dim> &data, const Processes &processes, Division division, unsigned n_alike, Functions &functions, bool refined_next);

    /// The mesh is divided, and can be divided anew: no process has to know it as a whole, and no node hangs. Collective.
    bool can_be_divided_anew() const;

    /// Of a mesh that is divided: the processes exchange cells until each has as much of the @p weights, of active cells, as the others.
    /// What this class says is that of the new part then, and so are the @p functions and the @p marks of active cells. False, and nothing
    /// is changed, where a process would be left without cells. Collective.
    bool divide_anew(const DirichletData<dim> &data, const std::vector<double> &weights, Functions &functions, std::vector<bool> &marks);

    /// The unknowns on cuts of V_h, or of the scalar functions nodes(). Nothing is shared by a process that has the whole mesh.
    const SharedUnknowns &shared() const { return shared_unknowns; }
    SharedUnknowns        shared(const dealii::DoFHandler<dim> &nodes) const;
    const Processes      &processes() const { return subdomain ? subdomain->processes : shared_unknowns.processes(); }

    /// A face on the boundary of the whole mesh, not on a cut.
    template <typename Cell>
    bool is_outside(const Cell &cell, const unsigned face) const
    {
      const bool on_cut = subdomain && cell->at_boundary(face) && cell->face(face)->boundary_id() == mesh.part_names.size() - 1;
      return cell->at_boundary(face) && !on_cut;
    }

    std::uint64_t n_cells() const;    ///< on all processes
    std::uint64_t n_unknowns() const; ///< on all processes

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

    bool hermite() const { return element.family == ElementName::Family::hermite; }

    /// In which order a cell is refined; of simplices.
    template <typename Cell>
    const CornerOrder &corner_order(const Cell &cell) const
    {
      return corner_orders.empty() ? in_sequence : corner_orders[cell->active_cell_index()];
    }

    /// Smallest and largest cell diameter.
    std::pair<double, double> cell_sizes() const;

    unsigned                                    level = 0; ///< of refinement
    const ElementName                           element;   ///< never simplex() in 1-D: on segments P is Q
    Mesh<dim>                                   mesh;
    std::unique_ptr<dealii::FiniteElement<dim>> fe; ///< scalar, or a system of dim equal ones
    std::unique_ptr<dealii::Mapping<dim>>       mapping;
    dealii::DoFHandler<dim>                     dof_handler;
    dealii::AffineConstraints<double>           hanging_nodes;           ///< of functions of V_h, in terms of their neighbours
    dealii::AffineConstraints<double>           dirichlet;               ///< the prescribed values, and those
    NodeCouplings<dim>                          couplings;               ///< ties between nodes, which `dirichlet` contains
    std::vector<DroppedValue<dim>>              dropped_values;          ///< what is prescribed and `dirichlet` leaves out
    std::unique_ptr<Subdomain<dim>>             subdomain;               ///< none: the mesh is the whole one
    std::vector<CutLines>                       lines_cut_by_refinement; ///< of simplices, from the coarse mesh of the part on
    std::vector<CornerOrder>                    corner_orders;           ///< of simplices, by active cell: how refine() sees them

  private:
    void                  flag_beyond_cuts();
    RefinedSimplices<dim> refined_in_places(const std::vector<bool> &chosen) const;

    bool                                              on_manifold = false; ///< cells follow one, be they curved or not
    const dealii::Quadrature<1>                       points_1d;
    TimeByPart                                       &time;
    std::unique_ptr<InterpolationToRefinedCells<dim>> carried_to_part; ///< by keep_own_part() for refine()
    SharedUnknowns                                    shared_unknowns;
  };
} // namespace unilateral
