#include "unilateral/base/confined_process.h"

#include "unilateral/base/progress.h"

#include <fmt/format.h>

#include <array>
#include <cerrno>
#include <chrono>
#include <csignal>
#include <cstdlib>
#include <cstring>
#include <ctime>
#include <new>
#include <optional>
#include <stdexcept>
#include <string>
#include <vector>

#include <dirent.h>
#include <fcntl.h>
#include <poll.h>
#include <sys/prctl.h>
#include <sys/syscall.h>
#include <sys/wait.h>
#include <unistd.h>

namespace unilateral
{
  namespace
  {
    // First bytes of what the child sends, beside those of Violation.
    constexpr char tag_answer = 'A', tag_exit = 'X', tag_memory = 'M';

    int report = -1;

    bool send(const char *data, std::size_t size)
    {
      while (size > 0)
      {
        const ssize_t n = write(report, data, size);
        if (n < 0 && errno == EINTR)
          continue;
        if (n <= 0)
          return false;
        data += n;
        size -= std::size_t(n);
      }
      return true;
    }

    /// exit() in the middle of the work. What this process inherited to be done at its end (MPI, temporary files, buffers) is the parent's.
    void on_exit_of_child()
    {
      send(&tag_exit, 1);
      _exit(0);
    }

    void close_all_but(const int keep)
    {
#ifdef SYS_close_range
      if ((keep == 3 || syscall(SYS_close_range, 3u, unsigned(keep - 1), 0u) == 0) &&
          syscall(SYS_close_range, unsigned(keep + 1), ~0u, 0u) == 0)
        return;
#endif
      const long n = std::min(sysconf(_SC_OPEN_MAX), 65536l);
      for (int file = 3; file < n; ++file)
        if (file != keep)
          close(file);
    }

    [[noreturn]] void child(const std::function<void()>                            &prepare,
                            const std::function<std::string(const SandboxState &)> &work,
                            const SandboxRules                                     &rules,
                            const pid_t                                             parent)
    {
      // The parent decides what an interrupt means; any other signal is the end of this process only.
      for (int number = 1; number < NSIG; ++number)
        std::signal(number, number == SIGINT || number == SIGTERM || number == SIGHUP || number == SIGPIPE ? SIG_IGN : SIG_DFL);
      sigset_t none;
      sigemptyset(&none);
      sigprocmask(SIG_SETMASK, &none, nullptr);
      prctl(PR_SET_PDEATHSIG, SIGKILL);
      if (getppid() != parent)
        _exit(1);
      const int nothing = open("/dev/null", O_RDWR);
      for (const int stream : {STDIN_FILENO, STDOUT_FILENO, STDERR_FILENO})
        if (nothing < 0 || dup2(nothing, stream) < 0)
          close(stream); // a folder made a root directory may have no /dev
      close_all_but(report);
      clearenv();
      std::atexit(on_exit_of_child);
      try
      {
        prepare();
        const std::string answer = work(enter_sandbox(rules, report));
        if (send(&tag_answer, 1))
          send(answer.data(), answer.size());
        _exit(0);
      }
      catch (const std::bad_alloc &)
      {
        send(&tag_memory, 1);
        _exit(1);
      }
      catch (...)
      {
        std::signal(SIGABRT, SIG_DFL);
        std::abort();
      }
    }

    ConfinedResult result_of(const int status, const bool late, std::string received)
    {
      using End = ConfinedResult::End;
      ConfinedResult result;
      if (WIFSIGNALED(status))
        result.signal = WTERMSIG(status);
      if (late || result.signal == SIGXCPU)
        result.end = End::out_of_time;
      else if (result.signal == SIGSYS) // the library blocks signals while it starts a program, so the handler was not asked
        result.end = End::command;
      else if (result.signal == SIGKILL)
        result.end = End::out_of_memory;
      else if (received.empty())
        result.end = End::crashed;
      else
        switch (received.front())
        {
        case tag_answer:
          result.end = result.signal == 0 ? End::finished : End::crashed;
          received.erase(0, 1);
          result.answer = std::move(received);
          break;
        case tag_exit:
          result.end = End::exited;
          break;
        case tag_memory:
          result.end = End::out_of_memory;
          break;
        case static_cast<char>(Violation::command):
          result.end = End::command;
          break;
        case static_cast<char>(Violation::writing):
          result.end = End::writing;
          break;
        default:
          result.end = End::crashed;
        }
      return result;
    }

    /// A child of this process, and the end of the pipe on which it answers.
    class ChildProcess
    {
    public:
      ChildProcess(const ChildProcess &) = delete;
      ChildProcess &operator=(const ChildProcess &) = delete;
      /// Throws std::runtime_error when no process can be started.
      ChildProcess(const std::function<void()>                            &prepare,
                   const std::function<std::string(const SandboxState &)> &work,
                   const SandboxRules                                     &rules);

