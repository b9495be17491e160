#include "unilateral/discretisation/terms_across_cuts.h"

#include "unilateral/algebra/numbers_of_all.h"
#include "unilateral/base/exchange_records.h"
#include "unilateral/base/sort_unique.h"

#include <deal.II/fe/fe_values.h>

#include <algorithm>
#include <map>
#include <numeric>

namespace unilateral
{
  using namespace dealii;

  namespace
  {
    /// @p side with other columns: combinations of those that it has.
    template <int dim>
    FaceSide<dim> combined(const FaceSide<dim> &side, const FullMatrix<double> &combination)
    {
      FaceSide<dim> result = side;
      for (auto *const matrix : {&result.slope, &result.moment})
      {
        FullMatrix<double> product(side.points.size(), combination.n());
        if (combination.n() > 0)
          matrix->mmult(product, combination);
        *matrix = product;
      }
      return result;
    }

    /// The weights of a rule are the same on both sides.
    template <int dim>
    std::vector<double> packed(const FaceSide<dim> &side, const std::vector<double> &labels)
    {
      std::vector<double> message = {double(side.points.size()), double(side.slope.n()), side.half_inverse_width};
      for (unsigned q = 0; q < side.points.size(); ++q)
      {
        for (unsigned d = 0; d < dim; ++d)
          message.push_back(side.points[q][d]);
        message.push_back(side.penalty[q]);
        for (unsigned k = 0; k < side.slope.n(); ++k)
        {
          message.push_back(side.slope(q, k));
          message.push_back(side.moment(q, k));
        }
      }
      message.insert(message.end(), labels.begin(), labels.end());
      return message;
    }

    template <int dim>
    void unpack(const std::vector<double> &message, FaceSide<dim> &side, std::vector<double> &labels)
    {
      auto           next = message.begin();
      const unsigned n_points = unsigned(*next++), n_functions = unsigned(*next++);
      side.half_inverse_width = *next++;
      side.points.resize(n_points);
      side.penalty.resize(n_points);
      side.slope.reinit(n_points, n_functions);
      side.moment.reinit(n_points, n_functions);
      for (unsigned q = 0; q < n_points; ++q)
      {
        for (unsigned d = 0; d < dim; ++d)
          side.points[q][d] = *next++;
        side.penalty[q] = *next++;
        for (unsigned k = 0; k < n_functions; ++k)
        {
          side.slope(q, k) = *next++;
          side.moment(q, k) = *next++;
        }
      }
      labels.assign(next, message.end());
    }

    using Unknowns = std::vector<types::global_dof_index>;

    /// What an unknown is where all that are free are zero.
    double prescribed_part(const types::global_dof_index dof, const AffineConstraints<double> &dirichlet)
    {
      return dirichlet.is_constrained(dof) ? dirichlet.get_inhomogeneity(dof) : 0.;
    }

    /// The unknowns that are not prescribed, with their numbers for labels, and last what prescribed values make of a function.
    struct FreeFunctions
    {
      SentFunctions sent;
      Unknowns      dofs;
    };

    FreeFunctions free_functions(const Unknowns &dofs, const AffineConstraints<double> &dirichlet, const NumbersOfAll &numbers)
    {
      std::map<types::global_dof_index, unsigned> column;
      const auto                                  for_each_entry = [&](const auto &visit)
      {
        for (unsigned i = 0; i < dofs.size(); ++i)
          if (!dirichlet.is_constrained(dofs[i]))
            visit(i, dofs[i], 1.);
          else
            for (const auto &[dof, weight] : *dirichlet.get_constraint_entries(dofs[i]))
              visit(i, dof, weight);
      };
      for_each_entry([&](unsigned, const types::global_dof_index dof, double) { column.emplace(dof, unsigned(column.size())); });
      FreeFunctions  result{{FullMatrix<double>(dofs.size(), column.size() + 1), std::vector<double>(column.size())},
                           Unknowns(column.size())};
      SentFunctions &sent = result.sent;
      for_each_entry([&](const unsigned i, const types::global_dof_index dof, const double weight)
                     { sent.combination(i, column.at(dof)) += weight; });
      for (const auto &[dof, k] : column)
      {
        sent.labels[k] = double(numbers.number[dof]); // below 2^53
        result.dofs[k] = dof;
      }
      for (unsigned i = 0; i < dofs.size(); ++i)
        sent.combination(i, column.size()) = prescribed_part(dofs[i], dirichlet);
      return result;
    }

    /// Its part for the own unknowns, with the load that the last function that was sent makes.
    void split(const FullMatrix<double> &rows, FullMatrix<double> &own, dealii::Vector<double> &load)
    {
      const unsigned n = rows.m();
      own.reinit(n, n);
      load.reinit(n);
      for (unsigned i = 0; i < n; ++i)
      {
        for (unsigned j = 0; j < n; ++j)
          own(i, j) = rows(i, j);
        load(i) = -rows(i, rows.n() - 1);
      }
    }
  } // namespace

