// Tractions on all faces of a body that are in balance with the load on every cell.
#pragma once

#include "unilateral/discretisation/cut_faces.h"
#include "unilateral/discretisation/problem.h"
#include "unilateral/equilibration/body_cells.h"
#include "unilateral/equilibration/face_tractions.h"
#include "unilateral/equilibration/feasible_displacement.h"
#include "unilateral/equilibration/rigid_motions.h"
#include "unilateral/equilibration/stress_balance.h"
#include "unilateral/evaluation/estimator.h"
#include "unilateral/forms/elasticity.h"

#include <string>
#include <vector>

namespace unilateral
{
  /// On faces inside, and where the displacement is given, the recovered stress times the normal; on the rest of the boundary, and in
  /// directions that are free there, traction - pressure n - springs (u_h + r) - rho n, with the contact pressure rho >= 0, all as
  /// polynomials on the faces. Forces and moments of cells are balanced by StressBalance. Where no support stops a mode of the body, rho is
  /// first scaled face by face until the body is in balance in it, and what is missing then is left to the springs, by r of spring_shift().
  /// Where the mesh is divided, each part is first brought into balance by TractionsAcrossCuts.
  template <int dim>
  class EquilibratedTractions
  {
  public:
    /// Collective.
    EquilibratedTractions(const Problem<dim>              &problem,
                          const Elasticity<dim>           &elasticity,
                          const Vector                    &u,
                          const std::vector<Vector>       &pressures,
                          const RecoveredFlux<dim>        &flux,
                          const FeasibleDisplacement<dim> &displacement,
                          const BodyCells<dim>            &cells);

    /// Why there are none; empty: there are. The same on all processes.
    const std::string &obstacle() const { return reason; }

    /// The pressure of one condition on a face, in the basis of the tractions: nowhere negative.
    struct Pressure
    {
      std::size_t     face, condition;
      Eigen::VectorXd coefficients;
    };

    /// The body load varies within the cell, so that it may be no polynomial.
    bool load_varies(const typename BodyCells<dim>::Cell &cell) const;

    /// A rigid body mode r, nothing but rounding and the residual of the solver over the stiffness of soft springs: the tractions of
    /// springs are those of the displacement u + r.
    dealii::Tensor<1, dim> spring_shift(const dealii::Point<dim> &x) const;

    FaceTractions<dim>             tractions;
    std::vector<RigidMotions<dim>> motions; ///< by active cell
    std::vector<Pressure>          pressure;

  private:
    using Cell = typename BodyCells<dim>::Cell;

    void find_open_directions();
    void take_over_stress(const Vector &u);
    void add_pressures(const Vector &u, const std::vector<Vector> &pressures, const FeasibleDisplacement<dim> &displacement);
    /// The nodes of the cell on a face that the obstacle can hold: with the rule `edges` none at vertices, and none that are prescribed.
    std::vector<unsigned> nodes_with_points(const Cell &cell, unsigned f, bool on_edges) const;
    /// The polynomial on a face through the pressures at these nodes, of a lower degree where some are missing.
    Eigen::VectorXd pressure_on(const Cell &cell, unsigned f, const UnilateralCondition &condition, const Eigen::VectorXd &at_nodes) const;
    /// The pressure does more work on the gap than the stress that stands in for it where it is left out.
    bool costs_too_much(const Cell            &cell,
                        unsigned               f,
                        std::size_t            condition,
                        const Eigen::VectorXd &coefficients,
                        const Eigen::VectorXd &normal_displacement) const;
    void collect_imbalance(const BodyCells<dim> &cells);
    /// The modes of `free`, or others, at a point.
    std::vector<dealii::Tensor<1, dim>> free_modes_at(const dealii::Point<dim> &x) const;
    std::vector<dealii::Tensor<1, dim>> modes_at(const dealii::Point<dim> &x, const Eigen::MatrixXd &which) const;
    /// What the cells of this process are short of, added up, for motions of all of them together.
    Eigen::VectorXd missing_force(const Eigen::MatrixXd &which) const;
    Eigen::VectorXd missing_force() const; ///< of all processes, for those of `free`; collective
    void            scale_pressures();     // collective
    /// A polynomial more on a face at the boundary, its coefficients as basis functions x directions; its cell is short of that much less.
    void add_at_boundary(std::size_t number, const Eigen::MatrixXd &coefficients);
    /// Leaves to the springs what the pressures could not balance. Collective.
    void move_against_springs();
    void balance_parts(const StressBalance<dim> &within); // by tractions on cuts; collective
    void balance();                                       // collective
    void balance_fails();

    const unsigned                     degree; ///< of the tractions
    const Problem<dim>                &problem;
    const Elasticity<dim>             &elasticity;
    const RecoveredFlux<dim>          &flux;
    std::vector<TabulatedElement<dim>> nodes_at_faces, element_at_faces; ///< at the points of the rule of tractions
    std::vector<double>                imbalance, stiffness;
    RigidMotions<dim>                  body;
    Eigen::MatrixXd                    free;
    Eigen::VectorXd                    shift;                       ///< see spring_shift()
    double                             largest_scale = 0;           ///< of forces on a cell
    bool                               leaves_out_pressure = false; ///< on some face
    std::string                        reason;
    const Processes                   &processes;
    const CutFaces<dim>                cuts;
  };
} // namespace unilateral
