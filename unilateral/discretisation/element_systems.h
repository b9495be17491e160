// A and f as sums of small matrices: of cells, boundary faces, faces between cells, and point loads.
#pragma once

#include "unilateral/discretisation/problem.h"
#include "unilateral/mesh/congruent_cells.h"
#include "unilateral/spaces/cell_points.h"

#include <deal.II/lac/full_matrix.h>
#include <deal.II/lac/vector.h>

#include <functional>
#include <vector>

namespace unilateral
{
  /// What a part of the mesh adds to A and f.
  struct LocalSystem
  {
    const std::vector<dealii::types::global_dof_index> &dofs;
    const dealii::FullMatrix<double>                   &matrix;
    const dealii::Vector<double>                       &load;
    bool                                                springs; ///< outside the cells: what boundary faces and single points add
  };

  /// Shapes of cells such that two cells of one shape have equal matrices and loads.
  template <int dim>
  CellShapes<dim> shapes_for_systems(const Problem<dim> &problem);

  /// The loads of cells whose matrices repeat where f does not: sums over the points of a rule with weights that repeat.
  template <int dim>
  class RepeatedLoad
  {
  public:
    explicit RepeatedLoad(const Problem<dim> &problem);

    /// @p values on a cell of the next shape (CellShapes).
    void add_shape(const dealii::FEValues<dim> &values);

    bool varies_in(const dealii::types::material_id region) const { return varies[region]; }

    /// Of a cell of a known shape, in place of what @p load holds.
    void integrate(const typename dealii::DoFHandler<dim>::active_cell_iterator &cell, unsigned shape, dealii::Vector<double> &load);

  private:
    const Problem<dim>              &problem;
    CellPoints<dim>                  points;
    std::vector<bool>                varies;
    std::vector<std::vector<double>> weighted_functions; ///< by shape: unknowns x points
    std::vector<std::vector<double>> density;            ///< components x points
  };

  /// What becomes of the terms that volume_rows() has, too. Those of VertexVolumes couple more unknowns than all others.
  enum class Volumes
  {
    included,
    of_vertices_apart, ///< the caller has those of VertexVolumes in another form
    apart              ///< the caller has all in another form
  };

  /// Visits all of them, cell by cell. Cells of one shape are integrated once.
  template <int dim>
  void for_each_local_system(const Problem<dim>                             &problem,
                             const std::function<void(const LocalSystem &)> &visit,
                             Volumes                                         volumes = Volumes::included);

  /// Those of the cells with their loads alone: the matrices are empty.
  template <int dim>
  void for_each_cell_load(const Problem<dim> &problem, const std::function<void(const LocalSystem &)> &visit);

  /// Those of boundary faces, faces between cells, vertices (VertexVolumes) and single points.
  template <int dim>
  void for_each_local_system_outside_cells(const Problem<dim>                             &problem,
                                           const std::function<void(const LocalSystem &)> &visit,
                                           Volumes                                         volumes = Volumes::included);

  /// The same for the H^m inner product, whose local load is empty. @p quadrature for the cells.
  template <int dim>
  void for_each_local_gram(const Problem<dim>                             &problem,
                           const dealii::Quadrature<dim>                  &quadrature,
                           const std::function<void(const LocalSystem &)> &visit);

  /// The couplings of A: of unknowns that share a cell, and across faces and around vertices where the form has terms there. Prescribed
  /// unknowns have none.
  template <int dim>
  void make_coupling_pattern(const Problem<dim> &problem, dealii::SparsityPattern &pattern, Volumes volumes = Volumes::included);

  /// What FEValues on cells must have for the form.
  template <int dim>
  dealii::UpdateFlags cell_flags(const BilinearForm<dim> &form)
  {
    const auto flags = dealii::update_values | dealii::update_gradients | dealii::update_quadrature_points | dealii::update_JxW_values;
    return form.order() > 1 ? flags | dealii::update_hessians : flags;
  }
} // namespace unilateral
