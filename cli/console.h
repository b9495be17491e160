// What people see of a computation: the progress table, messages, the log.
#pragma once

#include "unilateral/base/diagnostics.h"
#include "unilateral/base/progress.h"

#include <chrono>
#include <condition_variable>
#include <cstdio>
#include <map>
#include <mutex>
#include <optional>
#include <set>
#include <string>
#include <thread>
#include <vector>

namespace unilateral
{
  /// Takes the places of standard streams that were closed at the start, or the next file to be opened would get what is meant for them.
  /// Writing there fails, as it should. Before anything else.
  void reserve_standard_streams();

  /// Writes progress and results for people to standard output (to standard error when that carries JSON), messages to standard
  /// error, and keeps a log of everything whatever is shown. A stream that takes nothing any more (closed pipe, full disk) is left
  /// alone: what is shown is no reason to stop a computation.
  class Console : public Progress
  {
  public:
    struct Settings
    {
      bool        json = false;     ///< standard output carries results only
      bool        quiet = false;    ///< only warnings and errors
      bool        verbose = false;  ///< every Newton step and log line
      bool        no_color = false; ///< also: NO_COLOR in the environment, or not a terminal
      std::string log_file;         ///< the log as it grows; empty: none
      bool        mute = false;     ///< shows nothing at all: one of several processes speaks
    };

    /// Throws InputError when the log file cannot be written.
    explicit Console(const Settings &settings);
    ~Console() override;
    Console(const Console &) = delete;
    Console &operator=(const Console &) = delete;

    void phase(const std::string &name, const std::string &detail = "") override;
    void fraction(double share) override;
    void newton_step(const NewtonStep &step) override;
    void level_finished(const LevelReport &level) override;
    void log(const std::string &line) override;
    bool stop_requested() const override;

    /// Level after level, @p n_levels of them, each of 2^dim times as many cells as the one before: what an estimate of the time left is
    /// made of. None: nobody knows.
    void expect_levels(unsigned n_levels, unsigned dim);

    void               speak() { settings.mute = false; }
    bool               print(const std::string &text);                   ///< lines for people, not with -q; false when a disk is full
    void               record(const std::string &text);                  ///< lines for the log alone
    void               show(const std::vector<Diagnostic> &diagnostics); ///< those not shown before
    void               error(const std::string &message);                ///< "unilateral: error: message"
    void               conclude(const std::string &sentence, bool good); ///< the last line; a bad end goes to standard error, -q or not
    const std::string &log_text() const { return log_so_far; }           ///< everything so far

  private:
    void   write(std::FILE *stream, const std::string &text);
    void   line(std::FILE *stream, const std::string &text);
    void   table_header();
    void   show_activity(const std::string &text);
    void   draw_activity();
    void   erase_activity();
    double elapsed() const;

    /// "12 s, about 30 s left  ", once it takes long enough to be of interest.
    std::string           clock() const;
    std::optional<double> seconds_left() const;
    void                  keep_clock_running();

    Settings                              settings;
    std::FILE                            *people = stdout;
    std::FILE                            *log_stream = nullptr;
    bool                                  people_color = false, errors_color = false;
    bool                                  animated = false; ///< a line that erases itself may be shown
    bool                                  activity_shown = false, header_shown = false;
    unsigned                              n_steps = 0;                 ///< Newton steps on the present level
    unsigned                              n_levels = 0, dimension = 0; ///< that are expected
    std::vector<double>                   level_ends;                  ///< elapsed() after each
    std::string                           current_phase, activity, log_so_far;
    std::set<std::string>                 shown;
    std::map<std::FILE *, int>            lost; ///< streams that failed, and their error
    std::chrono::steady_clock::time_point start, last_activity;

    std::recursive_mutex        on_screen; ///< of all that is written
    std::condition_variable_any at_end;
    bool                        ended = false;
    std::thread                 clock_keeper; ///< redraws the line of activity where the computation is silent for long
  };
} // namespace unilateral
