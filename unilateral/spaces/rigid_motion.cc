#include "unilateral/spaces/rigid_motion.h"

#include "unilateral/algebra/null_space.h"

#include <algorithm>
#include <cmath>

namespace unilateral
{
  using namespace dealii;
  using Eigen::MatrixXd;
  using Eigen::RowVectorXd;
  using Eigen::VectorXd;

  namespace
  {
    /// An equation of which no more than this is left beside earlier ones says nothing new.
    constexpr double dependent = 1e-7;
  } // namespace

  template <int dim>
  RigidMotion<dim>::RigidMotion(const Point<dim> &reference, const double length)
    : reference(reference), length(length > 0 ? length : 1.), equations(0, dim + n_rotations), values(0)
  {
  }

  template <int dim>
  RowVectorXd RigidMotion<dim>::row_of_translation(const unsigned component) const
  {
    return RowVectorXd::Unit(dim + n_rotations, component);
  }

  template <int dim>
  RowVectorXd RigidMotion<dim>::row_of_rotation(const unsigned axis) const
  {
    return RowVectorXd::Unit(dim + n_rotations, dim + axis) / length;
  }

  template <int dim>
  RowVectorXd RigidMotion<dim>::row(const unsigned component, const Point<dim> &x) const
  {
    RowVectorXd          result = row_of_translation(component);
    const Tensor<1, dim> r = (x - reference) / length;
    if constexpr (dim == 2)
      result(2) = component == 0 ? -r[1] : r[0];
    if constexpr (dim == 3)
    {
      // theta x r, component by component.
      const unsigned a = (component + 1) % 3, b = (component + 2) % 3;
      result(3 + a) = r[b];
      result(3 + b) = -r[a];
    }
    return result;
  }

  template <int dim>
  RowVectorXd RigidMotion<dim>::row(const Tensor<1, dim> &direction, const Point<dim> &x) const
  {
    RowVectorXd result = RowVectorXd::Zero(dim + n_rotations);
    for (unsigned c = 0; c < dim; ++c)
      result += direction[c] * row(c, x);
    return result;
  }

  template <int dim>
  double RigidMotion<dim>::prescribe(const RowVectorXd &row, const double g)
  {
    const double norm = row.norm();
    RowVectorXd  rest = row;
    double       left = g, size = std::abs(g);
    // Twice, since one sweep leaves what rounding makes of nearly dependent rows.
    for (unsigned sweep = 0; sweep < 2; ++sweep)
      for (Eigen::Index k = 0; k < equations.rows(); ++k)
      {
        const double factor = rest.dot(equations.row(k));
        rest -= factor * equations.row(k);
        left -= factor * values(k);
        size += std::abs(factor * values(k));
      }
    if (rest.norm() <= dependent * std::max(norm, 1e-300))
      return std::abs(left) > 1e-6 * size ? std::abs(left) : 0.;
    const Eigen::Index n = equations.rows();
    equations.conservativeResize(n + 1, Eigen::NoChange);
    values.conservativeResize(n + 1);
    equations.row(n) = rest / rest.norm();
    values(n) = left / rest.norm();
    return 0;
  }

  template <int dim>
  VectorXd RigidMotion<dim>::particular() const
  {
    return equations.transpose() * values;
  }

  template <int dim>
  MatrixXd RigidMotion<dim>::free_motions() const
  {
    return null_space(equations.transpose() * equations, 0.5);
  }

  template class RigidMotion<1>;
  template class RigidMotion<2>;
  template class RigidMotion<3>;
} // namespace unilateral
