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

  namespace
  {
    std::string component_name(const unsigned component, const unsigned n_components)
    {
      return n_components == 1 ? std::string("u") : std::string("u") + "xyz"[component];
    }
  } // namespace

  template <int dim>
  std::shared_ptr<const CellFunctions> functions_of(const Solution<dim> &solution)
  {
    const auto    &problem = *solution.problem;
    const auto    &space = problem.space;
    const auto    &fe = *space.fe;
    const unsigned n_components = fe.n_components();
    const auto     running = problem.time_by_part.run("previous");

    CellNodes                           nodes = cell_nodes_of(space, space.element.degree);
    FEValues<dim>                       values(*space.mapping, fe, lattice_points<dim>(nodes, nodes.degree), update_values);
    std::vector<std::vector<double>>    columns(n_components);
    std::vector<dealii::Vector<double>> at_nodes(nodes.n_value_nodes(), dealii::Vector<double>(n_components));
    for (const auto &cell : space.dof_handler.active_cell_iterators())
    {
      values.reinit(cell);
      values.get_function_values(solution.displacement, at_nodes);
      for (const auto &value : at_nodes)
        for (unsigned c = 0; c < n_components; ++c)
          columns[c].push_back(value(c));
    }
    std::map<std::string, std::vector<double>> functions;
    for (unsigned c = 0; c < n_components; ++c)
      functions[component_name(c, n_components)] = std::move(columns[c]);
    return std::make_shared<const CellFunctions>(std::move(nodes), std::move(functions));
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

  template std::shared_ptr<const CellFunctions> functions_of(const Solution<1> &);
  template std::shared_ptr<const CellFunctions> functions_of(const Solution<2> &);
  template std::shared_ptr<const CellFunctions> functions_of(const Solution<3> &);
} // namespace unilateral
