#include "unilateral/equilibration/face_blend.h"

#include "unilateral/equilibration/straight_face.h"

namespace unilateral
{
  using namespace dealii;

  FaceBlend face_blend(const bool simplex, const unsigned face, const std::vector<Point<2>> &points)
  {
    const auto            corners = reference_corners<2>(simplex);
    const auto            own = corners_of_face<2>(simplex, face);
    const StraightFace<2> side(corners, simplex, face);
    FaceBlend             blend;
    // On triangles the barycentric coordinates of the corner across, and of the end of the side.
    const auto barycentric = [&](const unsigned v, const Point<2> &x) { return v == 0 ? 1 - x[0] - x[1] : x[v - 1]; };
    const auto gradient = [&](const unsigned v) { return v == 0 ? Tensor<1, 2>({-1., -1.}) : Point<2>::unit_vector(v - 1); };
    for (const Point<2> &x : points)
    {
      if (simplex)
      {
        const unsigned across = 3 - own[0] - own[1];
        const double   fading = 1 - barycentric(across, x), foot = fading > 0 ? barycentric(own[1], x) / fading : 0.;
        blend.fading.push_back(fading);
        blend.foot.push_back(foot);
        blend.fading_gradient.push_back(-gradient(across));
        blend.slope.push_back(gradient(own[1]) + foot * gradient(across)); // fading times the gradient of the foot
      }
      else
      {
        const double depth = (side.origin - x) * side.normal;
        blend.fading.push_back(1 - depth);
        blend.foot.push_back(side.parameters(x)[0]);
        blend.fading_gradient.push_back(side.normal);
        blend.slope.push_back((1 - depth) * side.dual[0]);
      }
    }
    return blend;
  }
} // namespace unilateral
