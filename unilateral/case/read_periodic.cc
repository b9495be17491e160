#include "unilateral/case/read_periodic.h"

#include "unilateral/case/read_field.h"

#include <algorithm>

namespace unilateral
{
  namespace
  {
    /// parts = ["left", "right"]
    void read_pair(const TomlValue &value, PeriodicSpec &pair, Diagnostics &diagnostics)
    {
      if (value.kind != TomlValue::Kind::array || value.elements.size() != 2 ||
          std::any_of(value.elements.begin(), value.elements.end(),
                      [](const TomlValue &name) { return name.kind != TomlValue::Kind::string; }))
      {
        diagnostics.error(value.where, "'parts' is a list of two names, [\"left\", \"right\"]", MessageName("wrong-type"));
        return;
      }
      pair.first = value.elements[0].string;
      pair.second = value.elements[1].string;
      pair.first_where = value.elements[0].where;
      pair.second_where = value.elements[1].where;
    }
  } // namespace

  void read_periodic(const std::vector<const TomlValue *> &contents, const std::string &folder, Case &request, Diagnostics &diagnostics)
  {
    for (const TomlValue *content : contents)
    {
      TableReader  table(*content, "[[periodic]]", diagnostics);
      PeriodicSpec pair;
      pair.where = content->where;
      if (const TomlValue *parts = table.find("parts"))
        read_pair(*parts, pair, diagnostics);
      if (const TomlValue *jump = table.find("jump"))
      {
        if (request.elastic())
          pair.jump = read_components(*jump, "jump", request.dimension, folder, diagnostics).value_or(std::vector<FieldSpec>());
        else if (auto number = read_field(*jump, "jump", folder, diagnostics))
          pair.jump = {std::move(*number)};
      }
      if (!table.has_or_misspells("parts"))
        diagnostics.error(content->where, "'parts' is missing in [[periodic]]; for example parts = [\"left\", \"right\"]",
                          MessageName("missing-key"));
      table.finish();
      if (!pair.first.empty())
        request.periodic.push_back(std::move(pair));
    }
  }
} // namespace unilateral
