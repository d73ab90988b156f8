#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "common/outcome.hpp"
#include "console/foxglove/server_message.hpp"

namespace priamos::console {

/// What a client may have done: what the page's buttons do.
std::vector<OfferedService> Services();

/// The message of a page (README.md, "What a page says") that a call stands for, so that it is read and
/// refused as one: of the service of this number, with the fields in `json`.
Outcome<std::string> PageMessageOf(std::uint32_t service, std::string_view json);

}  // namespace priamos::console
