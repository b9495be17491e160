#include "unilateral/base/mpi_session.h"

#include <cstdlib>
#include <filesystem>
#include <string>

#include <unistd.h>

namespace unilateral
{
  namespace
  {
    // Not the program's arguments: PETSc, started along with MPI, would read them as its own.
    char   program_name[] = "unilateral";
    char  *argument_list[] = {program_name, nullptr};
    char **arguments = argument_list;
    int    n_arguments = 1;

    /// Can files be made in @p folder? Permissions do not tell of disks that are full or read-only.
    bool takes_files(const std::string &folder)
    {
      std::string probe = folder + "/unilateral-XXXXXX";
      return mkdtemp(probe.data()) != nullptr && rmdir(probe.c_str()) == 0;
    }

    /// Open MPI keeps a folder for itself even when there is one process, and without one it ends the program with a page of text.
    void choose_temporary_folder()
    {
      const char *wanted = nullptr; // what Open MPI would take
      for (const char *const name : {"OMPI_MCA_orte_tmpdir_base", "TMPDIR", "TEMP", "TMP"})
        if (wanted == nullptr || *wanted == 0)
          wanted = std::getenv(name);
      if (takes_files(wanted != nullptr && *wanted != 0 ? wanted : "/tmp"))
        return;
      std::error_code   failure;
      const std::string here = std::filesystem::current_path(failure).string();
      for (const std::string &folder : {std::string("/tmp"), std::string("/var/tmp"), std::string("/dev/shm"), here})
        if (takes_files(folder))
        {
          setenv("OMPI_MCA_orte_tmpdir_base", folder.c_str(), 1);
          setenv("TMPDIR", folder.c_str(), 1);
          return;
        }
    }

    /// A process that no mpirun started does without the daemon and the network that Open MPI would set up for it: a fifth of a second
    /// instead of half a one, and no failure on a machine without a network. What the user has set stays.
    int &without_network_when_alone(int &argc)
    {
      for (const char *const launched : {"OMPI_COMM_WORLD_SIZE", "PMIX_RANK", "PMI_RANK"})
        if (std::getenv(launched) != nullptr)
          return argc;
      choose_temporary_folder();
      setenv("OMPI_MCA_ess_singleton_isolated", "1", 0);
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
