#pragma once

#include <vector>

#include "cli/verbs/help/manual_page.hpp"

namespace CLI {
class App;
}

namespace priamos::cli {

/// The manual, from the definitions that also answer --help and --print-config: one page for `priamos` and
/// for each of its verbs, for each process with its configuration, and for each other file of a deployment.
std::vector<ManualPage> Manual(const CLI::App& cli, const ManualIssue& issue);

}  // namespace priamos::cli
