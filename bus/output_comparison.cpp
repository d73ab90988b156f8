#include "bus/output_comparison.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <nlohmann/json.hpp>

#include "bus/schema/json.hpp"
#include "bus/schema/schema.hpp"
#include "bus/schema/walk.hpp"

namespace priamos::bus {
namespace {

using ByChannel = std::map<std::string, std::vector<const Output*>>;

ByChannel Sorted(const std::vector<Output>& outputs) {
  ByChannel sorted;
  for (const Output& output : outputs) sorted[output.channel].push_back(&output);
  return sorted;
}

void Compare(const std::string& name, const Json& recorded, const Json& replayed,
             std::vector<std::string>& differences) {
  if (recorded == replayed) return;
  if (recorded.is_object() && replayed.is_object()) {
    for (const auto& [key, value] : recorded.items())
      Compare(name.empty() ? key : fmt::format("{}.{}", name, key), value, replayed.value(key, Json()),
              differences);
  } else if (recorded.is_array() && replayed.is_array() && recorded.size() == replayed.size()) {
    for (std::size_t i = 0; i < recorded.size(); ++i)
      Compare(fmt::format("{}[{}]", name, i), recorded[i], replayed[i], differences);
  } else {
    differences.push_back(
        fmt::format("{}: recorded {}, replayed {}", name, recorded.dump(), replayed.dump()));
  }
}

const Struct* TypeOf(std::span<const std::byte> bytes, const Schema& schema) {
  const Struct* type = schema.Of(bytes);
  return type != nullptr && Walk(*type, bytes) ? type : nullptr;
}

double SecondsSince(std::int64_t start, std::int64_t utime) {
  return static_cast<double>(utime - start) * 1e-6;
}

void Explain(const std::string& where, const Output& recorded, const Output& replayed, const Schema& schema,
             std::vector<std::string>& lines) {
  if (recorded.utime != replayed.utime)
    lines.push_back(fmt::format("{}: recorded {:+.6f} s later than replayed", where,
                                SecondsSince(replayed.utime, recorded.utime)));
  for (const auto& line : FieldDifferences(recorded.bytes, replayed.bytes, schema))
    lines.push_back(fmt::format("{}: {}", where, line));
}

}  // namespace

std::vector<std::string> FieldDifferences(std::span<const std::byte> recorded,
                                          std::span<const std::byte> replayed, const Schema& schema) {
  std::vector<std::string> differences;
  if (std::equal(recorded.begin(), recorded.end(), replayed.begin(), replayed.end())) return differences;
  const Struct* type = TypeOf(recorded, schema);
  if (type != nullptr && type == TypeOf(replayed, schema))
    Compare("", ToJson(*type, recorded), ToJson(*type, replayed), differences);
  // Two NaN, or two strings with something behind their end, are equal as JSON and not as bytes.
  if (differences.empty())
    differences.push_back(
        fmt::format("recorded {} bytes, replayed {} other ones", recorded.size(), replayed.size()));
  return differences;
}

OutputComparison CompareOutputs(const std::vector<Output>& recorded, const std::vector<Output>& replayed,
                                const Schema& schema, std::size_t per_channel) {
  OutputComparison comparison;
  const std::int64_t start = recorded.empty() ? 0 : recorded.front().utime;
  ByChannel was = Sorted(recorded), is = Sorted(replayed);
  for (const auto& [channel, outputs] : is) was.try_emplace(channel);
  for (const auto& [channel, before] : was) {
    const auto& after = is[channel];
    auto& count = comparison.channels[channel];
    count = {before.size(), after.size(), 0};
    std::size_t explained = 0;
    for (std::size_t i = 0; i < std::min(before.size(), after.size()); ++i) {
      const bool same = before[i]->utime == after[i]->utime && before[i]->bytes == after[i]->bytes;
      count.equal += same;
      if (same || explained++ >= per_channel) continue;
      const auto where = fmt::format("{} {} at {:.3f} s", channel, i, SecondsSince(start, before[i]->utime));
      Explain(where, *before[i], *after[i], schema, comparison.differences);
    }
    if (count.recorded != count.replayed)
      comparison.differences.push_back(
          fmt::format("{}: {} messages recorded, {} replayed", channel, count.recorded, count.replayed));
    comparison.equal = comparison.equal && count.equal == count.recorded && count.equal == count.replayed;
  }
  return comparison;
}

}  // namespace priamos::bus
