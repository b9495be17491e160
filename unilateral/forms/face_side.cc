#include "unilateral/forms/face_side.h"

#include <deal.II/base/exceptions.h>
#include <deal.II/base/numbers.h>

namespace unilateral
{
  using namespace dealii;

  template <int dim>
  void FaceTraces::add(const FaceSide<dim> &side, const std::vector<unsigned> &function, const std::vector<unsigned> &place)
  {
    const unsigned n_points = place.size();
    if (penalty.empty())
    {
      JxW = side.JxW;
      penalty.assign(n_points, 0.);
      jump.reinit(n_points, n_functions);
      mean_moment.reinit(n_points, n_functions);
    }
    mean_inverse_width += side.half_inverse_width;
    for (unsigned q = 0; q < n_points; ++q)
    {
      penalty[q] += side.penalty[place[q]];
      for (unsigned k = 0; k < function.size(); ++k)
        if (function[k] != numbers::invalid_unsigned_int)
        {
          jump(q, function[k]) += side.slope(place[q], k);
          mean_moment(q, function[k]) += side.moment(place[q], k);
        }
    }
  }

  void FaceTraces::add_terms(FullMatrix<double> &matrix) const
  {
    for (unsigned q = 0; q < JxW.size(); ++q)
      for (unsigned i = 0; i < matrix.m(); ++i)
        for (unsigned j = 0; j < n_functions; ++j)
          matrix(i, j) += (penalty[q] * jump(q, i) * jump(q, j) - mean_moment(q, j) * jump(q, i) - jump(q, j) * mean_moment(q, i)) * JxW[q];
  }

  void FaceTraces::add_gram(FullMatrix<double> &matrix) const
  {
    for (unsigned q = 0; q < JxW.size(); ++q)
      for (unsigned i = 0; i < matrix.m(); ++i)
        for (unsigned j = 0; j < n_functions; ++j)
          matrix(i, j) += mean_inverse_width * jump(q, i) * jump(q, j) * JxW[q];
  }

  template <int dim>
  std::vector<unsigned> matching_points(const std::vector<Point<dim>> &here, const std::vector<Point<dim>> &there)
  {
    const unsigned        n = here.size();
    std::vector<unsigned> place(n);
    for (unsigned q = 0; q < n; ++q)
    {
      place[q] = here[q].distance(there[q]) <= here[q].distance(there[n - 1 - q]) ? q : n - 1 - q;
      Assert(here[q].distance(there[place[q]]) <= 1e-6 * here[0].distance(here[n - 1]) || n == 1,
             ExcMessage("the cells at a face do not have the same quadrature points there"));
    }
    return place;
  }

#define INSTANTIATE(dim)                                                                                                                   \
  template void                  FaceTraces::add(const FaceSide<dim> &, const std::vector<unsigned> &, const std::vector<unsigned> &);     \
  template std::vector<unsigned> matching_points(const std::vector<Point<dim>> &, const std::vector<Point<dim>> &);
  INSTANTIATE(1)
  INSTANTIATE(2)
  INSTANTIATE(3)
#undef INSTANTIATE
} // namespace unilateral
