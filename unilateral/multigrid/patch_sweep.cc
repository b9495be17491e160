#include "unilateral/multigrid/patch_sweep.h"

#include "unilateral/multigrid/cell_kernel.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace unilateral
{
  namespace
  {
    using Lanes = Simd<float>::Lanes;
    constexpr std::uint32_t none = std::numeric_limits<std::uint32_t>::max();

    void store(float *const x, const Lanes &lanes)
    {
      std::memcpy(x, &lanes, sizeof(lanes));
    }

    /// The lanes whose bit is set, zero in the others.
    Lanes select(const std::uint16_t bits, const Lanes &lanes)
    {
      typedef std::int32_t Integers __attribute__((vector_size(64)));
      constexpr Integers   bit = {1, 2, 4, 8, 16, 32, 64, 128, 256, 512, 1024, 2048, 4096, 8192, 16384, 32768};
      const Integers       chosen = (bit & std::int32_t(bits)) != 0;
      return reinterpret_cast<Lanes>(reinterpret_cast<Integers>(lanes) & chosen);
    }

    struct BesideCells
    {
      const float *penalty; ///< of all unknowns; none: 0
      float       *terms;
    };

    BesideCells beside_cells(const PatchSweep::Additions &additions, float *const terms, const std::size_t batch)
    {
      const unsigned char added = additions.batches.empty() ? 0 : additions.batches[batch];
      return {added & PatchSweep::Additions::has_penalty ? additions.penalty : nullptr,
              added & PatchSweep::Additions::has_terms ? terms : nullptr};
    }

    /// A x from the part of it that the cells make.
    Lanes completed(Lanes Ax, const Lanes &x, const std::size_t position, const float *const penalty, const float *const terms)
    {
      if (penalty)
        Ax += Simd<float>::load(penalty + position) * x;
      if (terms)
        Ax += Simd<float>::load(terms + position);
      return Ax;
    }

    void scatter_add(float *const y, const std::uint32_t *const index, const Lanes &lanes)
    {
      // Patches share unknowns: no two lanes may be added at the same time.
      for (unsigned l = 0; l < Simd<float>::width; ++l)
        y[index[l]] += lanes[l];
    }
  } // namespace

  PatchSweep::PatchSweep(const CellOperator                     &cell_operator,
                         const PatchSweep *const                 coarser,
                         const std::vector<std::vector<double>> &to_child)
    : op(&cell_operator), matrices(cell_operator.all_matrices().begin(), cell_operator.all_matrices().end())
  {
    in_places.row_start.clear();
    number_unknowns();
    if (coarser)
      connect(*coarser, to_child);
  }

  PatchSweep::PatchSweep(const CellOperator &cell_operator, const PatchSweep &coarser, const SparseTransfer &transfer)
    : PatchSweep(cell_operator, nullptr, {})
  {
    take_rows(coarser, transfer);
  }

  void PatchSweep::take_rows(const PatchSweep &coarser, const SparseTransfer &transfer)
  {
    std::vector<std::uint32_t> unknown_at(n, none);
    for (std::uint32_t dof = 0; dof < position.size(); ++dof)
      unknown_at[position[dof]] = dof;
    in_places.row_start = {0};
    for (std::uint32_t at = 0; at < n; ++at)
    {
      if (unknown_at[at] == none)
        continue;
      const auto begin = transfer.row_start[unknown_at[at]], end = transfer.row_start[unknown_at[at] + 1];
      if (end == begin + 1 && transfer.weights[begin] == 1)
      {
        kept.push_back(at);
        kept_coarse.push_back(coarser.position[transfer.columns[begin]]);
      }
      else if (end > begin)
      {
        others.push_back(at);
        for (auto k = begin; k < end; ++k)
        {
          in_places.columns.push_back(coarser.position[transfer.columns[k]]);
          in_places.weights.push_back(transfer.weights[k]);
        }
        in_places.row_start.push_back(in_places.columns.size());
      }
    }
    for (auto *const list : {&kept, &kept_coarse, &others, &in_places.columns, &in_places.row_start})
      list->shrink_to_fit();
    in_places.weights.shrink_to_fit();
  }

  std::vector<std::pair<std::uint32_t, float>> PatchSweep::coarse_row(const std::uint32_t dof) const
  {
    std::vector<std::pair<std::uint32_t, float>> row;
    if (const auto found = std::lower_bound(kept.begin(), kept.end(), position[dof]); found != kept.end() && *found == position[dof])
      row.emplace_back(kept_coarse[found - kept.begin()], 1.f);
    else if (const auto other = std::lower_bound(others.begin(), others.end(), position[dof]);
             other != others.end() && *other == position[dof])
      for (auto k = in_places.row_start[other - others.begin()]; k < in_places.row_start[other - others.begin() + 1]; ++k)
        row.emplace_back(in_places.columns[k], in_places.weights[k]);
    return row;
  }

  /// @p shared: of each unknown, whether several patches have it. Returns the place of each of a patch's unknowns.
  std::vector<std::uint32_t> PatchSweep::number_inside_first(const std::vector<unsigned char> &shared, const unsigned group)
  {
    Numbering                 &numbering = groups.emplace_back();
    const unsigned             n_patch = op->patch_groups()[group].shape.n_patch_dofs;
    std::vector<unsigned char> on_hull(n_patch, false);
    for (const auto &batch : op->batches())
      for (unsigned lane = 0; lane < batch.n_patches && batch.group == group; ++lane)
        for (unsigned i = 0; i < n_patch; ++i)
          on_hull[i] |= shared[op->dof(batch, lane, i)];
    numbering.shape = op->patch_groups()[group].shape;
    numbering.n_hull = std::count(on_hull.begin(), on_hull.end(), true);
    numbering.n_inside = n_patch - numbering.n_hull;
    std::vector<std::uint32_t> slot(n_patch);
    for (unsigned i = 0, inside = 0, outside = numbering.n_inside; i < n_patch; ++i)
      slot[i] = on_hull[i] ? outside++ : inside++;
    for (auto &i : numbering.shape.cell_dofs)
      i = slot[i];
    return slot;
  }

  void PatchSweep::number_unknowns()
  {
    const auto &batches = op->batches();
    // How many patches have an unknown, and which is the last.
    std::vector<unsigned char> shared(op->n_dofs(), false);
    std::vector<std::uint32_t> last_patch(op->n_dofs(), none);
    for (const auto &batch : batches)
      for (unsigned lane = 0; lane < batch.n_patches; ++lane)
        for (unsigned i = 0; i < op->shape_of(batch).n_patch_dofs; ++i)
        {
          auto &last = last_patch[op->dof(batch, lane, i)];
          shared[op->dof(batch, lane, i)] |= last != none;
          last = batch.first_patch + lane;
        }
    std::vector<std::vector<std::uint32_t>> slots;
    for (unsigned group = 0; group < op->patch_groups().size(); ++group)
      slots.push_back(number_inside_first(shared, group));

    position.assign(op->n_dofs(), none);
    begin_of_batch.push_back(0);
    std::size_t next = 0;
    for (std::size_t b = 0; b < batches.size(); ++b)
    {
      const auto       &batch = batches[b];
      const Numbering  &numbering = numbering_of(b);
      const auto       &slot = slots[batch.group];
      const std::size_t inside = next;
      first_of_hull.push_back(owned.size());
      owned.resize(owned.size() + numbering.n_hull, 0);
      next += numbering.n_inside * n_lanes;
      for (unsigned i = 0; i < slot.size(); ++i)
        for (unsigned l = 0; l < batch.n_patches; ++l)
          if (const auto dof = op->dof(batch, l, i); slot[i] < numbering.n_inside)
            position[dof] = inside + slot[i] * n_lanes + l;
          else if (last_patch[dof] == batch.first_patch + l)
          {
            owned[first_of_hull[b] + slot[i] - numbering.n_inside] |= 1u << l;
            position[dof] = next++;
          }
      next = (next + n_lanes - 1) / n_lanes * n_lanes;
      begin_of_batch.push_back(next);
      batch_of_lanes.resize(next / n_lanes, b);
    }
    // Lanes without a patch look at an entry that belongs to nothing.
    const std::uint32_t nothing = next;
    n = next + n_lanes;
    hull.assign(owned.size() * n_lanes, nothing);
    for (std::size_t b = 0; b < batches.size(); ++b)
      for (unsigned i = 0; i < slots[batches[b].group].size(); ++i)
        if (const unsigned slot = slots[batches[b].group][i], n_inside = numbering_of(b).n_inside; slot >= n_inside)
          for (unsigned l = 0; l < batches[b].n_patches; ++l)
            hull[(first_of_hull[b] + slot - n_inside) * n_lanes + l] = position[op->dof(batches[b], l, i)];
  }

  void PatchSweep::connect(const PatchSweep &coarser, const std::vector<std::vector<double>> &to_child)
  {
    const PatchShape          &shape = groups.front().shape;
    const unsigned             n_cell = shape.n_cell_dofs, n_children = to_child.size(), n_parents = shape.n_cells / n_children;
    const std::size_t          n_patches = op->patch_groups().front().n_patches;
    std::vector<std::uint32_t> dofs(n_cell), first_dofs;
    // The unknowns of the parents, each once: all patches are built alike.
    std::vector<unsigned> column_of(n_parents * n_cell), source;
    for (unsigned parent = 0; parent < n_parents; ++parent)
    {
      coarser.op->cell_dofs(parent, dofs.data());
      for (unsigned j = 0; j < n_cell; ++j)
      {
        const auto found = std::find(first_dofs.begin(), first_dofs.end(), dofs[j]);
        column_of[parent * n_cell + j] = found - first_dofs.begin();
        if (found == first_dofs.end())
        {
          first_dofs.push_back(dofs[j]);
          source.push_back(parent * n_cell + j);
        }
      }
    }
    n_coarse = source.size();
    const std::uint32_t nothing = coarser.n - n_lanes;
    coarse.assign(op->batches().size() * n_coarse * n_lanes, nothing);
    std::vector<std::uint32_t> dofs_of_parents(n_parents * n_cell);
    for (std::size_t p = 0; p < n_patches; ++p)
    {
      for (unsigned parent = 0; parent < n_parents; ++parent)
        coarser.op->cell_dofs(p * n_parents + parent, dofs_of_parents.data() + parent * n_cell);
      for (unsigned i = 0; i < n_coarse; ++i)
        coarse[(p / n_lanes * n_coarse + i) * n_lanes + p % n_lanes] = coarser.position[dofs_of_parents[source[i]]];
    }
    row_start = {0};
    for (unsigned i = 0; i < shape.n_patch_dofs; ++i)
    {
      const unsigned k = std::find(shape.cell_dofs.begin(), shape.cell_dofs.end(), i) - shape.cell_dofs.begin(), cell = k / n_cell;
      for (unsigned j = 0; j < n_cell; ++j)
        if (const double weight = to_child[cell % n_children][k % n_cell * n_cell + j]; std::abs(weight) > 1e-12)
        {
          columns.push_back(column_of[cell / n_children * n_cell + j]);
          weights.push_back(weight);
        }
      row_start.push_back(columns.size());
    }
  }

  void PatchSweep::load_patch(Lanes *const patch, const float *const x, const std::size_t batch) const
  {
    const float *const inside = x + begin_of_batch[batch];
    const unsigned     n_inside = numbering_of(batch).n_inside, n_hull = numbering_of(batch).n_hull;
    for (unsigned i = 0; i < n_inside; ++i)
      patch[i] = Simd<float>::load(inside + i * n_lanes);
    const std::uint32_t *const index = hull_of(batch);
    for (unsigned i = 0; i < n_hull; ++i)
      patch[n_inside + i] = Simd<float>::gather(x, index + i * n_lanes);
  }

  void PatchSweep::multiply(Lanes *const y_patch, const Lanes *const x_patch, const std::size_t batch) const
  {
    const PatchShape &shape = numbering_of(batch).shape;
    for (unsigned i = 0; i < shape.n_patch_dofs; ++i)
      y_patch[i] = Lanes{};
    const auto &with = op->batches()[batch];
    choose_kernel<float>(shape.n_cell_dofs, with.common)(shape, matrices.data() + with.offset, y_patch, x_patch);
  }

  template <typename Visit>
  void PatchSweep::for_each_product(const float *const x, const Additions &additions, float *const terms, const Visit &visit) const
  {
    alignas(64) PatchValues<float> x_patch, y_patch;
    for (std::size_t batch = 0; batch < n_batches(); ++batch)
    {
      const auto [penalty, further] = beside_cells(additions, terms, batch);
      load_patch(x_patch, x, batch);
      multiply(y_patch, x_patch, batch);
      const unsigned             n_inside = numbering_of(batch).n_inside, n_hull = numbering_of(batch).n_hull;
      const std::uint32_t *const index = hull_of(batch);
      for (unsigned i = 0; i < n_hull; ++i)
        scatter_add(terms, index + i * n_lanes, y_patch[n_inside + i]);
      // What is complete now.
      std::size_t position = begin_of_batch[batch];
      for (unsigned i = 0; i < n_inside; ++i, position += n_lanes)
        visit(position, completed(y_patch[i], x_patch[i], position, penalty, further));
      if (further)
        std::fill(further + begin_of_batch[batch], further + position, 0.f);
      for (; position < begin_of_batch[batch + 1]; position += n_lanes)
      {
        Lanes Ax = Simd<float>::load(terms + position);
        store(terms + position, Lanes{});
        if (penalty)
          Ax += Simd<float>::load(penalty + position) * Simd<float>::load(x + position);
        visit(position, Ax);
      }
    }
    store(terms + n - n_lanes, Lanes{});
  }

  void PatchSweep::smooth(const Smoothing &smoothing, const Additions &additions, float *const terms) const
  {
    const auto &s = smoothing;
    for_each_product(s.x, additions, terms,
                     [&s](const std::size_t i, const Lanes &Ax)
                     {
                       Lanes step = s.gain * Simd<float>::load(s.inverse_diagonal + i) * (Simd<float>::load(s.b + i) - Ax);
                       if (s.previous_step)
                         step += s.keep * Simd<float>::load(s.previous_step + i);
                       const Lanes moved = Simd<float>::load(s.x + i) + step;
                       if (s.step)
                         store(s.step + i, step);
                       store(s.x + i, moved);
                     });
  }

  void PatchSweep::restrict_residual(float *const       coarse_b,
                                     const float *const b,
                                     const float *const x,
                                     const float *const receives,
                                     const Additions   &additions,
                                     float *const       terms,
                                     float *const       scratch) const
  {
    if (has_sparse_transfer())
    {
      for_each_product(x, additions, terms,
                       [&](const std::size_t i, const Lanes &Ax)
                       { store(scratch + i, Simd<float>::load(receives + i) * (Simd<float>::load(b + i) - Ax)); });
      for (std::size_t row = 0; row < kept.size(); ++row)
        coarse_b[kept_coarse[row]] += scratch[kept[row]];
      for (std::size_t row = 0; row < others.size(); ++row)
        for (std::uint32_t k = in_places.row_start[row]; k < in_places.row_start[row + 1]; ++k)
          coarse_b[in_places.columns[k]] += in_places.weights[k] * scratch[others[row]];
      return;
    }
    const unsigned                 n_inside = groups.front().n_inside, n_hull = groups.front().n_hull;
    alignas(64) PatchValues<float> x_patch, y_patch;
    for (std::size_t batch = 0; batch < n_batches(); ++batch)
    {
      const auto [penalty, further] = beside_cells(additions, terms, batch);
      load_patch(x_patch, x, batch);
      multiply(y_patch, x_patch, batch);
      // Residuals, those on hulls in parts: what is no product is with the patch that owns the unknown.
      std::size_t position = begin_of_batch[batch];
      for (unsigned i = 0; i < n_inside; ++i, position += n_lanes)
        x_patch[i] = Simd<float>::load(receives + position) *
                     (Simd<float>::load(b + position) - completed(y_patch[i], x_patch[i], position, penalty, further));
      for (unsigned i = 0; i < n_hull; ++i)
      {
        const std::uint32_t *const index = hull_of(batch) + i * n_lanes;
        Lanes                      once = Simd<float>::gather(b, index);
        if (penalty)
          once -= Simd<float>::gather(penalty, index) * x_patch[n_inside + i];
        if (further)
          once -= Simd<float>::gather(further, index);
        x_patch[n_inside + i] =
          Simd<float>::gather(receives, index) * (select(owned[first_of_hull[batch] + i], once) - y_patch[n_inside + i]);
      }
      if (further)
        std::fill(further + begin_of_batch[batch], further + begin_of_batch[batch + 1], 0.f);
      for (unsigned i = 0; i < n_coarse; ++i)
        y_patch[i] = Lanes{};
      for (unsigned i = 0; i < n_inside + n_hull; ++i)
        for (unsigned k = row_start[i]; k < row_start[i + 1]; ++k)
          y_patch[columns[k]] += weights[k] * x_patch[i];
      for (unsigned i = 0; i < n_coarse; ++i)
        scatter_add(coarse_b, coarse.data() + (batch * n_coarse + i) * n_lanes, y_patch[i]);
    }
  }

  void PatchSweep::prolongate(float *const x, const float *const coarse_x, const float *const receives) const
  {
    if (has_sparse_transfer())
    {
      for (std::size_t row = 0; row < kept.size(); ++row)
        x[kept[row]] += receives[kept[row]] * coarse_x[kept_coarse[row]];
      for (std::size_t row = 0; row < others.size(); ++row)
      {
        float correction = 0;
        for (std::uint32_t k = in_places.row_start[row]; k < in_places.row_start[row + 1]; ++k)
          correction += in_places.weights[k] * coarse_x[in_places.columns[k]];
        x[others[row]] += receives[others[row]] * correction;
      }
      return;
    }
    const unsigned                 n_inside = groups.front().n_inside, n_hull = groups.front().n_hull;
    alignas(64) PatchValues<float> coarse_patch;
    for (std::size_t batch = 0; batch < n_batches(); ++batch)
    {
      for (unsigned i = 0; i < n_coarse; ++i)
        coarse_patch[i] = Simd<float>::gather(coarse_x, coarse.data() + (batch * n_coarse + i) * n_lanes);
      const auto correction = [&](const unsigned i)
      {
        Lanes sum{};
        for (unsigned k = row_start[i]; k < row_start[i + 1]; ++k)
          sum += weights[k] * coarse_patch[columns[k]];
        return sum;
      };
      std::size_t position = begin_of_batch[batch];
      for (unsigned i = 0; i < n_inside; ++i, position += n_lanes)
        store(x + position, Simd<float>::load(x + position) + Simd<float>::load(receives + position) * correction(i));
      for (unsigned i = 0; i < n_hull; ++i)
        if (unsigned lanes = owned[first_of_hull[batch] + i]; lanes != 0)
        {
          const Lanes                value = correction(n_inside + i);
          const std::uint32_t *const index = hull_of(batch) + i * n_lanes;
          for (; lanes != 0; lanes &= lanes - 1)
          {
            const unsigned l = __builtin_ctz(lanes);
            x[index[l]] += receives[index[l]] * value[l];
          }
        }
    }
  }

  std::size_t PatchSweep::memory() const
  {
    return sizeof(std::uint32_t) *
             (position.capacity() + hull.capacity() + coarse.capacity() + kept.capacity() + kept_coarse.capacity() + others.capacity()) +
           sizeof(std::uint16_t) * owned.capacity() + sizeof(float) * matrices.capacity() +
           (sizeof(std::uint32_t) + sizeof(float)) * in_places.columns.capacity() + sizeof(std::uint32_t) * in_places.row_start.capacity();
  }
} // namespace unilateral
