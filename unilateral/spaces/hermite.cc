#include "unilateral/spaces/hermite.h"

#include <deal.II/base/qprojector.h>
#include <deal.II/dofs/dof_accessor.h>

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <set>
#include <stdexcept>
#include <string>

namespace unilateral
{
  using namespace dealii;

  namespace
  {
    constexpr unsigned n_orders = 4; ///< the value and three derivatives

    /// The k-th derivatives in t, k = 0 .. 3, of a cubic Hermite function on (0, 1).
    using CubicDerivatives = std::array<double, n_orders>;

    /// The function that has the value (@p derivative = 0) or the slope (1) one at the @p end 0 or 1 of the unit segment.
    CubicDerivatives cubic_hermite(const unsigned end, const unsigned derivative, const double t)
    {
      if (derivative == 0)
      {
        const CubicDerivatives at_1 = {t * t * (3 - 2 * t), 6 * t * (1 - t), 6 - 12 * t, -12};
        return end == 1 ? at_1 : CubicDerivatives{(1 - t) * (1 - t) * (1 + 2 * t), -at_1[1], -at_1[2], -at_1[3]};
      }
      if (end == 0)
        return {t * (1 - t) * (1 - t), (1 - t) * (1 - 3 * t), 6 * t - 4, 6};
      return {-t * t * (1 - t), t * (3 * t - 2), 6 * t - 2, 6};
    }

    /// Cubic Hermite functions of all directions at one point of the reference cell: [direction][end][derivative that is the DoF].
    template <int dim>
    using CubicsAtPoint = std::array<std::array<std::array<CubicDerivatives, 2>, 2>, dim>;

    template <int dim>
    CubicsAtPoint<dim> cubics_at(const Point<dim> &reference_point)
    {
      CubicsAtPoint<dim> cubics;
      for (unsigned d = 0; d < dim; ++d)
        for (const unsigned end : {0, 1})
          for (const unsigned derivative : {0, 1})
            cubics[d][end][derivative] = cubic_hermite(end, derivative, reference_point[d]);
      return cubics;
    }

    template <int dim>
    constexpr unsigned n_dofs_per_vertex = 1u << dim;

    template <int dim>
    constexpr unsigned n_dofs_per_cell = n_dofs_per_vertex<dim> *n_dofs_per_vertex<dim>;

    /// A cell whose edges lie along the axes.
    template <int dim>
    struct Box
    {
      Point<dim>     lowest;
      Tensor<1, dim> size;
    };

    /// Nothing unless the cell is such a box and its reference directions are +x, +y, +z.
    template <int dim>
    std::optional<Box<dim>> axis_parallel_box(const TriaAccessor<dim, dim, dim> &cell)
    {
      if (!cell.reference_cell().is_hyper_cube())
        return {};
      Box<dim> box;
      box.lowest = cell.vertex(0);
      double shortest = INFINITY;
      for (unsigned d = 0; d < dim; ++d)
      {
        box.size[d] = cell.vertex(1u << d)[d] - box.lowest[d];
        shortest = std::min(shortest, box.size[d]);
      }
      if (!(shortest > 0))
        return {};
      for (const unsigned v : cell.vertex_indices())
        for (unsigned d = 0; d < dim; ++d)
          if (!(std::abs(cell.vertex(v)[d] - box.lowest[d] - (v >> d & 1) * box.size[d]) <= 1e-10 * shortest))
            return {};
      return box;
    }

    template <int dim>
    Box<dim> box_of(const TriaAccessor<dim, dim, dim> &cell)
    {
      if (const auto box = axis_parallel_box(cell))
        return *box;
      std::string center;
      for (unsigned d = 0; d < dim; ++d)
        center += fmt::format("{}{}", d == 0 ? "" : ", ", cell.center()[d]);
      throw std::invalid_argument(
        fmt::format("the Hermite element needs cells with edges along the axes, first +x, then +y: the cell at ({}) is none", center));
    }

    /// Derivatives in x of the shape functions of one cell: by the chain rule a derivative that is a DoF brings a factor h, one that is
    /// taken brings 1/h.
    template <int dim>
    class ShapeFunctions
    {
    public:
      explicit ShapeFunctions(const Tensor<1, dim> &size)
      {
        for (unsigned d = 0; d < dim; ++d)
          for (unsigned taken = 0; taken < n_orders; ++taken)
          {
            factor[d][0][taken] = 1 / std::pow(size[d], taken);
            factor[d][1][taken] = size[d] / std::pow(size[d], taken);
          }
      }

