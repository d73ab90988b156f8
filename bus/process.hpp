#pragma once

#include "bus/app.hpp"

namespace priamos::bus {

/// Runs one App as a process: argv (`--config FILE`, `--set KEY=VALUE`, `--bus URL`, `--seed N`,
/// `--print-config`,
/// `--interface`, `--help` and the App's own options), signals, real-time loop, HEALTH, sd_notify READY and
/// WATCHDOG, logging to stderr. Returns the exit code: 0 after SIGINT, SIGTERM or RequestStop, 2 for a
/// command line, configuration or bus that cannot be used (one sentence on stderr), 1 for an error while
/// running.
int RunProcess(const AppFactory& factory, int argc, char** argv);

template <App T>
int RunProcess(int argc, char** argv) {
  return RunProcess(FactoryOf<T>(), argc, argv);
}

}  // namespace priamos::bus
