#pragma once

#include "bus/bus_choice.hpp"
#include "common/config.hpp"

namespace priamos::bus {

/// Describes the section `[bus]`, which the configuration of every process may have beside the keys of its
/// App.
void DescribeBus(Archive& a, BusChoice& choice);

/// The bus in the configuration of a process; `choice` where it says nothing. Throws ConfigError.
BusChoice LoadBusChoice(const ConfigSource& source, BusChoice choice);

/// Reads the keys of an App, and checks `[bus]` beside them, which is for LoadBusChoice. Throws ConfigError.
template <class T>
T LoadAppConfig(const ConfigSource& source) {
  T config;
  BusChoice elsewhere;
  ConfigFile file(source);
  config.Describe(file.archive());
  DescribeBus(file.archive(), elsewhere);
  file.RefuseUnknownKeys();
  return config;
}

}  // namespace priamos::bus
