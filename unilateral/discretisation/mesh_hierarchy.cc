#include "unilateral/discretisation/mesh_hierarchy.h"

#include "unilateral/discretisation/element_systems.h"

#include <deal.II/fe/fe_values.h>
#include <deal.II/grid/grid_tools.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>

namespace unilateral
{
  using namespace dealii;

  namespace
  {
    /// The unknowns of a cell node by node, nodes in lexicographic order, components next to each other.
    template <int dim>
    class TensorNumbering
    {
    public:
      TensorNumbering(const FiniteElement<dim> &fe, const unsigned degree) : degree(degree), n_components(fe.n_components())
      {
        position.resize(fe.n_dofs_per_cell());
        element_index.resize(fe.n_dofs_per_cell());
        // The coordinates of nodes in one direction.
        std::vector<double> nodes;
        for (unsigned i = 0; i < fe.n_dofs_per_cell(); ++i)
        {
          const double x = fe.unit_support_point(i)[0];
          if (std::none_of(nodes.begin(), nodes.end(), [&](const double node) { return std::abs(node - x) < 1e-8; }))
            nodes.push_back(x);
        }
        std::sort(nodes.begin(), nodes.end());
        for (unsigned i = 0; i < fe.n_dofs_per_cell(); ++i)
        {
          unsigned number = 0;
          for (unsigned d = dim; d-- > 0;)
          {
            position[i][d] = std::lower_bound(nodes.begin(), nodes.end(), fe.unit_support_point(i)[d] - 1e-8) - nodes.begin();
            number = number * (degree + 1) + position[i][d];
          }
          element_index[number * n_components + fe.system_to_component_index(i).first] = i;
        }
      }

      unsigned                               degree, n_components;
      std::vector<unsigned>                  element_index; ///< number here -> number of the finite element
      std::vector<std::array<unsigned, dim>> position;      ///< of each unknown of the finite element among the nodes
    };

    /// Cells of a patch in the order of the hierarchy, their nodes on the lattice of the patch.
    template <int dim>
    CellOperator::PatchShape patch_shape(const TensorNumbering<dim> &numbering, const unsigned n_levels)
    {
      CellOperator::PatchShape shape;
      const unsigned           p = numbering.degree, n_components = numbering.n_components;
      shape.n_cell_dofs = numbering.element_index.size();
      shape.n_cells = 1u << (dim * n_levels);
      const unsigned n_nodes = p * (1u << n_levels) + 1;
      shape.n_patch_dofs = std::pow(n_nodes, dim) * n_components;
      for (unsigned cell = 0; cell < shape.n_cells; ++cell)
      {
        // Bit d of the child at each level of refinement is its place in direction d.
        std::array<unsigned, dim> corner{};
        for (unsigned l = 0; l < n_levels; ++l)
          for (unsigned d = 0; d < dim; ++d)
            corner[d] += (cell >> (dim * l + d) & 1u) << l;
        for (unsigned i = 0; i < shape.n_cell_dofs; ++i)
        {
          unsigned node = i / n_components, number = 0, stride = 1;
          for (unsigned d = 0; d < dim; ++d)
          {
            number += stride * (corner[d] * p + node % (p + 1));
            stride *= n_nodes;
            node /= p + 1;
          }
          shape.cell_dofs.push_back(number * n_components + i % n_components);
        }
      }
      return shape;
    }

    /// As many levels of refinement as keep what a patch gathers in the first-level cache; one at least, for the transfer between levels.
    template <int dim>
    unsigned levels_of_patch(const unsigned level, const unsigned degree, const unsigned n_components)
    {
      constexpr double most_unknowns = 260;
      unsigned         levels = std::min(level, 1u);
      while (levels < std::min(level, 3u) && n_components * std::pow((2u << levels) * degree + 1, dim) <= most_unknowns)
        ++levels;
      return levels;
    }

    /// The element matrices and loads of a level.
    template <int dim>
    class CellSystems
    {
    public:
      CellSystems(const Problem<dim> &problem, const TensorNumbering<dim> &numbering)
        : problem(problem), numbering(numbering), shapes(shapes_for_systems(problem)), repeated_load(problem),
          values(*problem.space.mapping, *problem.space.fe, problem.cell_quadrature(), cell_flags(*problem.form)),
          n(numbering.element_index.size()), local_matrix(n, n), local_load(n)
      {
      }

