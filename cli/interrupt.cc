#include "cli/interrupt.h"

#include "cli/options.h"

#include <atomic>
#include <csignal>
#include <system_error>
#include <thread>

#include <unistd.h>

namespace unilateral
{
  namespace
  {
    std::atomic<int>  n_signals = 0;
    std::atomic<bool> may_end_at_once = false;
    /// Batch systems give 30 s and more before they kill what is left; a user at a keyboard waits.
    constexpr unsigned seconds_after_sigterm = 20;
    static_assert(std::atomic<int>::is_always_lock_free && std::atomic<bool>::is_always_lock_free); // handlers use them

    extern "C" void on_signal(const int signal)
    {
      if (++n_signals > 1)
        _exit(exit_interrupted); // the one way out that is safe inside a handler
      if (may_end_at_once)
        alarm(signal == SIGTERM ? seconds_after_sigterm : 1);
      if (!may_end_at_once) // any more: another thread may be about to put files in their places
        alarm(0);
    }

    /// The computation did not come to a place where it asks.
    extern "C" void on_alarm(int)
    {
      constexpr char              message[] = "\ninterrupted: what was not finished is lost\n";
      [[maybe_unused]] const auto written = write(STDERR_FILENO, message, sizeof(message) - 1);
      _exit(exit_interrupted);
    }

    extern "C" void on_crash(int)
    {
      constexpr char message[] =
        "unilateral: error: internal error (crash); this is a fault of the program, please report it together with "
        "the case file\n";
      [[maybe_unused]] const auto written = write(STDERR_FILENO, message, sizeof(message) - 1);
      _exit(exit_internal_error);
    }

    /// Open MPI's own handler would print a stack.
    void install_crash_handlers()
    {
      static char stack[1 << 16]; // an overflown stack has no room for the handler
      stack_t     alternative = {};
      alternative.ss_sp = stack;
      alternative.ss_size = sizeof(stack);
      sigaltstack(&alternative, nullptr);

      struct sigaction action = {};
      action.sa_handler = on_crash;
      sigemptyset(&action.sa_mask);
      action.sa_flags = SA_ONSTACK;
      for (const int signal : {SIGSEGV, SIGBUS, SIGFPE, SIGILL, SIGABRT})
        sigaction(signal, &action, nullptr);
    }

    /// A thread of its own waits for SIGTERM, which is blocked in all others: while METIS works, a handler of its own would jump out of
    /// whatever SIGTERM interrupts. Out of malloc with its lock held, the program would wait for that lock forever.
    bool wait_for_sigterm()
    {
      sigset_t term;
      sigemptyset(&term);
      sigaddset(&term, SIGTERM);
      pthread_sigmask(SIG_BLOCK, &term, nullptr);
      try
      {
        std::thread(
          [term]
          {
            for (;;)
              if (int number = 0; sigwait(&term, &number) == 0)
                on_signal(number);
          })
          .detach();
        return true;
      }
      catch (const std::system_error &) // no threads to be had
      {
        pthread_sigmask(SIG_UNBLOCK, &term, nullptr);
        return false;
      }
    }
  } // namespace

  void install_signal_handlers()
  {
    struct sigaction action = {};
    action.sa_handler = on_signal;
    sigemptyset(&action.sa_mask);
    action.sa_flags = SA_RESTART;
    sigaction(SIGINT, &action, nullptr);
    sigaction(SIGTERM, &action, nullptr);
    [[maybe_unused]] static const bool waits = wait_for_sigterm();
    action.sa_handler = on_alarm;
    sigaction(SIGALRM, &action, nullptr);
    std::signal(SIGPIPE, SIG_IGN);
    std::signal(SIGXFSZ, SIG_IGN); // a file that may not grow any more is an error of writing, as on a full disk
    install_crash_handlers();
  }

  void end_soon_after_signals()
  {
    may_end_at_once = true;
  }

  void finish_whatever_is_asked()
  {
    may_end_at_once = false;
    alarm(0);
  }

  bool interrupt_requested()
  {
    return n_signals > 0;
  }
} // namespace unilateral