  template <int dim>
  FullMatrix<double> rows_of_own_side(const FaceOnCut<dim> &face)
  {
    const unsigned        n = face.dofs.size(), n_beyond = face.beyond.slope.n();
    FaceTraces            traces(n + n_beyond);
    std::vector<unsigned> functions(n), places(face.here.points.size()), functions_beyond(n_beyond);
    std::iota(functions.begin(), functions.end(), 0);
    std::iota(functions_beyond.begin(), functions_beyond.end(), n);
    std::iota(places.begin(), places.end(), 0);
    traces.add(face.here, functions, places);
    traces.add(face.beyond, functions_beyond, places);
    FullMatrix<double> rows(n, n + n_beyond);
    traces.add_terms(rows);
    return rows;
  }

  template <int dim>
  void for_each_face_on_cut(const Problem<dim>                                             &problem,
                            const std::function<SentFunctions(const Unknowns &, unsigned)> &functions,
                            const std::function<void(const FaceOnCut<dim> &)>              &visit)
  {
    if constexpr (dim > 1)
    {
      if (!problem.space.subdomain || !problem.form->has_interior_face_terms())
        return;
      const CutFaces<dim> cuts(problem);
      AssertThrow(!problem.space.processes().any(!cuts.conform()), ExcMessage("a face on a cut is that of one process alone"));
      FEFaceValues<dim>                values(*problem.space.mapping, *problem.space.fe, problem.face_quadrature(),
                                              update_gradients | update_hessians | update_normal_vectors | update_quadrature_points | update_JxW_values);
      std::vector<FaceOnCut<dim>>      faces;
      std::vector<std::vector<double>> messages;
      auto                             next = cuts.faces().begin(); // by cells
      for (const auto &cell : problem.space.dof_handler.active_cell_iterators())
        for (; next != cuts.faces().end() && next->cell == cell->active_cell_index(); ++next)
        {
          FaceOnCut<dim> face;
          face.cell = cell;
          face.process = cuts.find(next->cell, next->face)->process;
          face.dofs.resize(problem.space.fe->n_dofs_per_cell());
          cell->get_dof_indices(face.dofs);
          values.reinit(cell, next->face);
          face.here = problem.form->interior_face_side(values);
          const SentFunctions sent = functions(face.dofs, face.process);
          messages.push_back(packed(combined(face.here, sent.combination), sent.labels));
          faces.push_back(std::move(face));
        }
      const auto answers = cuts.exchange(messages);
      for (std::size_t k = 0; k < faces.size(); ++k)
      {
        FaceSide<dim> beyond;
        unpack(answers[k], beyond, faces[k].labels);
        const auto place = matching_points(faces[k].here.points, beyond.points);
        auto      &ordered = faces[k].beyond;
        ordered = beyond;
        for (unsigned q = 0; q < place.size(); ++q)
        {
          ordered.points[q] = beyond.points[place[q]];
          ordered.penalty[q] = beyond.penalty[place[q]];
          for (unsigned j = 0; j < beyond.slope.n(); ++j)
          {
            ordered.slope(q, j) = beyond.slope(place[q], j);
            ordered.moment(q, j) = beyond.moment(place[q], j);
          }
        }
        visit(faces[k]);
      }
    }
  }

