#pragma once

#include <concepts>
#include <functional>
#include <iosfwd>
#include <memory>
#include <string>
#include <vector>

#include "bus/context.hpp"
#include "bus/parameters/parameter_json.hpp"
#include "bus/process_config.hpp"
#include "common/config.hpp"
#include "common/config_printer.hpp"
#include "common/parameters/saved_parameters.hpp"
#include "common/time.hpp"
#include "lcmtypes/embedded_types.hpp"

namespace priamos::bus {

/// The interface of a module's App. It runs unchanged in real time, in lockstep and from a log. Optional
/// members:
///
///     static constexpr bool kOneOwner = true;     a second one of the same robot does not start on its bus
///     static constexpr auto kSpeaksAlone = ...;   channels: it does not run beside other senders on them
///     static constexpr bool kFollowsLogs = true;  it may run on the time of a bus onto which a log is played
///     static std::vector<TypeText> Types();       .lcm texts of its messages, beside those of lcmtypes/
///     void Yield(Time now);                       its last act when another process has its role
///     void Reconfigure(const Config& config);     between ticks: parameters marked Live have changed
template <class T>
concept App = requires(T app, const typename T::Config& config, Context& context, Time now) {
  { T::kName } -> std::convertible_to<std::string_view>;
  { T::kSummary } -> std::convertible_to<std::string_view>;
  T(config, context);
  { app.TickPeriod() } -> std::same_as<Duration>;
  app.Tick(now);
};

/// A command-line flag that sets one configuration key, e.g. `--port TTY` for `port`.
struct OptionAlias {
  std::string_view flag;   ///< "--port"
  std::string_view key;    ///< "port", dotted for sections
  std::string_view value;  ///< fixed TOML value for a flag without argument; empty when it takes one
  std::string_view doc;
};

/// An App whose type is forgotten, so that processes and lockstep are compiled once.
class AnyApp {
 public:
  virtual ~AnyApp() = default;
  virtual Duration TickPeriod() const = 0;
  virtual void Tick(Time now) = 0;
  virtual void Yield(Time now) = 0;
  /// What may be changed while it runs; nullptr: nothing.
  virtual ParameterStore* parameters() { return nullptr; }
  /// Tells it that parameters have changed.
  virtual void Reconfigure() {}
};

/// The configuration of an App: file and command line, with what was saved while it ran on top.
template <class T>
struct AppConfig {
  explicit AppConfig(const ConfigSource& source)
      : values(LoadAppConfig<T>(source)), parameters([this](Archive& a) { values.Describe(a); }) {
    ReadSavedParameters(source.saved, parameters);
  }
  AppConfig(const AppConfig&) = delete;
  AppConfig& operator=(const AppConfig&) = delete;

  /// What the file says of the parameters, beside what was saved.
  ParameterSheet Sheet() const {
    ParameterSheet sheet{parameters.table(), {}};
    for (std::size_t i = 1; i <= sheet.table.all().size(); ++i)
      sheet.values.push_back(parameters.FileValueOf(static_cast<int>(i)));
    return sheet;
  }

  T values;
  ParameterStore parameters;
};

/// How to start one kind of App.
struct AppFactory {
  std::string name;
  std::string summary;
  std::string default_bus = "onboard";  ///< or "offboard"
  std::vector<OptionAlias> aliases;
  bool one_owner = false;                 ///< only one such process may own its role on one robot's bus
  bool follows_logs = false;              ///< may run with `--clock bus`
  std::vector<TypeText> types;            ///< of its messages, beside those of lcmtypes/
  std::vector<std::string> speaks_alone;  ///< channels on which nobody but the owner may send
  std::function<std::unique_ptr<AnyApp>(const ConfigSource&, Context&)> start;
  std::function<void(std::ostream&, const ConfigSource&)> print_config;
  std::function<ParameterSheet(const ConfigSource&)> parameters;
};

template <App T>
AppFactory FactoryOf() {
  struct Erased : AnyApp {
    Erased(const ConfigSource& source, Context& context) : config(source), app(config.values, context) {}
    Duration TickPeriod() const override { return app.TickPeriod(); }
    void Tick(Time now) override { app.Tick(now); }
    void Yield(Time now) override {
      if constexpr (requires { app.Yield(now); }) app.Yield(now);
    }
    ParameterStore* parameters() override {
      if constexpr (requires { app.Reconfigure(config.values); }) return &config.parameters;
      return nullptr;
    }
    void Reconfigure() override {
      if constexpr (requires { app.Reconfigure(config.values); }) app.Reconfigure(config.values);
    }
    AppConfig<typename T::Config> config;
    T app;
  };
  AppFactory factory;
  factory.name = T::kName;
  factory.summary = T::kSummary;
  if constexpr (requires { T::kDefaultBus; }) factory.default_bus = T::kDefaultBus;
  if constexpr (requires { T::kOptions; })
    factory.aliases.assign(std::begin(T::kOptions), std::end(T::kOptions));
  if constexpr (requires { T::kOneOwner; }) factory.one_owner = T::kOneOwner;
  if constexpr (requires { T::kFollowsLogs; }) factory.follows_logs = T::kFollowsLogs;
  if constexpr (requires { T::Types(); }) factory.types = T::Types();
  if constexpr (requires { T::kSpeaksAlone; })
    factory.speaks_alone.assign(std::begin(T::kSpeaksAlone), std::end(T::kSpeaksAlone));
  factory.start = [](const ConfigSource& source, Context& context) {
    return std::make_unique<Erased>(source, context);
  };
  factory.print_config = [](std::ostream& out, const ConfigSource& source) {
    AppConfig<typename T::Config> config(source);
    config.values.Describe(*MakeConfigPrinter(out));
  };
  factory.parameters = [](const ConfigSource& source) {
    return AppConfig<typename T::Config>(source).Sheet();
  };
  return factory;
}

}  // namespace priamos::bus
