#include "unilateral/case/load_steps.h"

namespace unilateral
{
  Case without_steps(const Case &request)
  {
    Case single;
    static_cast<ProblemStatementOf<FieldSpec> &>(single) = request;
    static_cast<CaseSource &>(single) = request;
    single.name = request.name;
    single.parameters = request.parameters;
    single.files = request.files;
    single.dimension = request.dimension;
    single.part_names = request.part_names;
    single.region_names = request.region_names;
    return single;
  }

  Case case_of_step(const Case &request, const std::size_t k)
  {
    const LoadStep &step = request.steps.at(k);
    Case            single = step.others ? *step.others : without_steps(request);
    single.parameters = step.parameters;
    return single;
  }
} // namespace unilateral
