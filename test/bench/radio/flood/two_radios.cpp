#include "test/bench/radio/flood/two_radios.hpp"

#include <fstream>
#include <nlohmann/json.hpp>

#include "bus/schema/json.hpp"
#include "bus/type_files.hpp"
#include "bus/wire/bus_address.hpp"

namespace priamos::bench {
namespace {

const std::string& Folder() {
  static const std::string folder = std::string(PRIAMOS_SOURCE_DIR) + "/test/bench/radio";
  return folder;
}

/// The link.toml of a medium.
std::string LinkFile(const std::string& folder, bool datagrams) {
  const std::string path = folder + "/link.toml";
  std::ifstream from(Folder() + "/flood/link.toml");
  std::ofstream(path) << "datagrams = " << (datagrams ? "true" : "false") << "\n" << from.rdbuf();
  return path;
}

cli::ProcessSpec Radio(const std::string& programs, const std::string& link, const std::string& side,
                       const std::string& port, const std::string& bus) {
  return {.name = side,
          .group = {},
          .arguments = {programs + "/priamos-radio", "--config", link, "--types", Folder(), "--" + side,
                        "--port", port, "--bus", bus},
          .after = {},
          .notifies = true,
          .folder = {},
          .policy = {}};
}

}  // namespace

std::string OnboardBus() {
  return bus::BusUrl(bus::kDefaultRobot, bus::BusSide::kOnboard, 0);
}

std::string OffboardBus() {
  return bus::BusUrl(bus::kDefaultRobot, bus::BusSide::kOffboard, 0);
}

std::vector<cli::ProcessSpec> Ends(const std::string& programs, const std::string& folder, bool datagrams) {
  const std::string link = LinkFile(folder, datagrams), local = "127.0.0.1:";
  const std::string a = std::to_string(kOnboardPort), b = std::to_string(kOffboardPort);
  return {
      Radio(programs, link, "onboard", datagrams ? "udp:" + local + b + "@" + a : "tcp::" + a, OnboardBus()),
      Radio(programs, link, "offboard", datagrams ? "udp:" + local + a + "@" + b : "tcp:" + local + a,
            OffboardBus())};
}

bus::Schema FloodTypes() {
  return bus::Schema(bus::ReadTypeFiles(Folder()));
}

std::vector<std::byte> DriveCommand(const bus::Schema& types, int number) {
  return bus::FromJson(*types.Find("drive_t"), {{"vx_m_s", 0.01 * (number % 50)},
                                                {"vy_m_s", 0},
                                                {"wz_rad_s", 0},
                                                {"time_to_live_s", 0.2},
                                                {"mode", 1}});
}

}  // namespace priamos::bench
