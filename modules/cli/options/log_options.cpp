#include "cli/options/log_options.hpp"

#include <fmt/format.h>

#include <CLI/App.hpp>
#include <algorithm>
#include <cerrno>
#include <cstring>
#include <filesystem>
#include <iostream>
#include <set>
#include <stdexcept>

#include "bus/log/log_reader.hpp"
#include "cli/options/channel_renames.hpp"
#include "common/text/nearest_word.hpp"
#include "common/text/number_text.hpp"

namespace priamos::cli {
namespace {

constexpr double kLongest_s = 1e10;  ///< three centuries: as microseconds still a whole number
constexpr double kSlowest = 1.0 / 64, kFastest = 1000;

std::set<std::string> ChannelsOf(const std::string& log) {
  std::set<std::string> channels;
  for (bus::LogReader reader(log); const auto event = reader.Next();) channels.insert(event->channel);
  return channels;
}

bool IsName(const std::string& channel) {
  return channel.find('*') == std::string::npos;
}

/// No error: one of many logs that are treated alike may lack a channel.
void ReportAbsentChannels(const SelectionOptions& options, const std::set<std::string>& there,
                          const std::string& log) {
  const std::vector<std::string> known(there.begin(), there.end());
  for (const std::string& name : options.only)
    if (IsName(name) && !there.contains(name))
      std::cerr << fmt::format("{} has no channel {}{} (priamos log info lists all)\n", log,
                               name.empty() ? "\"\"" : name, NearestText(name, known));
}

/// The log is read once more only when a channel is named.
void CompareWithLog(const SelectionOptions& options, const bus::LogSelection& selection,
                    const std::string& log) {
  if (selection.rename.empty() && std::none_of(options.only.begin(), options.only.end(), IsName)) return;
  const std::set<std::string> there = ChannelsOf(log);
  RequireRenamesFit(selection, there, log);
  ReportAbsentChannels(options, there, log);
}

}  // namespace

void AddSelectionOptions(CLI::App& verb, SelectionOptions& options) {
  verb.add_option("--channels", options.only, "only these, A,B or with a star: 'WHEEL_*'")->delimiter(',');
  verb.add_option("--without", options.without, "not these")->delimiter(',');
  verb.add_option("--rename", options.rename, "A=B: channel A becomes B")->delimiter(',');
  verb.add_option("--from", options.from_s, "[s] since the first event")
      ->capture_default_str()
      ->check(CLI::Range(0.0, kLongest_s));
  verb.add_option("--to", options.to_s, "[s] since the first event")->check(CLI::Range(0.0, kLongest_s));
}

bus::LogSelection SelectionOf(const SelectionOptions& options, const std::string& log) {
  bus::LogSelection selection;
  selection.only = options.only;
  selection.without = options.without;
  selection.rename = ParseRenames(options.rename);
  if (options.to_s >= 0 && options.to_s <= options.from_s)
    throw std::runtime_error(
        fmt::format("--to: expected more than the {} s of --from, got {}", options.from_s, options.to_s));
  CompareWithLog(options, selection, log);
  const auto first = bus::LogReader(log).Next();
  if (!first) return selection;
  if (options.from_s > 0)
    selection.from_utime = first->utime + static_cast<std::int64_t>(options.from_s * 1e6);
  if (options.to_s >= 0) selection.to_utime = first->utime + static_cast<std::int64_t>(options.to_s * 1e6);
  return selection;
}

void RequireNewFile(const std::string& out, const std::string& in, bool force) {
  if (out == "-")
    throw std::runtime_error("expected the name of a new file, got \"-\": this cannot go to standard output");
  RequireFileOrNothing(out);
  std::error_code none;
  if (std::filesystem::equivalent(out, in, none))
    throw std::runtime_error(out + ": expected another file than the one that is read, got the same");
  if (!force && std::filesystem::exists(out))
    throw std::runtime_error(out + ": expected a new file, got an existing one; --force replaces it");
}

bool HasEvent(const std::string& log, const std::function<bool(const bus::LogEvent& event)>& wanted) {
  for (bus::LogReader reader(log); const auto event = reader.Next();)
    if (wanted(*event)) return true;
  return false;
}

void RequireEvents(const std::string& log, const std::string& out, const std::string& purpose,
                   const std::function<bool(const bus::LogEvent& event)>& wanted) {
  if (HasEvent(log, wanted)) return;
  throw std::runtime_error(
      fmt::format("{}: expected events to {}, got none; {} is not written", log, purpose, out));
}

OutputFile::OutputFile(const std::string& out, const std::string& in, bool force)
    : name_(out == "-" ? "" : out) {
  if (name_.empty()) return;
  RequireNewFile(out, in, force);
  file_.open(place_.emplace(out).written(), std::ios::binary | std::ios::trunc);
  if (!file_) throw std::runtime_error(fmt::format("{}: cannot be written: {}", out, std::strerror(errno)));
}

std::ostream& OutputFile::stream() {
  return name_.empty() ? std::cout : file_;
}

int OutputFile::Close() {
  stream().flush();
  if (!stream())
    throw std::runtime_error(
        fmt::format("{}: cannot be written: is the disk full?", name_.empty() ? "standard output" : name_));
  if (place_) place_->Keep();
  return 0;
}

double ParseSpeed(const std::string& text) {
  if (text == "max") return 0;
  const auto slash = text.find('/');
  const auto above = NumberOf<double>(std::string_view(text).substr(0, slash));
  const auto below =
      slash == std::string::npos ? 1.0 : NumberOf<double>(std::string_view(text).substr(slash + 1));
  const double speed = above && below ? *above / *below : 0;
  if (speed >= kSlowest && speed <= kFastest) return speed;
  throw std::runtime_error(fmt::format("--speed: expected 1/64 to 1000 or max, got \"{}\"", text));
}

}  // namespace priamos::cli
