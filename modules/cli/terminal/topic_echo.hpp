#pragma once

namespace CLI {
class App;
}

namespace priamos::cli {

/// Adds the verb `topic echo CHANNEL [FIELD...]`.
void AddTopicEchoVerb(CLI::App& topic, int& exit_code);

}  // namespace priamos::cli
