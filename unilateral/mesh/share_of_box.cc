#include "unilateral/mesh/share_of_box.h"

#include "unilateral/mesh/gmsh_order.h"
#include "unilateral/mesh/make_outline.h"
#include "unilateral/mesh/mesh_generators.h"

#include <algorithm>
#include <cmath>

namespace unilateral
{
  using namespace dealii;

  namespace
  {
    constexpr std::uint64_t too_many = 0xffffffff;

    /// The cells of the blocks of a box with two of them in each direction, all of [0, 2]^dim: the pattern repeats after that.
    template <int dim>
    std::vector<std::vector<std::vector<std::array<unsigned, dim>>>> pattern_of_box(const bool simplices)
    {
      std::vector<std::vector<std::vector<std::array<unsigned, dim>>>> pattern(1U << dim);
      Point<dim>                                                       far;
      for (unsigned d = 0; d < dim; ++d)
        far[d] = 2;
      const Mesh<dim> mesh = box_mesh<dim>(Point<dim>(), far, std::vector<unsigned>(dim, 2), simplices);
      for (const auto &cell : mesh.triangulation->active_cell_iterators())
      {
        unsigned parity = 0;
        for (unsigned d = 0; d < dim; ++d)
          parity |= (cell->center()[d] > 1 ? 1U : 0U) << d;
        auto &corners = pattern[parity].emplace_back();
        for (const unsigned v : cell->vertex_indices())
        {
          auto &corner = corners.emplace_back();
          for (unsigned d = 0; d < dim; ++d)
            corner[d] = unsigned(std::lround(cell->vertex(v)[d])) - (parity >> d & 1U);
        }
      }
      return pattern;
    }
  } // namespace

  template <int dim>
  ShareOfBox<dim>::ShareOfBox(const MeshDescription &spec, const bool simplices, const Processes &processes) : processes(processes)
  {
    std::vector<unsigned> cells = spec.cells;
    if (cells.size() < 2)
      cells.assign(dim, cells.empty() ? 1 : cells.front());
    if (cells.size() != dim || spec.box_lower.size() != dim || spec.box_upper.size() != dim)
      return;
    double n_nodes = 1, n_of_blocks = 1;
    for (unsigned d = 0; d < dim; ++d)
    {
      lower[d] = spec.box_lower[d];
      upper[d] = spec.box_upper[d];
      n_blocks[d] = cells[d];
      if (cells[d] == 0 || !(lower[d] < upper[d]) || !std::isfinite(lower[d]) || !std::isfinite(upper[d]))
        return;
      n_nodes *= cells[d] + 1.;
      n_of_blocks *= cells[d];
    }
    pattern = pattern_of_box<dim>(simplices);
    if (n_nodes >= double(too_many) || n_of_blocks * double(pattern[0].size()) >= double(too_many))
      return;
    MshIndex &index = index_of_box.emplace();
    index.kind =
      dim == 2 ? (simplices ? CellKind::triangle : CellKind::quadrilateral) : (simplices ? CellKind::tetrahedron : CellKind::hexahedron);
    index.n_nodes = std::uint64_t(n_nodes);
    index.n_cells = std::uint64_t(n_of_blocks) * pattern[0].size();
    index.region_names = {"domain"};
    index.part_names = box_part_names(dim);
  }

  template <int dim>
  std::uint64_t ShareOfBox<dim>::number_of(const Place &node) const
  {
    std::uint64_t number = 0;
    for (unsigned d = dim; d-- > 0;)
      number = number * (n_blocks[d] + 1) + node[d];
    return number;
  }

  template <int dim>
  std::optional<MshNodes> ShareOfBox<dim>::nodes() const
  {
    MshNodes            nodes;
    const std::uint64_t n = index_of_box->n_nodes, rank = processes.rank(), size = processes.size();
    for (std::uint64_t number = n * rank / size; number < n * (rank + 1) / size; ++number)
    {
      nodes.tags.push_back(number);
      auto         &x = nodes.x.emplace_back();
      std::uint64_t rest = number;
      for (unsigned d = 0; d < dim; ++d)
      {
        x[d] = lower[d] + double(rest % (n_blocks[d] + 1)) * ((upper[d] - lower[d]) / double(n_blocks[d]));
        rest /= n_blocks[d] + 1;
      }
    }
    return nodes;
  }

