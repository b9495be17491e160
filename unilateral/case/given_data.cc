#include "unilateral/case/given_data.h"

#include <optional>

namespace unilateral
{
  namespace
  {
    /// The number of the key `given`, or nothing with an error when there is no such thing among @p n.
    std::optional<std::size_t> given_number(const TomlValue &value, const std::size_t n, Diagnostics &diagnostics)
    {
      if (value.kind == TomlValue::Kind::integer && value.integer >= 0 && std::size_t(value.integer) < n)
        return std::size_t(value.integer);
      diagnostics.error(value.where,
                        "this is a function that a program has handed over when it stated the case, and no file holds it: state the case "
                        "by that program, or "
                        "write an expression or the name of a file here",
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
      if (const auto index = given_number(*number, given.functions.size(), diagnostics))
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
    // Keys of a section itself may have any name: a parameter or a part of the boundary that is called `given`, mesh.given.
    for (TomlEntry &section : document.entries)
    {
      for (TomlEntry &entry : section.value.entries)
        insert_functions(entry.value, given, diagnostics);
      for (TomlValue &element : section.value.elements)
        for (TomlEntry &entry : element.entries)
          insert_functions(entry.value, given, diagnostics);
    }
  }
} // namespace unilateral
