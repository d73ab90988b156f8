#include "bus/context.hpp"

#include <filesystem>

#include "bus/other_bus.hpp"
#include "common/serial_port.hpp"

namespace priamos::bus {

std::string Context::ResolvePath(const std::string& name) const {
  return (std::filesystem::path(around_.config_dir) / name).lexically_normal().string();
}

std::unique_ptr<ByteStream> Context::OpenSerial(const std::string& path, int baud) {
  return around_.open_serial(path, baud);
}

std::unique_ptr<OtherBus> Context::OpenBus(const std::string& robot) {
  if (!around_.open_bus) throw BusError(robot + ": expected a process in real time to join its bus");
  return around_.open_bus(robot);
}

void Context::LogRefusal(std::string_view channel, std::string_view text) {
  if (const auto told = refusals_.Take(channel, text, node_.Now())) Log(Level::kWarning, *told);
}

void Context::LogRefusalsLeftOut() {
  for (const std::string& told : refusals_.LeftOut(node_.Now())) Log(Level::kWarning, told);
}

void Context::SetHealth(Health health, std::string_view text) {
  health_ = health;
  health_text_ = text;
}

}  // namespace priamos::bus
