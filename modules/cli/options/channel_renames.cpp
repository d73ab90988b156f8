#include "cli/options/channel_renames.hpp"

#include <fmt/format.h>

#include <span>
#include <stdexcept>
#include <string_view>

#include "bus/wire/datagram.hpp"
#include "common/text/nearest_word.hpp"

namespace priamos::cli {
namespace {

bool IsChannelName(const std::string& name) {
  const std::string ended = name + '\0';
  std::string_view channel;
  std::span<const std::byte> none;
  return bus::SplitChannel(std::as_bytes(std::span(ended)), channel, none) && channel == name;
}

[[noreturn]] void Refuse(const std::string& from, const std::string& to, const std::string& why) {
  throw std::runtime_error(fmt::format("--rename {}={}: {}", from, to, why));
}

}  // namespace

std::map<std::string, std::string> ParseRenames(const std::vector<std::string>& pairs) {
  std::map<std::string, std::string> renames;
  for (const std::string& pair : pairs) {
    const auto equals = pair.find('=');
    if (equals == std::string::npos || equals == 0 || equals + 1 == pair.size())
      throw std::runtime_error(fmt::format("--rename: expected A=B, got \"{}\"", pair));
    const std::string from = pair.substr(0, equals), to = pair.substr(equals + 1);
    if (!IsChannelName(to))
      Refuse(
          from, to,
          fmt::format("expected a channel name of 1 to 63 printable ASCII characters, got \"{}\" of {} bytes",
                      to, to.size()));
    if (!renames.emplace(from, to).second)
      Refuse(from, to, fmt::format("expected one new name for a channel, got a second one for \"{}\"", from));
  }
  return renames;
}

void RequireRenamesFit(const bus::LogSelection& selection, const std::set<std::string>& there,
                       const std::string& log) {
  const std::vector<std::string> known(there.begin(), there.end());
  for (const auto& [from, to] : selection.rename)
    if (!there.contains(from))
      Refuse(from, to,
             fmt::format("expected a channel of {}, got \"{}\"{} (priamos log info lists all)", log, from,
                         NearestText(from, known)));
  std::map<std::string, std::string> taken;  // new name -> channel of the log
  for (const std::string& channel : there) {
    if (!selection.Wants(selection.from_utime, channel)) continue;
    const std::string& name = selection.NameOf(channel);
    const auto [other, is_free] = taken.emplace(name, channel);
    if (is_free) continue;
    const std::string& renamed = selection.rename.contains(channel) ? channel : other->second;
    const std::string& kept = renamed == channel ? other->second : channel;
    Refuse(
        renamed, name,
        fmt::format("expected a name that no other channel gets, but \"{}\" of {} gets it too; next: another "
                    "name, or --without {}",
                    kept, log, kept));
  }
}

}  // namespace priamos::cli
