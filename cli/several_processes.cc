#include "cli/several_processes.h"

#include "cli/options.h"

#include <fmt/format.h>

#include <algorithm>
#include <cerrno>
#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <string>
#include <thread>
#include <vector>

#include <fcntl.h>
#include <sys/prctl.h>
#include <sys/wait.h>
#include <unistd.h>

namespace unilateral
{
  namespace
  {
    /// More than one only takes longer, but shows that a case can be shared.
    constexpr unsigned most_for_a_processor = 16;

    volatile std::sig_atomic_t mpirun = 0, interrupted = 0;

    void pass_on(int)
    {
      interrupted = 1;
      if (mpirun != 0)
        kill(mpirun, SIGTERM);
    }

    /// Slurm, PBS or LSF says how many processes may run where.
    bool within_allocation()
    {
      for (const char *const job : {"SLURM_JOB_ID", "PBS_JOBID", "LSB_JOBID"})
        if (std::getenv(job) != nullptr)
          return true;
      return false;
    }

    /// The user names other machines, whose processors count, too.
    bool has_list_of_hosts()
    {
      return std::getenv("OMPI_MCA_orte_default_hostfile") != nullptr;
    }
  } // namespace

  bool other_number_of_processes(const unsigned n_processes)
  {
    const char *const started = std::getenv("OMPI_COMM_WORLD_SIZE");
    if (started == nullptr || std::to_string(n_processes) == started)
      return false;
    fmt::print(stderr, "unilateral: error: mpirun has started {} processes, and -n says {}; leave out one of them\n", started, n_processes);
    return true;
  }

  int run_as_processes(const unsigned n_processes, char **const argv)
  {
    if (const unsigned most = most_for_a_processor * std::max(1U, std::thread::hardware_concurrency());
        n_processes > most && !within_allocation() && !has_list_of_hosts())
    {
      fmt::print(stderr, "unilateral: error: -n {}: this machine has {} processors; start at most {} processes on it\n", n_processes,
                 std::thread::hardware_concurrency(), most);
      return exit_bad_input;
    }
    if (const char *const places = std::getenv("SLURM_NTASKS"); places != nullptr && !has_list_of_hosts() &&
                                                                std::getenv("OMPI_MCA_rmaps_base_oversubscribe") == nullptr &&
                                                                n_processes > std::strtoul(places, nullptr, 10))
    {
      fmt::print(stderr, "unilateral: error: -n {}: this job has {} tasks (SLURM_NTASKS)\n", n_processes, places);
      return exit_bad_input;
    }
    // Messages of the program's own say what was wrong; what mpirun says of the exit codes is no help. With 0 it speaks.
    setenv("OMPI_MCA_orte_execute_quiet", "1", 0);
    std::vector<std::string> words = {"mpirun", "-n", std::to_string(n_processes),
                                      std::filesystem::read_symlink("/proc/self/exe").string()};
    if (geteuid() == 0)
      words.insert(words.begin() + 1, "--allow-run-as-root");
    if (!within_allocation())
    {
      words.insert(words.begin() + 1, "--oversubscribe"); // more than there are cores take turns, in place of an error
      if (!has_list_of_hosts())                           // two runs at a time would be bound to the same cores
        setenv("OMPI_MCA_hwloc_base_binding_policy", "none", 0);
    }
    if (isatty(STDOUT_FILENO) == 0) // to its processes mpirun looks like a terminal nevertheless
      setenv("TERM", "dumb", 1);
    for (char **word = argv + 1; *word != nullptr; ++word)
      words.emplace_back(*word);
    std::vector<char *> arguments;
    for (std::string &word : words)
      arguments.push_back(word.data());
    arguments.push_back(nullptr);

    // mpirun answers an interrupt from the keyboard by killing its processes in silence, and a SIGTERM by passing it on: it gets the latter
    // alone, in a process group of its own, also when this process is killed.
    constexpr int cannot_be_started = 127;
    const pid_t   child = fork();
    if (child == 0)
    {
      setpgid(0, 0);
      prctl(PR_SET_PDEATHSIG, SIGTERM);
      if (const int nothing = open("/dev/null", O_RDONLY); nothing >= 0) // such a group is stopped when it reads from the terminal
        dup2(nothing, STDIN_FILENO);
      execvp("mpirun", arguments.data());
      fmt::print(stderr, "unilateral: error: mpirun cannot be started: {}; Debian has it in the package openmpi-bin\n",
                 std::strerror(errno));
      _exit(cannot_be_started);
    }
    if (child < 0)
    {
      fmt::print(stderr, "unilateral: error: no process can be started: {}\n", std::strerror(errno));
      return exit_internal_error;
    }
    mpirun = child;
    for (const int signal : {SIGINT, SIGTERM, SIGHUP})
      std::signal(signal, pass_on);
    int status = 0;
    while (waitpid(child, &status, 0) < 0 && errno == EINTR)
    {
    }
    if (interrupted && WIFEXITED(status) && WEXITSTATUS(status) == exit_interrupted) // it has said so
      return exit_interrupted;
    if (interrupted)
    {
      fmt::print(stderr, "interrupted: the results are not complete; --resume goes on with what was finished\n");
      return exit_interrupted;
    }
    if (WIFEXITED(status) && WEXITSTATUS(status) == cannot_be_started)
      return exit_internal_error;
    const int code = WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status);
    if (code <= 128 || code == exit_interrupted)
      return code;
    // As shells do, mpirun gives the signal that ended a process as 128 and its number; what else is above 128 is an error of its own.
    if (code - 128 > SIGRTMAX)
    {
      fmt::print(
        stderr,
        "unilateral: error: mpirun has ended with {}: a host, or the connection to it, was lost or could not be had, and the results "
        "are not complete; --resume goes on with what was finished; OMPI_MCA_orte_execute_quiet=0 in the "
        "environment makes mpirun say more\n",
        code);
      return exit_internal_error;
    }
    const char *remedy = "";
    if (code == 128 + SIGKILL)
      remedy = ", is there enough memory?";
    if (code == 128 + SIGILL) // also what mpirun says when it does not find the program on another host
      remedy = ", is the program in the same place on all hosts, and compiled for their processors?";
    fmt::print(
      stderr,
      "unilateral: error: a process was ended by signal {} ({}), and the others with it: the results are not complete{}; --resume goes on "
      "with what was finished\n",
      code - 128, strsignal(code - 128), remedy);
    return exit_internal_error;
  }
} // namespace unilateral
