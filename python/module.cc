// The Python module `unilateral`: cases as files or dicts, results as dicts and NumPy arrays.
#include "python/computation.h"
#include "python/studies.h"

#include "unilateral/base/diagnostics.h"
#include "unilateral/base/mpi_session.h"
#include "unilateral/case/case_results.h"
#include "unilateral/case/expectations.h"
#include "unilateral/case/problem_of_case.h"
#include "unilateral/case/solve_history.h"
#include "unilateral/case/write_case.h"
#include "unilateral/output/result_files.h"
#include "unilateral/output/results.h"
#include "unilateral/output/solution_files.h"
#include "unilateral/output/vtu_file.h"
#include "unilateral/report/picture.h"
#include "unilateral/report/report.h"
#include "unilateral/report/scene.h"
#include "unilateral/solve.h"

#include <deal.II/base/exceptions.h>

#include <fmt/format.h>
#include <nlohmann/json.hpp>
#include <pybind11/numpy.h>
#include <pybind11/pybind11.h>
#include <pybind11/stl.h>
#include <pybind11/stl/filesystem.h>

#include <filesystem>
#include <memory>
#include <optional>
#include <utility>

namespace py = pybind11;

namespace unilateral
{
  void start_libraries()
  {
    static MpiSession *session = nullptr;
    if (session)
      return;
    session = new MpiSession;
    dealii::deal_II_exceptions::disable_abort_on_exception();
    py::module_::import("atexit").attr("register")(py::cpp_function(
      []
      {
        delete session;
        session = nullptr;
      }));
  }

  py::object to_python(const nlohmann::ordered_json &json)
  {
    const std::string text = json.dump(-1, ' ', false, nlohmann::ordered_json::error_handler_t::replace);
    return py::module_::import("json").attr("loads")(py::bytes(text));
  }
} // namespace unilateral

namespace
{
  using namespace unilateral;

  /// What a run has found; arrays are views into it.
  struct Result
  {
    ResultsFolder folder; ///< as if it had been written and read back
    bool          converged = false, as_expected = false;
    py::object    results; ///< as a dict, once it has been asked for
  };

  const VtuArray *find_array(const std::vector<VtuArray> &arrays, const std::string &name)
  {
    for (const VtuArray &array : arrays)
      if (array.name == name)
        return &array;
    return nullptr;
  }

  /// Nobody writes to it.
  py::array read_only(py::array array)
  {
    array.attr("flags").attr("writeable") = false;
    return array;
  }

  py::array array_of(const VtuArray &array, const py::handle &owner)
  {
    return std::visit(
      [&](const auto &values) -> py::array
      {
        using T = typename std::decay_t<decltype(values)>::value_type;
        const auto n = py::ssize_t(values.size() / array.n_components), size = py::ssize_t(sizeof(T));
        if (array.n_components == 1)
          return read_only(py::array_t<T>({n}, {size}, values.data(), owner));
        return read_only(
          py::array_t<T>({n, py::ssize_t(array.n_components)}, {py::ssize_t(array.n_components) * size, size}, values.data(), owner));
      },
      array.values);
  }

  py::array points_of(const VtuGrid &grid, const py::handle &owner)
  {
    const auto n = py::ssize_t(grid.points.size()), size = py::ssize_t(sizeof(double));
    return read_only(
      py::array_t<double>({n, py::ssize_t(3)}, {3 * size, size}, grid.points.empty() ? nullptr : grid.points[0].data(), owner));
  }

  /// Those of one kind: (n, corners).
  py::array cells_of(const VtuGrid &grid, const py::handle &owner)
  {
    const auto n = py::ssize_t(grid.cell_types.size()), corners = n > 0 ? py::ssize_t(grid.offsets[0]) : 0,
               size = py::ssize_t(sizeof(std::int32_t));
    return read_only(py::array_t<std::int32_t>({n, corners}, {corners * size, size}, grid.connectivity.data(), owner));
  }

