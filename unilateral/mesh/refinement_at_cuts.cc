#include "unilateral/mesh/refinement_at_cuts.h"

#include <algorithm>
#include <functional>
#include <iterator>
#include <map>
#include <utility>

namespace unilateral
{
  using namespace dealii;

  namespace
  {
    /// The process of each cell of a divided mesh, and what processes have of its lines.
    template <int dim>
    class OwnersOfCells
    {
    public:
      using Iterator = typename Triangulation<dim>::cell_iterator;

      OwnersOfCells(const Triangulation<dim> &whole, const Division &division) : whole(whole), owner(whole.n_levels())
      {
        for (unsigned level = 0; level < owner.size(); ++level)
          owner[level].resize(whole.n_raw_cells(level));
        unsigned                                    number = 0, of_base = 0;
        const std::function<void(const Iterator &)> visit = [&](const Iterator &cell)
        {
          owner[cell->level()][cell->index()] = of_base;
          for (unsigned c = 0; c < cell->n_children(); ++c)
            visit(cell->child(c));
        };
        for (const auto &cell : whole.cell_iterators_on_level(division.base_level))
        {
          of_base = division.owner[number++];
          visit(cell);
        }
      }

      unsigned of(const Iterator &cell) const { return owner[cell->level()][cell->index()]; }

      bool on_cut(const Iterator &cell, const unsigned face) const
      {
        return !cell->at_boundary(face) && of(cell) != of(cell->neighbor(face));
      }

      /// The lines that are whole in some cells of a process and halved in others, or about to be, but not in the same way in the cells of
      /// another process; in space.
      std::vector<bool> lines_that_differ() const
      {
        constexpr unsigned char                                is_whole = 1, is_halved = 2;
        std::map<std::pair<unsigned, unsigned>, unsigned char> state; // of a line for a process
        for (const auto &cell : whole.active_cell_iterators())
          for (const unsigned l : cell->line_indices())
          {
            auto &here = state[{cell->line_index(l), of(cell)}];
            here |= cell->refine_flag_set() ? is_halved : is_whole;
          }
        // Of lines with children the cells beside them are on deeper levels.
        for (int level = int(owner.size()) - 1; level > 0; --level)
          for (const auto &cell : whole.cell_iterators_on_level(level - 1))
            if (!cell->is_active())
              for (const unsigned l : cell->line_indices())
                state[{cell->line_index(l), of(cell)}] |= is_halved;
        std::vector<bool> differ(whole.n_raw_lines(), false);
        for (auto entry = state.begin(); entry != state.end(); ++entry)
          if (const auto next = std::next(entry);
              next != state.end() && next->first.first == entry->first.first && next->second != entry->second)
            differ[entry->first.first] = true;
        return differ;
      }

    private:
      const Triangulation<dim>          &whole;
      std::vector<std::vector<unsigned>> owner; ///< by level and index
    };

    template <int dim>
    void clear_flags(Triangulation<dim> &triangulation)
    {
      for (const auto &cell : triangulation.active_cell_iterators())
      {
        cell->clear_refine_flag();
        cell->clear_coarsen_flag();
      }
    }

    template <typename Cell>
    bool flag(const Cell &cell)
    {
      if (cell->refine_flag_set())
        return false;
      cell->set_refine_flag();
      return true;
    }

    /// Flags the active cells with a line that is marked; whether there were any.
    template <int dim>
    bool flag_cells_at(const std::vector<bool> &lines, const Triangulation<dim> &triangulation)
    {
      bool any = false;
      for (const auto &cell : triangulation.active_cell_iterators())
        for (const unsigned l : cell->line_indices())
          if (lines[cell->line_index(l)])
            any = flag(cell) || any;
      return any;
    }
  } // namespace

  template <int dim>
  bool conforms_at_cuts(const Triangulation<dim> &whole, const Division &division)
  {
    const OwnersOfCells<dim> owners(whole, division);
    for (const auto &cell : whole.active_cell_iterators())
      for (const unsigned f : cell->face_indices())
        if (cell->face(f)->has_children() && owners.on_cut(cell, f))
          return false;
    if (dim == 2)
      return true;
    const std::vector<bool> differ = owners.lines_that_differ();
    return std::find(differ.begin(), differ.end(), true) == differ.end();
  }

  template <int dim>
  void refine_alike_at_cuts(Triangulation<dim> &whole, const Division &division, std::vector<bool> &chosen)
  {
    const OwnersOfCells<dim> owners(whole, division);
    for (const auto &cell : whole.active_cell_iterators())
    {
      bool refines = chosen[cell->active_cell_index()];
      for (const unsigned f : cell->face_indices())
        refines = refines && !(owners.on_cut(cell, f) && cell->neighbor_is_coarser(f));
      if (refines)
        cell->set_refine_flag();
    }
    for (bool changed = true; changed;)
    {
      whole.prepare_coarsening_and_refinement();
      changed = false;
      for (const auto &cell : whole.active_cell_iterators())
        for (const unsigned f : cell->face_indices())
          if (owners.on_cut(cell, f) && !cell->neighbor_is_coarser(f))
            if (const auto neighbor = cell->neighbor(f); neighbor->has_children() || neighbor->refine_flag_set())
              changed = flag(cell) || changed;
      if (dim == 3)
        changed = flag_cells_at(owners.lines_that_differ(), whole) || changed;
    }
    for (const auto &cell : whole.active_cell_iterators())
      chosen[cell->active_cell_index()] = bool(cell->refine_flag_set());
    clear_flags(whole);
  }