      /// The number of the cell's matrix; its load is in load().
      template <typename Cell>
      std::int32_t integrate(const Cell &cell)
      {
        const unsigned shape = shapes(cell);
        if (shape < matrix_of_shape.size() && repeated_load.varies_in(cell->material_id()))
        {
          repeated_load.integrate(cell, shape, local_load);
          keep_load();
          current_load = own_load.data();
          return matrix_of_shape[shape];
        }
        if (shape < matrix_of_shape.size())
        {
          current_load = load_of_shape.data() + shape * n;
          return matrix_of_shape[shape];
        }
        const std::int32_t number = compute(cell);
        current_load = own_load.data();
        if (shape != shapes.none)
        {
          matrix_of_shape.push_back(number);
          load_of_shape.insert(load_of_shape.end(), own_load.begin(), own_load.end());
          repeated_load.add_shape(values);
        }
        return number;
      }

      /// Of the cell that was integrated last.
      const double *load() const { return current_load; }

      std::vector<double> matrices, convection; ///< the symmetric part, and the rest where a is not symmetric

    private:
      template <typename Cell>
      std::int32_t compute(const Cell &cell)
      {
        local_matrix = 0.;
        local_load = 0.;
        values.reinit(cell);
        problem.form->add_cell_terms(values, local_matrix, local_load);
        const std::int32_t number = matrices.size() / (n * n);
        if (!problem.symmetric())
        {
          FullMatrix<double> local_convection(n, n);
          problem.form->add_convection_terms(values, local_convection);
          local_matrix.add(-1, local_convection);
          append(convection, local_convection);
        }
        append(matrices, local_matrix);
        keep_load();
        return number;
      }

      void append(std::vector<double> &to, const FullMatrix<double> &matrix) const
      {
        for (unsigned i = 0; i < n; ++i)
          for (unsigned j = 0; j < n; ++j)
            to.push_back(matrix(numbering.element_index[i], numbering.element_index[j]));
      }

      void keep_load()
      {
        own_load.resize(n);
        for (unsigned i = 0; i < n; ++i)
          own_load[i] = local_load(numbering.element_index[i]);
      }

      const Problem<dim>         &problem;
      const TensorNumbering<dim> &numbering;
      CellShapes<dim>             shapes;
      RepeatedLoad<dim>           repeated_load;
      FEValues<dim>               values;
      const unsigned              n;
      FullMatrix<double>          local_matrix;
      dealii::Vector<double>      local_load;
      std::vector<std::int32_t>   matrix_of_shape;
      std::vector<double>         load_of_shape, own_load;
      const double               *current_load = nullptr;
    };

    /// u = C u_free + g for a few unknowns.
    struct AffineDependence : Dependence
    {
      std::vector<double> g;

      template <typename Dof>
      AffineDependence(const std::vector<Dof> &dofs, const AffineConstraints<double> &dirichlet) : g(dofs.size(), 0.)
      {
        std::map<types::global_dof_index, unsigned>           number;
        std::vector<std::vector<std::pair<unsigned, double>>> rows(dofs.size());
        const auto                                            master = [&](const types::global_dof_index dof)
        {
          const auto [entry, is_new] = number.try_emplace(dof, number.size());
          if (is_new)
            masters.push_back(dof);
          return entry->second;
        };
        for (std::size_t i = 0; i < dofs.size(); ++i)
          if (dirichlet.is_constrained(dofs[i]))
          {
            g[i] = dirichlet.get_inhomogeneity(dofs[i]);
            for (const auto &[dof, weight] : *dirichlet.get_constraint_entries(dofs[i]))
              rows[i].emplace_back(master(dof), weight);
          }
          else
            rows[i].emplace_back(master(dofs[i]), 1.);
        C.assign(dofs.size() * masters.size(), 0.);
        for (std::size_t i = 0; i < dofs.size(); ++i)
          for (const auto &[column, weight] : rows[i])
            C[i * masters.size() + column] += weight;
      }

      /// Adds C'(f - A g).
      template <typename Load>
      void add_load(const double *A, const Load &f, Vector &load) const
      {
        for (std::size_t i = 0; i < g.size(); ++i)
        {
          double rest = f[i];
          for (std::size_t j = 0; j < g.size(); ++j)
            rest -= *A++ * g[j];
          for (std::size_t k = 0; k < masters.size(); ++k)
            load(masters[k]) += C[i * masters.size() + k] * rest;
        }
      }
    };

