#include "unilateral/case/given_data.h"

#include <fmt/format.h>

namespace unilateral
{
  namespace
  {
    /// The number of the key `given`, or nothing with an error when there is no such thing among @p n.
    std::optional<std::size_t> given_number(const TomlValue &value, const std::size_t n, const char *const what, Diagnostics &diagnostics)
    {
      if (value.kind == TomlValue::Kind::integer && value.integer >= 0 && std::size_t(value.integer) < n)
        return std::size_t(value.integer);
      diagnostics.error(value.where,
                        fmt::format("this is a {0} that a program has handed over when it stated the case; a file does not hold it: state "
                                    "the case by that program, or write an expression or the name of a file here",
                                    what),
                        MessageName("given-by-program"));
      return {};
    }

    void insert_functions(TomlValue &value, const GivenData &given, Diagnostics &diagnostics)
    {
      for (TomlValue &element : value.elements)
        insert_functions(element, given, diagnostics);
      const TomlValue *const number = value.kind == TomlValue::Kind::table ? value.find("given") : nullptr;
      if (!number)
      {
        for (TomlEntry &entry : value.entries)
          insert_functions(entry.value, given, diagnostics);
        return;
      }
      TomlValue function;
      function.where = value.where;
      if (const auto index = given_number(*number, given.functions.size(), "function", diagnostics))
      {
        function.kind = TomlValue::Kind::given;
        function.integer = std::int64_t(*index);
        function.given = given.functions[*index];
      }
      else
        function.kind = TomlValue::Kind::integer; // the error has been said
      value = std::move(function);
    }
  } // namespace

  void insert_given_functions(TomlValue &document, const GivenData &given, Diagnostics &diagnostics)
  {
    for (TomlEntry &section : document.entries)
      if (section.key == "mesh" && section.value.kind == TomlValue::Kind::table)
      {
        // Its own key `given` names a mesh.
        for (TomlEntry &entry : section.value.entries)
          if (entry.key == "given")
            given_number(entry.value, given.mesh ? 1 : 0, "mesh", diagnostics);
          else
            insert_functions(entry.value, given, diagnostics);
      }
      else
        insert_functions(section.value, given, diagnostics);
  }
} // namespace unilateral
