#include "unilateral/case/read_output.h"

#include "unilateral/case/read_field.h"
#include "unilateral/case/table_reader.h"

#include <fmt/format.h>

#include <algorithm>
#include <optional>
#include <utility>

namespace unilateral
{
  void read_output(const TomlValue &content, Case &request, Diagnostics &diagnostics)
  {
    TableReader table(content, "[output]", diagnostics);
    request.files.vtu = table.boolean("vtu").value_or(true);
    request.files.csv = table.boolean("csv").value_or(false);
    request.files.report = table.boolean("report").value_or(true);
    request.files.every = table.whole_number("every", 0, 1'000'000).value_or(1);
    const TomlValue *probes = table.find("probes");
    if (probes && probes->kind != TomlValue::Kind::array)
      diagnostics.error(probes->where, fmt::format("'probes' must be a list of points, [[x, y], ...], not {}", probes->kind_name()),
                        MessageName("wrong-type"));
    else if (probes)
      for (const TomlValue &point : probes->elements)
      {
        // In 1-D a number is a point.
        std::optional<std::vector<double>> coordinates;
        if (request.dimension == 1 && point.kind != TomlValue::Kind::array)
        {
          if (const auto x = read_number(point, "probes", diagnostics))
            coordinates = std::vector<double>{*x};
        }
        else if (point.kind != TomlValue::Kind::array)
          diagnostics.error(point.where, "'probes' must be a list of points, [[x, y], ...]", MessageName("wrong-type"));
        else
          coordinates = read_numbers(point, "probes", diagnostics);
        if (!coordinates)
          continue;
        if (request.dimension > 0 && coordinates->size() != request.dimension)
        {
          diagnostics.error(
            point.where,
            fmt::format("a probe has {} coordinates on a {}-D mesh, {} here", request.dimension, request.dimension, coordinates->size()),
            MessageName("wrong-length"));
          continue;
        }
        request.output.probes.push_back(*coordinates);
        request.output.probes_where.push_back(point.where);
      }
    table.finish();
  }

  void read_functionals(const std::vector<const TomlValue *> &contents, const std::string &folder, Case &request, Diagnostics &diagnostics)
  {
    for (const TomlValue *content : contents)
    {
      TableReader             table(*content, "[[functional]]", diagnostics);
      FunctionalOf<FieldSpec> functional;
      functional.where = content->where;
      if (const auto name = table.string("name"))
      {
        functional.name = *name;
        functional.where = table.find("name")->where;
        const auto letter = [](const char c)
        { return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '_' || c == '-'; };
        if (name->empty() || !std::all_of(name->begin(), name->end(), letter))
          diagnostics.error(functional.where, "the name of a functional has letters, digits, _ and - only: results and [[expect]] use it",
                            MessageName("out-of-range"));
        for (const auto &other : request.functionals)
          if (other.name == *name)
            diagnostics.error(functional.where, fmt::format("a functional '{}' exists already", *name), MessageName("contradiction"));
      }
      const TomlValue *const integrand = table.find("integrand");
      if (integrand && (integrand->kind == TomlValue::Kind::table || integrand->kind == TomlValue::Kind::array ||
                        integrand->kind == TomlValue::Kind::given))
        diagnostics.error(integrand->where, "'integrand' must be a number or an expression in quotes, for example \"u^2\"",
                          MessageName("wrong-type"));
      else if (integrand)
        if (auto text = read_field(*integrand, "integrand", folder, diagnostics))
          functional.integrand = std::move(*text);
      functional.on = table.string("on").value_or("domain");
      functional.region = table.string("region").value_or("");
      for (const char *const key : {"name", "integrand"})
        if (!table.has_or_misspells(key))
          diagnostics.error(content->where,
                            fmt::format("'{}' is missing in [[functional]]; for example name = \"volume\", integrand = \"u\"", key),
                            MessageName("missing-key"));
      table.finish();
      if (!functional.name.empty())
        request.functionals.push_back(std::move(functional));
    }
  }

  void read_expectations(const std::vector<const TomlValue *> &contents, Case &request, Diagnostics &diagnostics)
  {
    for (const TomlValue *content : contents)
    {
      TableReader table(*content, "[[expect]]", diagnostics);
      Expectation expectation;
      expectation.where = content->where;
      if (const auto quantity = table.string("quantity"))
      {
        expectation.quantity = *quantity;
        expectation.where = table.find("quantity")->where;
        if (quantity->empty())
          diagnostics.error(expectation.where, "'quantity' must be a path into results.json, for example \"solution.energy\"",
                            MessageName("wrong-type"));
      }
      expectation.value = table.number("value");
      expectation.min = table.number("min");
      expectation.max = table.number("max");
      for (const char *const key : {"rtol", "atol"})
        if (const auto tolerance = table.number(key))
        {
          (key[0] == 'r' ? expectation.rtol : expectation.atol) = *tolerance;
          if (*tolerance < 0)
            diagnostics.error(table.find(key)->where, fmt::format("'{}' must not be negative", key), MessageName("out-of-range"));
          if (!table.find("value"))
            diagnostics.error(table.find(key)->where, fmt::format("'{}' is the tolerance of 'value', which is missing", key),
                              MessageName("missing-key"));
        }
      if (!table.has_or_misspells("quantity"))
        diagnostics.error(content->where, "'quantity' is missing in [[expect]]; for example \"solution.energy\"",
                          MessageName("missing-key"));
      if (!table.has_or_misspells("value") && !table.has_or_misspells("min") && !table.has_or_misspells("max"))
        diagnostics.error(content->where, "[[expect]] expects nothing; give value, min or max", MessageName("does-nothing"));
      if (expectation.min && expectation.max && *expectation.min > *expectation.max)
        diagnostics.error(table.find("min")->where, fmt::format("'min' = {} is above 'max' = {}", *expectation.min, *expectation.max),
                          MessageName("contradiction"));
      table.finish();
      request.expect.push_back(std::move(expectation));
    }
  }
} // namespace unilateral
