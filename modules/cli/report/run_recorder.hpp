#pragma once

#include <optional>
#include <string>

#include "bus/log/log_writer.hpp"
#include "bus/own_types.hpp"
#include "cli/report/report_record.hpp"
#include "common/time.hpp"

namespace priamos::cli {

/// Writes both buses of a run to logs, which define their types, and keeps what the report needs.
class RunRecorder {
 public:
  /// Records into logs in `folder`; nothing is written to disk without a folder.
  explicit RunRecorder(const std::optional<std::string>& folder);

  void OnMessage(std::string_view bus, Time now, std::string_view channel, std::span<const std::byte> bytes);
  void Flush();
  const RunRecord& record() const { return record_; }
  /// Whether all logs could be written so far; a full disk is one reason for false.
  bool good() const;

 private:
  bus::Schema types_ = bus::OwnTypes();
  std::optional<bus::LogWriter> onboard_, offboard_;
  RunRecord record_;
};

}  // namespace priamos::cli
