#include "unilateral/spaces/dirichlet_conditions.h"

#include "unilateral/mesh/reference_face.h"
#include "unilateral/spaces/boundary_normal.h"
#include "unilateral/spaces/cell_points.h"
#include "unilateral/spaces/unknowns_on_cuts.h"

#include <deal.II/base/quadrature_lib.h>
#include <deal.II/fe/fe.h>
#include <deal.II/fe/fe_values.h>

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <map>
#include <optional>
#include <set>

namespace unilateral
{
  using namespace dealii;

  namespace
  {
    /// n.u = g at a node.
    template <int dim>
    struct Equation
    {
      Tensor<1, dim> n;
      double         g = 0;
      int            rank = 0; ///< the smaller, the sooner it counts
      bool           symmetry = false;
    };

    /// What a face has to say of a node of it: an equation, or the normal of a plane of symmetry with its weight.
    template <int dim>
    struct Statement
    {
      Tensor<1, dim> n;
      double         number = 0; ///< g or the weight
      int            rank = 0;
      bool           symmetry = false;
    };

    template <int dim>
    struct Node
    {
      std::array<types::global_dof_index, dim> dofs;
      Point<dim>                               x;
      std::vector<Equation<dim>>               equations;
      std::map<int, NodeNormals<dim>>          symmetry; ///< by rank
    };

    /// What a part prescribes, compiled.
    struct Prescription
    {
      std::vector<std::optional<FieldFunction>> components;
      bool                                      symmetry = false;
      int                                       rank = 0;
    };

    std::vector<Prescription> prescriptions_of(const std::vector<PartCondition> &conditions, const unsigned n_components)
    {
      std::vector<Prescription> result(conditions.size());
      for (std::size_t part = 0; part < conditions.size(); ++part)
      {
        const auto &condition = conditions[part];
        auto       &prescription = result[part];
        prescription.components.resize(n_components);
        if (condition.rigid)
          continue;                                                     // the nodes of a platen follow its motion, see add_rigid_lines()
        prescription.symmetry = condition.symmetry && n_components > 1; // of a plate it says something of the slope only
        prescription.rank = (condition.named ? 0 : conditions.size()) + (conditions.size() - part);
        if (condition.value)
          prescription.components[0] = *condition.value;
        for (std::size_t c = 0; c < condition.components.size(); ++c)
          if (condition.components[c])
            prescription.components[c] = *condition.components[c];
      }
      return result;
    }

    /// An equation that others of the node decide, and decide otherwise: the ranks of the two and how far they are apart.
    struct Contradiction
    {
      int    rank, kept_rank;
      double difference;
    };

    /// u_pivot = g - (other components), by elimination.
    template <int dim>
    struct ReducedEquation
    {
      Tensor<1, dim> n; ///< 1 at the pivot
      double         g;
      unsigned       pivot;
      int            rank;
    };

    /// Adds an equation to those of its node that are reduced already, unless they decide it.
    template <int dim>
    void reduce_equation(Equation<dim>                      equation,
                         const unsigned                     n_components,
                         std::vector<ReducedEquation<dim>> &reduced,
                         std::vector<Contradiction>        &contradictions)
    {
      double size = std::abs(equation.g), largest_factor = 0;
      int    kept_rank = 0;
      for (const auto &earlier : reduced)
      {
        const double factor = equation.n[earlier.pivot];
        size += std::abs(factor * earlier.g);
        if (std::abs(factor) > largest_factor)
        {
          largest_factor = std::abs(factor);
          kept_rank = earlier.rank;
        }
        equation.n -= factor * earlier.n;
        equation.g -= factor * earlier.g;
      }
      unsigned pivot = 0;
      for (unsigned c = 1; c < n_components; ++c)
        if (std::abs(equation.n[c]) > std::abs(equation.n[pivot]))
          pivot = c;
      if (std::abs(equation.n[pivot]) < 1e-6)
      {
        // Decided by those before. Expressions for one value agree to round-off.
        if (std::abs(equation.g) > 1e-6 * size)
          contradictions.push_back({equation.rank, kept_rank, std::abs(equation.g)});
        return;
      }
      const double scale = equation.n[pivot];
      equation.n /= scale;
      equation.g /= scale;
      equation.n[pivot] = 1;
      for (auto &earlier : reduced)
      {
        const double factor = earlier.n[pivot];
        earlier.n -= factor * equation.n;
        earlier.g -= factor * equation.g;
        earlier.n[pivot] = 0;
      }
      reduced.push_back({equation.n, equation.g, pivot, equation.rank});
    }

