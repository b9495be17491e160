// The numbers of a run.
#pragma once

#include "unilateral/base/diagnostics.h"
#include "unilateral/base/progress.h"
#include "unilateral/evaluation/expectation.h"
#include "unilateral/inequality/certificate.h"

#include <deal.II/base/point.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace unilateral
{
  /// A connected piece of contact, see contact_components.h.
  struct ContactComponent
  {
    std::size_t         n_points = 0;
    double              measure = 0; ///< sum of the weights
    double              force = 0, distributed = 0, concentrated = 0;
    bool                resolved = false; ///< wide enough, seven points, for its force to be split with some accuracy
    std::vector<double> lower, upper;     ///< the box around its points
  };

  /// What a support of a beam or plate bears.
  struct SupportReaction
  {
    std::string on;         ///< part, or "x = 0.5" for a support inside
    double      force = 0;  ///< on the structure, in the direction of u
    double      moment = 0; ///< beams: EI u'' at an end, its jump at a support inside
  };

  /// One side of one constraint.
  struct ConstraintResult
  {
    std::string on;   ///< boundary part, "domain" when in the domain
    std::string side; ///< "lower" | "upper"
    std::string quadrature;
    std::size_t n_points = 0, n_active = 0;
    bool        exact_pairing = false;   ///< (14)
    double      contact_measure = 0;     ///< sum of w_i over active points
    double      total_contact_force = 0; ///< sum_i w_i lambda_i
    double      max_contact_pressure = 0;
    double      pressure_L2 = 0;     ///< I_G(lambda^2)^(1/2)
    double      max_penetration = 0; ///< max (Bu - s)^+
    double      complementarity = 0; ///< I_G(lambda |Bu - s - eps lambda|)

    /// Projection: max (u - bound)^+ over a lattice between the points, where nothing keeps a polynomial below its bound.
    std::optional<double> max_violation_between_points;

    /// Beams and plates. The pressure may have concentrated forces: its norm and maximum then grow with refinement.
    std::optional<std::vector<ContactComponent>> components;
    bool                                         concentrated = false;

    // Elasticity.
    std::vector<double> contact_force;  ///< of the obstacle on the body
    std::vector<double> contact_moment; ///< about the origin: 1 number in 2-D, 3 in 3-D
    std::size_t         n_missed = 0;   ///< points of the part that never meet the obstacle
  };

  struct ProbeResult
  {
    std::vector<double>                  point;
    std::vector<double>                  value;  ///< a number per component of u
    std::optional<std::array<double, 6>> stress; ///< of an elastic body: xx, yy, zz, xy, xz, yz
    double                               von_mises = 0;
    std::vector<double>                  moments; ///< of a beam: EI u''; of a plate: M_xx, M_yy, M_xy
  };

  /// The resultant forces on an elastic body, in the units of stress times area (2-D: per unit thickness; axisymmetric: of the full
  /// circle, where only the component along the axis is not zero).
  struct ForceBalance
  {
    struct Reaction
    {
      std::string         on; ///< the part whose condition holds the nodes
      std::vector<double> force;
    };
    std::vector<double>   load;      ///< body forces, tractions, pressures
    std::vector<double>   springs;   ///< of the foundation on the body
    std::vector<double>   contact;   ///< of the obstacles on the body
    std::vector<double>   reaction;  ///< of the supports on the body
    std::vector<Reaction> reactions; ///< by part
    /// The largest work of load + springs + contact + reaction on a rigid body mode (largest displacement 1), translations and rotations
    /// alike, relative to the largest of the four sums of sizes of nodal forces; 0 without forces.
    double residual = 0;
    /// The same of the forces at the nodes that fix modes which neither contact nor load knows of. They vanish where contact resists such
    /// a mode as little as it should.
    double                   side_conditions = 0;
    std::vector<std::string> side_conditions_on; ///< those modes
  };

  /// A part of a body that is bonded to a rigid platen, u = translation + rotation x (x - about).
  struct PlatenResult
  {
    std::string         on; ///< the part
    std::vector<double> about;
    std::vector<double> translation;
    std::vector<double> rotation; ///< in radians: 1 number in 2-D, 3 in 3-D, none where axisymmetric
    std::vector<double> force;    ///< of the platen on the body, load and reaction
    std::vector<double> moment;   ///< of that force about `about`; as many as rotations
  };

  /// What passes through the boundary between a periodic cell and the next one.
  struct PeriodicResult
  {
    std::vector<std::string> parts;
    std::vector<double>      force; ///< of the next cell on the second part: the integral of the flux, or of the stress vector
  };

  struct FunctionalResult
  {
    std::string name;
    double      value = 0;
  };

  struct Errors
  {
    std::optional<double> L2, H1_semi, H2_semi, max_nodal, mean_nodal, pressure_L2;
    std::optional<double> energy; ///< of a membrane or a body: ||u - u_h||_a without springs
  };

  /// How far u_h is from the solution of the continuous problem, in the energy norm.
  struct Estimate
  {
    double                total = 0;
    double                discretisation = 0, penalty = 0, algebraic = 0; ///< its parts
    bool                  guaranteed = false;                             ///< `total` is a bound
    std::string           reason;                                         ///< why it is none
    bool                  load_unresolved = false; ///< the load varies within cells by more than their rules can follow
    std::optional<double> effectivity;             ///< total over the error, where that is known

    /// A number whose error adaptive refinement is to make small, see goal_error.h.
    struct Goal
    {
      std::string quantity;
      double      value = 0;
      double      error = 0;      ///< its estimated size; infinite where it cannot be estimated
      double      correction = 0; ///< value + correction is closer, if the estimate is right
      std::string why_no_error;   ///< why it cannot be estimated
      double      size = 0;       ///< the error is a part of this where it is larger than the value: a reaction that has to be zero

      double relative() const { return error == 0 ? 0. : error / std::max(size, std::abs(value)); }
    };
    std::optional<Goal> goal;

    /// A mesh of adaptive refinement.
    struct Cycle
    {
      unsigned    level = 0;
      std::size_t n_cells = 0, n_dofs = 0;
      double      total = 0, discretisation = 0, penalty = 0, algebraic = 0, relative = 0;
      bool        guaranteed = false;

      std::optional<Goal> goal = {};
    };
    std::vector<Cycle> cycles;
    bool               tolerance_met = true;      ///< or there is none
    bool               cells_too_small = false;   ///< why it is not met, where that is not max_unknowns
    bool               ended_by_rounding = false; ///< likewise: on a finer mesh rounding would make the error larger
  };

  /// A value of a coefficient, a load or a bound of which the points of its cell show nothing: see unseen_details().
  struct UnseenDetail
  {
    std::string      what; ///< "stiffness"
    SourceLocation   where;
    dealii::Point<3> x;
    double           value = 0, least = 0, most = 0; ///< and those that the points show
    std::size_t      cell = 0;                       ///< active cell index
  };

  /// Everything results.json says; plain numbers.
  struct RunResult
  {
    bool        converged = false;
    std::string reason;               ///< why the solver stopped
    unsigned    n_processes = 1;      ///< that ran, whether or not they shared the work
    double      memory_of_others = 0; ///< bytes that other processes of the run took at most

    unsigned    dimension = 0;
    std::size_t n_cells = 0, n_dofs = 0;
    unsigned    n_levels = 0;
    double      h_min = 0, h_max = 0;
    unsigned    upward_axis = 2; ///< of pictures in space, see upward_axis.h
    std::string element;
    unsigned    m = 1; ///< order of the Sobolev space H^m

    std::vector<ConstraintResult> constraints;

    std::string formulation, epsilon_reason, linear_solver, solver_reason;
    double      epsilon = 0; ///< 0: mixed
    double      tolerance = 0;

    double                                      energy = 0; ///< 1/2 a(u,u) - f(u), f with boundary flux
    double                                      norm_L2 = 0, norm_H1_semi = 0, min = 0, max = 0;
    std::vector<ProbeResult>                    probes;
    std::vector<FunctionalResult>               functionals;
    std::optional<double>                       max_von_mises; ///< over the nodes, of the recovered stress
    std::optional<ForceBalance>                 balance;
    std::vector<PlatenResult>                   platens;
    std::vector<PeriodicResult>                 periodic;
    std::optional<double>                       norm_H2_semi; ///< m = 2
    std::optional<std::vector<SupportReaction>> reactions;    ///< beams and plates
    std::optional<Errors>                       errors;

    std::optional<Certificate> certificate;
    std::optional<Estimate>    estimate;                     ///< none for m = 0: a projection is found point by point
    double                     discretisation_indicator = 0; ///< estimate of || u - u_h ||_a, see estimator.h
    double                     unresolved_stiffness = 0;     ///< its part for jumps of the stiffness in cells, see unresolved_stiffness.h
    std::vector<UnseenDetail>  unseen_details;               ///< of the last mesh, those of the own part
    bool                       sees_all_data = true;         ///< no process has unseen details
    bool                       bounds_searched = true;       ///< on the last mesh, to the end: see CrossedBounds
    double                     energy_norm = 0;              ///< of u with its prescribed values: see unilateral::energy_norm()
    double                     energy_norm_of_zero = 0;      ///< what that norm may be by rounding and the solver's tolerance alone
    bool                       certificate_holds = true;     ///< within [method] penalty_tolerance, when that is given

    /// What errors are relative to. 0 where the energy norm is zero but for rounding, as of a body that moves as a whole: no share of it
    /// means anything, and errors are given as they are.
    double reference_norm() const { return energy_norm > energy_norm_of_zero ? energy_norm : 0.; }

    /// Nor is there an error: u is a motion without energy, not a solution that the mesh is too coarse to show.
    bool nothing_deforms() const
    {
      return reference_norm() == 0 && sees_all_data && (!estimate || estimate->total <= 10 * energy_norm_of_zero);
    }

    /// Tolerances of the certificate and of adaptive refinement.
    bool meets_what_is_asked() const { return certificate_holds && (!estimate || estimate->tolerance_met); }

    unsigned                 outer_iterations = 0, newton_iterations = 0, linear_iterations = 0; ///< summed over levels
    std::size_t              fine_operator_applications = 0;
    std::vector<LevelReport> levels;

    struct
    {
      double                                      total = 0, mesh = 0, setup = 0, solve = 0, certify = 0, output = 0;
      std::vector<std::pair<std::string, double>> parts; ///< see TimeByPart: the same time cut another way
    } timing;                                            ///< seconds

    std::vector<Diagnostic>        warnings; ///< what makes the result, or a part of the case, other than it seems
    std::vector<ExpectationResult> expect;
  };
} // namespace unilateral
