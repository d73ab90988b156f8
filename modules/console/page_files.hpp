#pragma once

#include "common/web/web_request.hpp"

namespace priamos::console {

/// The page, as it was built from page/ and compiled in.
const WebFiles& PageFiles();

}  // namespace priamos::console