    /// The cells of a level in the order of the hierarchy: the children of each cell of the level before follow each other.
    template <int dim>
    class CellsInOrder
    {
    public:
      CellsInOrder(const LevelHierarchy &hierarchy, const Problem<dim> &problem, const bool follows_another)
        : triangulation(*problem.space.mesh.triangulation), depth(triangulation.n_levels() - 1), n(triangulation.n_active_cells())
      {
        const std::size_t before = hierarchy.levels.empty() ? 0 : hierarchy.finest().n_cells();
        if (hierarchy.places.empty() && n == triangulation.n_cells(depth) && (!follows_another || n == hierarchy.n_children * before))
          return;
        AssertThrow(follows_another, ExcMessage("a coarse mesh has cells of one level"));
        const auto add = [&](const int level, const int index) { places.push_back({level, index}); };
        for (std::size_t c = 0; c < before; ++c)
        {
          const LevelHierarchy::Place place =
            hierarchy.places.empty() ? LevelHierarchy::Place{int(hierarchy.levels.size()) - 1, int(c)} : hierarchy.places[c];
          const typename Triangulation<dim>::cell_iterator cell(&triangulation, place.level, place.index);
          first_child.push_back(places.size());
          if (cell->is_active())
            add(place.level, place.index);
          else
            for (unsigned child = 0; child < cell->n_children(); ++child)
              add(place.level + 1, cell->child_index(child));
        }
        first_child.push_back(places.size());
        AssertThrow(places.size() == n, ExcMessage("levels are added one by one"));
      }

      bool all_of_one_level() const { return places.empty(); }

      typename DoFHandler<dim>::active_cell_iterator at(const std::size_t k, const DoFHandler<dim> &dof_handler) const
      {
        return places.empty()
                 ? typename DoFHandler<dim>::active_cell_iterator(&triangulation, depth, k, &dof_handler)
                 : typename DoFHandler<dim>::active_cell_iterator(&triangulation, places[k].level, places[k].index, &dof_handler);
      }

    private:
      const Triangulation<dim> &triangulation;
      const int                 depth;

    public:
      const std::size_t                  n;
      std::vector<LevelHierarchy::Place> places;      ///< empty: all cells of the finest level of the triangulation
      std::vector<std::uint32_t>         first_child; ///< as in LevelHierarchy::Level
    };

    /// The V-cycle knows nothing of convection. Up to here GMRES makes up for it in about as much time as algebraic multigrid takes.
    constexpr double largest_peclet_number = 100;

    /// |b| L / k where it is largest on the mesh at hand, L the length of the domain.
    template <int dim>
    double peclet_number(const Problem<dim> &problem)
    {
      double largest = 0;
      if (problem.symmetric())
        return largest;
      for (const auto &cell : problem.space.mesh.triangulation->active_cell_iterators())
        for (const unsigned v : cell->vertex_indices())
          largest = std::max(largest, problem.form->convection_to_diffusion(cell->material_id(), cell->vertex(v)));
      const auto [low, high] = GridTools::compute_bounding_box(*problem.space.mesh.triangulation).get_boundary_points();
      return largest * low.distance(high);
    }
  } // namespace

  template <int dim>
  std::string obstacle_to_multigrid(const Problem<dim> &problem)
  {
    if (dim == 1)
      return "the mesh is one-dimensional";
    if (problem.space.element.family != ElementName::Family::Q || problem.space.element.simplex())
      return "it needs quadrilaterals or hexahedra with Lagrange elements";
    if (problem.space.element.degree > 6)
      return "the degree of the elements is above 6";
    if (problem.form->order() != 1)
      return "the problem is not of second order";
    if (problem.form->volume_to_shape_stiffness() > 1000)
      return "the material is as good as incompressible, no matter for its smoother";
    if (peclet_number(problem) > largest_peclet_number)
      return "convection is far stronger than diffusion";
    if (!problem.symmetric() && !problem.statement.mesh.local.empty())
      return "convection on a mesh that is refined in places";
    return "";
  }

