#include "unilateral/forms/adapted_face_values.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace unilateral
{
  using namespace dealii;

  namespace
  {
    /// Of the largest value of a function times the size of the face: beyond, the rule does not see the function as it is.
    constexpr double suspicious = 1e-3;

    template <int dim>
    constexpr unsigned most_cuts = dim == 2 ? 30 : 4;
  } // namespace

  template <int dim>
  AdaptedFaceValues<dim>::AdaptedFaceValues(const Mapping<dim>        &mapping,
                                            const FiniteElement<dim>  &fe,
                                            const Quadrature<dim - 1> &rule,
                                            const UpdateFlags          flags)
    : mapping(mapping), fe(fe), rule(rule), flags(flags), ordinary(mapping, fe, rule, flags)
  {
  }

  template <int dim>
  std::vector<typename AdaptedFaceValues<dim>::Piece> AdaptedFaceValues<dim>::halves(const Piece &piece) const
  {
    std::vector<Piece> result;
    const double       half = piece.size / 2;
    const bool         triangle = dim == 3 && fe.reference_cell().is_simplex();
    for (unsigned k = 0; k < 1u << (dim - 1); ++k)
    {
      Piece part{piece.corner, half};
      if (triangle && k == 3)
        part.size = -half;
      for (unsigned d = 0; d + 1 < dim; ++d)
        if (k >> d & 1)
          part.corner[d] += half;
      result.push_back(part);
    }
    return result;
  }

  template <int dim>
  Quadrature<dim - 1> AdaptedFaceValues<dim>::on_pieces(const std::vector<Piece> &pieces) const
  {
    std::vector<Point<dim - 1>> points;
    std::vector<double>         weights;
    for (const Piece &piece : pieces)
      for (unsigned q = 0; q < rule.size(); ++q)
      {
        Point<dim - 1> x;
        for (unsigned d = 0; d + 1 < dim; ++d)
          x[d] = piece.corner[d] + piece.size * rule.point(q)[d];
        points.push_back(x);
        weights.push_back(rule.weight(q) * std::pow(std::abs(piece.size), dim - 1));
      }
    return Quadrature<dim - 1>(points, weights);
  }

  template <int dim>
  std::optional<std::vector<typename AdaptedFaceValues<dim>::Piece>>
  AdaptedFaceValues<dim>::pieces_for(const Cell &cell, const unsigned face, const std::vector<FieldFunction> &functions)
  {
    if constexpr (dim == 1)
      return {};
    else
    {
      const unsigned n = functions.size(), n_q = rule.size();
      // Integrals over a piece in units of the reference face: one of each function for every n_q points.
      std::vector<double> largest(n, 0.);
      const auto          integrals = [&](const std::vector<Point<dim>> &x, const std::vector<double> &weights)
      {
        std::vector<double> sums(x.size() / n_q * n, 0.);
        for (unsigned q = 0; q < x.size(); ++q)
          for (unsigned f = 0; f < n; ++f)
          {
            const double value = functions[f].value(x[q]);
            largest[f] = std::max(largest[f], std::abs(value));
            sums[q / n_q * n + f] += weights[q] * value;
          }
        return sums;
      };
      const auto differs = [&](const double *const whole, const double *const parts, const double tolerance)
      {
        for (unsigned f = 0; f < n; ++f)
        {
          double sum = 0;
          for (unsigned part = 0; part < 1u << (dim - 1); ++part)
            sum += parts[part * n + f];
          if (std::abs(sum - whole[f]) > tolerance * largest[f])
            return true;
        }
        return false;
      };

      double reference_size = 0;
      for (const double weight : rule.get_weights())
        reference_size += weight;
      if (!halves_of_face)
        halves_of_face = std::make_unique<FEFaceValues<dim>>(mapping, fe, on_pieces(halves(Piece())), update_quadrature_points);
      halves_of_face->reinit(cell, face);
      std::vector<double>       whole = integrals(ordinary.get_quadrature_points(), rule.get_weights());
      const Quadrature<dim - 1> composite = on_pieces(halves(Piece()));
      std::vector<double>       parts = integrals(halves_of_face->get_quadrature_points(), composite.get_weights());
      if (!differs(whole.data(), parts.data(), suspicious * reference_size))
        return {};

      // A jump between the outermost point of a piece and its end, or in its very middle, changes no sum: the values themselves show it. On
      // faces in space a jump runs along a line, and a piece that it only touches at the edge bears little.
      const auto may_jump = [&](const std::vector<Piece> &pieces)
      {
        std::vector<bool> result(pieces.size(), false);
        if constexpr (dim == 2)
        {
          constexpr double inside = 1e-9, jump = 0.05;
          double           first = 1, last = 0;
          for (const auto &x : rule.get_points())
          {
            first = std::min(first, x[0]);
            last = std::max(last, x[0]);
          }
          std::vector<Point<1>> points;
          for (const Piece &piece : pieces)
            for (const double x : {inside, first, last, 1 - inside})
              points.push_back(Point<1>(piece.corner[0] + x * piece.size));
          FEFaceValues<dim> at(mapping, fe, Quadrature<1>(points), update_quadrature_points);
          at.reinit(cell, face);
          for (std::size_t k = 0; k < pieces.size(); ++k)
            for (unsigned f = 0; f < n; ++f)
            {
              double least = std::numeric_limits<double>::max(), most = -least;
              for (unsigned q = 4 * k; q < 4 * k + 4; ++q)
              {
                const double value = functions[f].value(at.quadrature_point(q));
                least = std::min(least, value);
                most = std::max(most, value);
              }
              if (most - least > jump * largest[f])
                result[k] = true;
            }
        }
        return result;
      };

      // Level by level, so that all points of a level are placed at once.
      std::vector<Piece> settled, open = {Piece()};
      for (unsigned cut = 0;; ++cut)
      {
        std::vector<Piece>  next;
        std::vector<double> whole_of_next;
        const unsigned      n_halves = 1u << (dim - 1);
        const auto          jumps = may_jump(open);
        for (std::size_t k = 0; k < open.size(); ++k)
        {
          const auto pieces = halves(open[k]);
          if (!jumps[k] && !differs(&whole[k * n], &parts[k * n_halves * n], 1e-9 * reference_size))
            settled.push_back(open[k]);
          else if (cut == most_cuts<dim>)
            settled.insert(settled.end(), pieces.begin(), pieces.end());
          else
          {
            next.insert(next.end(), pieces.begin(), pieces.end());
            whole_of_next.insert(whole_of_next.end(), &parts[k * n_halves * n], &parts[k * n_halves * n] + n_halves * n);
          }
        }
        if (next.empty())
          return settled;
        open = std::move(next);
        whole = std::move(whole_of_next);
        std::vector<Piece> finer;
        for (const Piece &piece : open)
        {
          const auto pieces = halves(piece);
          finer.insert(finer.end(), pieces.begin(), pieces.end());
        }
        const Quadrature<dim - 1> points = on_pieces(finer);
        FEFaceValues<dim>         at(mapping, fe, points, update_quadrature_points);
        at.reinit(cell, face);
        parts = integrals(at.get_quadrature_points(), points.get_weights());
      }
    }
  }

  template <int dim>
  const FEFaceValues<dim> &
  AdaptedFaceValues<dim>::reinit(const Cell &cell, const unsigned face, const std::vector<FieldFunction> &functions)
  {
    ordinary.reinit(cell, face);
    if (!functions.empty())
      if (const auto pieces = pieces_for(cell, face, functions))
      {
        adapted = std::make_unique<FEFaceValues<dim>>(mapping, fe, on_pieces(*pieces), flags);
        adapted->reinit(cell, face);
        return *adapted;
      }
    return ordinary;
  }

  template class AdaptedFaceValues<1>;
  template class AdaptedFaceValues<2>;
  template class AdaptedFaceValues<3>;
} // namespace unilateral
