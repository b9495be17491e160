// Known before MPI is started, and without it.
#pragma once

namespace unilateral
{
  /// This process is one of those that an mpirun has started.
  bool started_by_mpirun();
} // namespace unilateral
