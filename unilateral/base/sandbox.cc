#include "unilateral/base/sandbox.h"

#include <algorithm>
#include <cerrno>
#include <cmath>
#include <csignal>
#include <cstddef>
#include <fstream>

#include <fcntl.h>
#include <linux/audit.h>
#include <linux/filter.h>
#include <linux/seccomp.h>
#include <sched.h>
#include <sys/prctl.h>
#include <sys/resource.h>
#include <sys/stat.h>
#include <sys/syscall.h>
#include <unistd.h>

namespace unilateral
{
  namespace
  {
    // ---- Landlock: what may be read. The kernel's interface is written out here, headers of older systems know a part of it or nothing.

    constexpr long create_ruleset = 444, add_rule = 445, restrict_self = 446; // the same numbers on every architecture

    struct RulesetAttributes
    {
      std::uint64_t files, network, scopes;
    };
    struct [[gnu::packed]] PathRule
    {
      std::uint64_t allowed;
      std::int32_t  parent;
    };
    constexpr std::uint64_t read_file = 1u << 2;

    /// Everything that version @p abi of Landlock can deny.
    RulesetAttributes all_rights(const long abi)
    {
      const unsigned    n_file_rights = abi < 2 ? 13 : abi < 3 ? 14 : abi < 5 ? 15 : 16;
      RulesetAttributes attributes = {(std::uint64_t(1) << n_file_rights) - 1, 0, 0};
      if (abi >= 4)
        attributes.network = 3; // bind and connect
      if (abi >= 6)
        attributes.scopes = 3; // abstract sockets and signals to processes outside
      return attributes;
    }

    /// Requires that no new privileges can be had.
    bool restrict_paths(const std::vector<std::string> &readable)
    {
      const long abi = syscall(create_ruleset, nullptr, 0, 1);
      if (abi < 1)
        return false;
      const RulesetAttributes attributes = all_rights(abi);
      const int               ruleset = int(syscall(create_ruleset, &attributes, abi < 4 ? 8 : abi < 6 ? 16 : sizeof(attributes), 0));
      if (ruleset < 0)
        return false;
      for (const std::string &path : readable)
      {
        const int object = open(path.c_str(), O_PATH | O_NOFOLLOW | O_CLOEXEC);
        if (object < 0)
          continue; // what is not there cannot be read
        const PathRule rule = {read_file, object};
        syscall(add_rule, ruleset, 1, &rule, 0); // fails for links, which then stay closed
        close(object);
      }
      const bool restricted = syscall(restrict_self, ruleset, 0) == 0;
      close(ruleset);
      return restricted;
    }

    // ---- seccomp: which calls of the system may be made.

#if defined(__x86_64__)
    constexpr unsigned architecture = AUDIT_ARCH_X86_64;
#elif defined(__aarch64__)
    constexpr unsigned architecture = AUDIT_ARCH_AARCH64;
#else
    constexpr unsigned architecture = 0;
#endif

    /// Memory, time, threads of its own, reading: what computing takes.
    constexpr long harmless[] = {SYS_read,
                                 SYS_write,
                                 SYS_readv,
                                 SYS_writev,
                                 SYS_pread64,
                                 SYS_preadv,
                                 SYS_lseek,
                                 SYS_close,
                                 SYS_fstat,
                                 SYS_newfstatat,
                                 SYS_statx,
                                 SYS_statfs,
                                 SYS_fstatfs,
                                 SYS_faccessat,
                                 SYS_readlinkat,
                                 SYS_getcwd,
                                 SYS_getdents64,
                                 SYS_fcntl,
                                 SYS_dup,
                                 SYS_fadvise64,
                                 SYS_mmap,
                                 SYS_munmap,
                                 SYS_mremap,
                                 SYS_mprotect,
                                 SYS_madvise,
                                 SYS_brk,
                                 SYS_mincore,
                                 SYS_futex,
                                 SYS_set_robust_list,
                                 SYS_get_robust_list,
                                 SYS_set_tid_address,
                                 SYS_sched_yield,
                                 SYS_sched_getaffinity,
                                 SYS_sched_setaffinity,
                                 SYS_membarrier,
                                 SYS_rseq,
                                 SYS_getcpu,
                                 SYS_clock_gettime,
                                 SYS_clock_getres,
                                 SYS_clock_nanosleep,
                                 SYS_nanosleep,
                                 SYS_gettimeofday,
                                 SYS_times,
                                 SYS_getrusage,
                                 SYS_rt_sigaction,
                                 SYS_rt_sigprocmask,
                                 SYS_rt_sigreturn,
                                 SYS_sigaltstack,
                                 SYS_restart_syscall,
                                 SYS_getpid,
                                 SYS_getppid,
                                 SYS_gettid,
                                 SYS_getuid,
                                 SYS_geteuid,
                                 SYS_getgid,
                                 SYS_getegid,
                                 SYS_uname,
                                 SYS_sysinfo,
                                 SYS_getrandom,
                                 SYS_getrlimit,
                                 SYS_exit,
                                 SYS_exit_group,
#ifdef SYS_faccessat2
                                 SYS_faccessat2,
#endif
#ifdef SYS_stat
                                 SYS_stat,
                                 SYS_lstat,
                                 SYS_access,
                                 SYS_readlink,
                                 SYS_dup2,
                                 SYS_poll,
                                 SYS_time,
                                 SYS_arch_prctl,
#endif
                                 SYS_ppoll};

    constexpr long commands[] = {SYS_execve, SYS_execveat,
#ifdef SYS_fork
                                 SYS_fork, SYS_vfork
#endif
    };

