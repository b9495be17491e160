// The Python module `unilateral`: cases as files or dicts, results as dicts and NumPy arrays.
#include "unilateral/base/diagnostics.h"
#include "unilateral/base/mpi_session.h"
#include "unilateral/base/progress.h"
#include "unilateral/case/case_results.h"
#include "unilateral/case/expectations.h"
#include "unilateral/case/problem_of_case.h"
#include "unilateral/case/read_case.h"
#include "unilateral/case/toml_document.h"
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

namespace
{
  using namespace unilateral;

  /// MPI and what lives on it start with the first solution and end with Python.
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

  /// A value of Python as TOML; tables in one line.
  std::string toml_of(const py::handle &value)
  {
    if (py::isinstance<py::bool_>(value))
      return value.cast<bool>() ? "true" : "false";
    if (py::isinstance<py::int_>(value))
      return py::str(value);
    if (py::isinstance<py::float_>(value))
      return py::repr(py::float_(py::reinterpret_borrow<py::object>(value)));
    if (py::isinstance<py::str>(value))
      return toml_quoted(value.cast<std::string>());
    if (py::isinstance<py::dict>(value))
    {
      std::string text;
      for (const auto &[key, entry] : value.cast<py::dict>())
        text += fmt::format("{}{} = {}", text.empty() ? "" : ", ", toml_quoted(py::str(key)), toml_of(entry));
      return "{" + text + "}";
    }
    if (py::hasattr(value, "tolist")) // arrays and numbers of NumPy
      return toml_of(value.attr("tolist")());
    if (py::isinstance<py::list>(value) || py::isinstance<py::tuple>(value))
    {
      std::string text;
      for (const auto &entry : value)
        text += (text.empty() ? "" : ", ") + toml_of(entry);
      return "[" + text + "]";
    }
    if (py::hasattr(value, "__fspath__"))
      return toml_quoted(py::str(value.attr("__fspath__")()));
    throw py::type_error(
      fmt::format("a case holds numbers, texts, lists and dicts, not {}", std::string(py::str(py::type::handle_of(value)))));
  }

  std::vector<Override> overrides_of(const py::dict &settings)
  {
    std::vector<Override> overrides;
    for (const auto &[key, value] : settings)
      overrides.emplace_back(py::str(key), toml_of(value));
    return overrides;
  }

  /// Progress to a callable of Python, which gets a dict for each finished level; asks for Ctrl-C.
  class PythonProgress : public Progress
  {
  public:
    explicit PythonProgress(py::object callback) : callback(std::move(callback)) {}

    void level_finished(const LevelReport &level) override
    {
      const py::gil_scoped_acquire lock;
      if (!callback.is_none())
        callback(py::dict(py::arg("level") = level.level, py::arg("n_dofs") = level.n_dofs, py::arg("n_points") = level.n_points,
                          py::arg("n_active") = level.n_active, py::arg("newton_iterations") = level.newton_iterations,
                          py::arg("residual") = level.residual, py::arg("seconds") = level.seconds,
                          py::arg("converged") = level.converged));
    }

    bool stop_requested() const override
    {
      const py::gil_scoped_acquire lock;
      return PyErr_CheckSignals() != 0;
    }

  private:
    py::object callback;
  };

  void warn(const Diagnostics &diagnostics)
  {
    for (const Diagnostic &message : diagnostics.all())
      if (message.severity == Severity::warning && PyErr_WarnEx(PyExc_UserWarning, to_string(message).c_str(), 2) != 0)
        throw py::error_already_set(); // warnings are errors here
  }

  /// What a run has found; arrays are views into it.
  struct Result
  {
    std::string   json;
    ResultsFolder folder; ///< as if it had been written and read back
    bool          converged = false, as_expected = false;

    py::object results() const { return py::module_::import("json").attr("loads")(json); }
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

  py::dict arrays_of(const VtuGrid &grid, const py::handle &owner)
  {
    py::dict arrays;
    for (const VtuArray &array : grid.point_arrays)
      arrays[py::str(array.name)] = array_of(array, owner);
    return arrays;
  }

  template <int dim>
  std::unique_ptr<Result> solve_in(const Case &request, Progress &progress, Diagnostics &diagnostics)
  {
    auto                   result = std::make_unique<Result>();
    nlohmann::ordered_json json;
    {
      const py::gil_scoped_release free;
      Solution<dim>                solution = solve<dim>(problem_of(request), diagnostics, progress);
      result->as_expected = evaluate_expectations(solution.result, request);
      result->converged = solution.result.converged;
      json = to_json(solution.result, request);
      SolutionGrids grids = grids_of(solution);
      result->folder.name = request.name;
      result->folder.solution = std::move(grids.solution);
      result->folder.points = std::move(grids.points);
    }
    result->json = json.dump(-1, ' ', false, nlohmann::ordered_json::error_handler_t::replace);
    result->folder.results = std::move(json);
    return result;
  }

