#include "unilateral/discretisation/cut_faces.h"

#include "unilateral/base/exchange_records.h"

#include <algorithm>
#include <array>
#include <utility>
#include <vector>

namespace unilateral
{
  using namespace dealii;

  template <int dim>
  CutFaces<dim>::CutFaces(const Problem<dim> &problem)
  {
    if (!problem.space.subdomain)
      return;
    struct Record
    {
      std::array<double, dim> centre;
      unsigned                process, region, number;
    };
    team = problem.space.processes();
    const unsigned          own_rank = team.rank();
    std::vector<Point<dim>> centres;
    std::vector<double>     sizes;
    // Each face is told at all its vertices, so that every process that has it hears of it at each of them.
    std::vector<std::pair<unsigned, Record>> told;
    for (const auto &cell : problem.space.dof_handler.active_cell_iterators())
      for (const unsigned f : cell->face_indices())
        if (cell->at_boundary(f) && !problem.space.is_outside(cell, f))
        {
          const auto face = cell->face(f);
          Record     record{{}, own_rank, cell->material_id(), unsigned(own.size())};
          own.push_back({cell->active_cell_index(), f, unsigned(face->vertex_dof_index(0, 0))});
          centres.push_back(face->center());
          sizes.push_back(cell->diameter());
          for (unsigned d = 0; d < dim; ++d)
            record.centre[d] = centres.back()[d];
          for (const unsigned v : face->vertex_indices())
            told.emplace_back(face->vertex_dof_index(v, 0), record);
        }
    problem.space.shared().share(told);
    for (std::size_t k = 0; k < own.size(); ++k)
    {
      const Face       &face = own[k];
      const Point<dim> &centre = centres[k];
      // The same corners, summed in another order.
      const double slack = 1e-9 * (sizes[k] + centre.norm() * 1e-3);
      const auto   is_other_side = [&](const Record &other)
      {
        double square = 0;
        for (unsigned d = 0; d < dim; ++d)
          square += (other.centre[d] - centre[d]) * (other.centre[d] - centre[d]);
        return other.process != own_rank && square <= slack * slack;
      };
      auto at = std::lower_bound(told.begin(), told.end(), face.vertex,
                                 [](const auto &entry, const unsigned vertex) { return entry.first < vertex; });
      while (at != told.end() && at->first == face.vertex && !is_other_side(at->second))
        ++at;
      if (at == told.end() || at->first != face.vertex)
        complete = false;
      else
        beyond[{face.cell, face.face}] = {at->second.process, types::material_id(at->second.region), at->second.number};
    }
  }

  template <int dim>
  std::vector<std::vector<double>> CutFaces<dim>::exchange(const std::vector<std::vector<double>> &own_numbers) const
  {
    std::vector<std::vector<double>> to_each(team.size()), answers(own.size());
    for (std::size_t k = 0; k < own.size(); ++k)
    {
      const Beyond &other = *find(own[k].cell, own[k].face);
      auto         &message = to_each[other.process];
      message.push_back(other.number);
      message.push_back(double(own_numbers[k].size()));
      message.insert(message.end(), own_numbers[k].begin(), own_numbers[k].end());
    }
    for (const auto &message : exchange_records(to_each, team))
      for (std::size_t place = 0; place < message.size();)
      {
        const auto face = std::size_t(message[place]), length = std::size_t(message[place + 1]);
        const auto begin = message.begin() + std::ptrdiff_t(place) + 2;
        answers[face].assign(begin, begin + std::ptrdiff_t(length));
        place += 2 + length;
      }
    return answers;
  }

  template class CutFaces<1>;
  template class CutFaces<2>;
  template class CutFaces<3>;
} // namespace unilateral
