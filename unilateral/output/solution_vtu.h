// The files a run leaves: the solution and the constraint points for ParaView.
#pragma once

#include "unilateral/constraints/constraint_set.h"
#include "unilateral/inequality/discrete_problem.h"
#include "unilateral/output/result_files.h"
#include "unilateral/output/vtu_file.h"

#include <deal.II/dofs/dof_handler.h>
#include <deal.II/fe/mapping.h>

#include <string>
#include <vector>

namespace unilateral
{
  /// A function and the name it gets in the file.
  template <int dim>
  struct NamedField
  {
    std::string                    name;
    const Vector                  *values;
    const dealii::DoFHandler<dim> *space = nullptr; ///< where it lives: null for V_h
  };

  /// Where each of several processes writes a piece: the files of all pieces, the first of which also writes NAME.pvtu, and the level of
  /// refinement of the coarse cells of the own piece.
  struct Pieces
  {
    std::vector<std::string> files; ///< none: the file is the whole
    unsigned                 coarse_level = 0;
  };

  /// u and further functions of V_h at the nodes of degree @p degree of every locally owned cell, equally spaced: each cell is cut into
  /// degree^dim linear ones, neighbours share their points, so that ParaView's filters (warp by scalar, contour, slice) see a
  /// continuous surface. Point arrays: "u" (a vector of three components when V_h is vector-valued) and the names given; cell arrays:
  /// "level" (of refinement), "region" (material id). Functions that jump between cells get points of their own in each.
  template <int dim>
  VtuGrid solution_grid(const dealii::Mapping<dim>         &mapping,
                        const dealii::DoFHandler<dim>      &dof_handler,
                        const Vector                       &u,
                        unsigned int                        degree,
                        const std::vector<NamedField<dim>> &fields = {},
                        unsigned                            coarse_level = 0);

  /// The same in a file.
  template <int dim>
  void write_solution_vtu(const std::string                  &path,
                          const dealii::Mapping<dim>         &mapping,
                          const dealii::DoFHandler<dim>      &dof_handler,
                          const Vector                       &u,
                          unsigned int                        degree,
                          const std::vector<NamedField<dim>> &fields = {},
                          const Pieces                       &pieces = {});

  /// The points of I_G as a vertex cloud. Arrays: pressure (lambda >= 0), gap = sign (bound - u) (> 0 apart, < 0 penetrating),
  /// penetration = max(0, -gap), active (1 where pressure > 0), weight, side (0 lower, 1 upper), block (index of the constraint's side);
  /// for an elastic body also direction, along which the gap is measured, and u_along, the displacement along it.
  /// @p u and @p pressure hold a number for each point of @p set.
  template <int dim>
  VtuGrid constraint_points_grid(const ConstraintSet<dim> &set, const std::vector<double> &u, const std::vector<double> &pressure);

  /// The same in a file.
  template <int dim>
  void write_constraint_points_vtu(const std::string         &path,
                                   const ConstraintSet<dim>  &set,
                                   const std::vector<double> &u,
                                   const std::vector<double> &pressure,
                                   const Pieces              &pieces = {});
} // namespace unilateral
