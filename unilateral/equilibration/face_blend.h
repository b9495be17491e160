// Functions on a side of a plane cell, continued into the cell and to zero on its other sides.
#pragma once

#include <deal.II/base/point.h>
#include <deal.II/base/tensor.h>

#include <vector>

namespace unilateral
{
  /// d on the side with the parameter s in [0, 1], zero at both ends, becomes fading d(s), s the foot of the lines that leave the side or
  /// end in the corner across. On the reference cell; its gradient there is d fading' + d'(s) slope.
  struct FaceBlend
  {
    std::vector<double>               fading, foot;
    std::vector<dealii::Tensor<1, 2>> fading_gradient, slope;
  };

  FaceBlend face_blend(bool simplex, unsigned face, const std::vector<dealii::Point<2>> &points);
} // namespace unilateral