    /// The equations that normals on planes of symmetry stand for.
    template <int dim>
    void add_equations_of_symmetry(Node<dim> &node)
    {
      for (const auto &[rank, normals] : node.symmetry)
        for (const auto &side : normals.sides())
          node.equations.push_back({side.normal(), 0, rank, true});
      node.symmetry.clear();
    }

    /// Reduces the equations of a node and adds what is left of them. Returns those that others contradict by more than round-off.
    template <int dim>
    std::vector<Contradiction> add_lines(Node<dim> &node, const unsigned n_components, AffineConstraints<double> &lines)
    {
      std::stable_sort(node.equations.begin(), node.equations.end(), [](const auto &a, const auto &b) { return a.rank < b.rank; });

      std::vector<ReducedEquation<dim>> reduced;
      std::vector<Contradiction>        contradictions;
      for (const auto &equation : node.equations)
        reduce_equation(equation, n_components, reduced, contradictions);
      for (const auto &equation : reduced)
      {
        const auto dof = node.dofs[equation.pivot];
        lines.add_line(dof);
        lines.set_inhomogeneity(dof, equation.g);
        for (unsigned c = 0; c < n_components; ++c)
          if (c != equation.pivot && std::abs(equation.n[c]) > 1e-12)
            lines.add_entry(dof, node.dofs[c], -equation.n[c]);
      }
      return contradictions;
    }

    /// Points on a face from which a node of it takes its normal: the nearest.
    template <int dim>
    Quadrature<dim - 1> normal_points(const FiniteElement<dim> &fe)
    {
      if constexpr (dim == 3)
        if (fe.reference_cell().is_simplex())
          return QGaussSimplex<2>(1);
      if constexpr (dim == 1)
        return QGauss<0>(1);
      else
        return QGaussLobatto<dim - 1>(std::max(fe.degree, 1u) + 1);
    }

    template <int dim>
    Tensor<1, dim> unit_vector(const unsigned component)
    {
      Tensor<1, dim> unit;
      unit[component] = 1;
      return unit;
    }

    /// The nodes of the boundary, with what the faces there, pins and the axis of a body of revolution say of them.
    template <int dim>
    class BoundaryNodes
    {
    public:
      using Nodes = std::map<types::global_dof_index, Node<dim>>; ///< by the first of the unknowns

      BoundaryNodes(const std::vector<PartCondition> &conditions,
                    const Mapping<dim>               &mapping,
                    const DoFHandler<dim>            &dof_handler,
                    const std::vector<Pin<dim>>      &pins,
                    const bool                        on_axis)
        : dof_handler(dof_handler), fe(dof_handler.get_fe()), pins(pins), on_axis(on_axis),
          prescriptions(prescriptions_of(conditions, fe.n_components())),
          normals(mapping, fe, normal_points<dim>(fe), update_quadrature_points | update_normal_vectors),
          points(mapping, fe.reference_cell(), fe.get_unit_support_points()), dofs(fe.n_dofs_per_cell())
      {
        for (const auto &vertex : dof_handler.get_triangulation().get_vertices())
          extent = std::max(extent, vertex.norm());
        for (const auto &cell : dof_handler.active_cell_iterators())
          for (const auto face : cell->face_indices())
            if (cell->at_boundary(face))
              visit(cell, face, prescriptions[cell->face(face)->boundary_id()]);
      }

