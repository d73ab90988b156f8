#pragma once

#include <string_view>

namespace priamos::bus {

/// Version of the project and, as far as git knew it, the commit it was configured from: "0.1.0 (c066fa5e)".
std::string_view Version();

}  // namespace priamos::bus
