// The problem in functions: mesh, V_h, a, f, boundary data and constraints, on the current refinement level.
#pragma once

#include "unilateral/constraints/constraint_set.h"
#include "unilateral/discretisation/problem_statement.h"
#include "unilateral/forms/bilinear_form.h"
#include "unilateral/functions/field_function.h"
#include "unilateral/mesh/sent_part.h"
#include "unilateral/spaces/function_space.h"

#include <deal.II/base/quadrature.h>

#include <Eigen/Core>

#include <map>
#include <memory>
#include <optional>
#include <string>
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

    /// On @p mesh in place of the coarse one that the statement describes.
    Problem(const ProblemStatement &statement, Mesh<dim> mesh, Diagnostics &diagnostics);

    /// What only the coarse mesh as a whole shows.
    struct OfWhole
    {
      std::map<dealii::types::boundary_id, std::optional<RoundSurface>> round_parts;
      std::vector<Pin<dim>>                                             pins;

      template <typename Archive>
      void archive(Archive &bytes);
    };
    OfWhole of_whole() const;

    /// On a part of the coarse mesh, which the processes have made together. Collective.
    Problem(const ProblemStatement &statement, ReceivedPart<dim> part, Diagnostics &diagnostics);

    /// On a part of the coarse mesh; @p known: of the problem on the whole, in which no mistakes were found.
    Problem(const ProblemStatement &statement, ReceivedPart<dim> part, const OfWhole &known);

    /// What other data leave as it was, see restate().
    struct Unchanged
    {
      bool matrix = false; ///< a(u, v)
      bool fixed = false;  ///< which unknowns the Dirichlet conditions fix, and on what others depend
    };

    /// Takes over other data on the mesh as it is: coefficients, loads, boundary conditions, bounds. Element, regions, parts and all that
    /// makes the mesh must be the same in @p other. Throws InputError as the constructor does; the problem is of no use then.
    Unchanged restate(const ProblemStatement &other, Diagnostics &diagnostics);

    /// Refines every cell once, or those of the next local refinement that is asked for, and rebuilds what depends on the mesh. Carries the
    /// given functions of V_h over, see FunctionSpace::refine().
    /// With @p chosen those active cells instead, where the mesh can be refined in places.
    void refine(typename FunctionSpace<dim>::Functions &functions, bool smoothly = false, const std::vector<bool> *chosen = nullptr);

    /// The active cells of the next local refinement that is asked for; empty: all cells are to be refined.
    std::vector<bool> cells_of_next_refinement() const;

    /// Leaves this process a part of the mesh; other processes get the rest. See FunctionSpace::keep_own_part().
    void keep_own_part(const Processes                        &processes,
                       Division                                division,
                       unsigned                                n_alike,
                       typename FunctionSpace<dim>::Functions &functions,
                       bool                                    refined_next);

    /// Exchanges cells with the other processes that have parts of the mesh. See FunctionSpace::divide_anew().
    bool divide_anew(const std::vector<double> &weights, typename FunctionSpace<dim>::Functions &functions, std::vector<bool> &marks);

    /// How many cells the local refinements to come make of each active cell, see RefinementCount. Empty: there are none to come.
    std::vector<double> cells_by_local_refinements() const;

    /// How many times more cells they make of all.
    double growth_in_places() const;

    /// Gauss rule for a and f: exact for constant coefficients on affine cells, with a point a direction to spare for the load. For m = 0
    /// it is I_G itself where the points of I_G are the nodes of V_h.
    dealii::Quadrature<dim>     cell_quadrature() const;
    dealii::Quadrature<dim - 1> face_quadrature() const;

    bool symmetric() const { return form->symmetric(); }

    /// Why contact at the points of its rules does not hold the body on this mesh, though vertices in their place would, and points of
    /// finer meshes, which are to come, may: nothing can be solved here. Empty: it does.
    const std::string &why_not_held() const { return not_held; }

    /// Boundary conditions and coefficients leave a rigid body mode free (of a membrane the constant): only the constraint holds the
    /// solution.
    bool semicoercive() const { return !null_space.empty(); }

    bool axisymmetric() const; ///< a body of revolution about x = 0

    /// K_h on the current level. Throws InputError where the boundary data or another constraint violate a bound.
    ConstraintSet<dim> make_constraint_set() const { return make_constraint_set(conditions); }

    ProblemStatement statement; ///< only restate() changes it

    /// What is done with the problem counts here: whatever takes long is given the problem, and what it does not change is const to it.
    mutable TimeByPart time_by_part;

    FunctionSpace<dim>                 space;       ///< V_h
    DirichletData<dim>                 prescribed;  ///< what fixes values of V_h
    std::unique_ptr<BilinearForm<dim>> form;        ///< a and f
    std::vector<UnilateralCondition>   conditions;  ///< what bounds u where
    std::vector<RigidBodyMode<dim>>    null_space;  ///< of a: what only contact holds
    std::vector<RigidBodyMode<dim>>    unsupported; ///< what Dirichlet data leave free: the null_space and what springs alone hold

    bool has_pins() const { return !prescribed.pins.empty(); }

    /// Values at single nodes that stop the rigid body modes which neither contact nor load determines, and the names of these modes.
    const std::vector<Pin<dim>>    &pinned_values() const { return prescribed.pins; }
    const std::vector<std::string> &pinned_modes() const { return names_of_pinned; }

  private:
    ConstraintSet<dim> make_constraint_set(const std::vector<UnilateralCondition> &conditions) const;

    void build_form(Diagnostics &diagnostics);
    void read_constraints(Diagnostics &diagnostics);
    void read_surface(const UnilateralBound &spec, UnilateralCondition &condition, Diagnostics &diagnostics) const;
    void find_round_parts(bool on_coarse_mesh);
    void check_probes(Diagnostics &diagnostics) const;
    void hold_free_modes(Diagnostics *diagnostics = nullptr);
    bool vertices_hold(const Eigen::MatrixXd &free) const;
    void measure_parts();

    std::vector<std::string> names_of_pinned;
    std::string              not_held;

    std::map<dealii::types::boundary_id, std::optional<RoundSurface>> round_parts; ///< of the coarse mesh, as far as contact asked for them
  };

  template <int dim>
  template <typename Archive>
  void Problem<dim>::OfWhole::archive(Archive &bytes)
  {
    std::vector<dealii::types::boundary_id> parts;
    std::vector<char>                       is_round;
    std::vector<RoundSurface>               surfaces;
    for (const auto &[part, surface] : round_parts)
    {
      parts.push_back(part);
      is_round.push_back(surface.has_value());
      surfaces.push_back(surface.value_or(RoundSurface()));
    }
    bytes(parts);
    bytes(is_round);
    bytes(surfaces);
    for (std::size_t k = 0; k < parts.size(); ++k)
      round_parts[parts[k]] = is_round[k] ? std::optional<RoundSurface>(surfaces[k]) : std::nullopt;
    std::size_t n_pins = pins.size();
    bytes(n_pins);
    pins.resize(n_pins);
    for (Pin<dim> &pin : pins)
    {
      for (unsigned d = 0; d < dim; ++d)
        bytes(pin.x[d]);
      bytes(pin.component);
    }
  }

  /// The rule of the first bound, as far as it names one that exists; else the default of the element.
  RuleName first_rule(const ProblemStatement &statement, unsigned dim);

  /// The functions f, s and data are sampled by a mesh of size h; says where a raster or profile is much finer than that.
  template <int dim>
  void warn_about_fine_rasters(const Problem<dim> &problem, Diagnostics &diagnostics);
} // namespace unilateral