  template <int dim>
  TermsAcrossCuts::TermsAcrossCuts(const Problem<dim> &problem, SparseMatrix<double> &own, dealii::Vector<double> &load)
    : present(problem.space.subdomain && problem.form->has_interior_face_terms()), team(problem.space.processes())
  {
    if (!present)
      return;
    const auto        &dirichlet = problem.space.dirichlet;
    const NumbersOfAll numbers(problem.space.shared(), problem.space.dof_handler.n_dofs());

    // What each process beyond gets and sends, in the order of the numbers: both sides see it alike.
    std::vector<std::vector<std::pair<std::uint64_t, std::uint32_t>>> sent(team.size()); // numbers and unknowns
    std::vector<std::vector<std::uint64_t>>                           received(team.size());

    struct Found
    {
      std::uint32_t row;
      std::uint64_t number;
      double        value;
    };
    std::vector<Found>     found;
    FullMatrix<double>     own_matrix;
    dealii::Vector<double> own_load;
    for_each_face_on_cut<dim>(
      problem,
      [&](const Unknowns &dofs, const unsigned process)
      {
        const FreeFunctions functions = free_functions(dofs, dirichlet, numbers);
        for (const auto dof : functions.dofs)
          sent[process].emplace_back(numbers.number[dof], dof);
        return functions.sent;
      },
      [&](const FaceOnCut<dim> &face)
      {
        for (const double number : face.labels)
          received[face.process].push_back(std::uint64_t(number));
        const FullMatrix<double> rows = rows_of_own_side(face);
        const unsigned           n = face.dofs.size();
        split(rows, own_matrix, own_load);
        dirichlet.distribute_local_to_global(own_matrix, own_load, face.dofs, own, load);
        const auto take = [&](const unsigned i, const types::global_dof_index row, const double weight)
        {
          for (unsigned k = 0; k < face.labels.size(); ++k)
            found.push_back({std::uint32_t(row), std::uint64_t(face.labels[k]), weight * rows(i, n + k)});
        };
        for (unsigned i = 0; i < n; ++i)
          if (!dirichlet.is_constrained(face.dofs[i]))
            take(i, face.dofs[i], 1);
          else
            for (const auto &[row, weight] : *dirichlet.get_constraint_entries(face.dofs[i]))
              take(i, row, weight);
      });

    to_send.resize(team.size());
    std::map<std::uint64_t, std::uint32_t> place_of_number;
    std::uint32_t                          n_places = 0;
    for (unsigned process = 0; process < team.size(); ++process)
    {
      sort_unique(sent[process]);
      sort_unique(received[process]);
      for (const auto &[number, dof] : sent[process])
        to_send[process].push_back(dof);
      for (const auto number : received[process])
        place_of_number[number] = n_places++; // that of the last process that sends it: all have the same value
    }
    std::stable_sort(found.begin(), found.end(),
                     [](const auto &a, const auto &b) { return a.row != b.row ? a.row < b.row : a.number < b.number; });
    for (const auto &[row, number, value] : found)
      if (!of_all.empty() && couplings.back().row == row && of_all.back().column == number)
        of_all.back().value += value;
      else
      {
        couplings.push_back({row, place_of_number.at(number)});
        of_all.push_back({numbers.number[row], number, value});
      }
  }

  void TermsAcrossCuts::add_product(Vector &Au, const Vector &u) const
  {
    if (!present)
      return;
    std::vector<std::vector<double>> to_each(team.size());
    for (unsigned process = 0; process < team.size(); ++process)
      for (const auto dof : to_send[process])
        to_each[process].push_back(u(dof));
    std::vector<double> beyond;
    for (const auto &values : exchange_records(to_each, team))
      beyond.insert(beyond.end(), values.begin(), values.end());
    for (std::size_t k = 0; k < couplings.size(); ++k)
      Au(couplings[k].row) += of_all[k].value * beyond[couplings[k].beyond];
  }

  void TermsAcrossCuts::add_diagonal(Vector &diagonal) const
  {
    for (std::size_t k = 0; k < couplings.size(); ++k)
      if (of_all[k].row == of_all[k].column)
        diagonal(couplings[k].row) += of_all[k].value;
  }

  std::vector<std::uint32_t> TermsAcrossCuts::rows() const
  {
    std::vector<std::uint32_t> result;
    for (const Coupling &coupling : couplings)
      if (result.empty() || result.back() != coupling.row)
        result.push_back(coupling.row);
    return result;
  }

  template <int dim>
  void add_load_across_cuts(const Problem<dim> &problem, dealii::Vector<double> &load)
  {
    FullMatrix<double>     own_matrix;
    dealii::Vector<double> own_load;
    const auto            &dirichlet = problem.space.dirichlet;
    for_each_face_on_cut<dim>(
      problem,
      [&](const Unknowns &dofs, unsigned) { return one_function(dofs, [&](const auto dof) { return prescribed_part(dof, dirichlet); }); },
      [&](const FaceOnCut<dim> &face)
      {
        split(rows_of_own_side(face), own_matrix, own_load);
        dirichlet.distribute_local_to_global(own_load, face.dofs, load, own_matrix);
      });
  }

#define INSTANTIATE(dim)                                                                                                                   \
  template FullMatrix<double> rows_of_own_side(const FaceOnCut<dim> &);                                                                    \
  template void               for_each_face_on_cut(const Problem<dim> &, const std::function<SentFunctions(const Unknowns &, unsigned)> &, \
                                                   const std::function<void(const FaceOnCut<dim> &)> &);                                   \
  template TermsAcrossCuts::TermsAcrossCuts(const Problem<dim> &, SparseMatrix<double> &, dealii::Vector<double> &);                       \
  template void add_load_across_cuts(const Problem<dim> &, dealii::Vector<double> &);
  INSTANTIATE(1)
  INSTANTIATE(2)
  INSTANTIATE(3)
#undef INSTANTIATE
} // namespace unilateral