  py::dict arrays_of(const std::vector<VtuArray> &list, const py::handle &owner)
  {
    py::dict arrays;
    for (const VtuArray &array : list)
      arrays[py::str(array.name)] = array_of(array, owner);
    return arrays;
  }

  template <int dim>
  std::unique_ptr<Result> solve_in(const PythonCase &request, Diagnostics &diagnostics, Progress &progress)
  {
    auto                   result = std::make_unique<Result>();
    LoadStepping<dim>      stepping(progress);
    nlohmann::ordered_json steps;
    const auto             collect = [&](const SolvedStep<dim> &step, const auto &)
    {
      for (const Diagnostic &warning : step.diagnostics.all())
        if (warning.severity == Severity::warning)
          diagnostics.warning(warning.where, warning.message, warning.name);
    };
    if (request.steps.empty())
      stepping.solve(problem_of(request), diagnostics);
    else
      steps = solve_history<dim>(request, stepping, collect);
    Solution<dim> &solution = stepping.solution();
    result->as_expected = evaluate_expectations(solution.result, request, steps);
    result->converged = solution.result.converged;
    result->folder.name = request.name;
    result->folder.results = to_json(solution.result, request, steps);
    SolutionGrids grids = grids_of(solution);
    result->folder.solution = std::move(grids.solution);
    result->folder.points = std::move(grids.points);
    return result;
  }

  std::unique_ptr<Result> solve_case(const PythonCase &request, const py::object &on_level, const py::object &stop)
  {
    return compute(request, on_level, stop,
                   [&](const auto dim, Diagnostics &diagnostics, Progress &progress)
                   { return solve_in<dim>(request, diagnostics, progress); });
  }

  void write_results(const Result &result, const std::string &directory)
  {
    ResultFiles files(directory);
    const auto &json = *result.folder.results;
    write_file_atomically(files.path_of("results.json"), to_text(json));
    write_file_atomically(files.path_of("solution.vtu"), to_vtu(result.folder.solution));
    write_file_atomically(files.path_of("constraint-points.vtu"), to_vtu(result.folder.points));
    write_file_atomically(files.path_of("report.html"), report_html({result.folder}));
    write_file_atomically(files.path_of("case.toml"), json["case"].value("expanded", std::string()));
    files.publish("case.toml", is_solution_file);
  }
} // namespace

