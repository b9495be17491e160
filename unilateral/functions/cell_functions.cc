#include "unilateral/functions/cell_functions.h"

#include <boost/geometry.hpp>
#include <boost/geometry/index/rtree.hpp>

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <limits>
#include <stdexcept>
#include <utility>

namespace unilateral
{
  namespace
  {
    /// A point up to here outside of a cell, in its reference coordinates, has a value still: straight sides stand for curved ones, and two
    /// meshes of one curved domain differ there.
    constexpr double far_outside = 0.05;
    constexpr double on_side = 1e-9;

    using Coordinates = std::array<double, 3>;

    /// The values and derivatives of the polynomials of a lattice at a point of the reference cell.
    class LatticeBasis
    {
    public:
      LatticeBasis(const CellNodes                            &nodes,
                   const unsigned                              degree,
                   const std::vector<std::array<unsigned, 3>> &lattice,
                   const Coordinates                          &unit)
      {
        if (degree == 0)
        {
          values.assign(1, 1.);
          gradients.assign(1, {});
          return;
        }
        values.resize(lattice.size());
        gradients.resize(lattice.size());
        nodes.simplex ? set_simplex(nodes.dim, degree, lattice, unit) : set_cube(nodes.dim, degree, lattice, unit);
      }

      std::vector<double>      values;
      std::vector<Coordinates> gradients;

    private:
      /// Products of Lagrange polynomials in each coordinate.
      void set_cube(const unsigned dim, const unsigned degree, const std::vector<std::array<unsigned, 3>> &lattice, const Coordinates &unit)
      {
        std::vector<std::array<double, 2>> along[3]; // value and derivative
        for (unsigned d = 0; d < dim; ++d)
          for (unsigned i = 0; i <= degree; ++i)
          {
            double value = 1, slope = 0;
            for (unsigned m = 0; m <= degree; ++m)
              if (m != i)
              {
                const double distance = double(i) - double(m), factor = (degree * unit[d] - m) / distance;
                slope = slope * factor + value * degree / distance;
                value *= factor;
              }
            along[d].push_back({value, slope});
          }
        for (std::size_t k = 0; k < lattice.size(); ++k)
        {
          values[k] = 1;
          gradients[k] = {1, 1, 1};
          for (unsigned d = 0; d < dim; ++d)
          {
            const auto &[value, slope] = along[d][lattice[k][d]];
            values[k] *= value;
            for (unsigned e = 0; e < dim; ++e)
              gradients[k][e] *= d == e ? slope : value;
          }
        }
      }

      /// Products over the barycentric coordinates l of l (l - 1/p) ... (l - (i - 1)/p), scaled to 1 at the node.
      void
      set_simplex(const unsigned dim, const unsigned degree, const std::vector<std::array<unsigned, 3>> &lattice, const Coordinates &unit)
      {
        std::array<double, 4> barycentric = {1 - unit[0] - unit[1] - unit[2], unit[0], unit[1], unit[2]};
        for (std::size_t k = 0; k < lattice.size(); ++k)
        {
          const std::array<unsigned, 4> index = {degree - lattice[k][0] - lattice[k][1] - lattice[k][2], lattice[k][0], lattice[k][1],
                                                 lattice[k][2]};
          std::array<double, 4>         value{1, 1, 1, 1}, slope{};
          for (unsigned d = 0; d <= dim; ++d)
            for (unsigned m = 0; m < index[d]; ++m)
            {
              const double factor = (degree * barycentric[d] - m) / (m + 1.);
              slope[d] = slope[d] * factor + value[d] * degree / (m + 1.);
              value[d] *= factor;
            }
          const auto with_slope_of = [&](const unsigned d)
          {
            double product = slope[d];
            for (unsigned e = 0; e <= dim; ++e)
              product *= e == d ? 1. : value[e];
            return product;
          };
          values[k] = value[0] * value[1] * value[2] * value[3];
          for (unsigned d = 0; d < dim; ++d)
            gradients[k][d] = with_slope_of(d + 1) - with_slope_of(0);
        }
      }
    };