      double derivative(const CubicsAtPoint<dim> &cubics, const HermiteCellDof<dim> &dof, const DerivativeIndex<dim> &taken) const
      {
        double product = 1;
        for (unsigned d = 0; d < dim; ++d)
        {
          const unsigned end = dof.vertex >> d & 1, alpha = dof.derivative[d];
          product *= cubics[d][end][alpha][taken[d]] * factor[d][alpha][taken[d]];
        }
        return product;
      }

    private:
      std::array<std::array<std::array<double, n_orders>, 2>, dim> factor; ///< [direction][derivative that is the DoF][taken]
    };

    template <int dim>
    class Hermite : public FiniteElement<dim>
    {
    public:
      Hermite()
        : FiniteElement<dim>(FiniteElementData<dim>(dofs_per_object(), 1, 3, FiniteElementData<dim>::H2),
                             std::vector<bool>(n_dofs_per_cell<dim>, false),
                             std::vector<ComponentMask>(n_dofs_per_cell<dim>, ComponentMask(1, true))),
          cell_dofs(hermite_cell_dofs<dim>())
      {
      }

      std::unique_ptr<FiniteElement<dim>> clone() const override { return std::make_unique<Hermite<dim>>(*this); }
      std::string                         get_name() const override { return fmt::format("Hermite<{}>(3)", dim); }

      UpdateFlags requires_update_flags(const UpdateFlags flags) const override
      {
        return flags & (update_values | update_gradients | update_hessians | update_3rd_derivatives);
      }

      // The library's own refusal is an assertion: without debug checks an empty matrix would go unnoticed.
      const FullMatrix<double> &get_prolongation_matrix(const unsigned, const RefinementCase<dim> &) const override
      {
        AssertThrow(false, typename FiniteElement<dim>::ExcEmbeddingVoid());
        return this->prolongation[0][0];
      }
      const FullMatrix<double> &get_restriction_matrix(const unsigned, const RefinementCase<dim> &) const override
      {
        AssertThrow(false, typename FiniteElement<dim>::ExcProjectionVoid());
        return this->restriction[0][0];
      }

    private:
      using Cell = typename Triangulation<dim>::cell_iterator;
      using InternalDataBase = typename FiniteElement<dim>::InternalDataBase;
      using MappingInternal = typename Mapping<dim>::InternalDataBase;
      using MappingOutput = internal::FEValuesImplementation::MappingRelatedData<dim, dim>;
      using Output = internal::FEValuesImplementation::FiniteElementRelatedData<dim, dim>;
      using Projected = typename QProjector<dim>::DataSetDescriptor;

      struct AtQuadraturePoints : InternalDataBase
      {
        std::vector<CubicsAtPoint<dim>> cubics; ///< of a cell, or face by face of all its faces or subfaces
      };

      static std::vector<unsigned> dofs_per_object()
      {
        std::vector<unsigned> n(dim + 1, 0);
        n[0] = n_dofs_per_vertex<dim>;
        return n;
      }

      std::unique_ptr<InternalDataBase>
      get_data(const UpdateFlags flags, const Mapping<dim> &, const Quadrature<dim> &quadrature, Output &) const override
      {
        auto at_points = std::make_unique<AtQuadraturePoints>();
        at_points->update_each = requires_update_flags(flags);
        for (const auto &point : quadrature.get_points())
          at_points->cubics.push_back(cubics_at(point));
        return at_points;
      }

      void fill_fe_values(const Cell                      &cell,
                          const CellSimilarity::Similarity similarity,
                          const Quadrature<dim>           &quadrature,
                          const Mapping<dim> &,
                          const MappingInternal &,
                          const MappingOutput &,
                          const InternalDataBase &at_points,
                          Output                 &output) const override
      {
        if (similarity != CellSimilarity::translation)
          fill(*cell, at_points, 0, quadrature.size(), output);
      }

      using FiniteElement<dim>::fill_fe_face_values;

      void fill_fe_face_values(const Cell                     &cell,
                               const unsigned                  face,
                               const hp::QCollection<dim - 1> &quadrature,
                               const Mapping<dim> &,
                               const MappingInternal &,
                               const MappingOutput &,
                               const InternalDataBase &at_points,
                               Output                 &output) const override
      {
        const auto first = Projected::face(this->reference_cell(), face, cell->face_orientation(face), cell->face_flip(face),
                                           cell->face_rotation(face), quadrature);
        fill(*cell, at_points, first, quadrature[quadrature.size() == 1 ? 0 : face].size(), output);
      }

