#pragma once

namespace CLI {
class App;
}

namespace priamos::cli {

/// The verbs `topic`, `type` and `link`, with the rules of verbs/commands.hpp.
void AddTopicCommand(CLI::App& cli, int& exit_code);
void AddTypeCommand(CLI::App& cli, int& exit_code);
void AddLinkCommand(CLI::App& cli, int& exit_code);

/// The verbs `list`, `hz` and `bw` of `topic`, its `pub` and its `serve`.
void AddTopicTableVerbs(CLI::App& topic, int& exit_code);
void AddTopicPubVerb(CLI::App& topic, int& exit_code);
void AddTopicServeVerb(CLI::App& topic, int& exit_code);

/// The verb `table` of `link`.
void AddLinkTableVerb(CLI::App& link);

}  // namespace priamos::cli