      /// With their equations, those included that the faces of other processes give.
      Nodes with_equations(const SharedUnknowns &shared)
      {
        if (!shared.processes().alone())
        {
          // A process may have a node of the boundary and none of the faces there.
          shared.share(statements);
          std::set<types::global_dof_index> unseen;
          for (const auto &[dof, statement] : statements)
            if (!nodes.count(dof))
              unseen.insert(dof);
          for (const auto &[dof, unknowns] : unknowns_of_nodes(dof_handler, unseen))
            nodes[dof].dofs = unknowns;
        }
        for (const auto &[dof, statement] : statements)
          if (statement.symmetry)
            nodes[dof].symmetry[statement.rank].add(statement.n, statement.number);
          else
            nodes[dof].equations.push_back({statement.n, statement.number, statement.rank, false});
        return std::move(nodes);
      }

    private:
      using Cell = typename DoFHandler<dim>::active_cell_iterator;

      void visit(const Cell &cell, const unsigned face, const Prescription &prescription)
      {
        const bool prescribes = prescription.symmetry || std::any_of(prescription.components.begin(), prescription.components.end(),
                                                                     [](const auto &g) { return g.has_value(); });
        if (!prescribes && !on_axis && pins.empty())
          return;
        cell->get_dof_indices(dofs);
        const auto &nodes_of_cell = points.on(cell);
        if (prescription.symmetry)
          normals.reinit(cell, face);
        for (unsigned i = 0; i < dofs.size(); ++i)
        {
          const auto [component, shape] = fe.system_to_component_index(i);
          if (component != 0 || !lies_on_face<dim>(cell->reference_cell(), face, fe.unit_support_point(i)))
            continue;
          Node<dim> &node = nodes[dofs[i]];
          node.x = nodes_of_cell[i];
          for (unsigned c = 0; c < fe.n_components(); ++c)
            node.dofs[c] = dofs[fe.component_to_system_index(c, shape)];
          add_statements(dofs[i], node.x, cell->diameter(), prescription);
        }
      }

      /// Of a node @p x of a face, known by its first unknown.
      void add_statements(const types::global_dof_index dof, const Point<dim> &x, const double diameter, const Prescription &prescription)
      {
        for (unsigned c = 0; c < fe.n_components(); ++c)
          if (prescription.components[c])
            statements.push_back({dof, {unit_vector<dim>(c), prescription.components[c]->value(x), prescription.rank, false}});
        if (prescription.symmetry)
        {
          unsigned nearest = 0;
          for (unsigned q = 1; q < normals.n_quadrature_points; ++q)
            if (normals.quadrature_point(q).distance(x) < normals.quadrature_point(nearest).distance(x))
              nearest = q;
          statements.push_back({dof, {boundary_normal(normals, nearest), std::pow(diameter, dim - 1), prescription.rank, true}});
        }
        for (const auto &pin : pins)
          if (x.distance(pin.x) < 1e-8 * diameter)
            statements.push_back({dof, {unit_vector<dim>(pin.component), 0, std::numeric_limits<int>::max(), false}});
        if (on_axis && std::abs(x[0]) < 1e-12 * extent)
          statements.push_back({dof, {unit_vector<dim>(0), 0, -1, false}});
      }

      const DoFHandler<dim>                                          &dof_handler;
      const FiniteElement<dim>                                       &fe;
      const std::vector<Pin<dim>>                                    &pins;
      const bool                                                      on_axis;
      const std::vector<Prescription>                                 prescriptions; ///< by boundary_id
      double                                                          extent = 0;    ///< of the mesh from the origin
      FEFaceValues<dim>                                               normals;
      CellPoints<dim>                                                 points;
      std::vector<types::global_dof_index>                            dofs;
      Nodes                                                           nodes;
      std::vector<std::pair<types::global_dof_index, Statement<dim>>> statements;
    };

    /// The part whose Prescription::rank this is; empty for pins.
    std::string part_of_rank(const std::vector<PartCondition> &conditions, const int rank)
    {
      const int n = conditions.size();
      return rank < 1 ? "the axis" : rank > 2 * n ? "" : conditions[n - (rank > n ? rank - n : rank)].part;
    }

