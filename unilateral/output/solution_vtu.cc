#include "unilateral/output/solution_vtu.h"

#include "unilateral/output/vtu_file.h"
#include "unilateral/spaces/cell_points.h"
#include "unilateral/spaces/simplex_element.h"

#include <deal.II/base/quadrature_lib.h>
#include <deal.II/fe/fe_dgq.h>
#include <deal.II/fe/fe_q.h>
#include <deal.II/fe/fe_values.h>

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <limits>
#include <map>
#include <memory>
#include <numeric>
#include <stdexcept>

namespace unilateral
{
  namespace
  {
    using namespace dealii;

    /// A point of the lattice of spacing 1/degree on the reference cell.
    using LatticePoint = std::array<unsigned int, 3>;

    /// The element whose nodes are the lattice; neighbours share nodes on their common face.
    template <int dim>
    std::unique_ptr<FiniteElement<dim>> lattice_element(const bool simplex, const bool discontinuous, const unsigned int degree)
    {
      if (discontinuous)
        return std::make_unique<FE_DGQArbitraryNodes<dim>>(QIterated<1>(QTrapezoid<1>(), degree));
      if (simplex)
        return make_simplex_element<dim>(std::min(degree, 3u));
      return std::make_unique<FE_Q<dim>>(QIterated<1>(QTrapezoid<1>(), degree));
    }

    /// Corners of the degree^dim linear cells that the lattice cuts a cell into, in VTK's order.
    template <int dim>
    std::vector<std::vector<LatticePoint>> linear_pieces(const bool simplex, const unsigned int degree)
    {
      std::vector<std::vector<LatticePoint>> pieces;
      const unsigned int                     n = degree;
      for (unsigned int k = 0; k < (dim > 2 ? n : 1); ++k)
        for (unsigned int j = 0; j < (dim > 1 ? n : 1); ++j)
          for (unsigned int i = 0; i < n; ++i)
          {
            const LatticePoint corner = {i, j, k};
            if (!simplex)
            {
              static const std::array<LatticePoint, 8> cube = {
                {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}, {0, 0, 1}, {1, 0, 1}, {1, 1, 1}, {0, 1, 1}}};
              std::vector<LatticePoint> piece;
              for (unsigned int v = 0; v < (1u << dim); ++v)
                piece.push_back({i + cube[v][0], j + cube[v][1], k + cube[v][2]});
              pieces.push_back(piece);
              continue;
            }
            // With partial sums s_1 >= s_2 >= ... as coordinates the simplex is a Kuhn simplex of the cube, and so are its pieces: walks
            // from a corner of a small cube to the opposite one, along the axes in any order, that stay inside.
            std::array<unsigned int, 3> axes = {0, 1, 2};
            do
            {
              std::vector<LatticePoint> piece;
              LatticePoint              s = corner;
              bool                      inside = true;
              unsigned int              n_inversions = 0;
              for (unsigned int step = 0; step <= dim; ++step)
              {
                if (step > 0)
                  ++s[axes[step - 1]];
                inside = inside && s[0] <= n && s[1] <= s[0] && s[2] <= s[1];
                piece.push_back({s[0] - s[1], s[1] - s[2], s[2]});
              }
              for (unsigned int a = 0; a < dim; ++a)
                for (unsigned int b = a + 1; b < dim; ++b)
                  n_inversions += axes[a] > axes[b];
              if (n_inversions % 2 == 1)
                std::swap(piece[0], piece[1]);
              if (inside)
                pieces.push_back(piece);
            } while (std::next_permutation(axes.begin(), axes.begin() + dim));
          }
      return pieces;
    }