    /// The inverse of the leading dim x dim block, all zero where there is none.
    std::array<double, 9> inverse(const std::array<double, 9> &m, const unsigned dim)
    {
      std::array<double, 9> result{};
      if (dim == 1)
        result[0] = m[0] != 0 ? 1 / m[0] : 0;
      else if (dim == 2)
      {
        const double det = m[0] * m[4] - m[1] * m[3];
        if (det != 0)
          result = {m[4] / det, -m[1] / det, 0, -m[3] / det, m[0] / det, 0, 0, 0, 0};
      }
      else
      {
        const auto minor = [&](const unsigned a, const unsigned b, const unsigned c, const unsigned d)
        { return m[a] * m[d] - m[b] * m[c]; };
        const double det = m[0] * minor(4, 5, 7, 8) - m[1] * minor(3, 5, 6, 8) + m[2] * minor(3, 4, 6, 7);
        if (det != 0)
          result = {minor(4, 5, 7, 8) / det,  -minor(1, 2, 7, 8) / det, minor(1, 2, 4, 5) / det,
                    -minor(3, 5, 6, 8) / det, minor(0, 2, 6, 8) / det,  -minor(0, 2, 3, 5) / det,
                    minor(3, 4, 6, 7) / det,  -minor(0, 1, 6, 7) / det, minor(0, 1, 3, 4) / det};
      }
      return result;
    }

    double distance_to_reference_cell(const Coordinates &unit, const unsigned dim, const bool simplex)
    {
      double outside = 0, sum = 0;
      for (unsigned d = 0; d < dim; ++d)
      {
        outside = std::max({outside, -unit[d], simplex ? 0. : unit[d] - 1});
        sum += unit[d];
      }
      return std::isfinite(sum) ? std::max(outside, simplex ? sum - 1 : 0.) : std::numeric_limits<double>::infinity();
    }
  } // namespace

  std::vector<std::array<unsigned, 3>> CellNodes::lattice(const unsigned lattice_degree) const
  {
    std::vector<std::array<unsigned, 3>> result;
    const unsigned                       n = lattice_degree;
    for (unsigned k = 0; k <= (dim > 2 ? n : 0); ++k)
      for (unsigned j = 0; j <= (dim > 1 ? n : 0); ++j)
        for (unsigned i = 0; i <= n; ++i)
          if (!simplex || i + j + k <= n)
            result.push_back({i, j, k});
    return result;
  }

  std::size_t CellNodes::n_lattice_points(const unsigned lattice_degree) const
  {
    std::size_t n = 1;
    for (unsigned d = 1; d <= dim; ++d)
      n = simplex ? n * (lattice_degree + d) / d : n * (lattice_degree + 1);
    return n;
  }

  namespace
  {
    namespace bg = boost::geometry;
    using TreePoint = bg::model::point<double, 3, bg::cs::cartesian>;
    using TreeBox = bg::model::box<TreePoint>;
    using TreeEntry = std::pair<TreeBox, std::uint32_t>;
  } // namespace

  class CellFunctions::SearchTree
  {
  public:
    explicit SearchTree(const std::vector<TreeEntry> &boxes) : tree(boxes.begin(), boxes.end()) {}

    template <typename Visit>
    void visit_cells_at(const Coordinates &x, const Visit &visit) const
    {
      std::vector<TreeEntry> found;
      tree.query(bg::index::intersects(TreePoint(x[0], x[1], x[2])), std::back_inserter(found));
      for (const TreeEntry &entry : found)
        visit(entry.second);
    }

    template <typename Visit>
    void visit_nearest(const Coordinates &x, const unsigned n, const Visit &visit) const
    {
      std::vector<TreeEntry> found;
      tree.query(bg::index::nearest(TreePoint(x[0], x[1], x[2]), n), std::back_inserter(found));
      for (const TreeEntry &entry : found)
        visit(entry.second);
    }

  private:
    bg::index::rtree<TreeEntry, bg::index::rstar<16>> tree;
  };