PYBIND11_MODULE(unilateral, module)
{
  module.doc() =
    "Variational inequalities with unilateral constraints by finite elements: obstacle problems, contact of elastic bodies with rigid "
    "obstacles, beams, plates. Case(...).solve() gives the solution, the contact pressure and a guaranteed bound of the penalty's error.";
  module.attr("__version__") = UNILATERAL_VERSION;

  static const py::exception<InputError> input_error(module, "InputError", PyExc_ValueError);
  input_error.attr("__doc__") =
    "The case cannot be solved as it stands; the text has all mistakes, a line each, with their places. "
    "messages: the same as a list of dicts with message, name (for explain), file, line and column (0 where there is none).";
  py::register_exception_translator(
    [](std::exception_ptr thrown)
    {
      try
      {
        std::rethrow_exception(std::move(thrown));
      }
      catch (const InputError &e)
      {
        const py::object error = py::handle(input_error)(e.what());
        py::list         messages;
        for (const Diagnostic &message : e.diagnostics)
        {
          py::dict entry;
          entry["message"] = message.message;
          entry["name"] = message.name.text;
          entry["file"] = message.where.file;
          entry["line"] = message.where.line;
          entry["column"] = message.where.column;
          messages.append(entry);
        }
        error.attr("messages") = messages;
        PyErr_SetObject(input_error.ptr(), error.ptr());
      }
      catch (const dealii::ExceptionBase &e)
      {
        PyErr_SetString(PyExc_RuntimeError, e.get_exc_name());
      }
    });

  py::class_<Result> results(module, "Result",
                             "A solution. Arrays are views of its memory: nothing is copied, and nothing can be written.");

  py::class_<PythonCase> cases(module, "Case", R"(What is to be solved: the content of a case file (doc/case-file.md).

>>> import unilateral
>>> case = unilateral.Case({"mesh": {"box": [[0], [1]], "cells": 64}, "model": {"kind": "membrane", "load": 1},
...                         "boundary": {"all": 0}, "constraint": {"upper": 1 / 18}})
>>> case.dimension, case.part_names
(1, ['left', 'right'])

In place of a function, of an obstacle as of any coefficient, may stand a callable, which gets many points at once, (n, dim), and returns n
numbers; samples of a regular grid, {"array": a, "extent": [[x0, y0], [x1, y1]]}, the first row at the top; or, on a mesh by arrays,
{"values": v}, a number for each of its points. The mesh may be {"points": (n, dim), "cells": (m, corners), "parts": {name: facets, expression or
callable}, "regions": {name: cells}}, corners in the order of VTK, or a mesh of meshio.

>>> import numpy as np
>>> ceiling = case.with_settings({"constraint.upper": lambda x: 0.05 + 0.1 * np.abs(x[:, 0] - 0.5)})
>>> bool(ceiling.solve().solution.max() > 0.05)
True)");
  cases
    .def(py::init([](const py::dict &content, const std::string &name) { return case_of_dict(content, name); }), py::arg("content"),
         py::arg("name") = "case",
         "A case from a dict with the keys of a case file. File names in it are relative to the current folder. Raises InputError with all "
         "mistakes.")
    .def_static("load", &case_of_file, py::arg("path"), py::arg("settings") = py::dict(),
                "The case in a file, with some keys set: load('a.toml', {'mesh.refine': 4}). Raises InputError.")
    .def("with_settings", &case_with_settings, py::arg("settings"), R"(The same case with some keys set. Raises InputError.

>>> import unilateral
>>> case = unilateral.Case({"mesh": {"box": [[0], [1]], "cells": 64}, "model": {"kind": "membrane", "load": 1},
...                         "boundary": {"all": 0}, "constraint": {"upper": 1 / 18}})
>>> [round(case.with_settings({"model.load": f}).solve().pressure.max(), 3) for f in (1, 2)]
[1.0, 2.0])")
    .def(
      "solve", &solve_case, py::arg("progress") = py::none(), py::arg("stop") = py::none(),
      R"(Solves the case, of a load history all steps: the result is that of the last one, and results['steps'] has the numbers of all. A case that
does not converge is a result, too: look at `converged`.

`progress` is called with a dict after each level of refinement. Ctrl-C ends the solution with KeyboardInterrupt, in a thread what
PyThreadState_SetAsyncExc sets for it; so does `stop`, a callable that is asked every 20 ms, when it returns true (threading.Event().is_set),
and whatever `progress`, `stop` or a function of the case raises.

>>> import unilateral
>>> levels = []
>>> result = unilateral.Case({"mesh": {"box": [[0], [1]], "cells": 8, "refine": 2}, "model": {"kind": "membrane", "load": 1},
...                           "boundary": {"all": 0}, "constraint": {"upper": 1 / 18}}).solve(progress=levels.append)
>>> [level["n_dofs"] for level in levels]
[9, 17, 33]
>>> result.converged
True)")
    .def_property_readonly(
      "toml", [](const PythonCase &request) { return expand(request); },
      "The case as TOML, every default filled in. What has been handed over as a function or array stands there by its number alone.")
    .def_readonly("title", &PythonCase::title)
    .def_readonly("name", &PythonCase::name)
    .def_readonly("dimension", &PythonCase::dimension)
    .def_readonly("part_names", &PythonCase::part_names, "Parts of the boundary, as far as they are known before the mesh is built.")
    .def_readonly("region_names", &PythonCase::region_names, "Regions, as far as they are known before the mesh is built.")
    .def("__repr__",
         [](const PythonCase &request) { return fmt::format("<unilateral.Case '{}', {}-D>", request.name, request.dimension); });
  add_studies(cases);

  results
    .def_property_readonly(
      "results",
      [](Result &result)
      {
        if (!result.results)
          result.results = to_python(*result.folder.results);
        return result.results;
      },
      "All numbers: the dict of results.json (doc/case-file.md).")
    .def_property_readonly(
      "certificate", [](const py::object &self) { return self.attr("results").attr("get")("certificate"); },
      "results['certificate']: what the penalty and the solver add to the error, at most.")
    .def_property_readonly(
      "estimate", [](const py::object &self) { return self.attr("results").attr("get")("estimate"); },
      "results['estimate']: the error of u in the energy norm, guaranteed where `guaranteed` says so; None where there is none.")
    .def_readonly("converged", &Result::converged)
    .def_readonly("as_expected", &Result::as_expected, "Every [[expect]] of the case holds.")
    .def_property_readonly(
      "points", [](const py::object &self) { return points_of(self.cast<const Result &>().folder.solution, self); },
      "Nodes, (n, 3); coordinates that the mesh does not have are 0.")
    .def_property_readonly(
      "cells", [](const py::object &self) { return cells_of(self.cast<const Result &>().folder.solution, self); },
      "Corners of the linear cells between the nodes in VTK's order, (n_cells, corners).")
    .def_property_readonly(
      "solution",
      [](const py::object &self) { return array_of(*find_array(self.cast<const Result &>().folder.solution.point_arrays, "u"), self); },
      "u at `points`: (n,), of bodies (n, 3).")
    .def_property_readonly(
      "pressure",
      [](const py::object &self) -> py::object
      {
        const auto &arrays = self.cast<const Result &>().folder.solution.point_arrays;
        for (const char *const name : {"contact_pressure", "contact_pressure_0"})
          if (const VtuArray *const array = find_array(arrays, name))
            return array_of(*array, self);
        return py::none();
      },
      "The contact pressure at `points`, of the first constraint where there are several (see `fields`); None without constraints.")
    .def_property_readonly(
      "fields", [](const py::object &self) { return arrays_of(self.cast<const Result &>().folder.solution.point_arrays, self); },
      "All functions at `points` by name: u, contact_pressure, lower, upper; of a body von_mises, stress_xx, ..., stress_1, ...")
    .def_property_readonly(
      "cell_fields", [](const py::object &self) { return arrays_of(self.cast<const Result &>().folder.solution.cell_arrays, self); },
      "What `cells` have, by name: level (of refinement), region (its number).")
    .def_property_readonly(
      "contact_points", [](const py::object &self) { return points_of(self.cast<const Result &>().folder.points, self); },
      "The integration points of I_G, (m, 3).")
    .def_property_readonly(
      "contact", [](const py::object &self) { return arrays_of(self.cast<const Result &>().folder.points.point_arrays, self); },
      "What is known at `contact_points`, by name: pressure, gap, penetration, active, weight, side, block.")
    .def(
      "to_html", [](const Result &result) { return report_html({result.folder}); }, "The report as one HTML page.")
    .def(
      "to_svg",
      [](const Result &result, const std::string &field)
      { return picture_svg(make_scene(result.folder), result.folder.title(), {.field = field}); },
      py::arg("field") = "", "A picture; `field` is what its colours show.")
    .def(
      "_repr_html_",
      [](const Result &result)
      {
        const std::string page = report_html({result.folder});
        return py::str(
                 "<iframe sandbox=\"allow-scripts allow-downloads\" style=\"width:100%;height:720px;border:0\" srcdoc=\"{}\"></iframe>")
          .format(py::module_::import("html").attr("escape")(page));
      },
      "The report in a notebook.")
    .def(
      "save", [](const Result &result, const std::filesystem::path &directory) { write_results(result, directory.string()); },
      py::arg("directory"), "Writes results.json, the VTU files, report.html and case.toml into a folder.")
    .def("__repr__", [](const Result &result)
         { return fmt::format("<unilateral.Result of '{}', {}>", result.folder.name, result.converged ? "converged" : "not converged"); });
}
