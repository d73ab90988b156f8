#include "bus/log/log_export.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <fstream>
#include <functional>
#include <nlohmann/json.hpp>
#include <stdexcept>
#include <tuple>

#include "bus/log/csv_table.hpp"
#include "bus/log/event_copier.hpp"
#include "bus/log/log_writer.hpp"
#include "bus/log/mcap_writer.hpp"
#include "bus/schema/json_schema.hpp"
#include "bus/schema/json_text.hpp"
#include "bus/schema/schema.hpp"
#include "bus/schema/walk.hpp"

namespace priamos::bus {
namespace {

using Handler = std::function<void(const Struct&, const std::string& channel, const LogEvent&)>;

/// The fingerprint of a message as LCM's tools write it.
std::string FingerprintText(std::span<const std::byte> bytes) {
  return bytes.size() < sizeof(std::uint64_t)
             ? "none"
             : fmt::format("0x{:016x}", FingerprintOf(bytes.data(), bytes.size()));
}

/// Whether the event is a message; when not, `count` learns why.
bool IsMessage(const LogEvent& event, const Struct* type, ExportCount& count) {
  if (type == nullptr) {
    if (count.unknown++ == 0)
      count.first_unknown =
          fmt::format("{} with fingerprint {}", event.channel, FingerprintText(event.bytes));
  } else {
    const WalkResult walked = Walk(*type, event.bytes);
    if (walked) return true;
    if (count.first_refused.empty())
      count.first_refused = fmt::format("{} of {}, byte {} of {}: {}", event.channel, type->full_name,
                                        walked.offset, event.bytes.size(), Sentence(walked.error));
  }
  ++count.undecodable;
  return false;
}

/// Calls `handle` with every wanted event that is a message.
ExportCount ForEachMessage(LogReader& reader, LogTypes& types, const LogSelection& selection,
                           const Handler& handle) {
  ExportCount count;
  while (const auto event = reader.Next()) {
    if (types.Take(event->bytes) || !selection.Wants(event->utime, event->channel)) continue;
    const Struct* type = types.Of(event->bytes);
    if (!IsMessage(*event, type, count)) continue;
    handle(*type, selection.NameOf(event->channel), *event);
    ++count.written;
  }
  return count;
}

/// A channel's name may hold what no file name can.
std::string FileName(std::string name) {
  std::replace_if(
      name.begin(), name.end(), [](char c) { return c == '/' || c == '\\' || c == ' '; }, '_');
  return name.starts_with('.') ? "_" + name : name;
}

/// The tables of an export, made when their first row comes. Each takes its name when all are whole: what
/// fails before that leaves older tables as they were.
class CsvFolder {
 public:
  explicit CsvFolder(const std::filesystem::path& folder) : folder_(folder) {
    std::filesystem::create_directories(folder);
  }

  void Add(const Struct& type, const std::string& channel, const LogEvent& event) {
    auto found = tables_.find({channel, &type});
    if (found == tables_.end()) found = tables_.try_emplace({channel, &type}, Open(type, channel)).first;
    found->second.table.WriteRow(found->second.file, event);
  }
  void Close() {
    for (auto& [key, open] : tables_) {
      open.file.close();
      if (!open.file)
        throw std::runtime_error(fmt::format("{}: cannot be written: is the disk full?", open.path.string()));
    }
    for (auto& [key, open] : tables_) std::filesystem::rename(Unfinished(open.path), open.path);
    tables_.clear();
  }
  ~CsvFolder() {
    std::error_code none;
    for (const auto& [key, open] : tables_) std::filesystem::remove(Unfinished(open.path), none);
  }
  CsvFolder(const CsvFolder&) = delete;
  CsvFolder& operator=(const CsvFolder&) = delete;

 private:
  struct OpenTable {
    CsvTable table;
    std::filesystem::path path;
    std::ofstream file;
  };
  static std::filesystem::path Unfinished(const std::filesystem::path& path) {
    return path.string() + ".part";
  }
  OpenTable Open(const Struct& type, const std::string& channel) {
    const bool first = std::none_of(tables_.begin(), tables_.end(),
                                    [&](const auto& entry) { return entry.first.first == channel; });
    const std::string name = FileName(first ? channel : channel + "." + type.full_name) + ".csv";
    OpenTable open{CsvTable(type), folder_ / name,
                   std::ofstream(Unfinished(folder_ / name), std::ios::binary)};
    if (!open.file)
      throw std::runtime_error(
          fmt::format("{}: cannot be written: {}", open.path.string(), std::strerror(errno)));
    open.table.WriteHeader(open.file);
    return open;
  }
  std::filesystem::path folder_;
  std::map<std::pair<std::string, const Struct*>, OpenTable> tables_;
};

std::string SchemaText(const Struct& type) {
  try {
    return JsonSchemaOf(type).dump();
  } catch (const SchemaError&) {  // it contains itself: any object
    return Json{{"title", type.full_name}, {"type", "object"}}.dump();
  }
}

/// Schemas and channels of an MCAP file, made when their first message comes.
class McapIds {
 public:
  explicit McapIds(McapWriter& writer) : writer_(writer) {}

