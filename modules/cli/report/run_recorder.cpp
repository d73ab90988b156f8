#include "cli/report/run_recorder.hpp"

#include <filesystem>

namespace priamos::cli {

RunRecorder::RunRecorder(const std::optional<std::string>& folder) {
  if (!folder) return;
  onboard_.emplace((std::filesystem::path(*folder) / "onboard.lcmlog").string());
  offboard_.emplace((std::filesystem::path(*folder) / "offboard.lcmlog").string());
  onboard_->DefineTypesOf(types_);
  offboard_->DefineTypesOf(types_);
}

void RunRecorder::OnMessage(std::string_view bus, Time now, std::string_view channel,
                            std::span<const std::byte> bytes) {
  auto& log = bus == "onboard" ? onboard_ : offboard_;
  if (log) log->Write(ToUtime(now), channel, bytes);
  record_.Add(bus == "onboard" ? Side::kOnboard : Side::kOffboard, ToUtime(now), channel, bytes);
}

void RunRecorder::Flush() {
  if (onboard_) onboard_->Flush();
  if (offboard_) offboard_->Flush();
}

bool RunRecorder::good() const {
  return (!onboard_ || onboard_->good()) && (!offboard_ || offboard_->good());
}

}  // namespace priamos::cli