    /// Their first unknowns.
    template <int dim>
    std::set<types::global_dof_index> nodes_of_platens(const NodeCouplings<dim> &couplings)
    {
      std::set<types::global_dof_index> dofs;
      for (const auto &platen : couplings.rigid_parts)
        for (const auto &node : platen.nodes)
          dofs.insert(node.dofs[0]);
      return dofs;
    }

    /// What holds at the image of a node holds at the node, but for the jump. Nodes of platens keep their equations.
    template <int dim>
    void hand_over_equations(typename BoundaryNodes<dim>::Nodes &nodes, const NodeCouplings<dim> &couplings, const unsigned n_components)
    {
      const auto of_platens = nodes_of_platens(couplings);
      for (const auto &image : couplings.periodic.images())
      {
        const auto it = nodes.find(image.node.dofs[0]);
        if (it == nodes.end() || of_platens.count(image.node.dofs[0]))
          continue;
        Node<dim> &original = nodes[image.original.dofs[0]];
        original.x = image.original.x;
        original.dofs = image.original.dofs;
        for (Equation<dim> equation : it->second.equations)
        {
          for (unsigned c = 0; c < n_components; ++c)
            equation.g -= equation.n[c] * image.jump[c];
          original.equations.push_back(equation);
        }
        nodes.erase(image.node.dofs[0]);
      }
    }

    /// A platen that goes on beyond a plane of symmetry does not turn out of it: u.n = 0 at points of the plane beside the common nodes,
    /// too. Nodes of one part whose normals differ lie on no plane.
    template <int dim>
    void add_rotations_out_of_mirrors(const RigidPart<dim>                   &platen,
                                      const std::vector<PlatenEquation<dim>> &mirrors,
                                      std::vector<PlatenEquation<dim>>       &equations)
    {
      std::map<int, std::vector<const PlatenEquation<dim> *>> by_rank;
      for (const auto &mirror : mirrors)
        by_rank[mirror.rank].push_back(&mirror);
      for (const auto &[rank, of_part] : by_rank)
      {
        const auto &first = *of_part[0];
        if (std::any_of(of_part.begin(), of_part.end(), [&](const auto *mirror) { return std::abs(mirror->n * first.n) < 1 - 1e-8; }))
          continue;
        for (unsigned d = 0; d < dim; ++d)
        {
          const Tensor<1, dim> along = unit_vector<dim>(d) - first.n[d] * first.n;
          equations.push_back({first.n, 0, first.x + platen.length * along, first.x, rank});
        }
      }
    }

    /// The lines of platens, whose nodes leave @p nodes; returns the equations of these that do not hold.
    template <int dim>
    std::vector<DroppedValue<dim>> add_lines_of_platens(typename BoundaryNodes<dim>::Nodes &nodes,
                                                        const std::vector<PartCondition>   &conditions,
                                                        const bool                          on_axis,
                                                        NodeCouplings<dim>                 &couplings,
                                                        AffineConstraints<double>          &lines)
    {
      std::vector<DroppedValue<dim>> contradicted;
      for (auto &platen : couplings.rigid_parts)
      {
        std::vector<PlatenEquation<dim>>  equations, mirrors;
        std::set<types::global_dof_index> own;
        for (const auto &node : platen.nodes)
        {
          own.insert(node.dofs[0]);
          if (on_axis) // a ring that keeps its shape keeps its radius and does not tilt
            equations.push_back({unit_vector<dim>(0), 0, node.x, {}, -1});
          if (const auto it = nodes.find(node.dofs[0]); it != nodes.end())
          {
            for (const auto &equation : it->second.equations)
            {
              equations.push_back({equation.n, equation.g, node.x, {}, equation.rank});
              if (equation.symmetry)
                mirrors.push_back(equations.back());
            }
            nodes.erase(it);
          }
        }
        if (on_axis && dim == 2)
          // theta x (x - x_0): its difference across the radius
          equations.push_back({unit_vector<dim>(dim - 1), 0, platen.reference + unit_vector<dim>(0), platen.reference, -1});
        add_rotations_out_of_mirrors(platen, mirrors, equations);
        for (const auto &image : couplings.periodic.images())
          if (own.count(image.node.dofs[0]))
            for (unsigned c = 0; c < dim; ++c)
              equations.push_back({unit_vector<dim>(c), image.jump[c], image.node.x, image.original.x, 0});
        std::stable_sort(equations.begin(), equations.end(), [](const auto &a, const auto &b) { return a.rank < b.rank; });
        for (auto &[equation, difference] : add_rigid_lines(platen, equations, lines, couplings.ties))
        {
          if (equation.rank == 0)
            throw InputError(
              conditions[platen.part].where,
              fmt::format("the rigid part '{}' crosses periodic parts and cannot follow their jump", conditions[platen.part].part),
              MessageName("contradiction"));
          contradicted.push_back({equation.x, part_of_rank(conditions, equation.rank), conditions[platen.part].part, difference});
        }
      }
      return contradicted;
    }

