#pragma once

#include "bus/app.hpp"

namespace priamos::bus {

/// Runs one App as a process: argv (`--config FILE`, `--set KEY=VALUE`, `--bus URL`, `--seed N`,
/// `--print-config`,
/// `--interface`, `--help` and the App's own options), signals, real-time loop, HEALTH, sd_notify READY and
/// WATCHDOG, logging to stderr. On a real bus it first claims the App's role of its robot (README.md).
/// Returns the exit code: 0 after SIGINT, SIGTERM or RequestStop, 2 for a command line, configuration or bus
/// that cannot be used, or a role that somebody else has (one sentence on stderr), 1 for an error while
/// running, or a role that was lost to somebody who had it longer.
int RunProcess(const AppFactory& factory, int argc, char** argv);

template <App T>
int RunProcess(int argc, char** argv) {
  return RunProcess(FactoryOf<T>(), argc, argv);
}

}  // namespace priamos::bus
