#include "unilateral/spaces/periodic_nodes.h"

#include <deal.II/fe/fe.h>

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace unilateral
{
  using namespace dealii;

  namespace
  {
    constexpr double matching_tolerance = 1e-9; ///< relative to the size of the parts

    template <int dim>
    Point<dim> mean_of(const std::vector<PartNode<dim>> &nodes)
    {
      Point<dim> mean;
      for (const auto &node : nodes)
        mean += node.x / double(nodes.size());
      return mean;
    }

    /// Finds the node at a point.
    template <int dim>
    class NodeFinder
    {
    public:
      explicit NodeFinder(const std::vector<PartNode<dim>> &nodes)
      {
        Point<dim> lower = nodes[0].x, upper = nodes[0].x;
        for (const auto &node : nodes)
          for (unsigned d = 0; d < dim; ++d)
          {
            lower[d] = std::min(lower[d], node.x[d]);
            upper[d] = std::max(upper[d], node.x[d]);
          }
        for (unsigned d = 1; d < dim; ++d)
          if (upper[d] - lower[d] > upper[widest] - lower[widest])
            widest = d;
        for (const auto &node : nodes)
          sorted.push_back(&node);
        std::sort(sorted.begin(), sorted.end(), [&](const auto *a, const auto *b) { return a->x[widest] < b->x[widest]; });
      }

      const PartNode<dim> *at(const Point<dim> &x, const double tolerance) const
      {
        auto it = std::lower_bound(sorted.begin(), sorted.end(), x[widest] - tolerance,
                                   [&](const auto *node, const double bound) { return node->x[widest] < bound; });
        for (; it != sorted.end() && (*it)->x[widest] <= x[widest] + tolerance; ++it)
          if ((*it)->x.distance(x) <= tolerance)
            return *it;
        return nullptr;
      }

    private:
      unsigned                           widest = 0; ///< the coordinate in which the nodes spread most
      std::vector<const PartNode<dim> *> sorted;
    };

    template <int dim>
    std::string coordinates_of(const Point<dim> &x)
    {
      std::string text = "(";
      for (unsigned d = 0; d < dim; ++d)
        text += fmt::format("{}{:.6g}", d > 0 ? ", " : "", x[d]);
      return text + ")";
    }

    /// Which nodes are one, but for jumps. Each points to another or is an original.
    template <int dim>
    class Classes
    {
    public:
      struct Link
      {
        PartNode<dim>  to;
        Tensor<1, dim> jump; ///< u here minus u there
      };

      Link original_of(const PartNode<dim> &node) const
      {
        Link link{node, {}};
        for (auto it = links.find(node.dofs[0]); it != links.end(); it = links.find(link.to.dofs[0]))
        {
          link.to = it->second.to;
          link.jump += it->second.jump;
        }
        return link;
      }

      /// u at @p image is u at @p node plus @p jump.
      void join(const PartNode<dim> &node, const PartNode<dim> &image, const Tensor<1, dim> &jump)
      {
        const Link a = original_of(node), b = original_of(image);
        if (a.to.dofs[0] != b.to.dofs[0])
        {
          links[b.to.dofs[0]] = {a.to, a.jump + jump - b.jump};
          nodes[b.to.dofs[0]] = b.to;
        }
      }

      std::vector<PeriodicImage<dim>> images() const
      {
        std::vector<PeriodicImage<dim>> result;
        for (const auto &[dof, node] : nodes)
        {
          const Link link = original_of(node);
          result.push_back({node, link.to, link.jump});
        }
        return result;
      }

    private:
      std::map<types::global_dof_index, Link>          links; ///< by the first unknown of a node
      std::map<types::global_dof_index, PartNode<dim>> nodes;
    };
  } // namespace

  template <int dim>
  PeriodicNodes<dim>::PeriodicNodes(const std::vector<PeriodicPair> &pairs,
                                    const Mapping<dim>              &mapping,
                                    const DoFHandler<dim>           &dof_handler,
                                    const AffineConstraints<double> &hanging_nodes,
                                    const bool                       is_part)
  {
    Classes<dim> classes;
    for (const PeriodicPair &pair : pairs)
    {
      const auto first = nodes_of_part(pair.first, mapping, dof_handler), second = nodes_of_part(pair.second, mapping, dof_handler);
      if (is_part && first.empty() && second.empty())
        continue;
      if (first.size() != second.size() || first.empty())
        throw InputError(pair.where,
                         fmt::format("the meshes of '{}' and '{}' do not match: {} nodes and {}; periodic parts need the same mesh, and "
                                     "local refinement has to be the same on both",
                                     pair.first_name, pair.second_name, first.size(), second.size()),
                         MessageName("parts-do-not-match"));
      const Tensor<1, dim> shift = mean_of(second) - mean_of(first);
      double               size = shift.norm();
      for (const auto &node : first)
        size = std::max(size, node.x.distance(first[0].x));
      const double          tolerance = matching_tolerance * size;
      const NodeFinder<dim> finder(second);
      Tensor<1, dim>        jump;
      for (std::size_t c = 0; c < pair.jump.size(); ++c)
        jump[c] = pair.jump[c];
      for (const auto &node : first)
      {
        const auto *const image = finder.at(node.x + shift, tolerance);
        if (!image || hanging_nodes.is_constrained(image->dofs[0]) != hanging_nodes.is_constrained(node.dofs[0]))
          throw InputError(pair.where,
                           fmt::format("the meshes of '{}' and '{}' do not match: there is no node of '{}' at {}, where that at {} of '{}' "
                                       "comes by the shift; periodic parts need the same mesh (in Gmsh: Periodic Curve, Periodic Surface), "
                                       "and local refinement has to be the same on both",
                                       pair.first_name, pair.second_name, pair.second_name, coordinates_of<dim>(node.x + shift),
                                       coordinates_of(node.x), pair.first_name),
                           MessageName("parts-do-not-match"));
        if (!hanging_nodes.is_constrained(node.dofs[0]))
          classes.join(node, *image, jump);
      }
    }
    all = classes.images();
    for (std::size_t k = 0; k < all.size(); ++k)
      for (unsigned c = 0; c < dof_handler.get_fe().n_components(); ++c)
        place[all[k].node.dofs[c]] = {k, c};
  }

  template <int dim>
  std::pair<const PeriodicImage<dim> *, unsigned> PeriodicNodes<dim>::image_with(const types::global_dof_index dof) const
  {
    const auto it = place.find(dof);
    if (it == place.end())
      return {nullptr, 0};
    return {&all[it->second.first], it->second.second};
  }

  template class PeriodicNodes<1>;
  template class PeriodicNodes<2>;
  template class PeriodicNodes<3>;
} // namespace unilateral
