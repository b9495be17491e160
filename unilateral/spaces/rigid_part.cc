#include "unilateral/spaces/rigid_part.h"

#include "unilateral/algebra/dense_solvers.h"

#include <algorithm>
#include <cmath>

namespace unilateral
{
  using namespace dealii;
  using Eigen::MatrixXd;
  using Eigen::VectorXd;

  template <int dim>
  bool RigidPart<dim>::prescribes_motion() const
  {
    const auto given = [](const auto &motion) { return motion.has_value(); };
    return std::any_of(translation.begin(), translation.end(), given) || std::any_of(rotation.begin(), rotation.end(), given);
  }

  template <int dim>
  RigidPart<dim> make_rigid_part(const types::boundary_id         part,
                                 const PartCondition             &condition,
                                 const Point<dim>                &centroid,
                                 const Mapping<dim>              &mapping,
                                 const DoFHandler<dim>           &dof_handler,
                                 const AffineConstraints<double> &hanging_nodes)
  {
    RigidPart<dim> platen;
    platen.part = part;
    platen.reference = centroid;
    for (std::size_t d = 0; d < condition.about.size(); ++d)
      platen.reference[d] = condition.about[d];
    platen.translation.resize(dim);
    platen.rotation.resize(RigidMotion<dim>::n_rotations);
    const auto set = [](auto &motions, const auto &given)
    {
      for (std::size_t c = 0; c < std::min(motions.size(), given.size()); ++c)
        if (given[c])
          motions[c] = given[c]->value(Point<dim>());
    };
    set(platen.translation, condition.components);
    set(platen.rotation, condition.rotations);
    for (const auto &node : nodes_of_part(part, mapping, dof_handler))
      if (!hanging_nodes.is_constrained(node.dofs[0]))
      {
        platen.nodes.push_back(node);
        platen.length = std::max(platen.length, node.x.distance(platen.reference));
      }
    return platen;
  }

  namespace
  {
    /// A value at a node of a platen: offset + motions.z
    struct PlatenValue
    {
      types::global_dof_index dof;
      bool                    at_vertex;
      double                  offset;
    };

    /// As many rows as @p motions has columns, from which the others follow: elimination, the largest entry left being the next pivot.
    std::vector<Eigen::Index> best_rows(MatrixXd motions, const std::vector<PlatenValue> &values)
    {
      // The meshes that multigrid coarsens to have vertices in common, but no other nodes.
      for (Eigen::Index i = 0; i < motions.rows(); ++i)
        if (!values[i].at_vertex)
          motions.row(i) *= 0.5;
      std::vector<Eigen::Index> rows;
      for (Eigen::Index k = 0; k < motions.cols(); ++k)
      {
        Eigen::Index row, column;
        motions.cwiseAbs().maxCoeff(&row, &column);
        rows.push_back(row);
        const VectorXd           pivot_column = motions.col(column) / motions(row, column);
        const Eigen::RowVectorXd pivot_row = motions.row(row);
        motions -= pivot_column * pivot_row;
      }
      return rows;
    }
  } // namespace

  template <int dim>
  std::vector<std::pair<PlatenEquation<dim>, double>> add_rigid_lines(RigidPart<dim>                         &platen,
                                                                      const std::vector<PlatenEquation<dim>> &equations,
                                                                      AffineConstraints<double>              &lines,
                                                                      std::vector<TiedUnknown>               &ties)
  {
    if (platen.nodes.empty()) // another process has them
      return {};
    RigidMotion<dim> motion(platen.reference, platen.length);
    for (unsigned c = 0; c < platen.translation.size(); ++c)
      if (platen.translation[c])
        motion.prescribe(motion.row_of_translation(c), *platen.translation[c]);
    for (unsigned a = 0; a < platen.rotation.size(); ++a)
      if (platen.rotation[a])
        motion.prescribe(motion.row_of_rotation(a), *platen.rotation[a]);
    std::vector<std::pair<PlatenEquation<dim>, double>> contradicted;
    for (const auto &equation : equations)
    {
      Eigen::RowVectorXd row = motion.row(equation.n, equation.x);
      if (equation.other)
        row -= motion.row(equation.n, *equation.other);
      if (const double difference = motion.prescribe(row, equation.g); difference > 0)
        contradicted.push_back({equation, difference});
    }

    const VectorXd particular = motion.particular();
    const MatrixXd free = motion.free_motions();
    platen.restrained = free.cols() < free.rows();
    MatrixXd                 motions(platen.nodes.size() * dim, free.cols());
    std::vector<PlatenValue> values;
    for (const auto &node : platen.nodes)
      for (unsigned c = 0; c < dim; ++c)
      {
        const Eigen::RowVectorXd row = motion.row(c, node.x);
        motions.row(values.size()) = row * free;
        values.push_back({node.dofs[c], node.at_vertex, row.dot(particular)});
      }
    const auto     masters = best_rows(motions, values);
    const MatrixXd of_masters = motions(masters, Eigen::all);
    // motions = factors * of_masters
    const MatrixXd factors = free.cols() > 0 ? MatrixXd(of_masters.transpose().partialPivLu().solve(motions.transpose()).transpose())
                                             : MatrixXd(motions.rows(), 0);
    for (std::size_t i = 0; i < values.size(); ++i)
    {
      if (std::find(masters.begin(), masters.end(), Eigen::Index(i)) != masters.end())
        continue;
      TiedUnknown tie{values[i].dof, {}};
      double      constant = values[i].offset;
      for (std::size_t k = 0; k < masters.size(); ++k)
        if (const double factor = factors(i, k); std::abs(factor) > 1e-12)
        {
          tie.entries.emplace_back(values[masters[k]].dof, factor);
          constant -= factor * values[masters[k]].offset;
        }
      lines.add_line(tie.dof);
      lines.add_entries(tie.dof, tie.entries);
      lines.set_inhomogeneity(tie.dof, constant);
      ties.push_back(std::move(tie));
    }
    return contradicted;
  }

#define INSTANTIATE(dim)                                                                                                                   \
  template struct RigidPart<dim>;                                                                                                          \
  template RigidPart<dim> make_rigid_part(types::boundary_id, const PartCondition &, const Point<dim> &, const Mapping<dim> &,             \
                                          const DoFHandler<dim> &, const AffineConstraints<double> &);                                     \
  template std::vector<std::pair<PlatenEquation<dim>, double>> add_rigid_lines(RigidPart<dim> &, const std::vector<PlatenEquation<dim>> &, \
                                                                               AffineConstraints<double> &, std::vector<TiedUnknown> &);
  INSTANTIATE(1)
  INSTANTIATE(2)
  INSTANTIATE(3)
#undef INSTANTIATE
} // namespace unilateral