      void fill_fe_subface_values(const Cell                &cell,
                                  const unsigned             face,
                                  const unsigned             subface,
                                  const Quadrature<dim - 1> &quadrature,
                                  const Mapping<dim> &,
                                  const MappingInternal &,
                                  const MappingOutput &,
                                  const InternalDataBase &at_points,
                                  Output                 &output) const override
      {
        const auto first = Projected::subface(this->reference_cell(), face, subface, cell->face_orientation(face), cell->face_flip(face),
                                              cell->face_rotation(face), quadrature.size(), cell->subface_case(face));
        fill(*cell, at_points, first, quadrature.size(), output);
      }

      /// Values and derivatives at @p n quadrature points from @p first on.
      void fill(const TriaAccessor<dim, dim, dim> &cell,
                const InternalDataBase            &at_points,
                const unsigned                     first,
                const unsigned                     n,
                Output                            &output) const
      {
        const auto                flags = at_points.update_each;
        const auto               &cubics = static_cast<const AtQuadraturePoints &>(at_points).cubics;
        const ShapeFunctions<dim> shape(box_of(cell).size);
        for (unsigned k = 0; k < cell_dofs.size(); ++k)
          for (unsigned q = 0; q < n; ++q)
          {
            const auto derivative = [&](const std::initializer_list<unsigned> directions)
            {
              DerivativeIndex<dim> taken = {};
              for (const unsigned d : directions)
                ++taken[d];
              return shape.derivative(cubics[first + q], cell_dofs[k], taken);
            };
            if (flags & update_values)
              output.shape_values(k, q) = derivative({});
            for (unsigned a = 0; a < dim; ++a)
            {
              if (flags & update_gradients)
                output.shape_gradients(k, q)[a] = derivative({a});
              for (unsigned b = 0; b < dim; ++b)
              {
                if (flags & update_hessians)
                  output.shape_hessians(k, q)[a][b] = derivative({a, b});
                if (flags & update_3rd_derivatives)
                  for (unsigned c = 0; c < dim; ++c)
                    output.shape_3rd_derivatives(k, q)[a][b][c] = derivative({a, b, c});
              }
            }
          }
      }

      const std::vector<HermiteCellDof<dim>> cell_dofs;
    };
  } // namespace

  template <int dim>
  std::unique_ptr<FiniteElement<dim>> make_hermite_element()
  {
    return std::make_unique<Hermite<dim>>();
  }

  template <int dim>
  bool is_axis_parallel(const Triangulation<dim> &triangulation)
  {
    return std::all_of(triangulation.begin_active(), typename Triangulation<dim>::active_cell_iterator(triangulation.end()),
                       [](const auto &cell) { return axis_parallel_box<dim>(cell).has_value(); });
  }

  template <int dim>
  std::vector<HermiteCellDof<dim>> hermite_cell_dofs()
  {
    std::vector<HermiteCellDof<dim>> dofs(n_dofs_per_cell<dim>);
    for (unsigned i = 0; i < dofs.size(); ++i)
    {
      dofs[i].vertex = i / n_dofs_per_vertex<dim>;
      for (unsigned d = 0; d < dim; ++d)
        dofs[i].derivative[d] = i >> d & 1;
    }
    return dofs;
  }

  template <int dim>
  std::vector<HermiteNode<dim>> hermite_nodes(const DoFHandler<dim> &dof_handler)
  {
    const auto                           cell_dofs = hermite_cell_dofs<dim>();
    std::vector<HermiteNode<dim>>        nodes(dof_handler.n_dofs());
    std::vector<types::global_dof_index> dofs(cell_dofs.size());
    for (const auto &cell : dof_handler.active_cell_iterators())
    {
      cell->get_dof_indices(dofs);
      for (unsigned i = 0; i < dofs.size(); ++i)
        nodes[dofs[i]] = {cell->vertex(cell_dofs[i].vertex), cell_dofs[i].derivative};
    }
    return nodes;
  }