  namespace
  {
    /// Of lines or faces that several processes have, by their unknown of degree 2.
    class Counts
    {
    public:
      explicit Counts(const SharedUnknowns &shared) : shared(shared) {}

      void clear(const std::size_t n) { values.assign(n, 0.); }
      void set(const types::global_dof_index middle)
      {
        if (shared.shares(middle))
          values[middle] = 1;
      }
      /// On how many processes each is set.
      void add_up() { shared.add(values.data()); }

      double operator[](const types::global_dof_index middle) const { return values[middle]; }

    private:
      const SharedUnknowns &shared;
      std::vector<double>   values;
    };
  } // namespace

  template <int dim>
  void flag_alike_at_cuts(Triangulation<dim> &part, const DoFHandler<dim> &quadratic, const SharedUnknowns &shared)
  {
    Assert(quadratic.get_fe().degree == 2, ExcMessage("lines and faces have one unknown of their own"));
    const auto middle = [](const auto &line_or_face) { return line_or_face->dof_index(0); };
    const auto cells = [&] { return quadratic.active_cell_iterators(); };
    Counts     all(shared), halved(shared), whole(shared);
    all.clear(quadratic.n_dofs());
    for (const auto &cell : cells())
    {
      for (const unsigned f : cell->face_indices())
        all.set(middle(cell->face(f)));
      for (const unsigned l : cell->line_indices())
        all.set(middle(cell->line(l)));
    }
    all.add_up();
    for (bool changed = true; changed;)
    {
      part.prepare_coarsening_and_refinement();
      halved.clear(quadratic.n_dofs());
      whole.clear(quadratic.n_dofs());
      for (const auto &cell : cells())
      {
        for (const unsigned f : cell->face_indices())
          if (cell->refine_flag_set())
            halved.set(middle(cell->face(f)));
        for (const unsigned l : cell->line_indices())
          (cell->refine_flag_set() ? halved : whole).set(middle(cell->line(l)));
        for (const unsigned l : cell->line_indices())
          if (cell->line(l)->has_children())
            halved.set(middle(cell->line(l)));
      }
      halved.add_up();
      whole.add_up();
      changed = false;
      for (const auto &cell : cells())
      {
        for (const unsigned f : cell->face_indices())
          if (cell->at_boundary(f) && halved[middle(cell->face(f))] > 0) // across a cut: the cell is the only one of this process there
            changed = flag(cell) || changed;
        const auto on_some = [&](const Counts &counts, const auto at) { return counts[at] > 0 && counts[at] < all[at]; };
        if (dim == 3)
          for (const unsigned l : cell->line_indices())
            if (const auto at = middle(cell->line(l)); on_some(halved, at) || on_some(whole, at))
              changed = flag(cell) || changed;
      }
      changed = shared.processes().any(changed);
    }
  }

  template <int dim>
  bool mark_alike_at_cuts(std::vector<bool> &lines, const DoFHandler<dim> &quadratic, const SharedUnknowns &shared)
  {
    Assert(quadratic.get_fe().degree == 2, ExcMessage("lines have one unknown of their own"));
    Counts     marked(shared);
    const auto for_each_line = [&](const auto &action)
    {
      for (const auto &cell : quadratic.active_cell_iterators())
        for (const unsigned l : cell->line_indices())
          action(cell->line_index(l), cell->line(l)->dof_index(0));
    };
    marked.clear(quadratic.n_dofs());
    for_each_line(
      [&](const unsigned line, const types::global_dof_index middle)
      {
        if (lines[line])
          marked.set(middle);
      });
    marked.add_up();
    bool changed = false;
    for_each_line(
      [&](const unsigned line, const types::global_dof_index middle)
      {
        if (marked[middle] > 0 && !lines[line])
          lines[line] = changed = true;
      });
    return shared.processes().any(changed);
  }

#define INSTANTIATE(dim)                                                                                                                   \
  template bool conforms_at_cuts(const Triangulation<dim> &, const Division &);                                                            \
  template void refine_alike_at_cuts(Triangulation<dim> &, const Division &, std::vector<bool> &);                                         \
  template void flag_alike_at_cuts(Triangulation<dim> &, const DoFHandler<dim> &, const SharedUnknowns &);                                 \
  template bool mark_alike_at_cuts(std::vector<bool> &, const DoFHandler<dim> &, const SharedUnknowns &);
  INSTANTIATE(2)
  INSTANTIATE(3)
#undef INSTANTIATE
} // namespace unilateral
