// Signals. Ctrl-C and SIGTERM: the first asks the computation to stop, the second ends the process. A crash ends with a sentence and the
// exit code of an internal error. A pipe that closes is no signal but an error of the write to it.
#pragma once

namespace unilateral
{
  void install_signal_handlers();
  bool interrupt_requested();
} // namespace unilateral
