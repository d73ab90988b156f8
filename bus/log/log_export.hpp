#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <iosfwd>
#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

#include "bus/log/log_reader.hpp"
#include "bus/log/log_selection.hpp"

namespace priamos::bus {

class LogWriter;
class Schema;

// Every export knows the types of `schema`, and those that the log defines itself.

/// Numbers of events that an export wrote and left out.
struct ExportCount {
  std::uint64_t written = 0;
  std::uint64_t undecodable = 0;  ///< events left out: of unknown type or refused by the schema walk
  std::uint64_t unknown = 0;      ///< those of them that are of unknown type
  /// The first of each: channel and fingerprint; channel and what is wrong with the message.
  std::string first_unknown, first_refused;
};

/// One line of JSON per event: {"utime", "number", "channel", "type", "message"}.
ExportCount ExportJsonLines(LogReader& reader, const Schema& schema, const LogSelection& selection,
                            std::ostream& out);

/// One table per channel, FOLDER/CHANNEL.csv; a channel that carries several types gets
/// CHANNEL.TYPE.csv for each but the first. Throws std::runtime_error when a file cannot be written.
ExportCount ExportCsv(LogReader& reader, const Schema& schema, const LogSelection& selection,
                      const std::filesystem::path& folder);

/// A further message of an MCAP file, made of one in the log: the same in a schema that viewers draw.
struct DerivedMessage {
  std::string topic, schema_name, json;
};

/// How further messages are made; nothing is derived while `derive` is empty.
struct Derivation {
  /// What a message of a channel gives; `utime` is that of its event.
  std::function<std::vector<DerivedMessage>(const std::string& channel, const nlohmann::ordered_json& message,
                                            std::int64_t utime)>
      derive;
  /// JSON schema of a schema_name.
  std::function<std::string(const std::string& schema_name)> schema;
};

/// An MCAP file with a JSON schema per type (see McapWriter), and with what `derivation` adds.
ExportCount ExportMcap(LogReader& reader, const Schema& schema, const LogSelection& selection,
                       std::ostream& out, const Derivation& derivation = {});

/// Copies the wanted events, undecoded and with their new channel names, into another log, numbered anew:
/// what was not wanted is no loss. The log's definitions of their types come along. Returns how many they
/// are.
std::uint64_t CopyEvents(LogReader& reader, const LogSelection& selection, LogWriter& writer);

/// What RepairLog copied.
struct RepairCount {
  std::uint64_t events = 0;
  std::uint64_t not_increasing = 0;  ///< events with a number that is not above the one before
};

/// Copies all whole events with the numbers of their recorder: the gaps between them show what is lost.
RepairCount RepairLog(LogReader& reader, LogWriter& writer);

}  // namespace priamos::bus
