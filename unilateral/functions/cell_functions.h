// Functions that are known on the cells of a mesh, evaluated at any point: solutions of other runs and of steps before.
#pragma once

#include "unilateral/functions/field_function.h"

#include <array>
#include <cstdint>
#include <map>
#include <memory>
#include <span>
#include <string>
#include <vector>

namespace unilateral
{
  /// The nodes of cells of one kind. A cell is the image of the reference cell, (0, 1)^dim or the simplex between the origin and the unit
  /// vectors, under a polynomial map; functions are polynomials there. Both are given by what they are at the points of a lattice of
  /// spacing 1/degree, the first coordinate running fastest; of degree 0 it is the centre.
  struct CellNodes
  {
    unsigned dim = 1;
    bool     simplex = false; ///< a segment is none
    unsigned degree = 1;      ///< of functions
    unsigned map_degree = 1;  ///< of the map, 1 or more

    std::vector<std::array<double, 3>> points;      ///< coordinates beyond dim are 0
    std::vector<std::uint32_t>         map_nodes;   ///< in `points`, cell by cell
    std::vector<std::uint32_t>         value_nodes; ///< in the values of a function, cell by cell

    std::size_t n_map_nodes() const { return n_lattice_points(map_degree); }
    std::size_t n_value_nodes() const { return n_lattice_points(degree); }
    std::size_t n_cells() const { return map_nodes.size() / n_map_nodes(); }

    /// The points of a lattice, as multiples of its spacing; degree 0: one point.
    std::vector<std::array<unsigned, 3>> lattice(unsigned lattice_degree) const;

  private:
    std::size_t n_lattice_points(unsigned lattice_degree) const;
  };

  /// The cells of a mesh in a search tree, and functions on them by name.
  class CellFunctions : public std::enable_shared_from_this<CellFunctions>
  {
  public:
    /// @p functions: their values by `value_nodes`.
    CellFunctions(CellNodes nodes, std::map<std::string, std::vector<double>> functions);
    ~CellFunctions();

    /// scale * function + offset, with its gradient. Where it has no value, farther outside of the mesh than a twentieth of a cell, the
    /// reason begins with @p origin. Nullptr: there is no function @p name.
    std::shared_ptr<const FieldFunction::Source>
    function(const std::string &name, double scale, double offset, const std::string &origin) const;

    /// Sets all functions at a point, in the order of their names. False where they have no value, see function().
    bool values_at(const std::array<double, 3> &x, std::span<double> values) const;

    std::vector<std::string> names() const; ///< in ascending order
    unsigned                 dim() const { return nodes.dim; }

    const CellNodes                                  &cells() const { return nodes; }
    const std::map<std::string, std::vector<double>> &all() const { return functions; } ///< their values by `value_nodes`

  private:
    class Source;
    class SearchTree;

    /// A point in a cell.
    struct Place
    {
      std::size_t           cell = 0;
      std::array<double, 3> unit{};          ///< in its reference coordinates
      std::array<double, 9> inverse{};       ///< of the derivative of the map there: d unit_i / d x_j
      double                outside = 1e300; ///< how far outside it lies there
    };

    Place                 place_in(std::size_t cell, const std::array<double, 3> &x) const;
    Place                 locate(const std::array<double, 3> &x) const;
    std::array<double, 2> box_of(std::size_t cell, unsigned coordinate) const;

    const CellNodes                                  nodes;
    const std::map<std::string, std::vector<double>> functions;
    std::vector<std::array<unsigned, 3>>             map_lattice, value_lattice;
    std::unique_ptr<SearchTree>                      tree;
    double                                           spacing = 0;   ///< of nodes, a mean
    mutable std::size_t                              last_cell = 0; ///< points come cell by cell, most of the time
  };
} // namespace unilateral
