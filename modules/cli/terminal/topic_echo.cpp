#include "cli/terminal/topic_echo.hpp"

#include <fmt/format.h>

#include <CLI/App.hpp>
#include <exception>
#include <iostream>
#include <tuple>

#include "bus/clocks/host_clock.hpp"
#include "cli/options/verb_setup.hpp"
#include "cli/terminal/bus_watch.hpp"
#include "cli/terminal/echo_text.hpp"
#include "cli/terminal/silence_watch.hpp"
#include "lcmtypes/channels.hpp"

namespace priamos::cli {
namespace {

struct EchoOptions : BusOptions {
  std::string channel;
  std::vector<std::string> fields;
  int count = 0;
  bool json = false;
};

/// The type that a channel of PRIAMOS carries; nullptr for others, whose first message shows it.
const bus::Struct* TypeOf(const bus::Schema& schema, const std::string& name) {
  const bus::Struct* type = nullptr;
  const auto look = [&]<class T>(const Channel<T>& channel) {
    if (channel.name == name) type = schema.Find(static_cast<std::uint64_t>(T::getHash()));
  };
  std::apply([&](const auto&... channel) { (look(channel), ...); }, channels::kAll);
  return type;
}

/// Prints messages, or some of their fields.
class Echo {
 public:
  explicit Echo(const EchoOptions& options) : options_(options), schema_(LoadTypes(options.types)) {
    if (const auto* type = TypeOf(schema_, options.channel)) Resolve(*type);
  }

  int Run() {
    const bus::HostClock clock;
    bus::LcmBus bus(options_.bus.Url(), options_.messages());
    SilenceWatch silence("priamos topic echo", options_, options_.channel, clock.Now());
    bus.Subscribe(options_.channel, [&](std::string_view, std::span<const std::byte> bytes) {
      silence.Heard();
      if (!Done()) Take(bytes);
    });
    Watch(
        bus, clock, Time::max(), [&] { return Done(); }, [&] { silence.Step(clock.Now()); });
    if (problem_) std::rethrow_exception(problem_);
    return 0;
  }

 private:
  bool Done() const { return problem_ != nullptr || (options_.count > 0 && seen_ >= options_.count); }

  void Resolve(const bus::Struct& type) {
    resolved_ = &type;
    fields_.clear();
    for (const std::string& field : options_.fields) fields_.emplace_back(type, field);
  }

  /// A field that the type does not have ends it; a message that cannot be read does not. A handler of the
  /// bus must not throw.
  void Take(std::span<const std::byte> bytes) {
    ++seen_;
    const auto* type = schema_.Of(bytes);
    try {
      if (type != nullptr && type != resolved_) Resolve(*type);
    } catch (const bus::MessageError&) {
      problem_ = std::current_exception();
      return;
    }
    try {
      if (type == nullptr)
        throw bus::MessageError("no known type has this fingerprint; name its .lcm folder with --types");
      std::cout << EchoText(bus::ToJson(*type, bytes), fields_,
                            options_.json ? EchoForm::kOneLine : EchoForm::kForPeople)
                << std::endl;
    } catch (const bus::MessageError& error) {
      std::cerr << fmt::format("{}: {} bytes: {}\n", options_.channel, bytes.size(), error.what());
    }
  }

  EchoOptions options_;
  bus::Schema schema_;
  const bus::Struct* resolved_ = nullptr;  ///< what fields_ belong to
  std::vector<FieldPath> fields_;
  int seen_ = 0;
  std::exception_ptr problem_;
};

}  // namespace

void AddTopicEchoVerb(CLI::App& topic, int& exit_code) {
  auto options = std::make_shared<EchoOptions>();
  auto* verb = AddVerb(topic, "echo", "Print the messages of one channel, or some of their fields, as JSON.");
  verb->footer(
      "Examples: priamos topic echo POSE --count 1\n          priamos topic echo POSE x_m y_m\n"
      "          priamos topic echo SONAR_RANGES range_m[3] --bus onboard");
  AddChannelArgument(*verb, options->channel);
  verb->add_option("field", options->fields, "only these fields, e.g. x_m, range_m[3], channels[0].bytes");
  AddBusOption(*verb, *options);
  AddTypesOption(*verb, options->types);
  verb->add_option("--count", options->count, "stop after so many messages; 0: at Ctrl-C")
      ->check(CLI::NonNegativeNumber)
      ->capture_default_str();
  verb->add_flag("--json", options->json, "one line per message");
  verb->callback([options, &exit_code] { exit_code = Echo(*options).Run(); });
}

}  // namespace priamos::cli
