#include "unilateral/first_problem.h"

#include "unilateral/base/available_memory.h"
#include "unilateral/base/byte_archive.h"
#include "unilateral/discretisation/memory_estimate.h"
#include "unilateral/evaluation/functionals.h"
#include "unilateral/evaluation/goal_error.h"
#include "unilateral/mesh/cell_list.h"
#include "unilateral/mesh/part_of_mesh.h"
#include "unilateral/mesh/sent_part.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <exception>
#include <filesystem>
#include <system_error>
#include <utility>
#include <vector>

namespace unilateral
{
  namespace
  {
    template <int dim>
    FirstProblem<dim> on_whole_mesh(const ProblemStatement &statement, const std::optional<double> &memory_of_all, Diagnostics &diagnostics)
    {
      FirstProblem<dim> first;
      first.problem = std::make_unique<Problem<dim>>(statement, diagnostics);
      const auto &problem = *first.problem;
      check_functionals(problem);
      check_goal(problem);
      check_memory(statement, dim, problem.growth_in_places() * problem.space.mesh.triangulation->n_active_cells(), memory_of_all);
      first.coarse_faces.emplace(problem);
      first.discretisation.emplace(problem);
      return first;
    }

    /// In bytes; 0 where it is no mesh yet, but a script or drawing.
    std::size_t size_of_mesh_file(const std::string &file)
    {
      const std::filesystem::path path(file);
      std::error_code             none;
      const auto                  size = path.extension() == ".msh" ? std::filesystem::file_size(path, none) : 0;
      return none ? 0 : size;
    }

    /// A coarse mesh with fewer cells is surely not divided: because geometric multigrid takes it as a whole, or a factorisation is as
    /// quick, see Discretisation::obstacle_to_sharing().
    template <int dim>
    std::uint64_t least_cells_to_share(const ProblemStatement &statement, const Processes &processes)
    {
      const typename Discretisation<dim>::Parameters parameters;
      const auto                                    &mesh = statement.mesh;
      const bool                                     simplices = statement.model.element.simplex();
      double                                         least = double(parameters.cells_to_share) * processes.size();
      if (statement.method.solver != Method::Solver::automatic)
        return least;
      // Hypercubes have degree^dim nodes each, triangles a half of that, tetrahedra a sixth; a mesh with a large surface up to twice as
      // many.
      const double nodes_of_cell = std::pow(double(statement.model.element.degree), dim) / (!simplices ? 1 : dim == 2 ? 2 : 6) * 2;
      const double unknowns_of_cell = nodes_of_cell * (statement.elastic() ? dim : 1);
      const bool   refined = mesh.n_refinements() > 0 || mesh.adapt;
      if (refined && !(dim == 3 && simplices))
        least = std::max(least, (dim == 2 ? parameters.coarse_limit_2d : parameters.coarse_limit_3d) / unknowns_of_cell);
      if (!mesh.local.empty())
        return least;
      const double unknowns = mesh.adapt ? parameters.unknowns_to_share_adapted
                              : dim == 2 ? parameters.unknowns_to_share_2d
                                         : parameters.unknowns_to_share_3d;
      return std::max(least, unknowns / (unknowns_of_cell * std::pow(2., double(dim * mesh.refine))));
    }

    /// Before the mesh is known: whether there may be enough cells.
    template <int dim>
    bool may_be_sent(const ProblemStatement &statement, const Processes &processes)
    {
      if (processes.alone() || dim == 1 || statement.bending() || statement.method.solver == Method::Solver::multigrid)
        return false;
      const std::uint64_t enough_cells = least_cells_to_share<dim>(statement, processes);
      switch (statement.mesh.source)
      {
      case MeshDescription::Source::box:
        return known_coarse_cells(statement, dim) >= enough_cells;
      case MeshDescription::Source::file:
        return size_of_mesh_file(statement.mesh.file) >= 30 * enough_cells; // at least as many bytes as a cell takes
      case MeshDescription::Source::cells:
        return statement.mesh.cell_list->cells.size() >= enough_cells;
      default: // round meshes follow a manifold
        return false;
      }
    }

    /// Each process makes some of the mesh, and has never more than its part. Nothing, on all processes: the mesh, or what the case says of
    /// it, asks for it as a whole.
    template <int dim>
    std::optional<FirstProblem<dim>> on_parts_of_mesh(const ProblemStatement      &statement,
                                                      const Processes             &processes,
                                                      const std::optional<double> &memory_of_all,
                                                      Diagnostics                 &diagnostics,
                                                      Progress                    &progress)
    {
      // Cells at a rigid part belong to one process.
      const auto &boundary = statement.boundary;
      const bool  has_ties = !statement.periodic.empty() || std::any_of(boundary.begin(), boundary.end(),
                                                                        [](const BoundaryCondition &condition) { return condition.rigid; });
      // The division of quadrilaterals and hexahedra stays, so it goes by what the whole is refined to; that of a box may as well.
      const auto source = statement.mesh.source;
      const bool becomes_uneven =
        !statement.mesh.local.empty() && (!statement.model.element.simplex() || source == MeshDescription::Source::box);
      const bool in_pieces = source == MeshDescription::Source::file || source == MeshDescription::Source::box;
      if (!in_pieces || has_ties || becomes_uneven)
        return {};
      auto part = part_of_mesh<dim>(statement.mesh, statement.model.element.simplex(), processes,
                                    least_cells_to_share<dim>(statement, processes), statement.mesh.parts);
      if (!part)
        return {};
      FirstProblem<dim> first;
      Diagnostics       found = diagnostics;
      first.problem = std::make_unique<Problem<dim>>(statement, std::move(*part), found);
      const auto &problem = *first.problem;
      check_functionals(problem);
      check_goal(problem);
      check_memory(statement, dim, problem.growth_in_places() * problem.space.n_cells(), memory_of_all);
      first.discretisation.emplace(problem);
      if (!first.discretisation->shares_coarse_mesh(problem, processes))
        return {};
      first.coarse_faces.emplace(problem);
      diagnostics = std::move(found);
      progress.log(fmt::format("{} processes share the mesh of {} cells, of which each has {} a part, and all that are finer",
                               processes.size(), problem.space.n_cells(), source == MeshDescription::Source::file ? "read" : "made"));
      return first;
    }

