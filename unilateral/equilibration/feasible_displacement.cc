#include "unilateral/equilibration/feasible_displacement.h"

#include "unilateral/algebra/dense_solvers.h"
#include "unilateral/constraints/direction_of_contact.h"
#include "unilateral/equilibration/contact_gap.h"
#include "unilateral/equilibration/face_blend.h"
#include "unilateral/equilibration/jumping_gaps.h"
#include "unilateral/equilibration/jumps.h"
#include "unilateral/equilibration/prescribed_directions.h"
#include "unilateral/equilibration/steps_together.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace unilateral
{
  using namespace dealii;

  namespace
  {
    /// Points of a side, its ends the last of them, that are looked at; in space, of a face.
    template <int dim>
    std::vector<Point<dim - 1>> points_to_check(const bool simplex, const unsigned degree)
    {
      std::vector<Point<dim - 1>> points = rule_on_face<dim>(simplex, 2 * degree + 5).get_points();
      for (const auto &row : equidistant_rows<dim>(simplex))
        points.insert(points.end(), row.begin(), row.end());
      points.emplace_back();
      for (unsigned d = 0; d + 1 < dim; ++d)
        points.push_back(Point<dim - 1>(Point<dim - 1>::unit_vector(d)));
      if (dim == 3 && !simplex)
        points.push_back(points[points.size() - 1] + points[points.size() - 2]);
      return points;
    }
  } // namespace

  template <int dim>
  FeasibleDisplacement<dim>::OnFace::OnFace(const FiniteElement<dim>          &scalar,
                                            const unsigned                     face,
                                            const std::vector<Point<dim - 1>> &points)
    : points(points)
  {
    const bool                  simplex = scalar.reference_cell().is_simplex();
    const TabulatedElement<dim> table(scalar, on_reference_cell<dim>(simplex, face, Quadrature<dim - 1>(points)));
    const StraightFace<dim>     reference(reference_corners<dim>(simplex), simplex, face);
    values = table.values;
    slopes = Eigen::MatrixXd::Zero(points.size(), values.cols());
    for (unsigned d = 0; d < dim; ++d)
      slopes += reference.edges[0][d] * table.gradients[d];
  }

  template <int dim>
  FeasibleDisplacement<dim>::FeasibleDisplacement(const Problem<dim> &problem, const Vector &u, const std::vector<Vector> &pressures)
    : problem(problem), u(u), pressures(pressures), moved(u), vertices(problem.space.mesh.triangulation->n_vertices()),
      size(problem.space.processes().max(u.linfty_norm())), processes(problem.space.processes())
  {
    const auto points = points_to_check<dim>(problem.space.element.simplex(), problem.space.element.degree);
    for (unsigned f = 0; f < scalar().reference_cell().n_faces(); ++f)
      to_check.emplace_back(scalar(), f, points);
    step_together(reason, processes,
                  [&]
                  {
                    find_contact_faces();
                    hold_vertices();
                  });
    share_held_directions();
    if (reason.empty() && !problem.null_space.empty())
      move_as_a_whole();
    if (reason.empty())
      move_off_obstacles();
    step_together(reason, processes, [&] { check_faces(); });
    step_together(reason, processes, [&] { look_for_jumps(); });
  }

  template <int dim>
  void FeasibleDisplacement<dim>::find_contact_faces()
  {
    for (const auto &cell : problem.space.dof_handler.active_cell_iterators())
      for (const unsigned f : cell->face_indices())
        for (std::size_t b = 0; problem.space.is_outside(cell, f) && b < problem.conditions.size(); ++b)
        {
          const auto &condition = problem.conditions[b];
          if (!condition.part || *condition.part != cell->face(f)->boundary_id())
            continue;
          const StraightFace<dim> geometry(cell, f);
          if (const auto direction = direction_of_contact<dim>(condition.direction, condition.surface.get());
              direction && *direction * geometry.normal < 1 - 1e-12)
            reason = fmt::format("contact on '{}' acts in a direction that is not its normal", condition.on);
          if (condition.round)
            reason = fmt::format("contact on '{}' acts along the normals of the round surface that its facets stand for", condition.on);
          contact_of_cell[cell->active_cell_index()].push_back(contact.size());
          contact.push_back({cell, f, b, geometry});
        }
  }

  template <int dim>
  void FeasibleDisplacement<dim>::hold_vertices()
  {
    for (const auto &cell : problem.space.dof_handler.active_cell_iterators())
      for (const unsigned f : cell->face_indices())
        if (problem.space.is_outside(cell, f))
        {
          const auto directions =
            prescribed_directions<dim>(problem.prescribed.conditions[cell->face(f)->boundary_id()], StraightFace<dim>(cell, f).normal);
          for (const unsigned v : cell->face(f)->vertex_indices())
          {
            auto &held = vertices[cell->face(f)->vertex_index(v)].held;
            held.insert(held.end(), directions.begin(), directions.end());
          }
        }
  }

  namespace
  {
    /// What belongs to vertices, that of other processes taken in, in the same order on each that has the vertex. @p at: by vertex.
    template <int dim, typename Record>
    void share_at_vertices(const FunctionSpace<dim> &space, std::vector<std::vector<Record>> &at)
    {
      if (space.processes().alone())
        return;
      std::map<unsigned, unsigned> vertex_of; // by its first unknown
      for (const auto &cell : space.dof_handler.active_cell_iterators())
        for (const unsigned v : cell->vertex_indices())
          if (const auto dof = cell->vertex_dof_index(v, 0); space.shared().shares(dof))
            vertex_of[dof] = cell->vertex_index(v);
      std::vector<std::pair<unsigned, Record>> records;
      for (const auto &[dof, vertex] : vertex_of)
        for (const Record &record : at[vertex])
          records.emplace_back(dof, record);
      space.shared().share(records);
      for (const auto &[dof, vertex] : vertex_of)
        at[vertex].clear();
      for (const auto &[dof, record] : records)
        at[vertex_of.at(dof)].push_back(record);
    }
  } // namespace

  template <int dim>
  void FeasibleDisplacement<dim>::share_held_directions()
  {
    std::vector<std::vector<Tensor<1, dim>>> held;
    for (const AtVertex &vertex : vertices)
      held.push_back(vertex.held);
    share_at_vertices(problem.space, held);
    for (std::size_t v = 0; v < vertices.size(); ++v)
      vertices[v].held = std::move(held[v]);
  }

  template <int dim>
  Eigen::MatrixXd FeasibleDisplacement<dim>::on_cell(const Vector &w, const Cell &cell) const
  {
    std::vector<types::global_dof_index> dofs(problem.space.fe->n_dofs_per_cell());
    cell->get_dof_indices(dofs);
    Eigen::MatrixXd values(dofs.size() / dim, dim);
    for (unsigned i = 0; i < dofs.size(); ++i)
    {
      const auto [component, node] = problem.space.fe->system_to_component_index(i);
      values(node, component) = w(dofs[i]);
    }
    return values;
  }

  template <int dim>
  Eigen::VectorXd FeasibleDisplacement<dim>::along(const Vector &p, const Cell &cell, const Tensor<1, dim> &n) const
  {
    return on_cell(p, cell) * Eigen::Map<const Eigen::VectorXd>(n.begin_raw(), dim);
  }

  template <int dim>
  std::vector<unsigned> FeasibleDisplacement<dim>::nodes_on(const ContactFace &at) const
  {
    const bool              simplex = problem.space.element.simplex();
    const StraightFace<dim> reference(reference_corners<dim>(simplex), simplex, at.face);
    const auto             &nodes = scalar().get_unit_support_points();
    std::vector<unsigned>   result;
    for (unsigned i = 0; i < nodes.size(); ++i)
      if (std::abs((nodes[i] - reference.origin) * reference.normal) < 1e-10)
        result.push_back(i);
    return result;
  }

  template <int dim>
  void FeasibleDisplacement<dim>::put_nodes_of_faces(const bool closed)
  {
    const bool                           simplex = problem.space.element.simplex();
    const auto                          &nodes = scalar().get_unit_support_points();
    std::vector<types::global_dof_index> dofs(problem.space.fe->n_dofs_per_cell());
    for (const auto &at : contact)
    {
      if (in_contact(at) != closed)
        continue;
      const StraightFace<dim> reference(reference_corners<dim>(simplex), simplex, at.face);
      const Eigen::VectorXd   w = along(moved, at.cell, at.geometry.normal);
      at.cell->get_dof_indices(dofs);
      for (const unsigned i : nodes_on(at))
      {
        const auto gap =
          contact_gap<dim>(problem.conditions[at.condition], at.geometry.at(reference.parameters(nodes[i])), at.geometry.normal);
        bool is_free = gap && (closed || w(i) > *gap);
        for (unsigned c = 0; c < dim; ++c)
          is_free = is_free && (std::abs(at.geometry.normal[c]) < 1e-10 ||
                                !problem.space.dirichlet.is_constrained(dofs[problem.space.fe->component_to_system_index(c, i)]));
        for (unsigned c = 0; c < dim && is_free; ++c)
          moved(dofs[problem.space.fe->component_to_system_index(c, i)]) += (*gap - w(i)) * at.geometry.normal[c];
      }
    }
  }

  template <int dim>
  void FeasibleDisplacement<dim>::put_nodes_into_contact()
  {
    // Open faces only take back what penetrates, and come first.
    for (const bool closed : {false, true})
    {
      const Vector before(moved);
      step_together(reason, processes, [&] { put_nodes_of_faces(closed); });
      agree_at_cuts(before);
    }
    problem.space.hanging_nodes.distribute(moved);
  }

  /// Unknowns on cuts have moved as far as on the process where they moved most.
  template <int dim>
  void FeasibleDisplacement<dim>::agree_at_cuts(const Vector &before)
  {
    if (processes.alone())
      return;
    Vector down(moved), up(before);
    down -= before;
    up -= moved;
    problem.space.shared().minimize(down.begin());
    problem.space.shared().minimize(up.begin());
    for (const auto dof : problem.space.shared().all())
      moved(dof) = before(dof) + (-down(dof) > -up(dof) ? down(dof) : -up(dof));
  }

  template <int dim>
  void FeasibleDisplacement<dim>::add_move(std::vector<Move> &moves, const Move &move) const
  {
    for (auto &[normal, known] : moves)
      if (normal * move.normal > 1 - 1e-10)
      {
        known = std::max(known, move.amount);
        return;
      }
    moves.push_back(move);
  }

  template <int dim>
  void FeasibleDisplacement<dim>::add_move(const ContactFace &at, const unsigned corner, const double amount)
  {
    add_move(vertices[at.cell->vertex_index(corner)].moves, {at.geometry.normal, amount});
  }

  template <int dim>
  void FeasibleDisplacement<dim>::share_moves()
  {
    if (processes.alone())
      return;
    std::vector<std::vector<Move>> moves;
    for (const AtVertex &vertex : vertices)
      moves.push_back(vertex.moves);
    share_at_vertices(problem.space, moves);
    for (std::size_t v = 0; v < vertices.size(); ++v)
    {
      vertices[v].moves.clear();
      for (const Move &move : moves[v])
        add_move(vertices[v].moves, move);
    }
  }

  template <int dim>
  void FeasibleDisplacement<dim>::move_as_a_whole()
  {
    // Least squares, weighted with the pressure.
    const unsigned  n_modes = problem.null_space.size();
    Eigen::MatrixXd matrix = Eigen::MatrixXd::Zero(n_modes, n_modes);
    Eigen::VectorXd right = Eigen::VectorXd::Zero(n_modes), along_normal(n_modes);
    const auto      add_face = [&](const ContactFace &at)
    {
      const Eigen::VectorXd pressure = along(pressures[at.condition], at.cell, at.geometry.normal);
      if (pressure.isZero(0))
        return;
      const auto           &points = to_check[at.face].points;
      const auto           &values = to_check[at.face].values;
      const Eigen::VectorXd w = values * along(u, at.cell, at.geometry.normal), weight = values * pressure;
      for (unsigned q = 0; q < points.size(); ++q)
      {
        const Point<dim> x = at.geometry.at(points[q]);
        const auto       gap = contact_gap<dim>(problem.conditions[at.condition], x, at.geometry.normal);
        if (!gap || !(weight(q) > 0))
          continue;
        for (unsigned k = 0; k < n_modes; ++k)
          along_normal(k) = problem.null_space[k].value(x) * at.geometry.normal;
        matrix += weight(q) * at.geometry.dS * along_normal * along_normal.transpose();
        right -= weight(q) * at.geometry.dS * (w(q) - *gap) * along_normal;
      }
    };
    step_together(reason, processes, [&] { std::for_each(contact.begin(), contact.end(), add_face); });
    processes.sum(matrix.data(), matrix.size());
    processes.sum(right.data(), right.size());
    Eigen::CompleteOrthogonalDecomposition<Eigen::MatrixXd> solver;
    solver.setThreshold(1e-9);
    solver.compute(matrix);
    const Eigen::VectorXd amounts = solver.solve(right);
    for (const auto &node : problem.space.nodal_values())
      for (unsigned k = 0; k < n_modes; ++k)
        moved(node.dof) += amounts(k) * problem.null_space[k].value(node.x)[node.component];
    problem.space.hanging_nodes.distribute(moved);
  }

  template <int dim>
  typename FeasibleDisplacement<dim>::Penetration FeasibleDisplacement<dim>::find_penetration(const double tolerance)
  {
    Penetration result{false, std::vector<double>(contact.size(), 0.), std::vector<double>(problem.conditions.size(), 0.)};
    for (std::size_t k = 0; k < contact.size(); ++k)
    {
      const auto           &at = contact[k];
      const auto           &points = to_check[at.face].points;
      const auto            corners = corners_of_face<dim>(problem.space.element.simplex(), at.face);
      const Eigen::VectorXd w = to_check[at.face].values * along(moved, at.cell, at.geometry.normal);
      for (unsigned q = dim == 2 ? points.size() - 2 : 0; q < points.size(); ++q)
        if (const auto gap = contact_gap<dim>(problem.conditions[at.condition], at.geometry.at(points[q]), at.geometry.normal))
        {
          const double penetration = w(q) - *gap;
          if (penetration <= tolerance)
            continue;
          if (dim == 2)
            add_move(at, corners[q - (points.size() - 2)], penetration);
          result.any = true;
          result.of_face[k] = std::max(result.of_face[k], penetration);
          result.of_condition[at.condition] = std::max(result.of_condition[at.condition], penetration);
        }
    }
    return result;
  }

  template <int dim>
  void FeasibleDisplacement<dim>::move_off_obstacles()
  {
    if (dim == 3)
      put_nodes_into_contact();
    for (unsigned pass = 0; pass < 3 && reason.empty(); ++pass)
    {
      Penetration found;
      step_together(reason, processes, [&] { found = find_penetration((pass > 0 ? 1e-12 : 0.) * size); });
      if (!reason.empty() || !processes.any(found.any))
        return;
      processes.max(found.of_condition.data(), found.of_condition.size());
      if (pass == 2 && held_in_the_way)
        reason = "the displacement penetrates an obstacle where it is prescribed";
      else if (pass == 2)
        reason = "the displacement penetrates an obstacle between the points of the rule by more than can be mended";
      // Where vertices hang on others, the second time all go as far as the worst.
      if (dim == 3)
        for (std::size_t k = 0; k < contact.size(); ++k)
          if (const double amount = pass == 0 ? found.of_face[k] : found.of_condition[contact[k].condition]; amount > 0)
            for (const unsigned v : corners_of_face<dim>(problem.space.element.simplex(), contact[k].face))
              add_move(contact[k], v, amount);
      share_moves();
      apply_moves();
      held_in_the_way = processes.any(held_in_the_way);
      reason = first_reason(reason, processes);
    }
  }

  /// How far along each normal, all together: by @p moves where no two of them point against each other. Else a move off one face brings
  /// the vertex nearer to the other, and c with sum_l min(n_k.n_l, 0) c_l + c_k = amount_k takes it off both, if there is one that is not
  /// negative. Empty: there is none.
  template <int dim>
  std::vector<double> FeasibleDisplacement<dim>::amounts_together(const std::vector<Move> &moves)
  {
    const Eigen::Index n = moves.size();
    Eigen::MatrixXd    approach = Eigen::MatrixXd::Identity(n, n);
    Eigen::VectorXd    needed(n);
    for (Eigen::Index k = 0; k < n; ++k)
    {
      needed(k) = moves[k].amount;
      for (Eigen::Index l = 0; l < n; ++l)
        if (l != k)
          approach(k, l) = std::min(moves[k].normal * moves[l].normal, 0.);
    }
    const Eigen::VectorXd together = approach.partialPivLu().solve(needed);
    constexpr double      farthest = 100; // a wedge of less than a degree
    const bool            serves =
      n == 0 || (together.allFinite() && together.minCoeff() >= 0 && together.maxCoeff() <= farthest * needed.maxCoeff() &&
                 (approach * together - needed).cwiseAbs().maxCoeff() <= 1e-10 * needed.maxCoeff());
    return serves ? std::vector<double>(together.begin(), together.end()) : std::vector<double>();
  }

  template <int dim>
  void FeasibleDisplacement<dim>::apply_moves()
  {
    std::vector<Tensor<1, dim>> move(vertices.size());
    for (std::size_t v = 0; v < vertices.size(); ++v)
    {
      auto &[held, moves] = vertices[v];
      const std::vector<double> amounts = amounts_together(moves);
      if (amounts.size() < moves.size())
        reason = "contact faces meet at an acute angle";
      for (std::size_t a = 0; a < amounts.size(); ++a)
        move[v] -= amounts[a] * moves[a].normal;
      // Whole faces move by what is needed in one place, which need not be at this vertex.
      for (const auto &direction : held)
      {
        held_in_the_way = held_in_the_way || std::abs(move[v] * direction) > 1e-9 * size;
        move[v] -= (move[v] * direction) * direction;
      }
      moves.clear();
    }
    std::vector<types::global_dof_index> dofs(problem.space.fe->n_dofs_per_cell());
    const TabulatedElement<dim>          nodes(scalar(), Quadrature<dim>(scalar().get_unit_support_points()));
    Vector                               before(moved);
    for (const auto &cell : problem.space.dof_handler.active_cell_iterators())
    {
      bool any = false;
      for (const unsigned v : cell->vertex_indices())
        any = any || move[cell->vertex_index(v)].norm() > 0;
      if (!any)
        continue;
      cell->get_dof_indices(dofs);
      for (unsigned i = 0; i < dofs.size(); ++i)
      {
        const auto [component, node] = problem.space.fe->system_to_component_index(i);
        double sum = 0;
        for (const unsigned v : cell->vertex_indices())
          sum += nodes.vertex_values(node, v) * move[cell->vertex_index(v)][component];
        moved(dofs[i]) = before(dofs[i]) + sum;
      }
    }
    problem.space.hanging_nodes.distribute(moved);
  }

  template <int dim>
  bool FeasibleDisplacement<dim>::in_contact(const ContactFace &at) const
  {
    const Eigen::VectorXd pressure = along(pressures[at.condition], at.cell, at.geometry.normal);
    if (problem.conditions[at.condition].rule.family == RuleName::Family::edges)
      return pressure.maxCoeff() > 0 && (pressure.array() > 0).count() >= (dim == 2 ? 1 : 3) * (problem.space.element.degree - 1);
    for (const unsigned i : nodes_on(at))
      if (!(pressure(i) > 0))
        return false;
    return true;
  }

  template <int dim>
  void FeasibleDisplacement<dim>::add_contact_excess(const ContactFace &at, const OnFace &feet, std::vector<Excess> &result) const
  {
    const auto           &condition = problem.conditions[at.condition];
    const Tensor<1, dim> &n = at.geometry.normal, &edge = at.geometry.edges[0];
    const Eigen::VectorXd w = along(moved, at.cell, n);
    Eigen::VectorXd       gaps = Eigen::VectorXd::Zero(w.size());
    const bool            simplex = problem.space.element.simplex(), closed = in_contact(at);
    if (closed)
    {
      const StraightFace<dim> reference(reference_corners<dim>(simplex), simplex, at.face);
      const auto             &nodes = scalar().get_unit_support_points();
      for (const unsigned i : nodes_on(at))
        gaps(i) = contact_gap<dim>(condition, at.geometry.at(reference.parameters(nodes[i])), n).value_or(0.);
    }
    for (std::size_t q = 0; q < feet.points.size(); ++q)
    {
      const Point<dim> x = at.geometry.at(feet.points[q]);
      const auto       gap = contact_gap<dim>(condition, x, n);
      if (!gap)
        continue;
      const double before = feet.values.row(q).dot(w) + result[q].value * n, slope_before = feet.slopes.row(q).dot(w) + result[q].slope * n;
      const double more = closed ? *gap - feet.values.row(q).dot(gaps) : 0.;
      if (before + more <= *gap && more == 0)
        continue;
      const double gap_slope = gradient_of_contact_gap<dim>(condition, x, n, *gap) * edge;
      if (before + more > *gap)
      {
        result[q].value += (*gap - before) * n;
        result[q].slope += (gap_slope - slope_before) * n;
      }
      else
      {
        result[q].value += more * n;
        result[q].slope += (gap_slope - feet.slopes.row(q).dot(gaps)) * n;
      }
    }
  }

  template <int dim>
  void FeasibleDisplacement<dim>::add_prescribed_excess(const Cell          &cell,
                                                        const unsigned       face,
                                                        const OnFace        &feet,
                                                        std::vector<Excess> &result) const
  {
    const PartCondition    &condition = problem.prescribed.conditions[cell->face(face)->boundary_id()];
    const StraightFace<dim> geometry(cell, face);
    const Eigen::MatrixXd   w = on_cell(u, cell);
    std::vector<Point<dim>> x;
    for (const auto &foot : feet.points)
      x.push_back(geometry.at(foot));
    for (unsigned c = 0; c < condition.components.size() && c < dim; ++c)
      if (condition.components[c])
      {
        std::vector<double>         given;
        std::vector<Tensor<1, dim>> gradients;
        condition.components[c]->values_and_gradients(x, given, gradients);
        for (std::size_t q = 0; q < feet.points.size(); ++q)
        {
          result[q].value[c] += given[q] - feet.values.row(q).dot(w.col(c));
          result[q].slope[c] += gradients[q] * geometry.edges[0] - feet.slopes.row(q).dot(w.col(c));
        }
      }
    if (condition.symmetry)
    {
      const Eigen::VectorXd across = along(u, cell, geometry.normal);
      for (std::size_t q = 0; q < feet.points.size(); ++q)
      {
        result[q].value -= feet.values.row(q).dot(across) * geometry.normal;
        result[q].slope -= feet.slopes.row(q).dot(across) * geometry.normal;
      }
    }
  }

  template <int dim>
  std::vector<typename FeasibleDisplacement<dim>::Excess>
  FeasibleDisplacement<dim>::excess_at(const Cell &cell, const unsigned face, const OnFace &feet) const
  {
    std::vector<Excess> result(feet.points.size());
    add_prescribed_excess(cell, face, feet, result);
    if (const auto own = contact_of_cell.find(cell->active_cell_index()); dim == 2 && own != contact_of_cell.end())
      for (const unsigned k : own->second)
        if (contact[k].face == face)
          add_contact_excess(contact[k], feet, result);
    return result;
  }

  template <int dim>
  void FeasibleDisplacement<dim>::check_faces()
  {
    for (const auto &cell : problem.space.dof_handler.active_cell_iterators())
      for (const unsigned f : cell->face_indices())
      {
        if (!problem.space.is_outside(cell, f))
          continue;
        const auto excess = excess_at(cell, f, to_check[f]);
        double     largest = 0, at_ends = 0;
        for (std::size_t q = 0; q < excess.size(); ++q)
        {
          largest = std::max(largest, excess[q].value.norm());
          if (q + 2 >= excess.size())
            at_ends = std::max(at_ends, excess[q].value.norm());
        }
        if (largest <= 1e-12 * size)
          continue;
        if (dim == 3)
          reason = "the prescribed displacements are no functions of the finite elements, which only plane meshes can bridge";
        else if (at_ends > 1e-9 * size)
          reason = "prescribed displacements, or these and a gap, contradict each other in a corner";
        else
          lifts[cell->active_cell_index()].push_back(f);
      }
  }

  template <int dim>
  bool FeasibleDisplacement<dim>::touches(const ContactFace &at) const
  {
    if (in_contact(at))
      return true;
    const auto           &points = to_check[at.face].points;
    const Eigen::VectorXd w = to_check[at.face].values * along(moved, at.cell, at.geometry.normal);
    for (std::size_t q = 0; q < points.size(); ++q)
      if (const auto gap = contact_gap<dim>(problem.conditions[at.condition], at.geometry.at(points[q]), at.geometry.normal);
          gap && w(q) >= *gap - 1e-9 * size)
        return true;
    return false;
  }

  template <int dim>
  void FeasibleDisplacement<dim>::look_for_jumps()
  {
    JumpingGaps<dim> jumping(problem.space.element.simplex(), size);
    for (const ContactFace &at : contact)
      if (const auto &condition = problem.conditions[at.condition]; (condition.surface || !condition.bound.is_constant()) && touches(at) &&
                                                                    jumping.jumps_on(condition, at.cell, at.face, at.geometry))
      {
        reason = "a gap jumps where it is touched: no displacement of finite energy keeps it everywhere and touches it";
        return;
      }
  }

  template <int dim>
  void FeasibleDisplacement<dim>::evaluate(const Cell                                 &cell,
                                           const TabulatedElement<dim>                &tabulated,
                                           const typename StraightCell<dim>::AtPoints &at,
                                           AtPoints                                   &state) const
  {
    const unsigned n = tabulated.size();
    const auto     fill = [&](const Vector &w, std::vector<Tensor<1, dim>> &values, std::vector<Tensor<2, dim>> &gradients)
    {
      const Eigen::MatrixXd            nodes = on_cell(w, cell), of_w = tabulated.values * nodes;
      std::array<Eigen::MatrixXd, dim> slopes;
      for (unsigned d = 0; d < dim; ++d)
        slopes[d] = tabulated.gradients[d] * nodes;
      values.resize(n);
      gradients.resize(n);
      for (unsigned q = 0; q < n; ++q)
      {
        Tensor<2, dim> reference;
        for (unsigned c = 0; c < dim; ++c)
        {
          values[q][c] = of_w(q, c);
          for (unsigned d = 0; d < dim; ++d)
            reference[c][d] = slopes[d](q, c);
        }
        gradients[q] = reference * at.inverse[q];
      }
    };
    fill(u, state.u, state.u_gradient);
    fill(moved, state.v, state.v_gradient);
    if constexpr (dim == 2)
    {
      const auto own = lifts.find(cell->active_cell_index());
      if (own == lifts.end())
        return;
      for (const unsigned f : own->second)
      {
        const FaceBlend       blend = face_blend(problem.space.element.simplex(), f, tabulated.points);
        std::vector<Point<1>> feet;
        for (const double foot : blend.foot)
          feet.emplace_back(foot);
        const auto excess = excess_at(cell, f, OnFace(scalar(), f, feet));
        for (unsigned q = 0; q < n; ++q)
        {
          state.v[q] += blend.fading[q] * excess[q].value;
          state.v_gradient[q] +=
            (outer_product(excess[q].value, blend.fading_gradient[q]) + outer_product(excess[q].slope, blend.slope[q])) * at.inverse[q];
        }
      }
    }
  }

  template class FeasibleDisplacement<2>;
  template class FeasibleDisplacement<3>;
} // namespace unilateral
