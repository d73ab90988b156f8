#pragma once

#include <cstdint>
#include <fstream>
#include <nlohmann/json.hpp>
#include <string>
#include <string_view>

#include "common/time.hpp"

namespace priamos::console {

/// Who did what at the station: a line of JSON per act, {"utime", "client", "what", ...}, appended to a file.
/// When it has grown to kMostBytes it becomes FILE.1, and that before it is gone.
class AuditLog {
 public:
  static constexpr std::uint64_t kMostBytes = 10'000'000;
  using Json = nlohmann::ordered_json;

  /// Without a file nothing is written. Throws std::runtime_error, one sentence, when it cannot be opened.
  explicit AuditLog(std::string file);

  /// `details`: an object whose fields are added.
  void Note(Time now, std::uint64_t client, std::string_view what, const Json& details = Json::object());
  /// Acts that could not be written down.
  std::uint64_t failed() const { return failed_; }

 private:
  bool Open();

  std::string file_;
  std::ofstream out_;
  std::uint64_t bytes_ = 0, failed_ = 0;
};

}  // namespace priamos::console
