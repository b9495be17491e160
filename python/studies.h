// check, infsup and the studies as methods of a case.
#pragma once

#include "python/case_text.h"

#include <pybind11/pybind11.h>

namespace unilateral
{
  void add_studies(pybind11::class_<PythonCase> &cases);
} // namespace unilateral