  namespace
  {
    /// The next level, with a transfer from the one before unless that has the same cells; returns f.
    template <int dim>
    Vector append_level(LevelHierarchy &hierarchy, const Problem<dim> &problem, const bool with_transfer)
    {
      const unsigned       depth = problem.space.mesh.triangulation->n_levels() - 1;
      const auto          &fe = *problem.space.fe;
      const auto          &dirichlet = problem.space.dirichlet;
      CellsInOrder<dim>    cells(hierarchy, problem, with_transfer);
      const std::size_t    n_dofs = problem.space.dof_handler.n_dofs(), n_cells = cells.n;
      const unsigned       n = fe.n_dofs_per_cell();
      TensorNumbering<dim> numbering(fe, problem.space.element.degree);

      if (hierarchy.levels.empty())
      {
        hierarchy.n_children = GeometryInfo<dim>::max_children_per_cell;
        hierarchy.n_components = numbering.n_components;
        for (unsigned c = 0; c < hierarchy.n_children; ++c)
        {
          const auto          &P = fe.get_prolongation_matrix(c);
          std::vector<double> &to_child = hierarchy.to_child.emplace_back();
          for (unsigned i = 0; i < n; ++i)
            for (unsigned j = 0; j < n; ++j)
              to_child.push_back(P(numbering.element_index[i], numbering.element_index[j]));
        }
      }

      // Fixed unknowns; those that depend on others make their cells special.
      std::vector<std::uint32_t> fixed;
      std::vector<char>          kind(n_dofs, 0); // 0 free, 1 fixed, 2 depends on others
      for (const auto &line : dirichlet.get_lines())
      {
        fixed.push_back(line.index);
        kind[line.index] = line.entries.empty() ? 1 : 2;
      }

      Vector                               load(n_dofs);
      CellSystems<dim>                     systems(problem, numbering);
      std::vector<std::uint32_t>           dofs_of_cells(n_cells * n);
      std::vector<std::int32_t>            matrix_of_cell(n_cells);
      std::vector<DependentCell>           dependent;
      std::vector<DenseBlock>              blocks;
      std::vector<types::global_dof_index> dofs(n), ordered(n);
      for (std::size_t k = 0; k < n_cells; ++k)
      {
        const auto cell = cells.at(k, problem.space.dof_handler);
        AssertThrow(
          !cells.all_of_one_level() || cell->level() == 0 ||
            (cell->parent_index() == int(k / hierarchy.n_children) && cell->parent()->child_index(k % hierarchy.n_children) == int(k)),
          ExcMessage("children do not follow each other"));
        cell->get_dof_indices(dofs);
        bool touches_fixed = false, depends = false;
        for (unsigned i = 0; i < n; ++i)
        {
          const auto dof = ordered[i] = dofs[numbering.element_index[i]];
          dofs_of_cells[k * n + i] = dof;
          touches_fixed |= kind[dof] == 1;
          depends |= kind[dof] == 2;
        }
        matrix_of_cell[k] = systems.integrate(cell);
        const double *const cell_load = systems.load();
        const auto          place = std::size_t(matrix_of_cell[k]) * n * n;
        const double *const matrix = systems.matrices.data() + place, *const convection = systems.convection.empty()
                                                                                            ? nullptr
                                                                                            : systems.convection.data() + place;
        if (depends)
        {
          Assert(!convection, ExcInternalError()); // see obstacle_to_multigrid()
          const AffineDependence dependence(ordered, dirichlet);
          dependence.add_load(matrix, cell_load, load);
          dependent.push_back({std::uint32_t(k), dependence, {matrix, matrix + n * n}});
          matrix_of_cell[k] = -1;
          continue;
        }
        for (unsigned i = 0; i < n; ++i)
          load(ordered[i]) += cell_load[i];
        if (touches_fixed)
          for (unsigned j = 0; j < n; ++j)
            if (kind[ordered[j]] == 1)
              if (const double g = dirichlet.get_inhomogeneity(ordered[j]); g != 0)
                for (unsigned i = 0; i < n; ++i)
                  load(ordered[i]) -= (matrix[i * n + j] + (convection ? convection[i * n + j] : 0.)) * g;
      }
      for_each_local_system_outside_cells<dim>(
        problem,
        [&](const LocalSystem &local)
        {
          std::vector<double> matrix;
          for (unsigned i = 0; i < local.dofs.size(); ++i)
            for (unsigned j = 0; j < local.dofs.size(); ++j)
              matrix.push_back(local.matrix(i, j));
          const AffineDependence dependence(local.dofs, dirichlet);
          dependence.add_load(matrix.data(), local.load, load);
          auto block = dependence.condense(matrix.data());
          if (std::any_of(block.matrix.begin(), block.matrix.end(), [](const double a) { return a != 0; }))
            blocks.push_back(std::move(block));
        });
      problem.space.shared().add(load.begin());
      for (const auto dof : fixed)
        load(dof) = 0;

      hierarchy.convection.reset();
      if (!systems.convection.empty())
        hierarchy.convection =
          std::make_unique<ConvectionOperator>(n_dofs, n, dofs_of_cells, matrix_of_cell, std::move(systems.convection), fixed);

      LevelHierarchy::Level result;
      result.shared = problem.space.shared();
      auto shape = patch_shape(
        numbering, cells.all_of_one_level() ? levels_of_patch<dim>(depth, problem.space.element.degree, numbering.n_components) : 0);
      const unsigned cells_per_patch = shape.n_cells;
      const auto     in_patch = shape.cell_dofs;
      result.stiffness = std::make_unique<CellOperator>(
        n_dofs, n_cells / cells_per_patch, std::move(shape),
        [&](const std::size_t patch, std::uint32_t *const patch_dofs)
        {
          for (unsigned k = 0; k < cells_per_patch * n; ++k)
            patch_dofs[in_patch[k]] = dofs_of_cells[patch * cells_per_patch * n + k];
        },
        matrix_of_cell, systems.matrices, std::move(dependent), std::move(blocks), std::move(fixed));
      result.stiffness->complete_diagonal(result.shared);
      const auto running = problem.time_by_part.run("transfer");
      if (cells.all_of_one_level())
        result.sweep = std::make_unique<PatchSweep>(*result.stiffness, with_transfer ? hierarchy.levels.back().sweep.get() : nullptr,
                                                    hierarchy.to_child);
      else
      {
        std::vector<bool> is_free(n_dofs);
        std::transform(kind.begin(), kind.end(), is_free.begin(), [](const char k) { return k == 0; });
        result.sweep = std::make_unique<PatchSweep>(
          *result.stiffness, *hierarchy.levels.back().sweep,
          transfer_in_places(hierarchy.finest(), hierarchy.to_child, cells.first_child, dofs_of_cells, is_free));
      }
      result.first_child = std::move(cells.first_child);
      hierarchy.places = std::move(cells.places);
      hierarchy.levels.push_back(std::move(result));
      return load;
    }
  } // namespace

