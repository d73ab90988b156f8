#include "console/audit_log.hpp"

#include <fmt/format.h>

#include <filesystem>
#include <stdexcept>
#include <utility>

#include "console/core/json_line.hpp"

namespace priamos::console {
namespace {

namespace fs = std::filesystem;

}  // namespace

AuditLog::AuditLog(std::string file) : file_(std::move(file)) {
  if (!file_.empty() && !Open())
    throw std::runtime_error(fmt::format(
        "audit_file: {} cannot be written; next: another file, or a folder that is yours", file_));
}

bool AuditLog::Open() {
  out_ = std::ofstream(file_, std::ios::app | std::ios::binary);
  std::error_code no_file;
  const std::uintmax_t size = fs::file_size(file_, no_file);
  bytes_ = no_file ? 0 : size;
  return out_.good();
}

void AuditLog::Note(Time now, std::uint64_t client, std::string_view what, const Json& details) {
  if (file_.empty()) return;
  Json line = {{"utime", ToUtime(now)}, {"client", client}, {"what", what}};
  line.update(details);
  const std::string text = JsonLine(line) + "\n";
  if (bytes_ + text.size() > kMostBytes) {
    std::error_code stays;
    fs::rename(file_, file_ + ".1", stays);
    out_.close();
  }
  // After a full disk it is opened anew: there may be room again.
  if ((!out_.is_open() || !out_.good()) && !Open()) {
    ++failed_;
    return;
  }
  out_ << text << std::flush;
  bytes_ += text.size();
  if (!out_.good()) ++failed_;
}

}  // namespace priamos::console
