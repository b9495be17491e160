// a(.,.), f and the H^m inner product, cell by cell, for a membrane: (k grad u, grad v) + (b . grad u, v) + (c u, v) = (f, v).
#pragma once

#include "unilateral/field_function.h"

#include <deal.II/base/tensor.h>
#include <deal.II/fe/fe_values.h>
#include <deal.II/lac/full_matrix.h>
#include <deal.II/lac/vector.h>

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

  /// What holds on one part of the boundary: u = value, or k du/dn = flux - spring u.
  struct BoundaryCondition
  {
    std::optional<FieldFunction> value;
    FieldFunction                flux, spring;
    SourceLocation               where;
  };

  /// Adds a(phi_j, phi_i) on the cell to @p matrix and f(phi_i) to @p load; @p values has values, gradients, quadrature points, JxW.
  template <int dim>
  void add_cell_terms(const dealii::FEValues<dim>     &values,
                      const MembraneCoefficients<dim> &coefficients,
                      dealii::FullMatrix<double>      &matrix,
                      dealii::Vector<double>          &load);

  /// Adds spring (phi_j, phi_i) and (flux, phi_i) on a face.
  template <int dim>
  void add_face_terms(const dealii::FEFaceValues<dim> &values,
                      const BoundaryCondition         &condition,
                      dealii::FullMatrix<double>      &matrix,
                      dealii::Vector<double>          &load);

  /// Adds the full H^1 inner product (grad phi_j, grad phi_i) + (phi_j, phi_i) on the cell.
  template <int dim>
  void add_gram_terms(const dealii::FEValues<dim> &values, dealii::FullMatrix<double> &matrix);
} // namespace unilateral