    /// u at images from what it is at their originals; those of platens have lines already.
    template <int dim>
    void add_lines_of_images(const unsigned n_components, NodeCouplings<dim> &couplings, AffineConstraints<double> &lines)
    {
      const auto of_platens = nodes_of_platens(couplings);
      for (const auto &image : couplings.periodic.images())
        for (unsigned c = 0; c < n_components && !of_platens.count(image.node.dofs[0]); ++c)
        {
          const auto dof = image.node.dofs[c];
          lines.add_line(dof);
          lines.add_entry(dof, image.original.dofs[c], 1.);
          lines.set_inhomogeneity(dof, image.jump[c]);
          couplings.ties.push_back({dof, {{image.original.dofs[c], 1.}}});
        }
    }
  } // namespace

  template <int dim>
  AffineConstraints<double> make_dirichlet_conditions(const std::vector<PartCondition> &conditions,
                                                      const Mapping<dim>               &mapping,
                                                      const DoFHandler<dim>            &dof_handler,
                                                      const std::vector<Pin<dim>>      &pins,
                                                      const bool                        on_axis,
                                                      const AffineConstraints<double>  &hanging_nodes,
                                                      const SharedUnknowns             &shared,
                                                      std::vector<DroppedValue<dim>>   *dropped,
                                                      NodeCouplings<dim>               *couplings)
  {
    const unsigned            n_components = dof_handler.get_fe().n_components();
    auto                      nodes = BoundaryNodes<dim>(conditions, mapping, dof_handler, pins, on_axis).with_equations(shared);
    AffineConstraints<double> lines;
    for (auto &[first_dof, node] : nodes)
      add_equations_of_symmetry(node);
    if (couplings && !couplings->empty())
    {
      hand_over_equations<dim>(nodes, *couplings, n_components);
      for (const auto &value : add_lines_of_platens<dim>(nodes, conditions, on_axis, *couplings, lines))
        if (dropped)
          dropped->push_back(value);
      add_lines_of_images<dim>(n_components, *couplings, lines);
    }
    for (auto &[first_dof, node] : nodes)
      if (!hanging_nodes.is_constrained(first_dof))
        for (const auto &[rank, kept_rank, difference] : add_lines(node, n_components, lines))
          if (dropped && shared.owns(first_dof))
            dropped->push_back({node.x, part_of_rank(conditions, rank), part_of_rank(conditions, kept_rank), difference});
    for (const auto &line : hanging_nodes.get_lines())
    {
      lines.add_line(line.index);
      lines.add_entries(line.index, line.entries);
    }
    lines.close();
    return lines;
  }

#define INSTANTIATE(dim)                                                                                                                   \
  template AffineConstraints<double> make_dirichlet_conditions(                                                                            \
    const std::vector<PartCondition> &, const Mapping<dim> &, const DoFHandler<dim> &, const std::vector<Pin<dim>> &, bool,                \
    const AffineConstraints<double> &, const SharedUnknowns &, std::vector<DroppedValue<dim>> *, NodeCouplings<dim> *);
  INSTANTIATE(1)
  INSTANTIATE(2)
  INSTANTIATE(3)
#undef INSTANTIATE
} // namespace unilateral