  std::unique_ptr<Result> solve_case(const Case &request, const py::object &callback)
  {
    start_libraries();
    Diagnostics             diagnostics;
    PythonProgress          progress(callback);
    std::unique_ptr<Result> result;
    try
    {
      result = request.dimension == 1   ? solve_in<1>(request, progress, diagnostics)
               : request.dimension == 2 ? solve_in<2>(request, progress, diagnostics)
                                        : solve_in<3>(request, progress, diagnostics);
    }
    catch (const Interrupted &)
    {
      if (!PyErr_Occurred())
        PyErr_SetNone(PyExc_KeyboardInterrupt);
      throw py::error_already_set();
    }
    warn(diagnostics);
    return result;
  }

  Case case_of_dict(const py::dict &content, const std::string &name)
  {
    std::string text;
    for (const auto &[key, value] : content)
      text += fmt::format("{} = {}\n", toml_quoted(py::str(key)), toml_of(value));
    Diagnostics diagnostics;
    Case        request = parse_case(text, name + ".toml", {}, diagnostics);
    warn(diagnostics);
    return request;
  }

  void write_results(const Result &result, const std::string &directory)
  {
    ResultFiles files(directory);
    const auto  json = nlohmann::ordered_json::parse(result.json);
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
  input_error.attr("__doc__") = "The case cannot be solved as it stands; the text has all mistakes, a line each, with their places.";
  py::register_exception_translator(
    [](std::exception_ptr thrown)
    {
      try
      {
        std::rethrow_exception(std::move(thrown));
      }
      catch (const InputError &e)
      {
        PyErr_SetString(input_error.ptr(), e.what());
      }
      catch (const dealii::ExceptionBase &e)
      {
        PyErr_SetString(PyExc_RuntimeError, e.get_exc_name());
      }
    });

  py::class_<Case>(module, "Case", "What is to be solved: the content of a case file (doc/case-file.md).")
    .def(py::init([](const py::dict &content, const std::string &name) { return case_of_dict(content, name); }), py::arg("content"),
         py::arg("name") = "case",
         "A case from a dict with the keys of a case file, e.g. Case({'mesh': {'box': [[0], [1]], 'cells': 64}, 'model': {'kind': "
         "'membrane'}, ...}). "
         "File names in it are relative to the current folder. Raises InputError.")
    .def_static(
      "load",
      [](const std::filesystem::path &path, const py::dict &settings)
      {
        Diagnostics diagnostics;
        Case        request = read_case(path.string(), overrides_of(settings), diagnostics);
        warn(diagnostics);
        return request;
      },
      py::arg("path"), py::arg("settings") = py::dict(),
      "The case in a file, with some keys set: load('a.toml', {'mesh.refine': 4}). Raises InputError.")
    .def(
      "with_settings",
      [](const Case &request, const py::dict &settings)
      {
        Diagnostics diagnostics;
        Case        other = parse_case(expand(request), request.path, overrides_of(settings), diagnostics);
        warn(diagnostics);
        return other;
      },
      py::arg("settings"), "The same case with some keys set: case.with_settings({'method.epsilon': 1e-3}). Raises InputError.")
    .def("solve", &solve_case, py::arg("progress") = py::none(),
         "Solves the case. `progress` is called with a dict after each level of refinement. Ctrl-C ends it with KeyboardInterrupt. A case "
         "that does "
         "not converge is a result, too: look at `converged`.")
    .def_property_readonly(
      "toml", [](const Case &request) { return expand(request); }, "The case as TOML, every default filled in.")
    .def_readonly("title", &Case::title)
    .def_readonly("name", &Case::name)
    .def_readonly("dimension", &Case::dimension)
    .def_readonly("part_names", &Case::part_names, "Parts of the boundary, as far as they are known before the mesh is built.")
    .def("__repr__", [](const Case &request) { return fmt::format("<unilateral.Case '{}', {}-D>", request.name, request.dimension); });

  py::class_<Result>(module, "Result", "A solution. Arrays are views of its memory: nothing is copied, and nothing can be written.")
    .def_property_readonly("results", &Result::results, "All numbers: the dict of results.json (doc/case-file.md).")
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
      "fields", [](const py::object &self) { return arrays_of(self.cast<const Result &>().folder.solution, self); },
      "All functions at `points` by name: u, contact_pressure, lower, upper, von_mises, stress_xx, ...")
    .def_property_readonly(
      "contact_points", [](const py::object &self) { return points_of(self.cast<const Result &>().folder.points, self); },
      "The integration points of I_G, (m, 3).")
    .def_property_readonly(
      "contact", [](const py::object &self) { return arrays_of(self.cast<const Result &>().folder.points, self); },
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
