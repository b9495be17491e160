#include "unilateral/mesh/curved_cells.h"

#include <deal.II/base/geometry_info.h>
#include <deal.II/base/quadrature_lib.h>
#include <deal.II/fe/fe_q.h>
#include <deal.II/fe/fe_simplex_p.h>
#include <deal.II/fe/mapping.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <set>
#include <utility>

namespace unilateral
{
  using namespace dealii;

  namespace
  {
    template <int dim>
    std::shared_ptr<const FiniteElement<dim>> quadratic_element(const bool simplex)
    {
      if constexpr (dim > 1)
        if (simplex)
          return std::make_shared<FE_SimplexP<dim>>(2);
      return std::make_shared<FE_Q<dim>>(2);
    }

    /// What deviates less is round-off.
    constexpr double smallest_deviation = 1e-9;
  } // namespace

  template <int dim>
  std::vector<unsigned> vertices_around(const typename Triangulation<dim>::cell_iterator &cell, const Point<dim> &unit_node)
  {
    std::vector<unsigned> result;
    for (const unsigned v : cell->vertex_indices())
      if (cell->reference_cell().d_linear_shape_function(unit_node, v) > 1e-3)
        result.push_back(cell->vertex_index(v));
    std::sort(result.begin(), result.end());
    return result;
  }

  template <int dim>
  CurvedCells<dim>::CurvedCells(const Triangulation<dim> &coarse, const PointsByVertices<dim> &points)
    : fe(quadratic_element<dim>(coarse.begin()->reference_cell().is_simplex())), nodes_of_level(1)
  {
    const auto &unit_nodes = fe->get_unit_support_points();
    for (const auto &cell : coarse.active_cell_iterators())
      for (const Point<dim> &unit_node : unit_nodes)
      {
        Point<dim> middle;
        for (const unsigned v : cell->vertex_indices())
          middle += cell->reference_cell().d_linear_shape_function(unit_node, v) * cell->vertex(v);
        const auto found = points.find(vertices_around<dim>(cell, unit_node));
        nodes_of_level[0].push_back(found == points.end() ? middle : found->second);
        const double round_off = 1e-14 * middle.norm();
        is_straight =
          is_straight && middle.distance(nodes_of_level[0].back()) <= std::max(smallest_deviation * cell->diameter(), round_off);
      }
  }

  template <int dim>
  std::vector<typename CurvedCells<dim>::CellIterator> CurvedCells<dim>::folded_cells(const Triangulation<dim> &coarse) const
  {
    std::vector<Point<dim>> places = fe->get_unit_support_points();
    const auto              inside = fe->reference_cell().template get_gauss_type_quadrature<dim>(3).get_points();
    places.insert(places.end(), inside.begin(), inside.end());
    std::vector<CellIterator> folded;
    for (const auto &cell : coarse.active_cell_iterators())
      if (!std::all_of(places.begin(), places.end(), [&](const auto &unit) { return determinant(jacobian(cell, unit)) > 0; }))
        folded.push_back(cell);
    return folded;
  }

  template <int dim>
  Point<dim> CurvedCells<dim>::Place::operator()(const Point<dim> &unit) const
  {
    Point<dim> there = corners[0];
    for (unsigned d = 0; d < dim; ++d)
      there += unit[d] * (corners[d + 1] - corners[0]);
    return there;
  }

  template <int dim>
  typename CurvedCells<dim>::Place CurvedCells<dim>::Place::of_child(const std::array<Point<dim>, dim + 1> &corners_of_child) const
  {
    Place child{coarse_cell, {}};
    for (unsigned d = 0; d <= dim; ++d)
      child.corners[d] = (*this)(corners_of_child[d]);
    return child;
  }

  namespace
  {
    /// A point of a coarse cell by the vertices that it lies between, and how much of each it has, in whole numbers: the same in all cells
    /// that it belongs to.
    using SharedPoint = std::vector<std::pair<unsigned, unsigned>>;

    template <int dim>
    SharedPoint shared_point(const typename Triangulation<dim>::cell_iterator &cell, const Point<dim> &unit, const unsigned degree)
    {
      const double whole = std::pow(degree, cell->reference_cell().is_simplex() ? 1 : dim);
      SharedPoint  result;
      for (const unsigned v : cell->vertex_indices())
        if (const auto share = std::lround(whole * cell->reference_cell().d_linear_shape_function(unit, v)); share > 0)
          result.emplace_back(cell->vertex_index(v), share);
      std::sort(result.begin(), result.end());
      return result;
    }
  } // namespace

