#include "unilateral/base/mpi_session.h"

#include "unilateral/base/mpirun.h"

#include <cstdlib>

namespace unilateral
{
  namespace
  {
    // Not the program's arguments: PETSc, started along with MPI, would read them as its own.
    char   program_name[] = "unilateral";
    char  *argument_list[] = {program_name, nullptr};
    char **arguments = argument_list;
    int    n_arguments = 1;

    /// A process that no mpirun started does without the daemon and the network that Open MPI would set up for it: a fifth of a second
    /// instead of half a one, and no failure on a machine without a network. What the user has set stays.
    int &without_network_when_alone(int &argc)
    {
      if (started_by_mpirun())
        return argc;
      setenv("OMPI_MCA_ess_singleton_isolated", "1", 0);
      // No folder for temporary files: all processes that are alone would have the same one, and each removes it in the end.
      setenv("OMPI_MCA_orte_create_session_dirs", "0", 0);
      setenv("OMPI_MCA_btl", "self", 0);
      setenv("OMPI_MCA_pml", "ob1", 0);
      setenv("OMPI_MCA_if", "^posix_ipv4,linux_ipv6", 0); // or it remarks that there is no network interface
      setenv("HWLOC_HIDE_ERRORS", "2", 0);                // or hwloc does on a machine without /sys
      return argc;
    }
  } // namespace

  MpiSession::MpiSession() : session(without_network_when_alone(n_arguments), arguments, 1) {}

  unsigned MpiSession::rank() const
  {
    return dealii::Utilities::MPI::this_mpi_process(MPI_COMM_WORLD);
  }

  unsigned MpiSession::n_ranks() const
  {
    return dealii::Utilities::MPI::n_mpi_processes(MPI_COMM_WORLD);
  }
} // namespace unilateral
