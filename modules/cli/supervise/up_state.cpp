#include "cli/supervise/up_state.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/file.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <limits>
#include <nlohmann/json.hpp>
#include <stdexcept>
#include <string_view>

#include "common/replace_file.hpp"
#include "common/text/number_text.hpp"

namespace priamos::cli {
namespace {

namespace fs = std::filesystem;
using nlohmann::ordered_json;

constexpr std::array kStates{ProcessState::kWaiting, ProcessState::kStarting, ProcessState::kReady,
                             ProcessState::kBackOff, ProcessState::kStopping, ProcessState::kStopped};

std::string LockFile(const std::string& log_root) {
  return (fs::path(log_root) / "up.lock").string();
}

std::string StateFile(const std::string& log_root) {
  return (fs::path(log_root) / "up.json").string();
}

ProcessState StateOf(const std::string& text) {
  for (const ProcessState state : kStates)
    if (text == Text(state)) return state;
  return ProcessState::kStopped;
}

}  // namespace

UpLock::UpLock(const std::string& log_root) : file_(LockFile(log_root)) {
  fs::create_directories(log_root);
  fd_ = open(file_.c_str(), O_RDWR | O_CREAT | O_CLOEXEC, 0644);
  if (fd_ < 0)
    throw std::runtime_error(fmt::format("{}: cannot be written: {}", file_, std::strerror(errno)));
  if (flock(fd_, LOCK_EX | LOCK_NB) != 0) {
    const auto holder = Holder(log_root);
    close(fd_);
    throw std::runtime_error(
        fmt::format("{}: expected nothing up, got `priamos up` with pid {}: `priamos down` ends it", log_root,
                    holder.value_or(0)));
  }
  std::error_code ignored;
  fs::remove(StateFile(log_root), ignored);  // of one that was killed
  const std::string pid = std::to_string(getpid()) + "\n";
  if (ftruncate(fd_, 0) != 0 || write(fd_, pid.data(), pid.size()) < 0)
    throw std::runtime_error(file_ + ": cannot be written");
}

UpLock::~UpLock() {
  if (fd_ >= 0) close(fd_);
}

std::optional<pid_t> UpLock::Holder(const std::string& log_root) {
  const int fd = open(LockFile(log_root).c_str(), O_RDONLY | O_CLOEXEC);
  if (fd < 0) return std::nullopt;
  const bool free = flock(fd, LOCK_SH | LOCK_NB) == 0;
  std::array<char, 32> text{};
  const ssize_t n = read(fd, text.data(), text.size() - 1);
  close(fd);
  const std::string_view line(text.data(), static_cast<std::size_t>(std::max<ssize_t>(n, 0)));
  const auto pid = NumberOf<pid_t>(line.substr(0, line.find('\n')));
  return !free && pid > 0 ? pid : std::nullopt;
}

std::optional<std::string> UpLock::FolderOf(pid_t pid) {
  std::error_code none;
  for (const auto& entry : fs::directory_iterator(fmt::format("/proc/{}/fd", pid), none)) {
    const fs::path file = fs::read_symlink(entry.path(), none);
    if (file.filename() == fs::path(LockFile("")).filename()) return file.parent_path().string();
  }
  return std::nullopt;
}

ordered_json ToJson(const UpState& state) {
  ordered_json json{{"deployment", state.deployment},
                    {"config_folder", state.config_folder},
                    {"planner_set", state.planner_set},
                    {"folder", state.folder},
                    {"ready", state.ready},
                    {"up_s", state.up_s},
                    {"alarms", state.alarms},
                    {"processes", ordered_json::array()}};
  for (std::size_t i = 0; i < state.processes.size(); ++i) {
    const ProcessReport& p = state.processes[i];
    json["processes"].push_back({{"name", p.name},
                                 {"group", p.group},
                                 {"state", Text(p.state)},
                                 {"pid", p.pid},
                                 {"for_s", state.ages_s[i]},
                                 {"starts", p.starts},
                                 {"alarm", p.alarm},
                                 {"reason", p.reason}});
  }
  return json;
}

bool WriteUpState(const std::string& log_root, const UpState& state) {
  const std::string text = ToJson(state).dump(2, ' ', false, ordered_json::error_handler_t::replace) + "\n";
  return ReplaceFile(StateFile(log_root), text, false, 0644);
}

std::optional<UpState> ReadUpState(const std::string& log_root) {
  std::ifstream in(StateFile(log_root));
  const auto json = ordered_json::parse(in, nullptr, false);
  if (!json.is_object()) return std::nullopt;
  try {
    UpState state{json.at("deployment"),
                  json.at("config_folder"),
                  json.at("planner_set"),
                  json.at("folder"),
                  json.at("ready"),
                  json.at("up_s"),
                  {},
                  {},
                  json.at("alarms")};
    for (const auto& p : json.at("processes")) {
      ProcessReport report;
      report.name = p.at("name");
      report.group = p.at("group");
      report.state = StateOf(p.at("state"));
      report.pid = p.at("pid");
      report.starts = p.at("starts");
      report.alarm = p.at("alarm");
      report.reason = p.at("reason");
      state.processes.push_back(report);
      state.ages_s.push_back(p.at("for_s"));
    }
    return state;
  } catch (const nlohmann::json::exception&) {
    return std::nullopt;
  }
}

std::string FormatUpState(const UpState& state, std::optional<ScreenSize> size) {
  TextTable table({{"process", 100, true},
                   {"group", 20, true},
                   {"state", 95, true},
                   {"pid", 40},
                   {"for", 60},
                   {"starts", 70}});
  const int columns = size ? size->columns : std::numeric_limits<int>::max();
  std::string ends;
  for (std::size_t i = 0; i < state.processes.size(); ++i) {
    const ProcessReport& p = state.processes[i];
    table.Add({p.name, p.group, std::string(Text(p.state)), p.pid == 0 ? "-" : std::to_string(p.pid),
               fmt::format("{:.1f} s", state.ages_s[i]), std::to_string(p.starts)});
    if (p.alarm || !p.reason.empty())
      ends += Wrapped(fmt::format("{}{} last ended: {}", p.alarm ? "ALARM " : "", p.name, p.reason), columns);
  }
  for (const std::string& alarm : state.alarms) ends += Wrapped(alarm, columns);
  const std::string head = fmt::format("{}: {}, up for {:.0f} s; consoles in {}", state.deployment,
                                       state.ready ? "ready" : "not ready", state.up_s, state.folder);
  return Wrapped(head, columns) + (size ? table.Render(*size) : table.Render()) + ends;
}

}  // namespace priamos::cli
