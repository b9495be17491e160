#include "cli/expand.h"

#include "cli/run_files.h"

#include "unilateral/case/write_case.h"
#include "unilateral/output/results.h"

#include <nlohmann/json.hpp>

namespace unilateral
{
  int expand(const Options &options, const Case &request)
  {
    const std::string text = expand(request);
    if (options.json)
    {
      nlohmann::ordered_json json;
      json["case"] = to_json(static_cast<const CaseSource &>(request));
      json["case"]["expanded"] = text;
      print_results(to_text(json));
    }
    else
      print_results(text);
    return exit_solved;
  }
} // namespace unilateral
