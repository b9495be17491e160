#include "python/studies.h"

#include "python/computation.h"

#include "unilateral/case/problem_of_case.h"
#include "unilateral/functions/compile_field.h"
#include "unilateral/studies/epsilon_study.h"
#include "unilateral/studies/inf_sup_study.h"
#include "unilateral/studies/mesh_study.h"
#include "unilateral/studies/preview.h"
#include "unilateral/studies/quadrature_study.h"

#include <pybind11/stl.h>

#include <cmath>
#include <optional>
#include <string>
#include <vector>

namespace py = pybind11;

namespace unilateral
{
  namespace
  {
    using Json = nlohmann::ordered_json;

    py::object check_case_of(const PythonCase &request, const py::object &stop)
    {
      return to_python(compute(request, py::none(), stop,
                               [&](const auto dim, Diagnostics &diagnostics, Progress &progress)
                               { return to_json(check<dim>(problem_of(request), diagnostics, progress), request, dim); }));
    }

    py::object inf_sup_of(const PythonCase &request, const std::optional<unsigned> levels, const std::string &zone, const py::object &stop)
    {
      if (levels && *levels == 0)
        throw py::value_error("'levels' must be at least 1");
      return to_python(compute(request, py::none(), stop,
                               [&](const auto dim, Diagnostics &diagnostics, Progress &progress)
                               {
                                 InfSupStudyOptions wanted{.zone_name = zone, .limits = limits_for(dim)};
                                 if (!zone.empty())
                                 {
                                   FieldSpec spec = FieldSpec::expression(zone);
                                   spec.where = {"zone", 0, 0};
                                   wanted.zone = compile_field(spec, request.parameters, dim);
                                 }
                                 if (levels)
                                   wanted.n_levels = *levels;
                                 return to_json(study_inf_sup<dim>(problem_of(request), wanted, diagnostics, progress), request);
                               }));
    }

    py::object
    study_epsilon_of(const PythonCase &request, const std::vector<double> &values, const py::object &on_level, const py::object &stop)
    {
      for (const double epsilon : values)
        if (!(epsilon > 0) || !std::isfinite(epsilon))
          throw py::value_error("the values of epsilon must be positive numbers");
      return to_python(compute(request, on_level, stop,
                               [&](const auto dim, Diagnostics &diagnostics, Progress &progress)
                               { return to_json(study_epsilon<dim>(problem_of(request), {values}, diagnostics, progress), request); }));
    }

    py::object study_mesh_of(const PythonCase             &request,
                             const std::optional<unsigned> levels,
                             const std::optional<double>   epsilon,
                             const std::optional<double>   power,
                             const bool                    adaptive,
                             const py::object             &on_level,
                             const py::object             &stop)
    {
      if (levels && *levels == 0)
        throw py::value_error("'levels' must be at least 1");
      if (epsilon && !(*epsilon > 0 && std::isfinite(*epsilon)))
        throw py::value_error("'epsilon' must be positive");
      return to_python(compute(request, on_level, stop,
                               [&](const auto dim, Diagnostics &diagnostics, Progress &progress) {
                                 return to_json(study_mesh<dim>(problem_of(request), {levels.value_or(0), epsilon, power, adaptive},
                                                                diagnostics, progress),
                                                request);
                               }));
    }

    py::object study_quadrature_of(const PythonCase               &request,
                                   const std::vector<std::string> &rules,
                                   const py::object               &on_level,
                                   const py::object               &stop)
    {
      return to_python(compute(request, on_level, stop,
                               [&](const auto dim, Diagnostics &diagnostics, Progress &progress)
                               { return to_json(study_quadrature<dim>(problem_of(request), rules, diagnostics, progress), request); }));
    }
  } // namespace

  void add_studies(py::class_<PythonCase> &cases)
  {
    const py::arg_v progress = py::arg("progress") = py::none(), stop = py::arg("stop") = py::none();
    cases
      .def("check", &check_case_of, stop,
           R"(Mesh, names, gaps and stability as a dict; solves nothing. What `unilateral check --json` prints.

>>> import unilateral
>>> case = unilateral.Case({"mesh": {"box": [[0], [1]], "cells": 8}, "model": {"kind": "membrane", "load": 1},
...                         "boundary": {"all": 0}, "constraint": {"upper": 0.05}})
>>> case.check()["mesh"]["parts"]
['left', 'right'])")
      .def(
        "infsup", &inf_sup_of, py::arg("levels") = py::none(), py::arg("zone") = "", stop,
        R"(The inf-sup constants beta_h and C_h of element and rule on up to `levels` refinements of the coarse mesh, and a verdict, as the
dict of infsup.json; `zone`: an expression that is not 0 where pressures may live.

>>> import unilateral
>>> case = unilateral.Case({"mesh": {"box": [[0], [1]], "cells": 8}, "model": {"kind": "membrane", "load": 1},
...                         "boundary": {"all": 0}, "constraint": {"upper": 0.05}})
>>> [row["nullity"] for row in case.infsup(levels=2)["rows"]]
[0, 0])")
      .def("study_epsilon", &study_epsilon_of, py::arg("values") = std::vector<double>(), progress, stop,
           R"(The penalty method against the mixed solution, as the dict of study_epsilon.json; without `values` ten decades of epsilon.

>>> import unilateral
>>> case = unilateral.Case({"mesh": {"box": [[0], [1]], "cells": 64}, "model": {"kind": "membrane", "load": 1},
...                         "boundary": {"all": 0}, "constraint": {"upper": 1 / 18}})
>>> study = case.study_epsilon([1e-3, 1e-4, 1e-5])
>>> study["holds"]["theorem2"]
True)")
      .def("study_mesh", &study_mesh_of, py::arg("levels") = py::none(), py::arg("epsilon") = py::none(), py::arg("power") = py::none(),
           py::arg("adaptive") = false, progress, stop,
           "Errors and rates of convergence on one refinement after the other, as the dict of study_mesh.json; `epsilon` on the coarsest "
           "mesh and epsilon ~ h^power, else what the case says; `adaptive`: also meshes that are refined by the error.")
      .def("study_quadrature", &study_quadrature_of, py::arg("rules") = std::vector<std::string>(), progress, stop,
           "The rules I_G side by side, as the dict of study_quadrature.json; without `rules` all that the element takes.");
  }
} // namespace unilateral