    class Filter
    {
    public:
      Filter()
      {
        load(offsetof(seccomp_data, arch));
        jump(BPF_JEQ, architecture, 1, 0);
        end(SECCOMP_RET_KILL_PROCESS);
        load(offsetof(seccomp_data, nr));
      }
      void on(const long call, const unsigned action)
      {
        jump(BPF_JEQ, unsigned(call), 0, 1);
        end(action);
      }
      /// @p action where argument @p argument of @p call has a bit of @p bits, @p otherwise where it has none.
      void on_bits(const long call, const unsigned argument, const unsigned bits, const unsigned action, const unsigned otherwise)
      {
        jump(BPF_JEQ, unsigned(call), 0, 4);
        load(low_half(argument));
        jump(BPF_JSET, bits, 0, 1);
        end(action);
        end(otherwise);
      }
      /// @p action where argument @p argument of @p call is @p value, @p otherwise where it is not.
      void on_value(const long call, const unsigned argument, const std::uint64_t value, const unsigned action, const unsigned otherwise)
      {
        jump(BPF_JEQ, unsigned(call), 0, 6);
        load(low_half(argument));
        jump(BPF_JEQ, unsigned(value), 0, 3);
        load(low_half(argument) + 4);
        jump(BPF_JEQ, unsigned(value >> 32), 0, 1);
        end(action);
        end(otherwise);
      }
      bool install(const unsigned otherwise)
      {
        end(otherwise);
        const sock_fprog program = {static_cast<unsigned short>(code.size()), code.data()};
        return prctl(PR_SET_SECCOMP, SECCOMP_MODE_FILTER, &program, 0, 0) == 0;
      }

    private:
      static unsigned low_half(const unsigned argument) // both architectures are little-endian
      {
        return offsetof(seccomp_data, args) + 8 * argument;
      }
      void load(const unsigned offset) { code.push_back(BPF_STMT(BPF_LD | BPF_W | BPF_ABS, offset)); }
      void end(const unsigned action) { code.push_back(BPF_STMT(BPF_RET | BPF_K, action)); }
      void jump(const unsigned test, const unsigned value, const unsigned if_so, const unsigned if_not)
      {
        code.push_back(BPF_JUMP(BPF_JMP | test | BPF_K, value, static_cast<unsigned char>(if_so), static_cast<unsigned char>(if_not)));
      }

      std::vector<sock_filter> code;
    };

    bool restrict_system_calls()
    {
      if (architecture == 0)
        return false;
      constexpr unsigned allow = SECCOMP_RET_ALLOW, trap = SECCOMP_RET_TRAP;
      const auto         refuse = [](const int error) { return SECCOMP_RET_ERRNO | unsigned(error); };
      Filter             filter;
      for (const long call : harmless)
        filter.on(call, allow);
      constexpr unsigned writing = O_WRONLY | O_RDWR | O_CREAT | O_TRUNC | O_APPEND;
      filter.on_bits(SYS_openat, 2, writing, trap, allow);
#ifdef SYS_open
      filter.on_bits(SYS_open, 1, writing, trap, allow);
      filter.on(SYS_creat, trap);
#endif
      for (const long call : commands)
        filter.on(call, trap);
      filter.on_bits(SYS_clone, 0, CLONE_THREAD, allow, trap);
#ifdef SYS_clone3
      filter.on(SYS_clone3, refuse(ENOSYS)); // its flags cannot be seen from here; libraries then take clone
#endif
      filter.on_value(SYS_tgkill, 0, std::uint64_t(getpid()), allow, refuse(EPERM)); // abort()
      filter.on_value(SYS_prlimit64, 2, 0, allow, refuse(EPERM));                    // limits may be asked for, not raised
      return filter.install(refuse(EPERM));
    }

    int report_to = -1;

    /// A call was refused with a signal: say what it was, and end.
    extern "C" void on_refused_call(int, siginfo_t *info, void *)
    {
      bool writing = info->si_syscall == SYS_openat;
#ifdef SYS_open
      writing = writing || info->si_syscall == SYS_open || info->si_syscall == SYS_creat;
#endif
      const char                  tag = static_cast<char>(writing ? Violation::writing : Violation::command);
      [[maybe_unused]] const auto written = write(report_to, &tag, 1);
      _exit(1);
    }

    void limit(const int resource, const rlim_t soft, const rlim_t hard)
    {
      rlimit limit = {};
      getrlimit(static_cast<__rlimit_resource>(resource), &limit);
      limit.rlim_max = std::min(limit.rlim_max, hard);
      limit.rlim_cur = std::min(limit.rlim_max, soft);
      setrlimit(static_cast<__rlimit_resource>(resource), &limit);
    }

    /// Bytes of address space that the process has; without /proc a generous guess.
    std::uint64_t address_space()
    {
      std::ifstream file("/proc/self/statm");
      std::uint64_t pages = 0;
      return file >> pages ? pages * std::uint64_t(sysconf(_SC_PAGESIZE)) : std::uint64_t(8) << 30;
    }
  } // namespace

  SandboxState enter_sandbox(const SandboxRules &rules, const int report)
  {
    limit(RLIMIT_AS, address_space() + rules.memory, address_space() + rules.memory);
    limit(RLIMIT_CPU, rlim_t(std::ceil(rules.cpu_seconds)), rlim_t(std::ceil(rules.cpu_seconds)) + 5);
    limit(RLIMIT_CORE, 0, 0);
    limit(RLIMIT_FSIZE, 0, 0);

    report_to = report;
    struct sigaction action = {};
    action.sa_sigaction = on_refused_call;
    action.sa_flags = SA_SIGINFO;
    sigaction(SIGSYS, &action, nullptr);

    SandboxState state;
    if (prctl(PR_SET_NO_NEW_PRIVS, 1, 0, 0, 0) != 0)
      return state;
    state.paths = restrict_paths(rules.readable);
    state.system_calls = restrict_system_calls();
    return state;
  }
} // namespace unilateral