    /// What goes to all processes along with their parts.
    template <int dim, typename Archive>
    void archive(Archive &bytes, typename Problem<dim>::OfWhole &of_whole, DiscretisationChoice &choice, FacetedSurface<dim> &faces)
    {
      of_whole.archive(bytes);
      choice.archive(bytes);
      faces.archive(bytes);
    }

    /// @p whole, and the @p weights of its cells: on the first process.
    template <int dim>
    FirstProblem<dim> send_parts(FirstProblem<dim>          whole,
                                 const std::vector<double> &weights,
                                 const ProblemStatement    &statement,
                                 const Processes           &processes,
                                 Progress                  &progress)
    {
      typename Problem<dim>::OfWhole of_whole;
      DiscretisationChoice           choice;
      FacetedSurface<dim>            faces;
      ByteWriter                     writer;
      std::vector<char>              own_part;
      std::uint64_t                  n_cells = 0;
      if (whole.problem)
      {
        of_whole = whole.problem->of_whole();
        choice = whole.discretisation->choice();
        archive<dim>(writer, of_whole, choice, *whole.coarse_faces);
        const auto &mesh = whole.problem->space.mesh;
        n_cells = mesh.triangulation->n_active_cells();
        const Division         division = divide(*mesh.triangulation, processes.size(), weights, tied_parts(*whole.problem));
        const PartsToSend<dim> parts(mesh, division);
        for (unsigned rank = 1; rank < processes.size(); ++rank)
          processes.send(parts.bytes_for(rank), rank);
        own_part = parts.bytes_for(0);
        whole = {};
      }
      else
        own_part = processes.receive(0);
      const std::vector<char> for_all = processes.gather(writer.bytes);
      ByteReader              reader(for_all);
      archive<dim>(reader, of_whole, choice, faces);
      n_cells = processes.sum(n_cells);
      progress.log(fmt::format("{} processes share the mesh of {} cells, which the first one has made, and all that are finer",
                               processes.size(), n_cells));

      FirstProblem<dim> first;
      auto              part = unpack_part<dim>({own_part}, processes);
      own_part = {};
      first.problem = std::make_unique<Problem<dim>>(statement, std::move(part), of_whole);
      first.discretisation.emplace(*first.problem, choice);
      first.coarse_faces = std::move(faces);
      return first;
    }
  } // namespace

  template <int dim>
  FirstProblem<dim>
  make_first_problem(const ProblemStatement &statement, const Processes &processes, Diagnostics &diagnostics, Progress &progress)
  {
    check_memory(statement, dim, known_coarse_cells(statement, dim));
    if constexpr (dim > 1)
      if (processes.any(processes.rank() == 0 && may_be_sent<dim>(statement, processes)))
      {
        // Processes on one machine have its memory together.
        const auto            own = available_memory();
        const double          memory = processes.sum(own.value_or(0.) / processes.n_on_this_machine());
        std::optional<double> memory_of_all;
        if (!processes.any(!own))
          memory_of_all = memory;
        if (auto first = on_parts_of_mesh<dim>(statement, processes, memory_of_all, diagnostics, progress))
          return std::move(*first);
        FirstProblem<dim>   first;
        std::exception_ptr  mistake;
        bool                sends = false;
        std::vector<double> weights;
        if (processes.rank() == 0)
          try
          {
            first = on_whole_mesh<dim>(statement, memory_of_all, diagnostics);
            sends = first.discretisation->shares_coarse_mesh(*first.problem, processes) && can_be_sent(first.problem->space.mesh);
            if (sends && tied_parts(*first.problem).empty()) // else it was without weights that no part was found too large
              weights = cells_to_come(*first.problem);
          }
          catch (const InputError &)
          {
            mistake = std::current_exception();
          }
        if (processes.any(bool(mistake)))
        {
          if (mistake)
            std::rethrow_exception(mistake);
          throw InputError(statement.mesh.where, "the first process has found a mistake", MessageName("contradiction")); // says which
        }
        if (processes.any(sends))
          return send_parts(std::move(first), weights, statement, processes, progress);
        if (first.problem)
          return first;
      }
    return on_whole_mesh<dim>(statement, available_memory(), diagnostics);
  }

#define INSTANTIATE(dim)                                                                                                                   \
  template FirstProblem<dim> make_first_problem(const ProblemStatement &, const Processes &, Diagnostics &, Progress &);
  INSTANTIATE(1)
  INSTANTIATE(2)
  INSTANTIATE(3)
#undef INSTANTIATE
} // namespace unilateral