  template <int dim>
  void CurvedCells<dim>::leave_folded_cells(const Triangulation<dim> &coarse, DrawnCells<dim> &drawing) const
  {
    const auto point = [&](const unsigned cell, const std::size_t n)
    { return shared_point<dim>(CellIterator(&coarse, 0, cell), drawing.unit_nodes()[n], drawing.degree()); };
    std::set<SharedPoint> left;
    for (auto folded = drawing.folded_cells(); !folded.empty(); folded = drawing.folded_cells())
    {
      const std::size_t before = left.size();
      for (const unsigned cell : folded)
        for (std::size_t n = 0; n < drawing.unit_nodes().size(); ++n)
          left.insert(point(cell, n));
      if (left.size() == before)
        return; // they are as they were with degree 2
      for (const auto &[cell, nodes] : drawing.nodes())
        for (std::size_t n = 0; n < nodes.size(); ++n)
          if (left.count(point(cell, n)) > 0)
            drawing.move_node(cell, n, position(&nodes_of_level[0][std::size_t(cell) * fe->n_dofs_per_cell()], drawing.unit_nodes()[n]));
    }
  }

  template <int dim>
  void CurvedCells<dim>::follow_drawing(const Triangulation<dim> &coarse, DrawnCells<dim> drawing)
  {
    leave_folded_cells(coarse, drawing);
    std::array<Point<dim>, dim + 1> whole;
    for (unsigned d = 0; d < dim; ++d)
      whole[d + 1][d] = 1;
    place_of_level.resize(1);
    for (unsigned cell = 0; cell < coarse.n_cells(0); ++cell)
      place_of_level[0].push_back({cell, whole});
    drawn.emplace(std::move(drawing));
  }

  template <int dim>
  void CurvedCells<dim>::place_nodes(const Place &place, Point<dim> *const nodes) const
  {
    const auto &unit_nodes = fe->get_unit_support_points();
    for (unsigned i = 0; i < unit_nodes.size(); ++i)
      nodes[i] = drawn->position(place.coarse_cell, place(unit_nodes[i]));
  }

  template <int dim>
  std::vector<Point<dim>> CurvedCells<dim>::nodes(const CellIterator &cell) const
  {
    const auto begin = nodes_of_level[cell->level()].begin() + std::size_t(cell->index()) * fe->n_dofs_per_cell();
    return std::vector<Point<dim>>(begin, begin + fe->n_dofs_per_cell());
  }

  template <int dim>
  Point<dim> CurvedCells<dim>::unit_point(const CellIterator &cell, const Point<dim> &p) const
  {
    const Point<dim> *const of_cell = &nodes_of_level[cell->level()][std::size_t(cell->index()) * fe->n_dofs_per_cell()];
    Point<dim>              unit = fe->reference_cell().template barycenter<dim>();
    double                  last = std::numeric_limits<double>::max();
    for (unsigned step = 0; step < 30; ++step)
    {
      const Tensor<2, dim> J = jacobian(cell, unit);
      if (!(std::abs(determinant(J)) > 0) || unit.norm() > 10)
        break;
      const Tensor<1, dim> change = invert(J) * (p - position(of_cell, unit));
      unit += change;
      // Far from the origin round-off keeps steps above any fixed length: they end where they no longer shrink.
      if (change.norm() < 1e-12 || (change.norm() < 1e-5 && change.norm() >= 0.5 * last))
        return unit;
      last = change.norm();
    }
    throw typename Mapping<dim>::ExcTransformationFailed();
  }

  template <int dim>
  void CurvedCells<dim>::keep_cells(const Triangulation<dim> &triangulation, const int level, const std::vector<unsigned> &cells_on_level)
  {
    const unsigned            n = fe->n_dofs_per_cell();
    std::vector<CellIterator> cells;
    for (const auto &cell : triangulation.cell_iterators_on_level(level))
      cells.push_back(cell);
    std::vector<Point<dim>> kept_nodes;
    std::vector<Place>      kept_places;
    for (const unsigned k : cells_on_level)
    {
      const auto cell = cells[k];
      const auto begin = nodes_of_level[cell->level()].begin() + std::size_t(cell->index()) * n;
      kept_nodes.insert(kept_nodes.end(), begin, begin + n);
      if (drawn)
        kept_places.push_back(place_of_level[cell->level()][cell->index()]);
    }
    nodes_of_level.assign(1, std::move(kept_nodes));
    place_of_level.assign(drawn ? 1 : 0, std::move(kept_places));
    n_drawn_levels = std::max(1, int(n_drawn_levels) - level);
  }