  template <int dim>
  std::vector<types::global_dof_index> hermite_boundary_dofs(const DoFHandler<dim>                 &dof_handler,
                                                             const std::vector<types::boundary_id> &boundary_ids,
                                                             const unsigned                         normal_order)
  {
    if (normal_order > 1)
      throw std::invalid_argument(fmt::format("no DoFs of the Hermite element fix normal derivatives of order {}", normal_order));
    const auto                           cell_dofs = hermite_cell_dofs<dim>();
    std::set<types::global_dof_index>    found;
    std::vector<types::global_dof_index> dofs(cell_dofs.size());
    for (const auto &cell : dof_handler.active_cell_iterators())
      for (const unsigned face : cell->face_indices())
        if (cell->at_boundary(face) &&
            std::find(boundary_ids.begin(), boundary_ids.end(), cell->face(face)->boundary_id()) != boundary_ids.end())
        {
          const unsigned normal = face / 2, end = face % 2;
          cell->get_dof_indices(dofs);
          for (unsigned i = 0; i < dofs.size(); ++i)
            if ((cell_dofs[i].vertex >> normal & 1) == end && cell_dofs[i].derivative[normal] == normal_order)
              found.insert(dofs[i]);
        }
    return {found.begin(), found.end()};
  }

  template <int dim>
  HermiteOnFinerMesh<dim>::HermiteOnFinerMesh(const DoFHandler<dim> &coarse, const std::vector<VectorType> &functions)
    : cell_values(functions.size())
  {
    std::vector<types::global_dof_index> dofs(n_dofs_per_cell<dim>);
    for (const auto &cell : coarse.active_cell_iterators())
    {
      coarse_cells.emplace(cell->id(), coarse_cells.size());
      cell->get_dof_indices(dofs);
      for (std::size_t f = 0; f < functions.size(); ++f)
        for (const auto dof : dofs)
          cell_values[f].push_back(functions[f](dof));
    }
  }

  template <int dim>
  void HermiteOnFinerMesh<dim>::interpolate(const DoFHandler<dim> &fine, std::vector<VectorType> &functions) const
  {
    const auto                           cell_dofs = hermite_cell_dofs<dim>();
    std::vector<types::global_dof_index> dofs(cell_dofs.size());
    functions.resize(cell_values.size());
    for (auto &function : functions)
      function.reinit(fine.n_dofs());
    for (const auto &cell : fine.active_cell_iterators())
    {
      typename Triangulation<dim>::cell_iterator coarse = cell;
      auto                                       found = coarse_cells.find(coarse->id());
      while (found == coarse_cells.end() && coarse->level() > 0)
      {
        coarse = coarse->parent();
        found = coarse_cells.find(coarse->id());
      }
      if (found == coarse_cells.end())
        throw std::invalid_argument("a cell of the finer mesh lies in no cell of the coarser one");

      const Box<dim>            box = box_of<dim>(*coarse);
      const ShapeFunctions<dim> shape(box.size);
      cell->get_dof_indices(dofs);
      for (unsigned i = 0; i < dofs.size(); ++i)
      {
        Point<dim> x;
        for (unsigned d = 0; d < dim; ++d)
          x[d] = (cell->vertex(cell_dofs[i].vertex)[d] - box.lowest[d]) / box.size[d];
        const auto cubics = cubics_at(x);
        for (std::size_t f = 0; f < functions.size(); ++f)
        {
          const double *values = &cell_values[f][found->second * dofs.size()];
          double        sum = 0;
          for (unsigned k = 0; k < dofs.size(); ++k)
            sum += values[k] * shape.derivative(cubics, cell_dofs[k], cell_dofs[i].derivative);
          functions[f](dofs[i]) = sum;
        }
      }
    }
  }

#define INSTANTIATE(dim)                                                                                                                   \
  template std::unique_ptr<FiniteElement<dim>>  make_hermite_element<dim>();                                                               \
  template bool                                 is_axis_parallel(const Triangulation<dim> &);                                              \
  template std::vector<HermiteCellDof<dim>>     hermite_cell_dofs<dim>();                                                                  \
  template std::vector<HermiteNode<dim>>        hermite_nodes(const DoFHandler<dim> &);                                                    \
  template std::vector<types::global_dof_index> hermite_boundary_dofs(const DoFHandler<dim> &, const std::vector<types::boundary_id> &,    \
                                                                      unsigned);                                                           \
  template class HermiteOnFinerMesh<dim>;
  INSTANTIATE(1)
  INSTANTIATE(2)
  INSTANTIATE(3)
#undef INSTANTIATE
} // namespace unilateral