  template <int dim>
  template <typename Visit>
  void ShareOfBox<dim>::for_own_cells(const Visit &visit) const
  {
    const std::uint64_t n = index_of_box->n_cells / pattern[0].size(), rank = processes.rank(), size = processes.size();
    std::vector<Place>  corners;
    for (std::uint64_t block = n * rank / size; block < n * (rank + 1) / size; ++block)
    {
      Place         place;
      std::uint64_t rest = block;
      unsigned      parity = 0;
      for (unsigned d = 0; d < dim; ++d)
      {
        place[d] = rest % n_blocks[d];
        rest /= n_blocks[d];
        parity |= (place[d] % 2) << d;
      }
      for (std::size_t k = 0; k < pattern[parity].size(); ++k)
      {
        corners.clear();
        for (const auto &corner : pattern[parity][k])
        {
          auto &node = corners.emplace_back(place);
          for (unsigned d = 0; d < dim; ++d)
            node[d] += corner[d];
        }
        visit(block * pattern[parity].size() + k, corners);
      }
    }
  }

  template <int dim>
  std::optional<CellsOfShare> ShareOfBox<dim>::cells() const
  {
    CellsOfShare cells;
    for_own_cells(
      [&](const std::uint64_t number, const std::vector<Place> &corners)
      {
        cells.ids.push_back(std::uint32_t(number));
        cells.regions.push_back(0);
        for (unsigned v = 0; v < corners.size(); ++v)
          cells.nodes.push_back(number_of(corners[corner_of_gmsh(index_of_box->kind, v)]));
      });
    return cells;
  }

  template <int dim>
  std::optional<std::vector<NamedFace>> ShareOfBox<dim>::faces() const
  {
    std::vector<NamedFace> faces;
    const unsigned         n_corners = index_of_box->corners_of_face();
    for_own_cells(
      [&](const std::uint64_t number, const std::vector<Place> &corners)
      {
        // A cell has as many corners on a side of the box as a face has, or none of its faces lies there.
        for (unsigned side = 0; side < 2 * dim; ++side)
        {
          const unsigned d = side / 2;
          NamedFace      face{{}, side, number};
          unsigned       n = 0;
          face.vertices.fill(std::uint32_t(too_many));
          for (const Place &corner : corners)
            if (corner[d] == (side % 2 == 0 ? 0 : n_blocks[d]))
              face.vertices[n++] = std::uint32_t(number_of(corner));
          if (n < n_corners)
            continue;
          std::sort(face.vertices.begin(), face.vertices.end());
          faces.push_back(face);
        }
      });
    return faces;
  }

  template <int dim>
  std::pair<typename ShareOfBox<dim>::BlockRange, typename ShareOfBox<dim>::BlockRange>
  ShareOfBox<dim>::BlockRange::halves(unsigned &across) const
  {
    across = 0;
    for (unsigned d = 1; d < dim; ++d)
      if (end[d] - begin[d] >= end[across] - begin[across])
        across = d;
    BlockRange          before = *this, after = *this;
    const std::uint64_t n_layers = end[across] - begin[across];
    before.n_processes = n_processes / 2;
    after.first_process += before.n_processes;
    after.n_processes -= before.n_processes;
    before.end[across] = after.begin[across] = begin[across] + (2 * n_layers * before.n_processes + n_processes) / (2 * n_processes);
    return {before, after};
  }

  template <int dim>
  std::uint64_t ShareOfBox<dim>::BlockRange::largest_part() const
  {
    if (n_processes == 1)
    {
      std::uint64_t n = 1;
      for (unsigned d = 0; d < dim; ++d)
        n *= end[d] - begin[d];
      return n;
    }
    unsigned   across = 0;
    const auto both = halves(across);
    return std::max(both.first.largest_part(), both.second.largest_part());
  }

  template <int dim>
  std::vector<unsigned> ShareOfBox<dim>::owners(const std::vector<std::uint32_t> &ids) const
  {
    constexpr double      largest_over_mean = 1.05;
    const std::uint64_t   n_of_block = pattern[0].size(), n = index_of_box->n_cells / n_of_block;
    const BlockRange      all{Place{}, n_blocks, 0, processes.size()};
    std::vector<unsigned> result;
    if (double(all.largest_part()) * processes.size() > largest_over_mean * double(n))
      return result;
    for (const auto id : ids)
    {
      Place         place;
      std::uint64_t rest = id / n_of_block;
      for (unsigned d = 0; d < dim; ++d)
      {
        place[d] = rest % n_blocks[d];
        rest /= n_blocks[d];
      }
      BlockRange at = all;
      while (at.n_processes > 1)
      {
        unsigned   across = 0;
        const auto both = at.halves(across);
        at = place[across] < both.first.end[across] ? both.first : both.second;
      }
      result.push_back(at.first_process);
    }
    return result;
  }

  template class ShareOfBox<2>;
  template class ShareOfBox<3>;
} // namespace unilateral