      /// One that has not been finished is killed; waits a little for its end: the system may take seconds to clear gigabytes of memory
      /// away.
      ~ChildProcess();

      /// Processor time in seconds; 0 where the system does not tell.
      double used_time() const;

      /// How many bytes it sent: 0 at the end, nothing if there are none yet after a tenth of a second.
      std::optional<std::size_t> receive(std::vector<char> &buffer) const;

      /// Waits for its end, which @p kill_it brings about. Returns the status of waitpid().
      int finish(bool kill_it);

    private:
      pid_t process = -1; ///< -1: finished
      int   answers = -1;
    };

    ChildProcess::ChildProcess(const std::function<void()>                            &prepare,
                               const std::function<std::string(const SandboxState &)> &work,
                               const SandboxRules                                     &rules)
    {
      std::array<int, 2> ends = {-1, -1};
      if (pipe2(ends.data(), O_CLOEXEC) != 0)
        throw std::runtime_error(fmt::format("no pipe to another process can be made: {}", std::strerror(errno)));
      const pid_t parent = getpid();
      // A copy of this process, not a program of its own: that works from every executable, and where there is no /proc to find one by.
      process = fork();
      if (process < 0)
      {
        const int reason = errno;
        close(ends[0]);
        close(ends[1]);
        throw std::runtime_error(fmt::format("no process can be started: {}", std::strerror(reason)));
      }
      if (process == 0)
      {
        report = ends[1];
        child(prepare, work, rules, parent);
      }
      close(ends[1]);
      answers = ends[0];
    }

    double ChildProcess::used_time() const
    {
      clockid_t clock = {};
      timespec  used = {};
      return clock_getcpuclockid(process, &clock) == 0 && clock_gettime(clock, &used) == 0
               ? double(used.tv_sec) + 1e-9 * double(used.tv_nsec)
               : 0.;
    }

    std::optional<std::size_t> ChildProcess::receive(std::vector<char> &buffer) const
    {
      pollfd    event = {answers, POLLIN, 0};
      const int ready = poll(&event, 1, 100);
      if (ready <= 0)
        return {};
      const ssize_t n = read(answers, buffer.data(), buffer.size());
      if (n < 0 && (errno == EINTR || errno == EAGAIN))
        return {};
      return n <= 0 ? 0 : std::size_t(n);
    }

    int ChildProcess::finish(const bool kill_it)
    {
      if (kill_it)
        kill(process, SIGKILL);
      close(answers);
      int status = 0;
      while (waitpid(process, &status, 0) < 0 && errno == EINTR)
        ;
      process = -1;
      return status;
    }

    ChildProcess::~ChildProcess()
    {
      if (process < 0)
        return;
      int status = 0;
      kill(process, SIGKILL);
      close(answers);
      for (unsigned attempt = 0; attempt < 20 && waitpid(process, &status, WNOHANG) == 0; ++attempt)
        poll(nullptr, 0, 10);
    }

    /// For how long a process has used no time of the processor. One that waits for something uses none; one that others keep from the
    /// processor gets on.
    class IdleTime
    {
    public:
      bool exceeds(const double seconds, const double used_time)
      {
        const auto now = std::chrono::steady_clock::now();
        if (used_time > last_used)
        {
          last_used = used_time;
          last_active = now;
          return false;
        }
        return now - last_active > std::chrono::duration<double>(seconds);
      }

    private:
      double                                last_used = 0;
      std::chrono::steady_clock::time_point last_active = std::chrono::steady_clock::now();
    };
  } // namespace

  ConfinedResult run_confined(const std::function<void()>                            &prepare,
                              const std::function<std::string(const SandboxState &)> &work,
                              const SandboxRules                                     &rules,
                              const std::function<bool()>                            &stop_requested)
  {
    ChildProcess      process(prepare, work, rules);
    IdleTime          idle; // the limit of the sandbox counts the processor's time
    std::string       received;
    std::vector<char> buffer(1 << 16);
    for (;;)
    {
      if (stop_requested && stop_requested())
        throw Interrupted();
      if (idle.exceeds(rules.idle_seconds, process.used_time()))
        return result_of(process.finish(true), true, "");
      const auto n = process.receive(buffer);
      if (!n)
        continue;
      if (*n == 0 || received.size() > rules.memory)
        break;
      received.append(buffer.data(), *n);
    }
    const int status = process.finish(received.size() > rules.memory);
    return result_of(status, false, std::move(received));
  }
} // namespace unilateral