  CellFunctions::CellFunctions(CellNodes cell_nodes, std::map<std::string, std::vector<double>> values)
    : nodes(std::move(cell_nodes)), functions(std::move(values)), map_lattice(nodes.lattice(nodes.map_degree)),
      value_lattice(nodes.lattice(nodes.degree))
  {
    std::vector<TreeEntry> boxes;
    boxes.reserve(nodes.n_cells());
    for (std::size_t cell = 0; cell < nodes.n_cells(); ++cell)
    {
      std::array<std::array<double, 2>, 3> range{};
      double                               size = 0;
      for (unsigned d = 0; d < nodes.dim; ++d)
      {
        range[d] = box_of(cell, d);
        size = std::max(size, range[d][1] - range[d][0]);
      }
      spacing += size / (std::max(nodes.degree, 1u) * double(nodes.n_cells()));
      // Sides between the nodes of a curved cell may bulge out of their box.
      const double slack = size * (nodes.map_degree > 1 ? 0.1 : on_side);
      boxes.emplace_back(TreeBox(TreePoint(range[0][0] - slack, range[1][0] - slack, range[2][0] - slack),
                                 TreePoint(range[0][1] + slack, range[1][1] + slack, range[2][1] + slack)),
                         cell);
    }
    tree = std::make_unique<SearchTree>(boxes);
  }

  CellFunctions::~CellFunctions() = default;

  std::array<double, 2> CellFunctions::box_of(const std::size_t cell, const unsigned coordinate) const
  {
    std::array<double, 2> range = {std::numeric_limits<double>::infinity(), -std::numeric_limits<double>::infinity()};
    const std::size_t     n = nodes.n_map_nodes();
    for (std::size_t k = 0; k < n; ++k)
    {
      const double x = nodes.points[nodes.map_nodes[cell * n + k]][coordinate];
      range = {std::min(range[0], x), std::max(range[1], x)};
    }
    return range;
  }

  /// Newton's method from the middle of the cell; of a parallelogram or simplex one step.
  CellFunctions::Place CellFunctions::place_in(const std::size_t cell, const Coordinates &x) const
  {
    const unsigned    dim = nodes.dim;
    const std::size_t n = nodes.n_map_nodes();
    Place             place;
    place.cell = cell;
    for (unsigned d = 0; d < dim; ++d)
      place.unit[d] = nodes.simplex ? 1. / (dim + 1) : 0.5;
    const bool linear = nodes.map_degree == 1 && (nodes.simplex || dim == 1);
    for (unsigned iteration = 0; iteration < 20; ++iteration)
    {
      const LatticeBasis    basis(nodes, nodes.map_degree, map_lattice, place.unit);
      std::array<double, 9> derivative{};
      Coordinates           rest = x;
      for (std::size_t k = 0; k < n; ++k)
      {
        const Coordinates &p = nodes.points[nodes.map_nodes[cell * n + k]];
        for (unsigned i = 0; i < dim; ++i)
        {
          rest[i] -= basis.values[k] * p[i];
          for (unsigned j = 0; j < dim; ++j)
            derivative[3 * i + j] += basis.gradients[k][j] * p[i];
        }
      }
      place.inverse = inverse(derivative, dim);
      double step = 0;
      for (unsigned i = 0; i < dim; ++i)
      {
        double change = 0;
        for (unsigned j = 0; j < dim; ++j)
          change += place.inverse[3 * i + j] * rest[j];
        place.unit[i] += change;
        step = std::max(step, std::abs(change));
      }
      if (linear || step < 1e-12)
        break;
      if (!(step < 1e3)) // far from this cell
        return place;
    }
    place.outside = distance_to_reference_cell(place.unit, dim, nodes.simplex);
    return place;
  }