  template <int dim>
  Vector add_level(LevelHierarchy &hierarchy, const Problem<dim> &problem)
  {
    return append_level(hierarchy, problem, !hierarchy.levels.empty());
  }

  template <int dim>
  void add_own_part(LevelHierarchy &hierarchy, const Problem<dim> &problem)
  {
    auto &cut = hierarchy.cut.emplace();
    cut.level = hierarchy.levels.size();
    cut.cells = problem.space.subdomain->own_cells;
    append_level(hierarchy, problem, false);
    const auto &whole = *hierarchy.levels[cut.level - 1].stiffness, &part = hierarchy.finest();
    cut.to_whole.resize(part.n_dofs());
    std::vector<std::uint32_t> in_whole(part.n_cell_dofs()), in_part(part.n_cell_dofs());
    for (std::size_t cell = 0; cell < part.n_cells(); ++cell)
    {
      whole.cell_dofs(cut.cells[cell], in_whole.data());
      part.cell_dofs(cell, in_part.data());
      for (unsigned i = 0; i < in_part.size(); ++i)
        cut.to_whole[in_part[i]] = in_whole[i];
    }
  }

#define INSTANTIATE(dim)                                                                                                                   \
  template std::string obstacle_to_multigrid(const Problem<dim> &);                                                                        \
  template Vector      add_level(LevelHierarchy &, const Problem<dim> &);                                                                  \
  template void        add_own_part(LevelHierarchy &, const Problem<dim> &);
  INSTANTIATE(1)
  INSTANTIATE(2)
  INSTANTIATE(3)
#undef INSTANTIATE
} // namespace unilateral
