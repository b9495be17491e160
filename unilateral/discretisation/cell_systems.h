// Matrices and loads of cells for multigrid, in its order of unknowns.
#pragma once

#include "unilateral/discretisation/cell_numbering.h"
#include "unilateral/discretisation/element_systems.h"
#include "unilateral/inequality/discrete_problem.h"

#include <deal.II/fe/fe_values.h>

#include <cstdint>
#include <vector>

namespace unilateral
{
  /// The element matrices and loads of a level. Cells of one shape are integrated once. Triangles and tetrahedra share what is integrated
  /// with the descendants of their coarse cell, however many shapes there are in all, and turned by 180 degrees: in the order of corners
  /// in which they are refined both factors of a(u, v) then change the sign of their derivatives, and a constant load keeps its integrals.
  template <int dim>
  class CellSystems
  {
  public:
    using Cell = typename dealii::DoFHandler<dim>::active_cell_iterator;

    /// Keeps references to both.
    CellSystems(const Problem<dim> &problem, const CellNumbering<dim> &numbering);

    /// The number of the cell's matrix; its load is in load().
    std::int32_t integrate(const Cell &cell);

    /// Of the cell that was integrated last.
    const double *load() const { return current_load; }

    std::vector<double> matrices, convection; ///< the symmetric part, and the rest where a is not symmetric

  private:
    std::int32_t compute(const Cell &cell);
    void         append(std::vector<double> &to, const dealii::FullMatrix<double> &matrix) const;
    void         keep_load();

    /// From corner 0 to the others, in the order in which the cell is refined.
    using Edges = std::array<dealii::Tensor<1, dim>, dim>;
    struct KnownSimplex
    {
      dealii::types::material_id region;
      Edges                      edges;
      std::int32_t               matrix;
      std::vector<double>        load; ///< where that is constant in the region
    };
    Edges               edges_of(const Cell &cell) const;
    const KnownSimplex *find_congruent(const Cell &cell) const; ///< among the last few
    std::int32_t        take_from(const KnownSimplex &simplex, const Cell &cell);
    void                keep_simplex(const Cell &cell, std::int32_t matrix);

    const Problem<dim>          &problem;
    const CellNumbering<dim>    &numbering;
    CellShapes<dim>              shapes;
    RepeatedLoad<dim>            repeated_load;
    dealii::FEValues<dim>        values;
    const unsigned               n;
    const std::vector<unsigned> *element_index = nullptr; ///< of the cell at hand
    const bool                   affine;                  ///< triangles or tetrahedra with straight sides
    std::vector<KnownSimplex>    simplices;
    dealii::FullMatrix<double>   local_matrix;
    dealii::Vector<double>       local_load;
    std::vector<std::int32_t>    matrix_of_shape;
    std::vector<double>          load_of_shape, own_load;
    const double                *current_load = nullptr;
  };

  /// u = C u_free + g for a few unknowns.
  struct AffineDependence : Dependence
  {
    std::vector<double> g;

    AffineDependence(const std::vector<dealii::types::global_dof_index> &dofs, const dealii::AffineConstraints<double> &dirichlet);

    /// Adds C'(f - A g).
    template <typename Load>
    void add_load(const double *A, const Load &f, Vector &load) const
    {
      for (std::size_t i = 0; i < g.size(); ++i)
      {
        double rest = f[i];
        for (std::size_t j = 0; j < g.size(); ++j)
          rest -= *A++ * g[j];
        for (std::size_t k = 0; k < masters.size(); ++k)
          load(masters[k]) += C[i * masters.size() + k] * rest;
      }
    }
  };
} // namespace unilateral
