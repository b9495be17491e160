// In a build with sanitizers: the first finding ends a process, with an exit code that no test expects. Leaks are not looked for: MPI
// leaves some behind, in modules that are gone when they are reported, so that they cannot be told from ours. In the program itself, not in
// its environment, which some tests take away.
extern "C"
{
  const char *__asan_default_options()
  {
    return "exitcode=99:detect_leaks=0";
  }

  const char *__ubsan_default_options()
  {
    return "halt_on_error=1:print_stacktrace=1:exitcode=99";
  }
}
