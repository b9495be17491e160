#include "cli/console.h"

#include "cli/interrupt.h"

#include "unilateral/base/visible_text.h"

#include <fmt/format.h>

#include <algorithm>
#include <cerrno>
#include <cmath>
#include <csignal>
#include <cstdlib>
#include <cstring>

#include <fcntl.h>
#include <sys/ioctl.h>
#include <unistd.h>

namespace unilateral
{
  namespace
  {
    constexpr const char *red = "\033[1;31m", *yellow = "\033[1;33m", *green = "\033[1;32m", *bold = "\033[1m", *plain = "\033[0m";

    bool is_terminal(std::FILE *stream)
    {
      const char *const term = std::getenv("TERM");
      return isatty(fileno(stream)) && term != nullptr && std::strcmp(term, "dumb") != 0;
    }

    std::size_t terminal_width(std::FILE *stream)
    {
      winsize size = {};
      return ioctl(fileno(stream), TIOCGWINSZ, &size) == 0 && size.ws_col > 0 ? size.ws_col : 80;
    }

    std::string paint(const std::string &text, const char *color, const bool colored)
    {
      return colored ? color + text + plain : text;
    }

    /// The severity of a message in its colour; the place before it stays plain so that it can be clicked and copied.
    std::string paint(const Diagnostic &diagnostic, const bool colored)
    {
      std::string       text = to_string(diagnostic);
      const char *const word = diagnostic.severity == Severity::error     ? "error:"
                               : diagnostic.severity == Severity::warning ? "warning:"
                                                                          : "note:";
      const char *const color = diagnostic.severity == Severity::error ? red : diagnostic.severity == Severity::warning ? yellow : bold;
      if (const std::size_t position = text.find(word); colored && position != std::string::npos)
        text.replace(position, std::strlen(word), paint(word, color, true));
      return text;
    }

    std::string step_text(const unsigned number, const NewtonStep &step)
    {
      return fmt::format("Newton {:>3}: {} active, {} flipped, {} linear iterations{}{}, residual {:.1e}", number, step.active,
                         step.flipped, step.linear_iterations,
                         step.step_length < 1 ? fmt::format(", step length {:.2g}", step.step_length) : "",
                         step.outer > 0 ? fmt::format(", outer {}", step.outer) : "", step.residual);
    }

    constexpr const char *header = "level      cells   unknowns  Newton  linear     active    flipped  residual       time";

    std::string row_text(const LevelReport &level)
    {
      const std::string residual = std::isnan(level.residual) ? "-" : fmt::format("{:.1e}", level.residual);
      return fmt::format("{:>5} {:>10} {:>10} {:>7} {:>7} {:>10} {:>10} {:>9} {:>8.2f} s{}", level.level, level.n_cells, level.n_dofs,
                         level.newton_iterations, level.linear_iterations, level.n_active, level.n_flipped, residual, level.seconds,
                         level.variant.empty() ? "" : "  " + level.variant);
    }
  } // namespace

  void reserve_standard_streams()
  {
    for (const int stream : {STDIN_FILENO, STDOUT_FILENO, STDERR_FILENO})
      if (fcntl(stream, F_GETFD) == -1 && errno == EBADF)
        open("/dev/null", stream == STDIN_FILENO ? O_WRONLY : O_RDONLY); // takes the lowest free number, which is this one
  }

  Console::Console(const Settings &settings) : settings(settings), people(settings.json ? stderr : stdout)
  {
    start = last_activity = std::chrono::steady_clock::now();
    const char *const no_color = std::getenv("NO_COLOR");
    const bool        color = !settings.no_color && (no_color == nullptr || *no_color == '\0');
    people_color = color && is_terminal(people);
    errors_color = color && is_terminal(stderr);
    animated = is_terminal(people) && !settings.quiet;
    if (!settings.log_file.empty() && !settings.mute)
    {
      log_stream = std::fopen(settings.log_file.c_str(), "w");
      if (log_stream == nullptr)
        throw InputError(SourceLocation{settings.log_file}, fmt::format("cannot write the log: {}", std::strerror(errno)),
                         MessageName("cannot-write"));
    }
  }

