#include "cli/failure.h"

#include "cli/file_readers.h"
#include "cli/options.h"
#include "cli/run_files.h"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <new>
#include <stdexcept>
#include <string>

namespace unilateral
{
  Failure out_of_memory()
  {
    return {exit_internal_error, [](Console &console)
            { console.error("out of memory; try fewer refinements (mesh.refine) or an iterative solver (method.solver)"); }};
  }

  Failure internal_error(const std::string &text, const std::string &details)
  {
    return {exit_internal_error, [text, details](Console &console)
            {
              if (!details.empty())
                console.record(details);
              console.error(
                fmt::format("internal error ({}); this is a fault of the program, please report it together with the case file", text));
            }};
  }

  bool is_shortage_of_memory(const std::exception &e)
  {
    if (dynamic_cast<const std::bad_alloc *>(&e) || dynamic_cast<const std::length_error *>(&e))
      return true;
    std::string text = e.what();
    std::transform(text.begin(), text.end(), text.begin(), [](const unsigned char c) { return std::tolower(c); });
    return text.find("out of memory") != std::string::npos || text.find("bad_alloc") != std::string::npos ||
           text.find("cannot allocate memory") != std::string::npos;
  }

  Failure failure_of(const std::exception_ptr &exception, const Diagnostics &diagnostics)
  {
    try
    {
      std::rethrow_exception(exception);
    }
    catch (const InputError &e)
    {
      return {exit_bad_input, [before = diagnostics.all(), messages = e.diagnostics](Console &console)
              {
                console.show(before);
                console.show(messages);
              }};
    }
    catch (const FileReaderIsAbsent &e)
    {
      return {exit_internal_error, [text = std::string(e.what())](Console &console) { console.error(text); }};
    }
    catch (const Interrupted &)
    {
      return {exit_interrupted, [before = diagnostics.all()](Console &console)
              {
                console.show(before);
                console.conclude("interrupted: no results were written", false);
              }};
    }
    catch (const OutputError &e)
    {
      return {exit_internal_error, [text = std::string(e.what())](Console &console) { console.error(text); }};
    }
    catch (const std::exception &e)
    {
      return is_shortage_of_memory(e) ? out_of_memory() : internal_error(e.what());
    }
    catch (...)
    {
      return internal_error("unknown");
    }
  }
} // namespace unilateral