  std::uint16_t ChannelOf(const std::string& channel, const Struct& type) {
    return ChannelOf(channel, type.full_name, [&] { return SchemaText(type); });
  }
  std::uint16_t ChannelOf(const std::string& channel, const std::string& schema_name,
                          const std::function<std::string()>& schema) {
    const auto [at, added] = channels_.try_emplace({channel, schema_name});
    if (added) at->second = writer_.AddChannel(channel, SchemaOf(schema_name, schema));
    return at->second;
  }

 private:
  std::uint16_t SchemaOf(const std::string& name, const std::function<std::string()>& text) {
    const auto [at, added] = schemas_.try_emplace(name);
    if (added) at->second = writer_.AddSchema(name, text());
    return at->second;
  }
  McapWriter& writer_;
  std::map<std::pair<std::string, std::string>, std::uint16_t> channels_;
  std::map<std::string, std::uint16_t> schemas_;
};

}  // namespace

ExportCount ExportJsonLines(LogReader& reader, const Schema& schema, const LogSelection& selection,
                            std::ostream& out) {
  LogTypes types(&schema);
  return ForEachMessage(reader, types, selection,
                        [&](const Struct& type, const std::string& channel, const LogEvent& event) {
                          const Json line{{"utime", event.utime},
                                          {"number", event.number},
                                          {"channel", channel},
                                          {"type", type.full_name},
                                          {"message", ToJson(type, event.bytes)}};
                          out << JsonText(line) << '\n';
                        });
}

ExportCount ExportCsv(LogReader& reader, const Schema& schema, const LogSelection& selection,
                      const std::filesystem::path& folder) {
  CsvFolder tables(folder);
  LogTypes types(&schema);
  const auto count = ForEachMessage(
      reader, types, selection, [&](const Struct& type, const std::string& channel, const LogEvent& event) {
        tables.Add(type, channel, event);
      });
  tables.Close();
  return count;
}

ExportCount ExportMcap(LogReader& reader, const Schema& schema, const LogSelection& selection,
                       std::ostream& out, const Derivation& derivation) {
  McapWriter writer(out);
  McapIds ids(writer);
  LogTypes types(&schema);
  const auto count = ForEachMessage(
      reader, types, selection, [&](const Struct& type, const std::string& channel, const LogEvent& event) {
        const auto number = static_cast<std::uint32_t>(event.number);
        const auto time_ns = static_cast<std::uint64_t>(std::max<std::int64_t>(event.utime, 0)) * 1000;
        const Json message = ToJson(type, event.bytes);
        writer.AddMessage(ids.ChannelOf(channel, type), number, time_ns, JsonText(message));
        if (!derivation.derive) return;
        for (const DerivedMessage& more : derivation.derive(channel, message, event.utime))
          writer.AddMessage(ids.ChannelOf(more.topic, more.schema_name,
                                          [&] { return derivation.schema(more.schema_name); }),
                            number, time_ns, more.json);
      });
  writer.Finish();
  return count;
}

std::uint64_t CopyEvents(LogReader& reader, const LogSelection& selection, LogWriter& writer) {
  std::uint64_t copied = 0;
  EventCopier copier(writer);
  while (const auto event = reader.Next()) {
    if (copier.Keep(event->bytes) || !selection.Wants(event->utime, event->channel)) continue;
    copier.Write(event->utime, selection.NameOf(event->channel), event->bytes);
    ++copied;
  }
  return copied;
}

RepairCount RepairLog(LogReader& reader, LogWriter& writer) {
  RepairCount count;
  std::int64_t before = 0;
  while (const auto event = reader.Next()) {
    count.not_increasing += count.events > 0 && event->number <= before;
    before = event->number;
    writer.WriteAsNumbered(*event);
    ++count.events;
  }
  return count;
}

}  // namespace priamos::bus
