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
        if (depth == most_depth)
          throw py::value_error(
            fmt::format("a case holds no lists and dicts within each other at more than {} levels; this one may hold itself", most_depth));
        ++depth;
        std::string text = of_what_it_is(value);
        --depth;
        return text;
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
      static constexpr unsigned most_depth = 200; ///< below that of TOML's reader

      std::string of_what_it_is(const py::handle &value)
      {
        if (py::isinstance<py::bool_>(value))
          return value.cast<bool>() ? "true" : "false";
        if (py::isinstance<py::int_>(value))
        {
          int too_large = 0;
          PyLong_AsLongLongAndOverflow(value.ptr(), &too_large);
          const std::string digits = py::str(value);
          if (too_large != 0)
            throw py::value_error(fmt::format("the whole number {} is too large for a case; give it as a float", digits));
          return digits;
        }
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

      unsigned depth = 0; ///< of the value at hand within the case
    };
  } // namespace

  namespace
  {
    bool is_at_or_before(const SourceLocation &a, const SourceLocation &b)
    {
      return a.line > 0 && std::pair(a.line, a.column) <= std::pair(b.line, b.column);
    }

    /// The keys that lead to @p place become @p keys; entries follow each other as in the text.
    void find_keys(const TomlValue &value, const SourceLocation &place, const std::string &so_far, std::string &keys)
    {
      for (const TomlEntry &entry : value.entries)
        // A [[section]] begins with its bracket.
        if (is_at_or_before(entry.where, place) || is_at_or_before(entry.value.where, place))
        {
          const std::string here = fmt::format("{}['{}']", so_far, entry.key);
          keys = here;
          find_keys(entry.value, place, here, keys);
        }
      for (std::size_t i = 0; i < value.elements.size(); ++i)
        if (is_at_or_before(value.elements[i].where, place))
        {
          const std::string here = fmt::format("{}[{}]", so_far, i);
          keys = here;
          find_keys(value.elements[i], place, here, keys);
        }
    }

    PythonCase read_text(const std::string &text, const std::string &file, const std::vector<Override> &overrides, const CaseText &content)
    {
      Diagnostics diagnostics;
      try
      {
        PythonCase request{parse_case(text, file, overrides, diagnostics, content.given), content.nodes, text, file};
        warn(diagnostics, request);
        return request;
      }
      catch (const InputError &e)
      {
        throw InputError(with_keys(e.diagnostics, text, file));
      }
    }
  } // namespace

  std::vector<Diagnostic> with_keys(std::vector<Diagnostic> diagnostics, const std::string &text, const std::string &file)
  {
    try
    {
      const TomlValue document = parse_toml(text, file);
      for (Diagnostic &message : diagnostics)
        if (message.where.line > 0 && message.where.file == file)
        {
          std::string keys;
          find_keys(document, message.where, "", keys);
          message.where = {std::filesystem::path(file).stem().string() + keys, 0, 0};
        }
    }
    catch (const InputError &)
    {
      // The text is no TOML: its places are all there is.
    }
    return diagnostics;
  }

  void warn(const Diagnostics &diagnostics, const PythonCase &request)
  {
    const auto messages = request.text.empty() ? diagnostics.all() : with_keys(diagnostics.all(), request.text, request.file_in_messages);
    for (const Diagnostic &message : messages)
      if (message.severity == Severity::warning && PyErr_WarnEx(PyExc_UserWarning, to_string(message).c_str(), 2) != 0)
        throw py::error_already_set(); // warnings are errors here
  }

  PythonCase case_of_dict(const py::dict &content, const std::string &name)
  {
    CaseText          text;
    const std::string toml = text.of_case(content);
    return read_text(toml, name + ".toml", {}, text);
  }

  PythonCase case_of_file(const std::filesystem::path &path, const py::dict &settings)
  {
    CaseText    text;
    const auto  overrides = text.overrides(settings);
    Diagnostics diagnostics;
    PythonCase  request{read_case(path.string(), overrides, diagnostics, text.given), nullptr, "", ""};
    warn(diagnostics, request);
    return request;
  }

  PythonCase case_with_settings(const PythonCase &request, const py::dict &settings)
  {
    CaseText   text(request.given, request.nodes);
    const auto overrides = text.overrides(settings);
    return read_text(expand(request), request.path, overrides, text);
  }
} // namespace unilateral
