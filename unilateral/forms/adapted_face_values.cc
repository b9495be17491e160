#include "unilateral/forms/adapted_face_values.h"

#include <deal.II/grid/reference_cell.h>
#include <deal.II/hp/q_collection.h>

#include <Eigen/Dense>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

namespace unilateral
{
  using namespace dealii;

  namespace
  {
    /// Of the largest value of a function times the size of the face: beyond, the rule does not see the function as it is.
    constexpr double suspicious = 1e-3;

    /// Of the largest value: no smooth function differs so much, nor has it so large a part of the highest degree.
    constexpr double jump = 0.05, visible = 0.05;

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

  namespace
  {
    /// Polynomials on the reference face, all that @p n points can tell apart, of Legendre's kind.
    template <int n_coordinates>
    struct Polynomials
    {
      Polynomials(const bool triangle, const unsigned n)
      {
        const auto size = [&](const unsigned degree) {
          return n_coordinates == 1 ? degree + 1 : triangle ? (degree + 1) * (degree + 2) / 2 : (degree + 1) * (degree + 1);
        };
        unsigned degree = 0;
        while (size(degree + 1) <= n)
          ++degree;
        for (unsigned i = 0; i <= degree; ++i)
          for (unsigned k = 0; k <= (n_coordinates == 1 ? 0 : triangle ? degree - i : degree); ++k)
          {
            degrees.push_back({i, k});
            is_highest.push_back(triangle ? i + k == degree : std::max(i, k) == degree);
          }
      }

      /// Rows: points.
      Eigen::MatrixXd values(const std::vector<Point<n_coordinates>> &points) const
      {
        Eigen::MatrixXd result = Eigen::MatrixXd::Ones(points.size(), degrees.size());
        for (std::size_t q = 0; q < points.size(); ++q)
          for (std::size_t j = 0; j < degrees.size(); ++j)
            for (unsigned d = 0; d < n_coordinates; ++d)
              result(q, j) *= std::legendre(degrees[j][d], 2 * points[q][d] - 1);
        return result;
      }

      std::vector<std::array<unsigned, 2>> degrees;
      std::vector<bool>                    is_highest;
    };

    /// Just inside.
    template <int n_coordinates>
    std::vector<Point<n_coordinates>> ends_of_face(const bool triangle)
    {
      constexpr double inside = n_coordinates == 1 ? 1e-9 : 1e-6;
      if constexpr (n_coordinates == 1)
        return {Point<1>(inside), Point<1>(1 - inside)};
      else
      {
        const auto                        cell = triangle ? ReferenceCells::Triangle : ReferenceCells::Quadrilateral;
        const Point<n_coordinates>        centre = cell.template barycenter<n_coordinates>();
        std::vector<Point<n_coordinates>> points;
        for (const unsigned v : cell.vertex_indices())
          points.push_back(cell.template vertex<n_coordinates>(v));
        for (const unsigned edge : cell.face_indices())
          points.push_back((points[cell.face_to_cell_vertices(edge, 0, 1)] + points[cell.face_to_cell_vertices(edge, 1, 1)]) / 2);
        for (auto &x : points)
          x += inside * (centre - x);
        return points;
      }
    }
  } // namespace

  /// The functions of the parameters that place points on a face: linear, on squares bilinear.
  template <int dim>
  Eigen::MatrixXd AdaptedFaceValues<dim>::placing_functions(const std::vector<Point<dim - 1>> &parameters) const
  {
    const bool      bilinear = dim == 3 && !fe.reference_cell().is_simplex();
    Eigen::MatrixXd values = Eigen::MatrixXd::Ones(parameters.size(), bilinear ? 4 : dim);
    for (std::size_t q = 0; q < parameters.size(); ++q)
    {
      for (unsigned d = 0; d + 1 < dim; ++d)
        values(q, d + 1) = parameters[q][d];
      if (bilinear)
        values(q, 3) = values(q, 1) * values(q, 2);
    }
    return values;
  }

