#pragma once

#include <string>

namespace priamos::head {

/// Text of progress, "[#####...............]  25 %, 0:41 left": `done` of `total` parts in `seconds`, the
/// rest taking as long. Without a time left before the first part is done.
std::string ProgressBar(int done, int total, double seconds);

}  // namespace priamos::head
