// Signals. Ctrl-C and SIGTERM: the first asks the computation to stop, the second ends the process. A crash ends with a sentence and the
// exit code of an internal error. A pipe that closes is no signal but an error of the write to it.
#pragma once

namespace unilateral
{
  void install_signal_handlers();
  bool interrupt_requested();

  /// From here on the program is over a second after Ctrl-C at the latest, and 20 after SIGTERM, whatever it is doing: refining a mesh of
  /// millions of cells takes longer than a second. For a program of one process; others would wait for it.
  void end_soon_after_signals();

  /// From here on it is not: files are put in their places.
  void finish_whatever_is_asked();
} // namespace unilateral
