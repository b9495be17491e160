// An expression in the first line, parameters NAME=EXPRESSION in the others. What is checked can be evaluated, everywhere.
#include "fuzzed_bytes.h"

#include "unilateral/functions/compile_field.h"
#include "unilateral/functions/expression.h"

#include <cmath>

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t *bytes, const std::size_t size)
{
  using namespace unilateral;
  const std::string      text = fuzzed::text(bytes, size);
  std::size_t            end = std::min(text.find('\n'), text.size());
  const FieldSpec        spec = FieldSpec::expression(text.substr(0, end));
  std::vector<Parameter> parameters;
  while (end < text.size() && parameters.size() < 8)
  {
    const std::size_t begin = end + 1;
    end = std::min(text.find('\n', begin), text.size());
    const std::string line = text.substr(begin, end - begin);
    const std::size_t sign = std::min(line.find('='), line.size());
    parameters.push_back({line.substr(0, sign), FieldSpec::expression(line.substr(std::min(sign + 1, line.size()))), {"fuzz.toml", 2, 1}});
  }
  const unsigned dim = 1 + size % 3;

  Diagnostics diagnostics;
  check_parameters(parameters, dim, diagnostics);
  parse_expression(spec, parameters, dim, diagnostics);
  try
  {
    const Expression expression(spec, parameters, dim);
    fuzzed::require(!diagnostics.has_errors());
    const double at_origin = expression.value(0, 0, 0);
    for (const double x : {-1e300, -1., -1e-300, 0.5, 1e9})
    {
      const double value = expression.value(x, dim > 1 ? -x : 0, dim > 2 ? 2 * x : 0);
      fuzzed::require(!expression.is_constant() || value == at_origin || (std::isnan(value) && std::isnan(at_origin)));
    }
    expression.parameter_values();
    // Many points at a time, more than the evaluator takes at once.
    std::vector<std::array<double, 3>> points(ExpressionColumn::n_points + 3), gradients(points.size());
    std::vector<double>                values(points.size());
    for (std::size_t i = 0; i < points.size(); ++i)
      points[i] = {0.01 * double(i) - 0.5, dim > 1 ? 1 - 0.03 * double(i) : 0, dim > 2 ? 0.5 : 0};
    expression.values(points, values, gradients);
    for (std::size_t i = 0; i < points.size(); i += 13)
    {
      const double value = expression.value(points[i][0], points[i][1], points[i][2]);
      fuzzed::require(value == values[i] || (std::isnan(value) && std::isnan(values[i])));
    }
    const FieldFunction function = compile_field(spec, parameters, dim);
    function.gradient(dealii::Point<2>(0.25, 0.5));
  }
  catch (const InputError &e)
  {
    fuzzed::require(!e.diagnostics.empty());
  }
  return 0;
}
