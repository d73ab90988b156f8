#include "robot/last_word.hpp"

#include <fmt/format.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <stdexcept>
#include <string_view>

#include "common/replace_file.hpp"

namespace priamos::robot {
namespace {

namespace fs = std::filesystem;

std::string_view Text(LastWord word) {
  switch (word) {
    case LastWord::kNone:
      break;
    case LastWord::kEnded:
      return "ended\n";
    case LastWord::kRunning:
      return "running\n";
    case LastWord::kEstop:
      return "e-stop\n";
  }
  return "";
}

}  // namespace

std::string WhyLatched(LastWord last) {
  switch (last) {
    case LastWord::kNone:
    case LastWord::kEnded:
      break;
    case LastWord::kRunning:
      return "the process before did not end in order";
    case LastWord::kEstop:
      return "it was latched before the restart";
  }
  return "";
}

LastWord LastWordFile::Load() const {
  if (path_.empty()) return LastWord::kNone;
  const auto folder = fs::absolute(path_).parent_path();
  if (access(folder.c_str(), W_OK) != 0)
    throw std::runtime_error(fmt::format("state_file: expected a folder that can be written, got {}: {}",
                                         folder.string(), std::strerror(errno)));
  if (!fs::exists(path_)) return LastWord::kNone;
  std::ifstream in(path_);
  if (!in) throw std::runtime_error(fmt::format("{}: the state of the robot cannot be read", path_));
  std::string text;
  std::getline(in, text);
  for (const LastWord word : {LastWord::kEnded, LastWord::kRunning})
    if (text + "\n" == Text(word)) return word;
  return LastWord::kEstop;
}

void LastWordFile::Save(LastWord word) {
  if (path_.empty() || word == saved_) return;
  if (!ReplaceFile(path_, Text(word), true, 0644))
    throw std::runtime_error(
        fmt::format("{}: the state of the robot cannot be saved: {}", path_, std::strerror(errno)));
  saved_ = word;
}

}  // namespace priamos::robot