  Console::~Console()
  {
    {
      const std::lock_guard lock(on_screen);
      ended = true;
    }
    at_end.notify_all();
    if (clock_keeper.joinable())
      clock_keeper.join();
    erase_activity();
    if (log_stream != nullptr)
      std::fclose(log_stream);
  }

  double Console::elapsed() const
  {
    return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  }

  void Console::expect_levels(const unsigned n, const unsigned dim)
  {
    const std::lock_guard lock(on_screen);
    n_levels = n;
    dimension = dim;
    level_ends.clear();
  }

  std::optional<double> Console::seconds_left() const
  {
    // After the finest level: norms and files.
    constexpr double rest_to_level = 1;
    const auto       n = level_ends.size();
    if (n < 2 || n > n_levels)
      return {};
    const double last = level_ends[n - 1] - level_ends[n - 2], before = n > 2 ? level_ends[n - 2] - level_ends[n - 3] : 0;
    if (last < 0.05)
      return {};
    const double cells = std::pow(2., dimension), growth = before > 0.05 ? std::clamp(last / before, 1.2, 1.3 * cells) : cells;
    double       left = 0, level = last;
    for (std::size_t k = n; k < n_levels; ++k)
    {
      level *= growth;
      left += level;
    }
    left += level * rest_to_level;
    left -= elapsed() - level_ends.back();
    return left > 0 ? std::optional(left) : std::nullopt;
  }

  std::string Console::clock() const
  {
    constexpr double of_interest = 2;
    const auto       text = [](const double seconds)
    { return seconds < 90 ? fmt::format("{:.0f} s", seconds) : fmt::format("{:.0f} min", seconds / 60); };
    if (elapsed() < of_interest)
      return "";
    const auto left = seconds_left();
    return left && *left > 1 ? fmt::format("{}, about {} left  ", text(elapsed()), text(*left)) : text(elapsed()) + "  ";
  }

  void Console::keep_clock_running()
  {
    if (clock_keeper.joinable())
      return;
    // Interrupts are for the thread that computes.
    sigset_t all, before;
    sigfillset(&all);
    pthread_sigmask(SIG_SETMASK, &all, &before);
    clock_keeper = std::thread(
      [this]
      {
        std::unique_lock lock(on_screen);
        while (!at_end.wait_for(lock, std::chrono::milliseconds(500), [this] { return ended; }))
          if (activity_shown && elapsed() > 2)
            draw_activity();
      });
    pthread_sigmask(SIG_SETMASK, &before, nullptr);
  }

  void Console::line(std::FILE *stream, const std::string &text)
  {
    const std::lock_guard lock(on_screen);
    erase_activity();
    if (stream == stderr)
      std::fflush(stdout); // keep the order where both go to one place
    write(stream, text + "\n");
  }

  void Console::write(std::FILE *stream, const std::string &text)
  {
    if (settings.mute || lost.count(stream) > 0)
      return;
    if (std::fwrite(text.data(), 1, text.size(), stream) != text.size() || std::fflush(stream) != 0)
      lost[stream] = errno;
  }

  void Console::record(const std::string &lines)
  {
    const std::string text = visible_lines(lines);
    log_so_far += text + "\n";
    if (log_stream != nullptr)
    {
      const bool before = lost.count(log_stream) == 0;
      write(log_stream, text + "\n");
      if (before && lost.count(log_stream) > 0)
        line(stderr, fmt::format("{}: warning: the log ends here: {}", settings.log_file, std::strerror(lost[log_stream])));
    }
  }

  void Console::show_activity(const std::string &text)
  {
    if (!animated)
      return;
    const std::lock_guard lock(on_screen);
    keep_clock_running();
    activity = text;
    const auto now = std::chrono::steady_clock::now();
    if (activity_shown && now - last_activity < std::chrono::milliseconds(100))
      return;
    last_activity = now;
    activity_shown = true;
    draw_activity();
  }