  /// The cell that holds the point, or misses it by least.
  CellFunctions::Place CellFunctions::locate(const Coordinates &x) const
  {
    Place      best;
    const auto look_at = [&](const std::size_t cell)
    {
      if (best.outside <= on_side || cell >= nodes.n_cells())
        return;
      if (const Place place = place_in(cell, x); place.outside < best.outside)
        best = place;
    };
    const auto may_hold = [&](const std::size_t cell)
    {
      for (unsigned d = 0; d < nodes.dim && cell < nodes.n_cells(); ++d)
        if (const auto range = box_of(cell, d); x[d] < range[0] || x[d] > range[1])
          return false;
      return true;
    };
    for (const std::size_t cell : {last_cell, last_cell + 1})
      if (may_hold(cell))
        look_at(cell);
    tree->visit_cells_at(x, look_at);
    if (best.outside > on_side)
      tree->visit_nearest(x, 8, look_at);
    last_cell = best.cell;
    return best;
  }

  class CellFunctions::Source : public FieldFunction::Source
  {
  public:
    Source(std::shared_ptr<const CellFunctions> cells,
           const std::vector<double>           &function,
           const double                         scale,
           const double                         offset,
           std::string                          origin)
      : cells(std::move(cells)), function(function), scale(scale), offset(offset), origin(std::move(origin))
    {
    }

    double value(const double x, const double y, const double z) const override
    {
      double value = 0;
      if (evaluate({x, y, z}, value, nullptr))
        return value;
      throw std::domain_error(fmt::format("{} has no value there: the point lies outside its mesh", origin));
    }

    bool
    values(const std::span<const Coordinates> points, const std::span<double> values, const std::span<Coordinates> gradients) const override
    {
      for (std::size_t i = 0; i < points.size(); ++i)
        if (!evaluate(points[i], values[i], gradients.empty() ? nullptr : &gradients[i]))
          values[i] = std::numeric_limits<double>::quiet_NaN();
      return true;
    }

    double      sample_spacing() const override { return cells->spacing; }
    std::string explanation() const override { return fmt::format("scale * ({}) + offset", origin); }

  private:
    bool evaluate(const Coordinates &x, double &value, Coordinates *const gradient) const
    {
      const Place place = cells->locate(x);
      if (!(place.outside <= far_outside))
        return false;
      const CellNodes   &nodes = cells->nodes;
      const LatticeBasis basis(nodes, nodes.degree, cells->value_lattice, place.unit);
      const std::size_t  n = nodes.n_value_nodes();
      Coordinates        slope{};
      value = 0;
      for (std::size_t k = 0; k < n; ++k)
      {
        const double at_node = function[nodes.value_nodes[place.cell * n + k]];
        value += basis.values[k] * at_node;
        for (unsigned d = 0; d < nodes.dim; ++d)
          slope[d] += basis.gradients[k][d] * at_node;
      }
      value = scale * value + offset;
      if (gradient)
      {
        *gradient = {};
        for (unsigned j = 0; j < nodes.dim; ++j)
          for (unsigned i = 0; i < nodes.dim; ++i)
            (*gradient)[j] += scale * place.inverse[3 * i + j] * slope[i];
      }
      return true;
    }

    const std::shared_ptr<const CellFunctions> cells;
    const std::vector<double>                 &function;
    const double                               scale, offset;
    const std::string                          origin;
  };

  std::shared_ptr<const FieldFunction::Source>
  CellFunctions::function(const std::string &name, const double scale, const double offset, const std::string &origin) const
  {
    const auto found = functions.find(name);
    if (found == functions.end())
      return nullptr;
    return std::make_shared<Source>(shared_from_this(), found->second, scale, offset, origin);
  }

  bool CellFunctions::values_at(const Coordinates &x, const std::span<double> values) const
  {
    const Place place = locate(x);
    if (!(place.outside <= far_outside))
      return false;
    const LatticeBasis basis(nodes, nodes.degree, value_lattice, place.unit);
    const std::size_t  n = nodes.n_value_nodes();
    std::size_t        number = 0;
    for (const auto &[name, function] : functions)
    {
      double &value = values[number++] = 0;
      for (std::size_t k = 0; k < n; ++k)
        value += basis.values[k] * function[nodes.value_nodes[place.cell * n + k]];
    }
    return true;
  }

  std::vector<std::string> CellFunctions::names() const
  {
    std::vector<std::string> result;
    for (const auto &[name, values] : functions)
      result.push_back(name);
    return result;
  }
} // namespace unilateral
