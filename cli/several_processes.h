// The program once more, as several processes.
#pragma once

namespace unilateral
{
  /// Starts this program with these arguments under mpirun, waits for it and returns its exit code; an interrupt ends it. @p argv ends with
  /// a null pointer.
  int run_as_processes(unsigned n_processes, char **argv);

  /// mpirun has started this process, as one of another number; says so on standard error.
  bool other_number_of_processes(unsigned n_processes);
} // namespace unilateral