  template <int dim>
  AdaptedFaceValues<dim>::Ends::Ends(const AdaptedFaceValues &values)
    : points(ends_of_face<dim - 1>(dim == 3 && values.fe.reference_cell().is_simplex())),
      with_rule(
        [&]
        {
          std::vector<Point<dim - 1>> all = values.rule.get_points();
          all.insert(all.end(), points.begin(), points.end());
          return Quadrature<dim - 1>(all);
        }()),
      on_face(values.mapping, values.fe, with_rule, update_quadrature_points)
  {
    const Polynomials<dim - 1> polynomials(dim == 3 && values.fe.reference_cell().is_simplex(), values.rule.size());
    const Eigen::MatrixXd      at_rule = polynomials.values(values.rule.get_points());
    const Eigen::MatrixXd      coefficients = Eigen::CompleteOrthogonalDecomposition<Eigen::MatrixXd>(at_rule).pseudoInverse();
    from_rule = polynomials.values(points) * coefficients;
    for (std::size_t j = 0; j < polynomials.degrees.size(); ++j)
      if (polynomials.is_highest[j])
      {
        highest_part.conservativeResize(highest_part.rows() + 1, values.rule.size());
        highest_part.bottomRows(1) = coefficients.row(j);
      }
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
    bool is_needed()
    {
      return differs(0, suspicious * reference_size) || jumps_at_end(values.ends->on_face.get_quadrature_points(), 0, /*hidden=*/false);
    }

    bool jumps_beyond_points() { return jumps_at_end(values.ends->on_face.get_quadrature_points(), 0, /*hidden=*/true); }

    std::vector<Piece> pieces();

  private:
    std::vector<double> integrals(const std::vector<Point<dim>> &points, const std::vector<double> &weights);
    void                integrate_parts(const std::vector<Piece> &pieces);
    bool                differs(std::size_t k, double tolerance) const;
    std::vector<bool>   may_jump(const std::vector<Piece> &pieces);
    bool                jumps_at_end(const std::vector<Point<dim>> &at, unsigned begin, bool hidden);
    bool                values_jump(std::size_t f, const std::vector<Point<dim>> &at, unsigned begin, unsigned end) const;

    /// Points on the face: FEFaceValues would look at them on all faces of the reference cell, in all orientations.
    std::vector<Point<dim>> place(const std::vector<Point<dim - 1>> &parameters) const;

    static constexpr unsigned         n_halves = 1u << (dim - 1);
    AdaptedFaceValues                &values;
    const Cell                        cell;
    const unsigned                    face;
    const std::vector<FieldFunction> &functions;
    const std::size_t                 n; ///< functions
    double                            reference_size = 0;
    Eigen::MatrixXd                   placing;      ///< coefficients of placing_functions(); none where the face is curved
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
    if (values.fit_of_placing.size() == 0)
    {
      values.placing_at_halves = values.placing_functions(composite.get_points());
      values.fit_of_placing = values.placing_at_halves.completeOrthogonalDecomposition().pseudoInverse();
    }
    const auto     &placed = values.halves_of_face->get_quadrature_points();
    Eigen::MatrixXd x(placed.size(), dim);
    for (std::size_t q = 0; q < placed.size(); ++q)
      for (unsigned d = 0; d < dim; ++d)
        x(q, d) = placed[q][d];
    placing = values.fit_of_placing * x;
    constexpr double rounding = 1e-12;
    if ((values.placing_at_halves * placing - x).cwiseAbs().maxCoeff() > rounding * x.cwiseAbs().maxCoeff())
      placing.resize(0, 0);
    if (!values.ends)
      values.ends = std::make_unique<Ends>(values);
    values.ends->on_face.reinit(cell, face);
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
    parts = integrals(place(points.get_points()), points.get_weights());
  }

