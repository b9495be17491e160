#include "python/python_progress.h"

#include <pybind11/eval.h>

#include <utility>

namespace py = pybind11;

namespace unilateral
{
  PythonProgress::PythonProgress(py::object on_level, py::object stop)
    : on_level(std::move(on_level)), stop(std::move(stop)), any_instruction(py::eval("lambda: None"))
  {
  }

  void PythonProgress::level_finished(const LevelReport &level)
  {
    const py::gil_scoped_acquire lock;
    if (!on_level.is_none())
      on_level(py::dict(py::arg("level") = level.level, py::arg("n_dofs") = level.n_dofs, py::arg("n_points") = level.n_points,
                        py::arg("n_active") = level.n_active, py::arg("newton_iterations") = level.newton_iterations,
                        py::arg("residual") = level.residual, py::arg("seconds") = level.seconds, py::arg("converged") = level.converged));
  }

  bool PythonProgress::stop_requested() const
  {
    constexpr std::chrono::milliseconds interval(20);
    const auto                          now = std::chrono::steady_clock::now();
    if (stopped || now - asked < interval)
      return stopped;
    asked = now;
    const py::gil_scoped_acquire lock;
    try
    {
      // Signals reach the main thread; what PyThreadState_SetAsyncExc sets for another is raised when it interprets something.
      if (PyErr_CheckSignals() != 0)
        throw py::error_already_set();
      any_instruction();
      stopped = !stop.is_none() && py::bool_(stop());
    }
    catch (py::error_already_set &e)
    {
      reason.emplace(std::move(e));
      stopped = true;
    }
    return stopped;
  }

  void PythonProgress::throw_reason() const
  {
    if (reason)
      throw py::error_already_set(std::move(*reason));
    PyErr_SetNone(PyExc_KeyboardInterrupt);
    throw py::error_already_set();
  }
} // namespace unilateral