    template <int dim>
    std::uint8_t vtk_cell_type(const bool simplex)
    {
      if (dim == 1)
        return 3;
      if (dim == 2)
        return simplex ? 5 : 9;
      return simplex ? 10 : 12;
    }
  } // namespace

  namespace
  {
    /// Functions of a space at the lattice of one cell after another: sums over the unknowns of the cell.
    template <int dim>
    class ValuesOnLattice
    {
    public:
      ValuesOnLattice(const Mapping<dim> &mapping, const DoFHandler<dim> &space, const std::vector<Point<dim>> &lattice)
        : space(space), rows(lattice.size()), dofs(space.get_fe().n_dofs_per_cell())
      {
        const auto &fe = space.get_fe();
        if (fe.has_support_points())
          set_rows([&](const unsigned k, const unsigned q) { return fe.shape_value(k, lattice[q]); });
        else // those of Hermite elements scale with the cell
          values = std::make_unique<FEValues<dim>>(mapping, fe, Quadrature<dim>(lattice), update_values);
      }

      void reinit(const typename Triangulation<dim>::cell_iterator &cell)
      {
        const typename DoFHandler<dim>::active_cell_iterator here(&space.get_triangulation(), cell->level(), cell->index(), &space);
        here->get_dof_indices(dofs);
        if (!values)
          return;
        values->reinit(here);
        set_rows([&](const unsigned k, const unsigned q) { return values->shape_value(k, q); });
      }

      unsigned n_components() const { return space.get_fe().n_components(); }

      /// Adds the components of @p function at lattice point @p q to the numbers that begin at @p at.
      void add_value(const Vector &function, const unsigned q, double *const at) const
      {
        for (const Entry &entry : rows[q])
          at[entry.component] += entry.value * function(dofs[entry.unknown]);
      }

    private:
      struct Entry
      {
        unsigned unknown, component;
        double   value;
      };

      template <typename ShapeValue>
      void set_rows(const ShapeValue &shape_value)
      {
        for (unsigned q = 0; q < rows.size(); ++q)
        {
          rows[q].clear();
          for (unsigned k = 0; k < dofs.size(); ++k)
            if (const double value = shape_value(k, q); std::abs(value) > 1e-14)
              rows[q].push_back({k, space.get_fe().system_to_component_index(k).first, value});
        }
      }

      const DoFHandler<dim>               &space;
      std::vector<std::vector<Entry>>      rows; ///< by lattice point
      std::vector<types::global_dof_index> dofs;
      std::unique_ptr<FEValues<dim>>       values;
    };

    /// The unknowns of the space are values at the nodes of @p lattice, in the same order on each cell.
    template <int dim>
    bool has_nodes_of(const DoFHandler<dim> &space, const FiniteElement<dim> &lattice)
    {
      const auto &fe = space.get_fe();
      return fe.n_components() == 1 && fe.conforming_space == lattice.conforming_space && fe.has_support_points() &&
             fe.n_dofs_per_cell() == lattice.n_dofs_per_cell() &&
             std::equal(fe.get_unit_support_points().begin(), fe.get_unit_support_points().end(), lattice.get_unit_support_points().begin(),
                        [](const auto &x, const auto &y) { return x.distance(y) < 1e-12; });
    }

    /// The nodes that the cells of a mesh get in the file, and the linear cells between them.
    template <int dim>
    struct Lattice
    {
      Lattice(const FiniteElement<dim> &fe, const unsigned int degree)
        : simplex(dim > 1 && fe.reference_cell().is_simplex()),
          element(lattice_element<dim>(simplex, fe.conforming_space == FiniteElementData<dim>::L2, std::max(degree, 1u)))
      {
        std::map<LatticePoint, unsigned int> node_at;
        for (unsigned int q = 0; q < element->n_dofs_per_cell(); ++q)
        {
          LatticePoint p{};
          for (unsigned int d = 0; d < dim; ++d)
            p[d] = std::lround(element->unit_support_point(q)[d] * element->degree);
          node_at[p] = q;
        }
        for (const auto &piece : linear_pieces<dim>(simplex, element->degree))
        {
          linear_cells.emplace_back();
          for (const auto &p : piece)
            linear_cells.back().push_back(node_at.at(p));
        }
      }

      const bool                                simplex;
      const std::unique_ptr<FiniteElement<dim>> element;
      std::vector<std::vector<unsigned int>>    linear_cells; ///< their nodes, in VTK's order
    };

    /// Functions at the nodes of cells that are added one by one; cells share the points on their common faces.
    template <int dim>
    class SolutionGrid
    {
    public:
      /// Every function has its space. @p coarse_level: see Pieces.
      SolutionGrid(const Mapping<dim>                 &mapping,
                   const DoFHandler<dim>              &dof_handler,
                   const Lattice<dim>                 &lattice,
                   const std::vector<NamedField<dim>> &functions,
                   unsigned int                        coarse_level);

      void    add(const typename DoFHandler<dim>::active_cell_iterator &cell);
      VtuGrid take();

    private:
      struct Column
      {
        std::string                 name;
        const ValuesOnLattice<dim> &space;
        const Vector               &function;
        unsigned                    n_components; ///< in the file
        std::vector<double>         values;
      };

      void number_nodes(const Triangulation<dim> &triangulation, const std::vector<NamedField<dim>> &functions);
      void add_points(const typename DoFHandler<dim>::active_cell_iterator &cell);
      void add_linear_cells(const typename DoFHandler<dim>::active_cell_iterator &cell);

      static constexpr std::int32_t                           not_seen = -1;
      const Lattice<dim>                                     &lattice;
      const unsigned int                                      coarse_level;
      std::unique_ptr<DoFHandler<dim>>                        own_nodes;
      const DoFHandler<dim>                                  *nodes = nullptr; ///< numbers the nodes of the lattice
      CellPoints<dim>                                         points;
      std::map<const DoFHandler<dim> *, ValuesOnLattice<dim>> spaces;
      std::vector<Column>                                     columns;
      VtuGrid                                                 grid;
      std::vector<std::int32_t>                               level, region;
      std::vector<std::int32_t>                               point_of_node;
      std::vector<types::global_dof_index>                    cell_nodes;
      std::vector<unsigned int>                               new_nodes; ///< of the cell
    };

    template <int dim>
    SolutionGrid<dim>::SolutionGrid(const Mapping<dim>                 &mapping,
                                    const DoFHandler<dim>              &dof_handler,
                                    const Lattice<dim>                 &lattice,
                                    const std::vector<NamedField<dim>> &functions,
                                    const unsigned int                  coarse_level)
      : lattice(lattice), coarse_level(coarse_level),
        points(mapping, dof_handler.get_fe().reference_cell(), lattice.element->get_unit_support_points()),
        cell_nodes(lattice.element->n_dofs_per_cell())
    {
      const auto &triangulation = dof_handler.get_triangulation();
      number_nodes(triangulation, functions);
      for (const auto &function : functions)
        spaces.try_emplace(function.space, mapping, *function.space, lattice.element->get_unit_support_points());
      const std::size_t n_points = nodes->n_dofs(), n_cells = triangulation.n_active_cells() * lattice.linear_cells.size();
      for (const auto &function : functions)
      {
        const auto    &space = spaces.at(function.space);
        const unsigned n_components = space.n_components() == 1 ? 1 : 3;
        columns.push_back({function.name, space, *function.values, n_components, std::vector<double>(n_points * n_components)});
      }
      grid.points.reserve(n_points);
      grid.connectivity.reserve(n_cells * lattice.linear_cells[0].size());
      grid.offsets.reserve(n_cells);
      grid.cell_types.reserve(n_cells);
      level.reserve(n_cells);
      region.reserve(n_cells);
      point_of_node.assign(n_points, not_seen);
    }

    /// By the unknowns of a function where these are its values at the nodes.
    template <int dim>
    void SolutionGrid<dim>::number_nodes(const Triangulation<dim> &triangulation, const std::vector<NamedField<dim>> &functions)
    {
      for (const auto &function : functions)
        if (!nodes && has_nodes_of(*function.space, *lattice.element))
          nodes = function.space;
      if (nodes)
        return;
      own_nodes = std::make_unique<DoFHandler<dim>>(triangulation);
      own_nodes->distribute_dofs(*lattice.element);
      match_line_nodes(*own_nodes);
      nodes = own_nodes.get();
    }

    template <int dim>
    void SolutionGrid<dim>::add(const typename DoFHandler<dim>::active_cell_iterator &cell)
    {
      typename DoFHandler<dim>::active_cell_iterator(&cell->get_triangulation(), cell->level(), cell->index(), nodes)
        ->get_dof_indices(cell_nodes);
      add_points(cell);
      add_linear_cells(cell);
    }

    template <int dim>
    void SolutionGrid<dim>::add_points(const typename DoFHandler<dim>::active_cell_iterator &cell)
    {
      new_nodes.clear();
      for (unsigned int q = 0; q < cell_nodes.size(); ++q)
        if (point_of_node[cell_nodes[q]] == not_seen)
        {
          new_nodes.push_back(q);
          point_of_node[cell_nodes[q]] = grid.points.size() + new_nodes.size() - 1;
        }
      if (new_nodes.empty())
        return;
      const auto &x = points.on(cell);
      for (auto &[space, values] : spaces)
        values.reinit(cell);
      for (const unsigned int q : new_nodes)
      {
        for (Column &column : columns)
          column.space.add_value(column.function, q, column.values.data() + column.n_components * grid.points.size());
        auto &point = grid.points.emplace_back();
        for (unsigned int d = 0; d < dim; ++d)
          point[d] = x[q][d];
      }
    }

    template <int dim>
    void SolutionGrid<dim>::add_linear_cells(const typename DoFHandler<dim>::active_cell_iterator &cell)
    {
      for (const auto &piece : lattice.linear_cells)
      {
        for (const unsigned int q : piece)
          grid.connectivity.push_back(point_of_node[cell_nodes[q]]);
        grid.offsets.push_back(grid.connectivity.size());
        grid.cell_types.push_back(vtk_cell_type<dim>(lattice.simplex));
        level.push_back(cell->level() + coarse_level);
        region.push_back(cell->material_id());
      }
    }

    template <int dim>
    VtuGrid SolutionGrid<dim>::take()
    {
      for (Column &column : columns)
      {
        column.values.resize(grid.points.size() * column.n_components);
        grid.point_arrays.push_back({column.name, std::move(column.values), column.n_components});
      }
      grid.cell_arrays = {{"level", std::move(level)}, {"region", std::move(region)}};
      return std::move(grid);
    }
  } // namespace

  namespace
  {
    /// Several files are held together by one that ends in pvtu.
    void write_grid(const std::string &path, const VtuGrid &grid, const Pieces &pieces)
    {
      write_file_atomically(path, [&](std::ostream &out) { write_vtu(out, grid); });
      const std::filesystem::path file(path);
      if (!pieces.files.empty() && file.filename() == pieces.files[0])
        write_file_atomically(file.parent_path() / (file.stem().stem().string() + ".pvtu"), to_pvtu(grid, pieces.files));
    }
  } // namespace

  template <int dim>
  VtuGrid solution_grid(const Mapping<dim>                 &mapping,
                        const DoFHandler<dim>              &dof_handler,
                        const Vector                       &u,
                        const unsigned int                  degree,
                        const std::vector<NamedField<dim>> &fields,
                        const unsigned                      coarse_level)
  {
    const Lattice<dim> lattice(dof_handler.get_fe(), degree);
    const std::size_t  n_cells = dof_handler.get_triangulation().n_active_cells() * lattice.linear_cells.size();
    if (n_cells * lattice.linear_cells[0].size() > std::numeric_limits<std::int32_t>::max())
      throw std::runtime_error(
        fmt::format("a file of the solution cannot be written: {} cells are more than its numbers can count", n_cells));
    std::vector<NamedField<dim>> functions = {{"u", &u}};
    functions.insert(functions.end(), fields.begin(), fields.end());
    for (auto &function : functions)
      if (!function.space)
        function.space = &dof_handler;
    SolutionGrid<dim> grid(mapping, dof_handler, lattice, functions, coarse_level);
    for (const auto &cell : dof_handler.active_cell_iterators())
      if (cell->is_locally_owned())
        grid.add(cell);
    return grid.take();
  }

  template <int dim>
  void write_solution_vtu(const std::string                  &path,
                          const Mapping<dim>                 &mapping,
                          const DoFHandler<dim>              &dof_handler,
                          const Vector                       &u,
                          const unsigned int                  degree,
                          const std::vector<NamedField<dim>> &fields,
                          const Pieces                       &pieces)
  {
    write_grid(path, solution_grid(mapping, dof_handler, u, degree, fields, pieces.coarse_level), pieces);
  }

  template <int dim>
  VtuGrid constraint_points_grid(const ConstraintSet<dim> &set, const std::vector<double> &u, const std::vector<double> &pressure)
  {
    if (u.size() != set.size() || pressure.size() != set.size())
      throw std::invalid_argument("constraint_points_grid: a value of u and a pressure are needed for each constraint point");
    VtuGrid                   grid;
    std::vector<double>       pressures, weights, gap, penetration, directions, u_along;
    std::vector<std::uint8_t> active, side;
    std::vector<std::int32_t> block;
    for (std::vector<double> *const values : {&pressures, &weights, &gap, &penetration})
      values->reserve(set.size());
    grid.points.reserve(set.size());
    std::int32_t number = set.blocks.empty() ? -1 : 0;
    for (std::size_t i = 0; i < set.size(); ++i)
    {
      while (number >= 0 && i >= set.blocks[number].end)
        if (++number == std::int32_t(set.blocks.size()))
          number = -1;
      if (!set.owns(i))
        continue;
      auto &point = grid.points.emplace_back();
      for (unsigned int d = 0; d < dim; ++d)
        point[d] = set.points[i].x[d];
      const double distance = set.points[i].sign * (set.points[i].bound - u[i]);
      pressures.push_back(pressure[i]);
      weights.push_back(set.points[i].weight);
      gap.push_back(distance);
      penetration.push_back(std::max(0., -distance));
      active.push_back(pressure[i] > 0);
      side.push_back(set.points[i].sign > 0);
      block.push_back(number);
      if (set.directions.empty())
        continue;
      for (unsigned int c = 0; c < 3; ++c)
        directions.push_back(c < dim ? set.directions[i][c % dim] : 0.);
      u_along.push_back(u[i]);
    }
    const std::size_t n = grid.points.size();
    grid.cell_types.assign(n, 1);
    grid.connectivity.resize(n);
    std::iota(grid.connectivity.begin(), grid.connectivity.end(), 0);
    grid.offsets.resize(n);
    std::iota(grid.offsets.begin(), grid.offsets.end(), 1);
    grid.point_arrays = {{"pressure", std::move(pressures)}, {"gap", std::move(gap)},        {"penetration", std::move(penetration)},
                         {"active", std::move(active)},      {"weight", std::move(weights)}, {"side", std::move(side)},
                         {"block", std::move(block)}};
    if (!set.directions.empty())
    {
      grid.point_arrays.push_back({"direction", std::move(directions), 3});
      grid.point_arrays.push_back({"u_along", std::move(u_along)});
    }
    return grid;
  }

  template <int dim>
  void write_constraint_points_vtu(const std::string         &path,
                                   const ConstraintSet<dim>  &set,
                                   const std::vector<double> &u,
                                   const std::vector<double> &pressure,
                                   const Pieces              &pieces)
  {
    write_grid(path, constraint_points_grid(set, u, pressure), pieces);
  }

#define INSTANTIATE(dim)                                                                                                                     \
  template VtuGrid solution_grid<dim>(const Mapping<dim> &, const DoFHandler<dim> &, const Vector &, unsigned int,                           \
                                      const std::vector<NamedField<dim>> &, unsigned);                                                       \
  template VtuGrid constraint_points_grid<dim>(const ConstraintSet<dim> &, const std::vector<double> &, const std::vector<double> &);        \
  template void    write_solution_vtu<dim>(const std::string &, const Mapping<dim> &, const DoFHandler<dim> &, const Vector &, unsigned int, \
                                        const std::vector<NamedField<dim>> &, const Pieces &);                                            \
  template void    write_constraint_points_vtu<dim>(const std::string &, const ConstraintSet<dim> &, const std::vector<double> &,            \
                                                 const std::vector<double> &, const Pieces &);
  INSTANTIATE(1)
  INSTANTIATE(2)
  INSTANTIATE(3)
#undef INSTANTIATE
} // namespace unilateral