  template <int dim>
  void CurvedCells<dim>::follow_refinement(Triangulation<dim> &triangulation, const bool others_have_hanging_nodes)
  {
    const unsigned                               n = fe->n_dofs_per_cell(), n_children = GeometryInfo<dim>::max_children_per_cell;
    std::vector<std::array<Point<dim>, dim + 1>> corners_of_child(n_children);
    std::vector<double>                          weights; // of the nodes of a cell at those of each child
    for (unsigned child = 0; child < n_children; ++child)
    {
      for (unsigned d = 0; d <= dim; ++d)
        corners_of_child[child][d] =
          GeometryInfo<dim>::child_to_cell_coordinates(d == 0 ? Point<dim>() : Point<dim>::unit_vector(d - 1), child);
      for (const Point<dim> &unit_node : fe->get_unit_support_points())
        for (unsigned j = 0; j < n; ++j)
          weights.push_back(fe->shape_value(j, GeometryInfo<dim>::child_to_cell_coordinates(unit_node, child)));
    }
    nodes_of_level.resize(triangulation.n_levels());
    place_of_level.resize(drawn ? triangulation.n_levels() : 0);
    had_hanging_nodes = had_hanging_nodes || others_have_hanging_nodes || triangulation.has_hanging_nodes();
    if (!had_hanging_nodes)
      for (n_drawn_levels = 1; triangulation.n_active_cells(n_drawn_levels - 1) == 0;)
        ++n_drawn_levels;
    for (unsigned level = 0; level + 1 < triangulation.n_levels(); ++level)
    {
      nodes_of_level[level + 1].resize(std::size_t(triangulation.n_raw_cells(level + 1)) * n);
      if (drawn)
        place_of_level[level + 1].resize(triangulation.n_raw_cells(level + 1));
      for (const auto &parent : triangulation.cell_iterators_on_level(level))
        for (unsigned child = 0; child < n_children && parent->has_children(); ++child)
        {
          const unsigned    index = parent->child_index(child);
          Point<dim> *const of_child = &nodes_of_level[level + 1][std::size_t(index) * n];
          if (drawn)
            place_of_level[level + 1][index] = place_of_level[level][parent->index()].of_child(corners_of_child[child]);
          if (drawn && level + 1 < n_drawn_levels && drawn->contain(place_of_level[level + 1][index].coarse_cell))
          {
            place_nodes(place_of_level[level + 1][index], of_child);
            continue;
          }
          const Point<dim> *const of_parent = &nodes_of_level[level][std::size_t(parent->index()) * n];
          for (unsigned i = 0; i < n; ++i)
          {
            of_child[i] = Point<dim>();
            for (unsigned j = 0; j < n; ++j)
              of_child[i] += weights[(child * n + i) * n + j] * of_parent[j];
          }
        }
    }
    move_vertices(triangulation);
  }

  template <int dim>
  void CurvedCells<dim>::follow_refinement(Triangulation<dim>                                       &triangulation,
                                           const std::vector<typename RefinedSimplices<dim>::Child> &children)
  {
    const unsigned          n = fe->n_dofs_per_cell();
    const auto             &unit_nodes = fe->get_unit_support_points();
    std::vector<Point<dim>> finer;
    finer.reserve(children.size() * n);
    std::vector<Place> places;
    for (const auto &child : children)
    {
      if (drawn)
      {
        places.push_back(place_of_level[0][child.parent].of_child(child.corners));
        if (drawn->contain(places.back().coarse_cell))
        {
          finer.resize(finer.size() + n);
          place_nodes(places.back(), &finer[finer.size() - n]);
          continue;
        }
      }
      const Point<dim> *const of_parent = &nodes_of_level[0][std::size_t(child.parent) * n];
      for (const Point<dim> &unit_node : unit_nodes)
      {
        Point<dim> unit = child.corners[0];
        for (unsigned d = 0; d < dim; ++d)
          unit += unit_node[d] * (child.corners[d + 1] - child.corners[0]);
        finer.push_back(position(of_parent, unit));
      }
    }
    nodes_of_level[0] = std::move(finer);
    if (drawn)
      place_of_level[0] = std::move(places);
    move_vertices(triangulation);
  }

  template <int dim>
  void CurvedCells<dim>::move_vertices(const Triangulation<dim> &triangulation) const
  {
    const unsigned n = fe->n_dofs_per_cell();
    for (const auto &cell : triangulation.active_cell_iterators())
      for (const unsigned v : cell->vertex_indices())
        cell->vertex(v) = nodes_of_level[cell->level()][std::size_t(cell->index()) * n + v];
  }

  template <int dim>
  Tensor<2, dim> CurvedCells<dim>::jacobian(const CellIterator &cell, const Point<dim> &unit) const
  {
    const Point<dim> *const of_cell = &nodes_of_level[cell->level()][std::size_t(cell->index()) * fe->n_dofs_per_cell()];
    Tensor<2, dim>          J;
    for (unsigned j = 0; j < fe->n_dofs_per_cell(); ++j)
      J += outer_product(Tensor<1, dim>(of_cell[j]), fe->shape_grad(j, unit));
    return J;
  }

  template <int dim>
  Point<dim> CurvedCells<dim>::position(const Point<dim> *const nodes, const Point<dim> &unit) const
  {
    Point<dim> p;
    for (unsigned j = 0; j < fe->n_dofs_per_cell(); ++j)
      p += fe->shape_value(j, unit) * nodes[j];
    return p;
  }

  template std::vector<unsigned> vertices_around<1>(const Triangulation<1>::cell_iterator &, const Point<1> &);
  template std::vector<unsigned> vertices_around<2>(const Triangulation<2>::cell_iterator &, const Point<2> &);
  template std::vector<unsigned> vertices_around<3>(const Triangulation<3>::cell_iterator &, const Point<3> &);
  template class CurvedCells<1>;
  template class CurvedCells<2>;
  template class CurvedCells<3>;
} // namespace unilateral