  void Console::draw_activity()
  {
    write(people, "\r\033[K" + (clock() + activity).substr(0, terminal_width(people) - 1));
  }

  void Console::erase_activity()
  {
    const std::lock_guard lock(on_screen);
    if (activity_shown)
      write(people, "\r\033[K");
    activity_shown = false;
  }

  void Console::phase(const std::string &name, const std::string &detail)
  {
    current_phase = visible(detail.empty() ? name : name + ": " + detail);
    n_steps = 0;
    record(fmt::format("[{:9.3f}] {}", elapsed(), current_phase));
    if (settings.verbose && !settings.quiet)
      line(people, current_phase);
    erase_activity(); // so that the new phase is shown at once
    show_activity(current_phase + " ...");
  }

  void Console::fraction(const double share)
  {
    constexpr unsigned width = 24;
    const double       done = share > 0 ? (share < 1 ? share : 1.) : 0.;
    const auto         filled = static_cast<unsigned>(width * done);
    show_activity(
      fmt::format("[{}{}] {:3.0f} %  {}", std::string(filled, '#'), std::string(width - filled, '.'), 100 * done, current_phase));
  }

  void Console::newton_step(const NewtonStep &step)
  {
    const std::string text = step_text(++n_steps, step);
    record(fmt::format("[{:9.3f}]   {}", elapsed(), text));
    if (settings.verbose && !settings.quiet)
      line(people, "      " + text);
    constexpr const char *wheel = "|/-\\";
    show_activity(fmt::format("{} {}  {}", wheel[n_steps % 4], current_phase, text));
  }

  void Console::table_header()
  {
    if (header_shown)
      return;
    header_shown = true;
    line(people, paint(header, bold, people_color));
  }

  void Console::level_finished(const LevelReport &level)
  {
    record(fmt::format("{}\n{}{}", header, row_text(level), level.converged ? "" : "  not converged: " + level.reason));
    n_steps = 0;
    {
      const std::lock_guard lock(on_screen);
      level_ends.push_back(elapsed());
    }
    if (settings.quiet)
      return;
    if (settings.verbose)
      header_shown = false; // the steps above it have pushed the last one away
    table_header();
    line(people, row_text(level) + (level.converged ? "" : paint("  not converged", red, people_color)));
  }

  void Console::log(const std::string &text)
  {
    record(fmt::format("[{:9.3f}] {}", elapsed(), text));
    if (settings.verbose && !settings.quiet)
      line(people, visible(text));
  }

  bool Console::stop_requested() const
  {
    return interrupt_requested();
  }

  bool Console::print(const std::string &text)
  {
    record(text);
    if (!settings.quiet)
      line(people, visible_lines(text));
    const auto failure = lost.find(people);
    return failure == lost.end() || failure->second == EPIPE;
  }

  void Console::show(const std::vector<Diagnostic> &diagnostics)
  {
    for (const Diagnostic &diagnostic : diagnostics)
    {
      const std::string text = to_string(diagnostic);
      if (!shown.insert(text).second)
        continue;
      record(text);
      if (diagnostic.severity != Severity::note || !settings.quiet)
        line(stderr, paint(diagnostic, errors_color));
    }
  }

  void Console::error(const std::string &text)
  {
    const std::string message = visible(text);
    record("unilateral: error: " + message);
    line(stderr, fmt::format("unilateral: {} {}", paint("error:", red, errors_color), message));
  }

  void Console::conclude(const std::string &text, const bool good)
  {
    const std::string sentence = visible(text);
    record(sentence);
    const std::size_t end = std::min(sentence.find_first_of(":,;"), sentence.size());
    const auto        painted = [&](const char *color, const bool colored)
    { return paint(sentence.substr(0, end), color, colored) + sentence.substr(end); };
    if (!good)
      line(stderr, painted(red, errors_color));
    else if (!settings.quiet)
      line(people, painted(green, people_color));
  }
} // namespace unilateral
