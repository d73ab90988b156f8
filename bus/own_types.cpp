#include "bus/own_types.hpp"

#include "lcmtypes/embedded_types.hpp"

namespace priamos::bus {

Schema OwnTypes() {
  return Schema::FromTexts(EmbeddedTypes());
}

}  // namespace priamos::bus
