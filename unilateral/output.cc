#include "unilateral/output.h"

#include "unilateral/simplex_element.h"
#include "unilateral/vtu_file.h"

#include <deal.II/base/quadrature_lib.h>
#include <deal.II/fe/fe_dgq.h>
#include <deal.II/fe/fe_q.h>
#include <deal.II/fe/fe_values.h>
#include <deal.II/fe/fe_values_extractors.h>

#include <fmt/format.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <filesystem>
#include <map>
#include <sstream>
#include <stdexcept>

#include <fcntl.h>
#include <unistd.h>

namespace unilateral
{
  void write_file_atomically(const std::string &path, const std::string &content)
  {
    const std::filesystem::path target(path);
    const std::string temporary = (target.parent_path() / fmt::format(".{}.{}.part", target.filename().string(), getpid())).string();
    const auto        fail = [&](const int reason)
    {
      unlink(temporary.c_str());
      throw std::runtime_error(fmt::format("cannot write '{}': {}", path, std::strerror(reason)));
    };

    const int file = open(temporary.c_str(), O_WRONLY | O_CREAT | O_TRUNC | O_CLOEXEC, 0666);
    if (file < 0)
      fail(errno);
    for (std::size_t written = 0; written < content.size();)
    {
      const ssize_t n = write(file, content.data() + written, content.size() - written);
      if (n < 0 && errno == EINTR)
        continue;
      if (n < 0)
      {
        const int reason = errno;
        close(file);
        fail(reason);
      }
      written += n;
    }
    // A full disk or a network drive may report only here that the bytes did not arrive.
    if (fsync(file) != 0 && errno != EINVAL && errno != EROFS)
    {
      const int reason = errno;
      close(file);
      fail(reason);
    }
    if (close(file) != 0)
      fail(errno);
    if (std::rename(temporary.c_str(), path.c_str()) != 0)
      fail(errno);
  }

  void write_file_atomically(const std::string &path, const std::function<void(std::ostream &)> &writer)
  {
    std::ostringstream out;
    writer(out);
    if (!out)
      throw std::runtime_error(fmt::format("cannot write '{}': its content could not be produced", path));
    write_file_atomically(path, out.str());
  }

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

  template <int dim>
  void write_solution_vtu(const std::string                  &path,
                          const Mapping<dim>                 &mapping,
                          const DoFHandler<dim>              &dof_handler,
                          const Vector                       &u,
                          const unsigned int                  degree,
                          const std::vector<NamedField<dim>> &fields)
  {
    const auto        &triangulation = dof_handler.get_triangulation();
    const auto        &fe = dof_handler.get_fe();
    const bool         simplex = dim > 1 && fe.reference_cell().is_simplex();
    const unsigned int n_components = fe.n_components();

    std::vector<NamedField<dim>> functions = {{"u", &u}};
    functions.insert(functions.end(), fields.begin(), fields.end());

    const auto      lattice = lattice_element<dim>(simplex, fe.conforming_space == FiniteElementData<dim>::L2, std::max(degree, 1u));
    DoFHandler<dim> nodes(triangulation);
    nodes.distribute_dofs(*lattice);
    match_line_nodes(nodes);

    std::map<LatticePoint, unsigned int> node_at;
    for (unsigned int q = 0; q < lattice->n_dofs_per_cell(); ++q)
    {
      LatticePoint p{};
      for (unsigned int d = 0; d < dim; ++d)
        p[d] = std::lround(lattice->unit_support_point(q)[d] * lattice->degree);
      node_at[p] = q;
    }
    std::vector<std::vector<unsigned int>> pieces;
    for (const auto &piece : linear_pieces<dim>(simplex, lattice->degree))
    {
      pieces.emplace_back();
      for (const auto &p : piece)
        pieces.back().push_back(node_at.at(p));
    }

    VtuGrid grid;
    for (const auto &function : functions)
    {
      const unsigned int n = function.space ? function.space->get_fe().n_components() : n_components;
      grid.point_arrays.push_back({function.name, {}, n == 1 ? 1u : 3u, false});
    }
    grid.cell_arrays = {{"level", {}, 1, true}, {"region", {}, 1, true}};

    constexpr std::int64_t               not_seen = -1;
    std::vector<std::int64_t>            point_of_node(nodes.n_dofs(), not_seen);
    std::vector<types::global_dof_index> cell_nodes(lattice->n_dofs_per_cell());
    FEValues<dim> values(mapping, fe, Quadrature<dim>(lattice->get_unit_support_points()), update_values | update_quadrature_points);
    std::vector<dealii::Vector<double>> at_nodes(values.n_quadrature_points, dealii::Vector<double>(n_components));
    std::map<const DoFHandler<dim> *, std::unique_ptr<FEValues<dim>>> other_values; // of the functions that live elsewhere
    for (const auto &function : functions)
      if (function.space && !other_values[function.space])
        other_values[function.space] = std::make_unique<FEValues<dim>>(mapping, function.space->get_fe(),
                                                                       Quadrature<dim>(lattice->get_unit_support_points()), update_values);
    for (const auto &cell : dof_handler.active_cell_iterators())
      if (cell->is_locally_owned())
      {
        values.reinit(cell);
        typename DoFHandler<dim>::active_cell_iterator(&triangulation, cell->level(), cell->index(), &nodes)->get_dof_indices(cell_nodes);

        std::vector<unsigned int> is_new;
        for (unsigned int q = 0; q < cell_nodes.size(); ++q)
          if (point_of_node[cell_nodes[q]] == not_seen)
          {
            is_new.push_back(q);
            point_of_node[cell_nodes[q]] = grid.points.size();
            grid.points.push_back({0, 0, 0});
            for (unsigned int d = 0; d < dim; ++d)
              grid.points.back()[d] = values.quadrature_point(q)[d];
          }
        for (unsigned int f = 0; f < functions.size(); ++f)
        {
          auto              &array = grid.point_arrays[f];
          const auto        *space = functions[f].space;
          const unsigned int n = space ? space->get_fe().n_components() : n_components;
          at_nodes.assign(values.n_quadrature_points, dealii::Vector<double>(n));
          if (space)
          {
            auto &elsewhere = *other_values[space];
            elsewhere.reinit(typename DoFHandler<dim>::active_cell_iterator(&triangulation, cell->level(), cell->index(), space));
            elsewhere.get_function_values(*functions[f].values, at_nodes);
          }
          else
            values.get_function_values(*functions[f].values, at_nodes);
          for (const unsigned int q : is_new)
            for (unsigned int c = 0; c < array.n_components; ++c)
              array.values.push_back(c < n ? at_nodes[q][c] : 0.);
        }
        for (const auto &piece : pieces)
        {
          for (const unsigned int q : piece)
            grid.connectivity.push_back(point_of_node[cell_nodes[q]]);
          grid.offsets.push_back(grid.connectivity.size());
          grid.cell_types.push_back(vtk_cell_type<dim>(simplex));
          grid.cell_arrays[0].values.push_back(cell->level());
          grid.cell_arrays[1].values.push_back(cell->material_id());
        }
      }
    write_file_atomically(path, to_vtu(grid));
  }

