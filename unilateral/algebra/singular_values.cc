#include "unilateral/algebra/singular_values.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <vector>

extern "C" void dgesdd_(const char *job,
                        const int  *m,
                        const int  *n,
                        double     *A,
                        const int  *rows_of_A,
                        double     *values,
                        double     *U,
                        const int  *rows_of_U,
                        double     *V_transposed,
                        const int  *rows_of_V_transposed,
                        double     *work,
                        const int  *work_size,
                        int        *integer_work,
                        int        *info);

namespace unilateral
{
  SingularValues singular_values(Eigen::MatrixXd M)
  {
    const int       m = M.rows(), n = M.cols(), k = std::min(m, n);
    SingularValues  result{Eigen::VectorXd(k), Eigen::MatrixXd()};
    Eigen::MatrixXd U(m, k), V_transposed(k, n);
    if (k > 0)
    {
      std::vector<int> integer_work(8 * k);
      double           best_size = 0;
      int              info = 0, work_size = -1; // asks for the best size
      dgesdd_("S", &m, &n, M.data(), &m, result.values.data(), U.data(), &m, V_transposed.data(), &k, &best_size, &work_size,
              integer_work.data(), &info);
      work_size = int(best_size);
      std::vector<double> work(work_size);
      dgesdd_("S", &m, &n, M.data(), &m, result.values.data(), U.data(), &m, V_transposed.data(), &k, work.data(), &work_size,
              integer_work.data(), &info);
      if (info != 0)
        throw std::runtime_error("the singular values of a matrix were not found");
    }
    result.right_vectors = V_transposed.transpose();
    return result;
  }
} // namespace unilateral
