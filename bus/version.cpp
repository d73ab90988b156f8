#include "bus/version.hpp"

namespace priamos::bus {

std::string_view Version() {
  return PRIAMOS_VERSION;  // from CMake: this file alone is compiled anew when the commit changes
}

}  // namespace priamos::bus
