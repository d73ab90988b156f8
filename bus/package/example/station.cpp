// A process of somebody else's robot: it measures the wind twice a second.

#include "bus/process.hpp"
#include "weather/wind_t.hpp"
#include "weather_types.hpp"

namespace weather {

constexpr priamos::Channel<wind_t> kWind{"WIND", 2, std::chrono::milliseconds(2000)};

struct StationConfig {
  double speed_m_s = 3.5;

  void Describe(priamos::Archive& a) {
    a.Number("speed_m_s", speed_m_s, {"m/s", 0, 60, "what it measures, as long as it has no instrument"});
  }
};

class Station {
 public:
  static constexpr std::string_view kName = "weather";
  static constexpr std::string_view kSummary = "Measures the wind.";
  static constexpr bool kOneOwner = true;
  static std::vector<priamos::TypeText> Types() { return weather::Types(); }
  using Config = StationConfig;

  Station(const StationConfig& config, priamos::bus::Context& context)
      : config_(config), wind_(context.node().Advertise(kWind)) {}

  priamos::Duration TickPeriod() const { return std::chrono::milliseconds(500); }
  void Tick(priamos::Time now) {
    wind_t message{};
    message.utime = priamos::ToUtime(now);
    message.speed_m_s = config_.speed_m_s;
    wind_.Publish(message);
  }

 private:
  StationConfig config_;
  priamos::bus::Publisher<wind_t> wind_;
};

}  // namespace weather

int main(int argc, char** argv) {
  return priamos::bus::RunProcess<weather::Station>(argc, argv);
}
