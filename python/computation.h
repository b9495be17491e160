// Running the library from Python: the GIL, interrupts, warnings.
#pragma once

#include "python/case_text.h"
#include "python/python_progress.h"

#include "unilateral/base/diagnostics.h"

#include <nlohmann/json.hpp>
#include <pybind11/pybind11.h>

#include <type_traits>

namespace unilateral
{
  /// MPI and what lives on it start with the first computation and end with Python.
  void start_libraries();

  pybind11::object to_python(const nlohmann::ordered_json &json);

  /// Calls @p action with the dimension of the case as a type, diagnostics and progress, the GIL released. Warnings become those of Python.
  template <typename Action>
  auto compute(const PythonCase &request, const pybind11::object &on_level, const pybind11::object &stop, const Action &action)
  {
    start_libraries();
    Diagnostics    diagnostics;
    PythonProgress progress(on_level, stop);
    const auto     call = [&](const auto dim)
    {
      try
      {
        const pybind11::gil_scoped_release free;
        return action(dim, diagnostics, progress);
      }
      catch (const Interrupted &)
      {
        progress.throw_reason();
      }
      catch (const InputError &e)
      {
        if (request.text.empty())
          throw;
        throw InputError(with_keys(e.diagnostics, request.text, request.file_in_messages));
      }
    };
    auto result = request.dimension == 1   ? call(std::integral_constant<int, 1>())
                  : request.dimension == 2 ? call(std::integral_constant<int, 2>())
                                           : call(std::integral_constant<int, 3>());
    warn(diagnostics, request);
    return result;
  }
} // namespace unilateral
