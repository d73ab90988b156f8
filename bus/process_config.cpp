#include "bus/process_config.hpp"

namespace priamos::bus {

void DescribeBus(Archive& a, BusChoice& choice) {
  a.Section("bus", choice, "the LCM bus; the command line and the environment win over it");
}

BusChoice LoadBusChoice(const ConfigSource& source, BusChoice choice) {
  ConfigFile file(source);
  DescribeBus(file.archive(), choice);
  return choice;
}

}  // namespace priamos::bus
