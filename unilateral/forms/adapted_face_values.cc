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

    /// After so many cuts. A jump leaves one or two pieces open, in 3-D those along a line, straight or closed. A function that differs on
    /// more of them is noise, as the rounding of one that should be zero, or oscillates: finer pieces would show no other picture, many
    /// more times.
    template <int dim>
    constexpr std::size_t most_open_pieces(const unsigned cuts)
    {
      return dim == 2 ? 256 : 6u << cuts;
    }
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
  std::vector<typename AdaptedFaceValues<dim>::Piece> AdaptedFaceValues<dim>::halves(const std::vector<Piece> &pieces) const
  {
    std::vector<Piece> result;
    for (const Piece &piece : pieces)
    {
      const auto parts = halves(piece);
      result.insert(result.end(), parts.begin(), parts.end());
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

  /// The cutting of one face into pieces until the rule sees the functions on each as they are. Integrals over a piece are in units of the
  /// reference face.
  template <int dim>
  class AdaptedFaceValues<dim>::Subdivision
  {
  public:
    /// @p values: with its ordinary ones on this face.
    Subdivision(AdaptedFaceValues &values, const Cell &cell, unsigned face, const std::vector<FieldFunction> &functions);

    /// The rule on the whole face does not see a function as it is.
    bool is_needed() const { return differs(0, suspicious * reference_size); }

    std::vector<Piece> pieces();

  private:
    std::vector<double> integrals(const std::vector<Point<dim>> &points, const std::vector<double> &weights);
    void                integrate_parts(const std::vector<Piece> &pieces);
    bool                differs(std::size_t k, double tolerance) const;
    std::vector<bool>   may_jump(const std::vector<Piece> &pieces) const;
    bool                values_jump(std::size_t f, const FEFaceValues<dim> &at, unsigned begin, unsigned end) const;

    static constexpr unsigned         n_halves = 1u << (dim - 1);
    AdaptedFaceValues                &values;
    const Cell                        cell;
    const unsigned                    face;
    const std::vector<FieldFunction> &functions;
    const std::size_t                 n; ///< functions
    double                            reference_size = 0;
    std::vector<double>               largest;      ///< absolute values so far, of each function
    std::vector<double>               whole, parts; ///< integrals of the functions over the open pieces and over the halves of these
  };

  template <int dim>
  AdaptedFaceValues<dim>::Subdivision::Subdivision(AdaptedFaceValues                &values,
                                                   const Cell                       &cell,
                                                   const unsigned                    face,
                                                   const std::vector<FieldFunction> &functions)
    : values(values), cell(cell), face(face), functions(functions), n(functions.size()), largest(n, 0.)
  {
    for (const double weight : values.rule.get_weights())
      reference_size += weight;
    const Quadrature<dim - 1> composite = values.on_pieces(values.halves(Piece()));
    if (!values.halves_of_face)
      values.halves_of_face = std::make_unique<FEFaceValues<dim>>(values.mapping, values.fe, composite, update_quadrature_points);
    values.halves_of_face->reinit(cell, face);
    whole = integrals(values.ordinary.get_quadrature_points(), values.rule.get_weights());
    parts = integrals(values.halves_of_face->get_quadrature_points(), composite.get_weights());
  }

  /// One of each function for as many points as the rule has.
  template <int dim>
  std::vector<double> AdaptedFaceValues<dim>::Subdivision::integrals(const std::vector<Point<dim>> &points,
                                                                     const std::vector<double>     &weights)
  {
    const unsigned      n_q = values.rule.size();
    std::vector<double> sums(points.size() / n_q * n, 0.);
    for (unsigned q = 0; q < points.size(); ++q)
      for (unsigned f = 0; f < n; ++f)
      {
        const double value = functions[f].value(points[q]);
        largest[f] = std::max(largest[f], std::abs(value));
        sums[q / n_q * n + f] += weights[q] * value;
      }
    return sums;
  }

  template <int dim>
  void AdaptedFaceValues<dim>::Subdivision::integrate_parts(const std::vector<Piece> &pieces)
  {
    const Quadrature<dim - 1> points = values.on_pieces(values.halves(pieces));
    FEFaceValues<dim>         at(values.mapping, values.fe, points, update_quadrature_points);
    at.reinit(cell, face);
    parts = integrals(at.get_quadrature_points(), points.get_weights());
  }

  /// Over open piece @p k and over its halves.
  template <int dim>
  bool AdaptedFaceValues<dim>::Subdivision::differs(const std::size_t k, const double tolerance) const
  {
    for (unsigned f = 0; f < n; ++f)
    {
      double sum = 0;
      for (unsigned part = 0; part < n_halves; ++part)
        sum += parts[(k * n_halves + part) * n + f];
      if (std::abs(sum - whole[k * n + f]) > tolerance * largest[f])
        return true;
    }
    return false;
  }

  /// A jump between the outermost point of a piece and its end, or in its very middle, changes no sum: the values themselves show it. On
  /// faces in space a jump runs along a line, and a piece that it only touches at the edge bears little.
  template <int dim>
  std::vector<bool> AdaptedFaceValues<dim>::Subdivision::may_jump(const std::vector<Piece> &pieces) const
  {
    std::vector<bool> result(pieces.size(), false);
    if constexpr (dim == 2)
    {
      constexpr double inside = 1e-9;
      double           first = 1, last = 0;
      for (const auto &x : values.rule.get_points())
      {
        first = std::min(first, x[0]);
        last = std::max(last, x[0]);
      }
      std::vector<Point<1>> points;
      for (const Piece &piece : pieces)
        for (const double x : {inside, first, last, 1 - inside})
          points.push_back(Point<1>(piece.corner[0] + x * piece.size));
      FEFaceValues<dim> at(values.mapping, values.fe, Quadrature<1>(points), update_quadrature_points);
      at.reinit(cell, face);
      for (std::size_t k = 0; k < pieces.size(); ++k)
        for (std::size_t f = 0; f < n; ++f)
          if (values_jump(f, at, 4 * k, 4 * k + 4))
            result[k] = true;
    }
    return result;
  }

  /// The values of function @p f at some of the points are further apart than those of a smooth one.
  template <int dim>
  bool AdaptedFaceValues<dim>::Subdivision::values_jump(const std::size_t        f,
                                                        const FEFaceValues<dim> &at,
                                                        const unsigned           begin,
                                                        const unsigned           end) const
  {
    constexpr double jump = 0.05;
    double           least = std::numeric_limits<double>::max(), most = -least;
    for (unsigned q = begin; q < end; ++q)
    {
      const double value = functions[f].value(at.quadrature_point(q));
      least = std::min(least, value);
      most = std::max(most, value);
    }
    return most - least > jump * largest[f];
  }

  template <int dim>
  std::vector<typename AdaptedFaceValues<dim>::Piece> AdaptedFaceValues<dim>::Subdivision::pieces()
  {
    // Level by level, so that all points of a level are placed at once.
    std::vector<Piece> settled, open = {Piece()};
    for (unsigned cut = 0;; ++cut)
    {
      std::vector<Piece>  next;
      std::vector<double> whole_of_next;
      const auto          jumps = may_jump(open);
      for (std::size_t k = 0; k < open.size(); ++k)
      {
        const auto halves = values.halves(open[k]);
        if (!jumps[k] && !differs(k, 1e-9 * reference_size))
          settled.push_back(open[k]);
        else if (cut == most_cuts<dim> || open.size() > most_open_pieces<dim>(cut))
          settled.insert(settled.end(), halves.begin(), halves.end());
        else
        {
          next.insert(next.end(), halves.begin(), halves.end());
          const auto integrals_of_halves = parts.begin() + k * n_halves * n;
          whole_of_next.insert(whole_of_next.end(), integrals_of_halves, integrals_of_halves + n_halves * n);
        }
      }
      if (next.empty())
        return settled;
      open = std::move(next);
      whole = std::move(whole_of_next);
      integrate_parts(open);
    }
  }

  template <int dim>
  std::optional<std::vector<typename AdaptedFaceValues<dim>::Piece>>
  AdaptedFaceValues<dim>::pieces_for(const Cell &cell, const unsigned face, const std::vector<FieldFunction> &functions)
  {
    if constexpr (dim > 1)
    {
      Subdivision subdivision(*this, cell, face, functions);
      if (subdivision.is_needed())
        return subdivision.pieces();
    }
    return {};
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
