#include "unilateral/discretisation/dear_functions.h"

#include "unilateral/constraints/quadrature_rule.h"
#include "unilateral/spaces/cell_points.h"

#include <deal.II/fe/fe_nothing.h>

#include <algorithm>
#include <optional>

namespace unilateral
{
  using namespace dealii;

  namespace
  {
    /// Points are handed over in portions of this size, which bounds the memory of the call.
    constexpr std::size_t points_in_a_call = 1u << 18;

    class DearFunctions
    {
    public:
      void add(const FieldFunction &function)
      {
        if (function.dear_to_call())
          functions.push_back(function);
      }
      void add(const std::optional<FieldFunction> &function)
      {
        if (function)
          add(*function);
      }
      void add(const std::vector<FieldFunction> &list)
      {
        for (const FieldFunction &function : list)
          add(function);
      }
      void add(const std::optional<std::vector<FieldFunction>> &list)
      {
        if (list)
          add(*list);
      }
      void add(const Coefficients &c)
      {
        add(c.stiffness);
        add(c.velocity);
        add(c.reaction);
        add(c.young);
        add(c.poisson);
        add(c.thickness);
        add(c.load);
      }

      template <int dim>
      void prepare(const std::vector<Point<dim>> &points) const
      {
        for (const FieldFunction &function : functions)
          function.prepare(points);
      }

      bool empty() const { return functions.empty(); }

    private:
      std::vector<FieldFunction> functions;
    };

    /// The points of @p rule on every cell.
    template <int dim>
    void prepare_on_cells(const Problem<dim> &problem, const DearFunctions &functions, const std::vector<Point<dim>> &rule)
    {
      if (functions.empty() || rule.empty())
        return;
      CellPoints<dim>         on_cell(*problem.space.mapping, problem.space.fe->reference_cell(), rule);
      std::vector<Point<dim>> points;
      for (const auto &cell : problem.space.dof_handler.active_cell_iterators())
      {
        const auto &here = on_cell.on(cell);
        points.insert(points.end(), here.begin(), here.end());
        if (points.size() >= points_in_a_call)
        {
          functions.prepare(points);
          points.clear();
        }
      }
      functions.prepare(points);
    }

    /// The points of @p rule on the faces of the boundary that belong to @p part, or to any where that is empty.
    template <int dim>
    void
    prepare_on_faces(const Problem<dim> &problem, const DearFunctions &functions, const Quadrature<dim - 1> &rule, const std::string &part)
    {
      if (functions.empty())
        return;
      const auto             &names = problem.space.mesh.part_names;
      const FE_Nothing<dim>   nothing(problem.space.fe->reference_cell());
      FEFaceValues<dim>       values(*problem.space.mapping, nothing, rule, update_quadrature_points);
      std::vector<Point<dim>> points;
      for (const auto &cell : problem.space.mesh.triangulation->active_cell_iterators())
        for (const unsigned f : cell->face_indices())
        {
          if (!cell->at_boundary(f) || cell->face(f)->boundary_id() >= names.size() ||
              (!part.empty() && names[cell->face(f)->boundary_id()] != part))
            continue;
          values.reinit(cell, f);
          points.insert(points.end(), values.get_quadrature_points().begin(), values.get_quadrature_points().end());
        }
      functions.prepare(points);
    }

    DearFunctions coefficients_of(const ProblemStatement &statement)
    {
      DearFunctions functions;
      functions.add(statement.model.coefficients);
      for (const Material &material : statement.materials)
        functions.add(material.coefficients);
      return functions;
    }

    DearFunctions functions_on_boundary(const ProblemStatement &statement)
    {
      DearFunctions functions;
      for (const BoundaryCondition &condition : statement.boundary)
      {
        functions.add(condition.flux);
        functions.add(condition.spring);
        functions.add(condition.traction);
        functions.add(condition.pressure);
        functions.add(condition.springs);
        functions.add(condition.moment);
        functions.add(condition.slope_spring);
      }
      return functions;
    }
  } // namespace

  template <int dim>
  void prepare_dear_functions(const Problem<dim> &problem)
  {
    const ProblemStatement &statement = problem.statement;
    prepare_on_cells(problem, coefficients_of(statement), problem.cell_quadrature().get_points());
    prepare_on_faces(problem, functions_on_boundary(statement), problem.face_quadrature(), "");
    for (const UnilateralCondition &condition : problem.conditions)
    {
      DearFunctions bound;
      bound.add(condition.bound);
      if (bound.empty())
        continue;
      if (condition.on.empty())
      {
        std::vector<Point<dim>> points = quadrature_rule<dim>(condition.rule, problem.space.element).get_points();
        for (const Point<dim> &node : problem.space.fe->get_unit_support_points())
          if (std::find(points.begin(), points.end(), node) == points.end())
            points.push_back(node);
        prepare_on_cells(problem, bound, points);
      }
      else if constexpr (dim > 1)
        prepare_on_faces(problem, bound, quadrature_rule<dim - 1>(condition.rule, problem.space.element), condition.on);
    }
  }

  template void prepare_dear_functions(const Problem<1> &);
  template void prepare_dear_functions(const Problem<2> &);
  template void prepare_dear_functions(const Problem<3> &);
} // namespace unilateral