  template <int dim>
  std::vector<Point<dim>> AdaptedFaceValues<dim>::Subdivision::place(const std::vector<Point<dim - 1>> &parameters) const
  {
    if (placing.size() == 0)
    {
      FEFaceValues<dim> at(values.mapping, values.fe, Quadrature<dim - 1>(parameters), update_quadrature_points);
      at.reinit(cell, face);
      return at.get_quadrature_points();
    }
    const Eigen::MatrixXd   x = values.placing_functions(parameters) * placing;
    std::vector<Point<dim>> points(parameters.size());
    for (std::size_t q = 0; q < points.size(); ++q)
      for (unsigned d = 0; d < dim; ++d)
        points[q][d] = x(q, d);
    return points;
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

  /// At the ends of a piece a function is not as at the points of the rule: these begin at @p begin, and the ends come after them.
  /// @p hidden: and at the points it is smooth.
  template <int dim>
  bool AdaptedFaceValues<dim>::Subdivision::jumps_at_end(const std::vector<Point<dim>> &at, const unsigned begin, const bool hidden)
  {
    const unsigned  n_q = values.rule.size(), n_ends = values.ends->points.size();
    Eigen::VectorXd at_rule(n_q), at_ends(n_ends);
    for (unsigned f = 0; f < n; ++f)
    {
      for (unsigned q = 0; q < n_q; ++q)
        at_rule(q) = functions[f].value(at[begin + q]);
      for (unsigned e = 0; e < n_ends; ++e)
        at_ends(e) = functions[f].value(at[begin + n_q + e]);
      largest[f] = std::max(largest[f], at_ends.cwiseAbs().maxCoeff());
      if ((at_ends - values.ends->from_rule * at_rule).cwiseAbs().maxCoeff() > jump * largest[f] &&
          !(hidden && (values.ends->highest_part * at_rule).cwiseAbs().maxCoeff() > visible * largest[f]))
        return true;
    }
    return false;
  }

  /// A jump between the outermost point of a piece and its end, or in its very middle, changes no sum: the values themselves show it. On
  /// faces in space a jump runs along a line, and a piece that it only touches at the edge bears little.
  template <int dim>
  std::vector<bool> AdaptedFaceValues<dim>::Subdivision::may_jump(const std::vector<Piece> &pieces)
  {
    std::vector<bool> result(pieces.size(), false);
    if constexpr (dim == 3)
    {
      std::vector<Point<dim - 1>> points;
      for (const Piece &piece : pieces)
        for (const auto &x : values.ends->with_rule.get_points())
        {
          Point<dim - 1> placed = piece.corner;
          for (unsigned d = 0; d + 1 < dim; ++d)
            placed[d] += piece.size * x[d];
          points.push_back(placed);
        }
      const auto at = place(points);
      for (std::size_t k = 0; k < pieces.size(); ++k)
        result[k] = jumps_at_end(at, k * values.ends->with_rule.size(), /*hidden=*/false);
    }
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
      const auto at = place(points);
      for (std::size_t k = 0; k < pieces.size(); ++k)
        for (std::size_t f = 0; f < n; ++f)
          if (values_jump(f, at, 4 * k, 4 * k + 4))
            result[k] = true;
    }
    return result;
  }

  /// The values of function @p f at some of the points are further apart than those of a smooth one.
  template <int dim>
  bool AdaptedFaceValues<dim>::Subdivision::values_jump(const std::size_t              f,
                                                        const std::vector<Point<dim>> &at,
                                                        const unsigned                 begin,
                                                        const unsigned                 end) const
  {
    double least = std::numeric_limits<double>::max(), most = -least;
    for (unsigned q = begin; q < end; ++q)
    {
      const double value = functions[f].value(at[q]);
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
  bool AdaptedFaceValues<dim>::jumps_beyond_points(const Cell &cell, const unsigned face, const std::vector<FieldFunction> &functions)
  {
    if constexpr (dim > 1)
    {
      ordinary.reinit(cell, face);
      return !functions.empty() && Subdivision(*this, cell, face, functions).jumps_beyond_points();
    }
    else
      return false;
  }

  template <int dim>
  const FEFaceValues<dim> &
  AdaptedFaceValues<dim>::reinit(const Cell &cell, const unsigned face, const std::vector<FieldFunction> &functions)
  {
    ordinary.reinit(cell, face);
    if (!functions.empty())
      if (const auto pieces = pieces_for(cell, face, functions))
      {
        // Other faces than this one need no points, but hypercubes take the same on all.
        hp::QCollection<dim - 1> rules;
        const bool               simplex = fe.reference_cell().is_simplex();
        for (unsigned f = 0; f < (simplex && dim == 3 ? fe.reference_cell().n_faces() : 1); ++f)
          rules.push_back(f == face || !simplex || dim < 3 ? on_pieces(*pieces) : Quadrature<dim - 1>(Point<dim - 1>()));
        adapted = std::make_unique<FEFaceValues<dim>>(mapping, fe, rules, flags);
        adapted->reinit(cell, face);
        return *adapted;
      }
    return ordinary;
  }

  template class AdaptedFaceValues<1>;
  template class AdaptedFaceValues<2>;
  template class AdaptedFaceValues<3>;
} // namespace unilateral
