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
#include <stdexcept>

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
  } // namespace

  ConfinedResult run_confined(const std::function<void()>                            &prepare,
                              const std::function<std::string(const SandboxState &)> &work,
                              const SandboxRules                                     &rules,
                              const std::function<bool()>                            &stop_requested)
  {
    std::array<int, 2> ends = {-1, -1};
    if (pipe2(ends.data(), O_CLOEXEC) != 0)
      throw std::runtime_error(fmt::format("no pipe to another process can be made: {}", std::strerror(errno)));
    const pid_t parent = getpid();
    // A copy of this process, not a program of its own: that works from every executable, and where there is no /proc to find one by.
    const pid_t process = fork();
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

    int        status = 0;
    const auto finish = [&](const bool kill_it)
    {
      if (kill_it)
        kill(process, SIGKILL);
      close(ends[0]);
      while (waitpid(process, &status, 0) < 0 && errno == EINTR)
        ;
    };

    // Its limit counts the processor's time. A process that waits for something uses none; one that others keep from the processor gets on.
    const auto used_time = [&]
    {
      clockid_t clock = {};
      timespec  used = {};
      return clock_getcpuclockid(process, &clock) == 0 && clock_gettime(clock, &used) == 0
               ? double(used.tv_sec) + 1e-9 * double(used.tv_nsec)
               : 0.;
    };
    double            last_used = 0;
    auto              last_active = std::chrono::steady_clock::now();
    std::string       received;
    std::vector<char> buffer(1 << 16);
    for (;;)
    {
      if (stop_requested && stop_requested())
      {
        kill(process, SIGKILL);
        close(ends[0]);
        // Not until it is gone: the system may take seconds to clear gigabytes of memory away.
        for (unsigned attempt = 0; attempt < 20 && waitpid(process, &status, WNOHANG) == 0; ++attempt)
          poll(nullptr, 0, 10);
        throw Interrupted();
      }
      const auto now = std::chrono::steady_clock::now();
      if (const double used = used_time(); used > last_used)
      {
        last_used = used;
        last_active = now;
      }
      else if (now - last_active > std::chrono::duration<double>(rules.idle_seconds))
      {
        finish(true);
        return result_of(status, true, "");
      }
      pollfd    event = {ends[0], POLLIN, 0};
      const int ready = poll(&event, 1, 100);
      if (ready <= 0)
        continue;
      const ssize_t n = read(ends[0], buffer.data(), buffer.size());
      if (n < 0 && (errno == EINTR || errno == EAGAIN))
        continue;
      if (n <= 0 || received.size() > rules.memory)
        break;
      try
      {
        received.append(buffer.data(), std::size_t(n));
      }
      catch (...)
      {
        finish(true);
        throw;
      }
    }
    finish(received.size() > rules.memory);
    return result_of(status, false, std::move(received));
  }
} // namespace unilateral
