#include "bus/log/log_merge.hpp"

#include <algorithm>
#include <map>
#include <memory>
#include <nlohmann/json.hpp>

#include "bus/log/event_copier.hpp"
#include "bus/schema/json.hpp"
#include "bus/schema/packing.hpp"
#include "bus/schema/schema.hpp"
#include "bus/schema/walk.hpp"

namespace priamos::bus {
namespace {

/// Sets every stamp (a field with @age) to 0, so that equal contents give equal bits.
void ClearStamps(const Struct& type, Json& json) {
  for (const Field& field : type.fields) {
    Json& value = json.at(field.name);
    if (field.annotation.age_us && field.dims.empty()) value = 0;
    if (field.kind != Kind::kStruct) continue;
    if (field.dims.empty()) ClearStamps(*field.type, value);
    if (field.dims.size() == 1)
      for (Json& element : value) ClearStamps(*field.type, element);
  }
}

/// The first stamp of a type, by which a message is dated.
const Field* StampOf(const Struct& type) {
  const auto found = std::find_if(type.fields.begin(), type.fields.end(), [](const Field& field) {
    return field.kind == Kind::kInt64 && field.dims.empty() && field.annotation.age_us;
  });
  return found == type.fields.end() ? nullptr : &*found;
}

/// One message as it stands in one log.
struct Sighting {
  std::int64_t stamp_us = 0;
  std::int64_t recorded_us = 0;
  bool unique = true;
};
using Sightings = std::map<std::string, Sighting>;  ///< by channel and content

/// Identifies messages, for each type by what of it the radio carries.
class Identifier {
 public:
  explicit Identifier(const Schema& schema) : types_(&schema) {}

  /// Notes the event when it is of a type that can cross a link.
  void Note(const LogEvent& event, Sightings& sightings) {
    if (types_.Take(event.bytes)) return;
    const Struct* type = types_.Of(event.bytes);
    const Packer* packer = type ? PackerOf(*type) : nullptr;
    if (packer == nullptr || !Walk(*type, event.bytes)) return;
    Json json = ToJson(*type, event.bytes);
    const auto stamp = json.at(StampOf(*type)->name).get<std::int64_t>();
    ClearStamps(*type, json);
    const auto packed = packer->Pack(FromJson(*type, json), 0);
    if (!packed->refused.empty()) return;  // it never crossed
    std::string key = event.channel + '\0';
    key.append(reinterpret_cast<const char*>(packed->bytes.data()), packed->bytes.size());
    const auto [at, added] = sightings.try_emplace(std::move(key), Sighting{stamp, event.utime, true});
    if (!added) at->second.unique = false;
  }

 private:
  /// Packer of a type; nullptr if it cannot be packed or carries no stamp.
  const Packer* PackerOf(const Struct& type) {
    const auto [at, added] = packers_.try_emplace(&type);
    if (added && StampOf(type) != nullptr) {
      try {
        at->second = std::make_unique<Packer>(type);
      } catch (const SchemaError&) {  // not annotated: the radio does not carry it
      }
    }
    return at->second.get();
  }

  LogTypes types_;
  std::map<const Struct*, std::unique_ptr<Packer>> packers_;
};

Sightings SightingsIn(LogReader& log, Identifier& identifier) {
  Sightings sightings;
  while (const auto event = log.Next()) identifier.Note(*event, sightings);
  return sightings;
}

}  // namespace

std::vector<StampPair> FindStampPairs(LogReader& a, LogReader& b, const Schema& schema) {
  Identifier identifier(schema);
  const Sightings in_a = SightingsIn(a, identifier), in_b = SightingsIn(b, identifier);
  std::vector<StampPair> pairs;
  for (const auto& [key, seen_a] : in_a) {
    const auto found = in_b.find(key);
    if (found == in_b.end() || !seen_a.unique || !found->second.unique) continue;
    const Sighting& seen_b = found->second;
    const bool from_a = seen_a.recorded_us - seen_a.stamp_us < seen_b.recorded_us - seen_b.stamp_us;
    pairs.push_back({seen_a.stamp_us, seen_b.stamp_us, from_a});
  }
  return pairs;
}

std::uint64_t MergeLogs(LogReader& a, LogReader& b, const ClockFit& b_to_a, const std::string& prefix_b,
                        LogWriter& writer) {
  a.Seek(0);
  b.Seek(0);
  std::uint64_t events = 0;
  auto next_a = a.Next(), next_b = b.Next();
  EventCopier copier(writer);
  while (next_a || next_b) {
    if (next_a && copier.Keep(next_a->bytes)) {
      next_a = a.Next();
      continue;
    }
    if (next_b && copier.Keep(next_b->bytes)) {
      next_b = b.Next();
      continue;
    }
    const bool take_a = next_a && (!next_b || next_a->utime <= b_to_a.ToA(next_b->utime));
    if (take_a) {
      copier.Write(next_a->utime, next_a->channel, next_a->bytes);
      next_a = a.Next();
    } else {
      copier.Write(b_to_a.ToA(next_b->utime), prefix_b + next_b->channel, next_b->bytes);
      next_b = b.Next();
    }
    ++events;
  }
  return events;
}

}  // namespace priamos::bus
