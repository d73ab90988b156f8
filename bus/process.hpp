#pragma once

#include <functional>

#include "bus/app.hpp"

namespace priamos::bus {

class SignalWatch;

/// A bus onto which somebody plays a log, for a process that shows it rather than runs its App on it.
struct PlayedLog {
  LcmBus& bus;
  const Schema& schema;
  const ConfigSource& config;
  const SignalWatch& signals;
  std::function<void(Level, std::string_view)> report;  ///< lines for whoever started the process
};
/// What such a process does with `--clock bus`, until a signal; returns the exit code.
using LogShow = std::function<int(const PlayedLog&)>;

/// Runs one App as a process: argv (`--config FILE`, `--set KEY=VALUE`, `--bus URL`, `--seed N`,
/// `--print-config`,
/// `--interface`, `--help` and the App's own options), signals, real-time loop, HEALTH, sd_notify READY and
/// WATCHDOG, logging to stderr. On a real bus it first claims the App's role of its robot (README.md).
/// Returns the exit code: 0 after SIGINT, SIGTERM or RequestStop, 2 for a command line, configuration or bus
/// that cannot be used, or a role that somebody else has (one sentence on stderr), 1 for an error while
/// running, or a role that was lost to somebody who had it longer.
///
/// `show`: what is done with `--clock bus` in place of running the App on the log's time (LogFollower).
int RunProcess(const AppFactory& factory, int argc, char** argv, const LogShow& show = {});

template <App T>
int RunProcess(int argc, char** argv, const LogShow& show = {}) {
  return RunProcess(FactoryOf<T>(), argc, argv, show);
}

}  // namespace priamos::bus
