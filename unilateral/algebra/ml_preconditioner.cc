#include "unilateral/algebra/ml_preconditioner.h"

#include <Epetra_MultiVector.h>
#include <Teuchos_ParameterList.hpp>

#include <algorithm>

namespace unilateral
{
  using namespace dealii;

  std::unique_ptr<TrilinosWrappers::PreconditionAMG> ml_preconditioner(const Epetra_CrsMatrix                 &matrix,
                                                                       const std::vector<std::vector<double>> &modes,
                                                                       const unsigned                          block_size,
                                                                       const MlParameters                     &parameters)
  {
    TrilinosWrappers::PreconditionAMG::AdditionalData data;
    data.elliptic = parameters.symmetric;
    data.higher_order_elements = parameters.higher_order;
    data.smoother_sweeps = 2;
    data.aggregation_threshold = parameters.drop_tolerance;
    data.smoother_type = parameters.symmetric ? "Chebyshev" : "symmetric Gauss-Seidel";
    Teuchos::ParameterList              list;
    std::unique_ptr<Epetra_MultiVector> no_modes, kernel;
    data.set_parameters(list, no_modes, matrix);
    if (!modes.empty())
    {
      kernel = std::make_unique<Epetra_MultiVector>(matrix.OperatorDomainMap(), modes.size());
      for (std::size_t k = 0; k < modes.size(); ++k)
        std::copy(modes[k].begin(), modes[k].end(), (*kernel)[k]);
      list.set("PDE equations", int(block_size));
      list.set("null space: type", "pre-computed");
      list.set("null space: dimension", kernel->NumVectors());
      list.set("null space: vectors", kernel->Values());
    }
    auto amg = std::make_unique<TrilinosWrappers::PreconditionAMG>();
    amg->initialize(matrix, list);
    return amg;
  }
} // namespace unilateral
