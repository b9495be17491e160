#include "unilateral/evaluation/error_of_free_boundary.h"

#include "unilateral/discretisation/points_by_cell.h"

#include <algorithm>
#include <cmath>

namespace unilateral
{
  namespace
  {
    /// Sums at the points of K_h over the cells that have them, and of how many.
    struct MeansAtPoints
    {
      explicit MeansAtPoints(const std::size_t n_points) : sum(n_points, 0.), n(n_points, 0.) {}

      void add(const std::size_t i, const double value)
      {
        sum[i] += value;
        n[i] += 1;
      }
      double operator[](const std::size_t i) const { return sum[i] / n[i]; }

      std::vector<double> sum, n;
    };

    template <int dim>
    class ErrorOfFreeBoundary
    {
    public:
      ErrorOfFreeBoundary(const Problem<dim>       &problem,
                          const DiscreteProblem    &discrete,
                          const ConstraintSet<dim> &K_h,
                          const Vector             &lambda,
                          const Vector             &Bz,
                          const double              g)
        : problem(problem), discrete(discrete), K_h(K_h), lambda(lambda), Bz(Bz), g(g), pressures(K_h.size()), slopes(K_h.size())
      {
      }

      std::vector<double> by_cell()
      {
        std::vector<double> errors(problem.space.mesh.triangulation->n_active_cells(), 0.);
        for_each_cell([&](const RuleOnCell<dim> &rule, const Pressures &in_contact) { look_at(rule, in_contact.mean()); });
        for (MeansAtPoints *const means : {&pressures, &slopes})
        {
          add_at_cuts(problem, K_h, means->sum);
          add_at_cuts(problem, K_h, means->n);
        }
        for_each_cell([&](const RuleOnCell<dim> &rule, const Pressures &in_contact)
                      { errors[rule.cell->active_cell_index()] += error_in(rule, in_contact); });
        return errors;
      }

    private:
      bool is_active(const std::size_t i) const { return i < K_h.size() && lambda(i) > 0; }
      bool is_free(const std::size_t i) const { return i < K_h.size() && !(lambda(i) > 0); }

      /// Of the points of a cell that are in contact.
      struct Pressures
      {
        double   sum = 0;
        unsigned n = 0;

        double mean() const { return sum / n; }
        double mean_but(const double one) const { return (sum - one) / (n - 1); }
      };

      /// Those with points in contact.
      template <typename Action>
      void for_each_cell(const Action &action) const
      {
        for (std::size_t b = 0; b < K_h.blocks.size(); ++b)
          for (const RuleOnCell<dim> &rule : rule_on_cells(problem, K_h, b))
          {
            Pressures in_contact;
            for (const std::size_t i : rule.points)
              if (is_active(i))
              {
                in_contact.sum += lambda(i);
                ++in_contact.n;
              }
            if (in_contact.n > 0)
              action(rule, in_contact);
          }
      }

      void look_at(const RuleOnCell<dim> &rule, const double pressure)
      {
        for (const std::size_t i : rule.points)
        {
          if (is_free(i))
            pressures.add(i, pressure);
          double slope = 0;
          for (const std::size_t j : rule.points)
            if (is_active(i) && is_free(j))
              slope = std::max(slope, std::abs(g - Bz(j)) / K_h.points[i].x.distance(K_h.points[j].x));
          if (slope > 0)
            slopes.add(i, slope);
        }
      }

      double error_in(const RuleOnCell<dim> &rule, const Pressures &in_contact) const
      {
        double error = 0;
        for (const std::size_t i : rule.points)
          if (is_free(i))
            error += discrete.weights()(i) / pressures.n[i] * pressures[i] * std::abs(g - Bz(i));
          else if (is_active(i) && slopes.n[i] > 0 && in_contact.n > 1)
          {
            const double others = in_contact.mean_but(lambda(i)), q = std::max(0., 1 - lambda(i) / others);
            error += discrete.weights()(i) / (slopes.n[i] + 1) * others * q * q * slopes[i] * rule.cell->diameter() / 2;
          }
        return error;
      }

      const Problem<dim>       &problem;
      const DiscreteProblem    &discrete;
      const ConstraintSet<dim> &K_h;
      const Vector             &lambda, &Bz;
      const double              g;
      MeansAtPoints             pressures; ///< at points without: the mean of the others
      MeansAtPoints             slopes;    ///< at points in contact: of B z in cells with others that are not
    };
  } // namespace

  template <int dim>
  std::vector<double> error_of_free_boundary(const Problem<dim>       &problem,
                                             const DiscreteProblem    &discrete,
                                             const ConstraintSet<dim> &K_h,
                                             const Vector             &lambda,
                                             const Vector             &Bz,
                                             const double              g)
  {
    return ErrorOfFreeBoundary<dim>(problem, discrete, K_h, lambda, Bz, g).by_cell();
  }

#define INSTANTIATE(dim)                                                                                                                   \
  template std::vector<double> error_of_free_boundary(const Problem<dim> &, const DiscreteProblem &, const ConstraintSet<dim> &,           \
                                                      const Vector &, const Vector &, double);
  INSTANTIATE(1)
  INSTANTIATE(2)
  INSTANTIATE(3)
#undef INSTANTIATE
} // namespace unilateral
