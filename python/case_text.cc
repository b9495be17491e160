#include "python/case_text.h"

#include "python/given_values.h"
#include "python/mesh_arrays.h"

#include "unilateral/case/read_case.h"
#include "unilateral/case/toml_document.h"
#include "unilateral/case/write_case.h"

#include <fmt/format.h>

#include <utility>
#include <vector>

namespace py = pybind11;

namespace unilateral
{
  namespace
  {
    /// Values of Python as TOML. Functions go to `given`, and the text has their number.
    class CaseText
    {
    public:
      CaseText() = default;
      CaseText(GivenData known, std::shared_ptr<const NodalMesh> mesh) : given(std::move(known)), nodes(std::move(mesh)) {}

      /// A value; tables in one line.
      std::string of(const py::handle &value)
      {
        if (py::isinstance<py::bool_>(value))
          return value.cast<bool>() ? "true" : "false";
        if (py::isinstance<py::int_>(value))
          return py::str(value);
        if (py::isinstance<py::float_>(value))
          return py::repr(py::float_(py::reinterpret_borrow<py::object>(value)));
        if (py::isinstance<py::str>(value))
          return toml_quoted(value.cast<std::string>());
        if (is_given_value(value))
        {
          given.functions.push_back(given_value(value, nodes));
          return fmt::format("{{ given = {} }}", given.functions.size() - 1);
        }
        if (py::isinstance<py::dict>(value))
          return "{" + entries(py::reinterpret_borrow<py::dict>(value), " = ", ", ") + "}";
        if (py::hasattr(value, "tolist")) // arrays and numbers of NumPy
          return of(value.attr("tolist")());
        if (py::isinstance<py::list>(value) || py::isinstance<py::tuple>(value))
        {
          std::string text;
          for (const auto &entry : value)
            text += (text.empty() ? "" : ", ") + of(entry);
          return "[" + text + "]";
        }
        if (py::hasattr(value, "__fspath__"))
          return toml_quoted(py::str(value.attr("__fspath__")()));
        throw py::type_error(fmt::format("a case holds numbers, texts, functions, arrays, lists and dicts, not {}",
                                         std::string(py::str(py::type::handle_of(value)))));
      }

      /// A whole case, a line a section.
      std::string of_case(const py::dict &content)
      {
        py::dict sections;
        for (const auto &[key, value] : content)
          sections[key] = value;
        if (content.contains("mesh") && is_array_mesh(content["mesh"]))
          take_mesh(content["mesh"], sections);
        return entries(sections, " = ", "\n") + "\n";
      }

      std::vector<Override> overrides(const py::dict &settings)
      {
        std::vector<Override> list;
        for (const auto &[key, value] : settings)
          list.emplace_back(py::str(key), of(value));
        return list;
      }

      GivenData                        given;
      std::shared_ptr<const NodalMesh> nodes;

    private:
      std::string entries(const py::dict &table, const char *const equals, const char *const separator)
      {
        std::string text;
        for (const auto &[key, value] : table)
          text += (text.empty() ? "" : separator) + toml_quoted(py::str(key)) + equals + of(value);
        return text;
      }

      void take_mesh(const py::handle &mesh, py::dict &sections)
      {
        ArrayMesh arrays = mesh_of_arrays(mesh);
        given.mesh = std::move(arrays.cells);
        nodes = std::move(arrays.nodes);
        py::dict rest;
        if (py::isinstance<py::dict>(mesh))
          for (const auto &[key, value] : py::reinterpret_borrow<py::dict>(mesh))
            if (const std::string name = py::str(key);
                name != "points" && name != "cells" && name != "parts" && name != "regions" && name != "meshio")
              rest[key] = value;
        rest["given"] = 0;
        sections["mesh"] = rest;
        if (arrays.parts_by_place.empty())
          return;
        py::list parts;
        for (const auto &[name, where] : arrays.parts_by_place)
          parts.append(py::dict(py::arg("name") = name, py::arg("where") = where));
        if (sections.contains("part"))
          parts.attr("extend")(sections["part"]);
        sections["part"] = parts;
      }
    };
  } // namespace

  void warn(const Diagnostics &diagnostics)
  {
    for (const Diagnostic &message : diagnostics.all())
      if (message.severity == Severity::warning && PyErr_WarnEx(PyExc_UserWarning, to_string(message).c_str(), 2) != 0)
        throw py::error_already_set(); // warnings are errors here
  }

  PythonCase case_of_dict(const py::dict &content, const std::string &name)
  {
    CaseText          text;
    const std::string toml = text.of_case(content);
    Diagnostics       diagnostics;
    PythonCase        request{parse_case(toml, name + ".toml", {}, diagnostics, text.given), text.nodes};
    warn(diagnostics);
    return request;
  }

  PythonCase case_of_file(const std::filesystem::path &path, const py::dict &settings)
  {
    CaseText    text;
    const auto  overrides = text.overrides(settings);
    Diagnostics diagnostics;
    PythonCase  request{read_case(path.string(), overrides, diagnostics, text.given), nullptr};
    warn(diagnostics);
    return request;
  }

  PythonCase case_with_settings(const PythonCase &request, const py::dict &settings)
  {
    CaseText    text(request.given, request.nodes);
    const auto  overrides = text.overrides(settings);
    Diagnostics diagnostics;
    PythonCase  other{parse_case(expand(request), request.path, overrides, diagnostics, text.given), request.nodes};
    warn(diagnostics);
    return other;
  }
} // namespace unilateral
