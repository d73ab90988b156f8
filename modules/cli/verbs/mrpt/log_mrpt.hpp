#pragma once

namespace CLI {
class App;
}

namespace priamos::cli {

/// The verb `log mrpt`, apart from the others of `log`: MRPT's libraries take more memory than a log of any
/// size may.
void AddLogMrptVerb(CLI::App& log, int& exit_code);

}  // namespace priamos::cli
