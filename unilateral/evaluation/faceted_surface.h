// Flat facets in place of a curved surface, and what contact makes of them.
#pragma once

#include "unilateral/constraints/constraint_set.h"
#include "unilateral/discretisation/problem.h"
#include "unilateral/inequality/discrete_problem.h"

#include <optional>
#include <string>
#include <vector>

namespace unilateral
{
  /// The flat faces of the parts of a body where contact may act.
  ///
  /// Facets stand for a curved surface where neighbours meet at an angle between 0 and 45 degrees; larger angles are edges of the body. At
  /// the ends a, b of a chord of a facet the normals n_a, n_b are the means of those of the facets there, and the surface that the facets
  /// stand for lies at most about s = |(n_b - n_a).(b - a)| / 8 from the chord, its sagitta. Contact that is felt at the corners alone does
  /// not see s, contact inside the facets does: to press a facet flat that is 2a long takes the pressure E* a/(2 R) of a line contact
  /// with R = a^2/(2 s), which is 2 E* s/(2a), E* = E/(1 - nu^2). It does not depend on the mesh of the facet. Where it is no small part
  /// of the pressure that the contact force makes on the facets in touch, what is computed is the contact of the facets, not of the
  /// surface.
  template <int dim>
  class FacetedSurface
  {
  public:
    FacetedSurface() = default; ///< no faces

    /// The faces of the mesh as it is, those of all processes; divided among these, it is the coarse mesh. Collective.
    explicit FacetedSurface(const Problem<dim> &problem);

    struct Finding
    {
      double angle = 0;    ///< between neighbours, the largest, in degrees
      double sagitta = 0;  ///< the largest, in lengths
      double pressure = 0; ///< by which the facets change that of contact
      double mean = 0;     ///< force by area of the facets in touch
    };

    /// Of the facets that @p block has active points on. Nothing where there is no contact, or no facet has a sagitta.
    std::optional<Finding> look_at(
      const Problem<dim> &problem, const ConstraintSet<dim> &set, const ConstraintBlock &block, unsigned part, const Vector &lambda) const;

    template <typename Archive>
    void archive(Archive &bytes)
    {
      std::size_t n = facets.size();
      bytes(n);
      facets.resize(n);
      for (Facet &facet : facets)
      {
        for (unsigned d = 0; d < dim; ++d)
        {
          bytes(facet.lower[d]);
          bytes(facet.upper[d]);
        }
        for (double *const number : {&facet.area, &facet.sagitta, &facet.slope, &facet.modulus})
          bytes(*number);
        bytes(facet.part);
      }
    }

  private:
    struct Facet
    {
      dealii::Point<dim> lower, upper; ///< the box around it
      double             area = 0;
      double             sagitta = 0, slope = 0; ///< largest s, largest s/|b - a|
      double             modulus = 0;            ///< E*
      unsigned           part = 0;
    };
    std::vector<Facet> facets;
  };

  /// The rule has points on a face that are not corners of it.
  template <int dim>
  bool feels_inside_faces(const Problem<dim> &problem, const RuleName &rule);
} // namespace unilateral
