// What a long computation tells whoever watches, and how it is asked to stop.
#pragma once

#include <cstddef>
#include <exception>
#include <string>
#include <vector>

namespace unilateral
{
  /// One step of the solver: a linear solve with a given active set.
  struct NewtonStep
  {
    unsigned    outer = 0;   ///< step of the method of multipliers
    std::size_t active = 0;  ///< constraint points with positive pressure after the step
    std::size_t flipped = 0; ///< points that changed sides in the step
    unsigned    linear_iterations = 0;
    double      step_length = 1; ///< of the line search
    double      residual = 0;    ///< relative, the larger of equilibrium and complementarity
  };

  /// What one refinement level cost and gave: a row of the progress table and of `solver.levels`.
  struct LevelReport
  {
    unsigned                level = 0;
    std::string             variant; ///< of a study: what is solved on this level, e.g. the rule; else empty
    std::size_t             n_cells = 0, n_dofs = 0, n_points = 0, n_active = 0;
    std::size_t             n_flipped = 0; ///< points that changed sides on this level, summed over its steps
    unsigned                outer_iterations = 0, newton_iterations = 0, linear_iterations = 0;
    std::size_t             operator_applications = 0; ///< products with A or the tangent on this level
    double                  largest_part = 0;          ///< of several processes the one with most cells, over the mean; 0: not divided
    double                  residual = 0;              ///< relative
    double                  seconds = 0;
    bool                    converged = false;
    std::string             linear_solver; ///< direct | amg
    std::string             reason;        ///< why it stopped
    std::vector<NewtonStep> history;
  };

  /// Thrown when the watcher asks to stop: exit code 130.
  class Interrupted : public std::exception
  {
  public:
    const char *what() const noexcept override { return "interrupted"; }
  };

  /// Override what you want to see. All calls come from one thread.
  class Progress
  {
  public:
    virtual ~Progress() = default;
    /// A phase begins: "mesh", "setup", "solve", "output"; @p detail for people.
    virtual void phase(const std::string & /*name*/, const std::string & /*detail*/ = "") {}
    /// Share of the phase that is done, 0..1.
    virtual void fraction(double) {}
    virtual void newton_step(const NewtonStep &) {}
    virtual void level_finished(const LevelReport &) {}
    /// One plain line for the log and, with -v, the terminal.
    virtual void log(const std::string &) {}
    /// Asked often; true makes the computation throw Interrupted at the next safe point.
    virtual bool stop_requested() const { return false; }
  };

  /// All of another one, which is not asked to stop: for what several processes do that have to agree on it, and cannot.
  class WithoutStops : public Progress
  {
  public:
    explicit WithoutStops(Progress &other) : other(other) {}

    void phase(const std::string &name, const std::string &detail = "") override { other.phase(name, detail); }
    void fraction(const double share) override { other.fraction(share); }
    void newton_step(const NewtonStep &step) override { other.newton_step(step); }
    void level_finished(const LevelReport &level) override { other.level_finished(level); }
    void log(const std::string &line) override { other.log(line); }

  private:
    Progress &other;
  };
} // namespace unilateral
