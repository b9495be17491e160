#include "unilateral/solution_functions.h"

#include "unilateral/spaces/cell_nodes_of_space.h"

#include <deal.II/fe/fe_values.h>

#include <array>
#include <map>
#include <numeric>
#include <string>
#include <utility>
#include <vector>

namespace unilateral
{
  using namespace dealii;

  std::string component_name(const std::string &function, const unsigned component, const unsigned n_components)
  {
    return n_components == 1 ? function : function + "xyz"[component];
  }

  template <int dim>
  std::shared_ptr<const CellFunctions> functions_on_cells(const FunctionSpace<dim>                    &space,
                                                          const std::map<std::string, const Vector *> &functions)
  {
    const auto                                &fe = *space.fe;
    const unsigned                             n_components = fe.n_components();
    CellNodes                                  nodes = cell_nodes_of(space, space.element.degree);
    FEValues<dim>                              values(*space.mapping, fe, lattice_points<dim>(nodes, nodes.degree), update_values);
    std::vector<dealii::Vector<double>>        at_nodes(nodes.n_value_nodes(), dealii::Vector<double>(n_components));
    std::map<std::string, std::vector<double>> columns;
    for (const auto &cell : space.dof_handler.active_cell_iterators())
    {
      values.reinit(cell);
      for (const auto &[name, function] : functions)
      {
        values.get_function_values(*function, at_nodes);
        for (unsigned c = 0; c < n_components; ++c)
        {
          auto &column = columns[component_name(name, c, n_components)];
          for (const auto &value : at_nodes)
            column.push_back(value(c));
        }
      }
    }
    return std::make_shared<const CellFunctions>(std::move(nodes), std::move(columns));
  }

  template <int dim>
  std::shared_ptr<const CellFunctions> functions_of(const Solution<dim> &solution)
  {
    const auto running = solution.problem->time_by_part.run("previous");
    return functions_on_cells(solution.problem->space, {{"u", &solution.displacement}});
  }

  std::shared_ptr<const CellFunctions> together(const CellFunctions &part, const Processes &processes)
  {
    CellNodes nodes = part.cells();
    // Nodes of each cell stand one after the other.
    const std::vector<std::array<double, 3>> own_points(std::move(nodes.points));
    std::vector<std::array<double, 3>>       points;
    for (const auto node : nodes.map_nodes)
      points.push_back(own_points[node]);
    nodes.points = processes.gather(points);
    std::map<std::string, std::vector<double>> functions;
    for (const auto &[name, values] : part.all())
    {
      std::vector<double> in_order;
      for (const auto node : nodes.value_nodes)
        in_order.push_back(values[node]);
      functions[name] = processes.gather(in_order);
    }
    nodes.map_nodes.resize(nodes.points.size());
    std::iota(nodes.map_nodes.begin(), nodes.map_nodes.end(), 0);
    nodes.value_nodes.resize(nodes.points.size() / nodes.n_map_nodes() * nodes.n_value_nodes());
    std::iota(nodes.value_nodes.begin(), nodes.value_nodes.end(), 0);
    return std::make_shared<const CellFunctions>(std::move(nodes), std::move(functions));
  }

#define INSTANTIATE(dim)                                                                                                                   \
  template std::shared_ptr<const CellFunctions> functions_on_cells(const FunctionSpace<dim> &,                                             \
                                                                   const std::map<std::string, const Vector *> &);                         \
  template std::shared_ptr<const CellFunctions> functions_of(const Solution<dim> &);
  INSTANTIATE(1)
  INSTANTIATE(2)
  INSTANTIATE(3)
#undef INSTANTIATE
} // namespace unilateral