  template <int dim>
  void write_constraint_points_vtu(const std::string         &path,
                                   const ConstraintSet<dim>  &set,
                                   const std::vector<double> &u,
                                   const std::vector<double> &pressure)
  {
    if (u.size() != set.size() || pressure.size() != set.size())
      throw std::invalid_argument("write_constraint_points_vtu: a value of u and a pressure are needed for each constraint point");
    VtuGrid  grid;
    VtuArray gap{"gap"}, penetration{"penetration"}, active{"active", {}, 1, true}, side{"side", {}, 1, true},
      block{"block", std::vector<double>(set.size(), -1), 1, true};
    for (std::size_t i = 0; i < set.size(); ++i)
    {
      grid.points.push_back({0, 0, 0});
      for (unsigned int d = 0; d < dim; ++d)
        grid.points.back()[d] = set.points[i][d];
      grid.connectivity.push_back(i);
      grid.offsets.push_back(i + 1);
      grid.cell_types.push_back(1);

      const double distance = set.sign[i] * (set.bound[i] - u[i]);
      gap.values.push_back(distance);
      penetration.values.push_back(std::max(0., -distance));
      active.values.push_back(pressure[i] > 0);
      side.values.push_back(set.sign[i] > 0);
    }
    for (std::size_t b = 0; b < set.blocks.size(); ++b)
      std::fill(block.values.begin() + set.blocks[b].begin, block.values.begin() + set.blocks[b].end, double(b));
    grid.point_arrays = {{"pressure", pressure}, gap, penetration, active, {"weight", set.weights}, side, block};
    if (!set.directions.empty())
    {
      VtuArray direction{"direction", {}, 3};
      for (const auto &n : set.directions)
        for (unsigned int c = 0; c < 3; ++c)
          direction.values.push_back(c < dim ? n[c % dim] : 0.);
      grid.point_arrays.push_back(std::move(direction));
    }
    write_file_atomically(path, to_vtu(grid));
  }

#define INSTANTIATE(dim)                                                                                                                   \
  template void write_solution_vtu<dim>(const std::string &, const Mapping<dim> &, const DoFHandler<dim> &, const Vector &, unsigned int,  \
                                        const std::vector<NamedField<dim>> &);                                                             \
  template void write_constraint_points_vtu<dim>(const std::string &, const ConstraintSet<dim> &, const std::vector<double> &,             \
                                                 const std::vector<double> &);
  INSTANTIATE(1)
  INSTANTIATE(2)
  INSTANTIATE(3)
#undef INSTANTIATE
} // namespace unilateral
