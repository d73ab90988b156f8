#pragma once

#include <cstdint>
#include <functional>
#include <map>
#include <optional>
#include <set>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "common/time.hpp"
#include "console/foxglove/client_message.hpp"
#include "console/foxglove/server_message.hpp"

namespace priamos::console {

/// The parameters that may be changed while their processes run, as Foxglove clients see them: by the name
/// `process/key`, with the newest value that is known. A process answers over the radio and takes its time,
/// so whoever changes something is answered when the process has, or after kPatience. Pure: time is an
/// argument, and what is to be sent and ordered goes to functions.
class ParameterBoard {
 public:
  using Client = std::uint64_t;
  /// Most requests that wait for an answer; of more the oldest is answered with what is known.
  static constexpr std::size_t kMostWaiting = 100;
  /// The radio carries an order every 4 s, and what was read before has to be answered first.
  static constexpr Duration kPatience = std::chrono::seconds(30);

  /// Where the board's words go.
  struct Port {
    /// Values for a client; `id` is that of the request that they answer, empty when nobody asked.
    std::function<void(Client, std::span<const ShownParameter>, std::string_view id)> values;
    /// A sentence for the person at the client.
    std::function<void(Client, const std::string& sentence)> warn;
    /// Does what a page's message (README.md, "What a page says") asks for; returns why not.
    std::function<std::optional<Refusal>(Client, const std::string& page_message)> order;
  };

  explicit ParameterBoard(Port port) : port_(std::move(port)) {}

  /// The parameters of a process, in the order of their numbers, with the values of its file.
  void Know(const std::string& process, std::span<const ShownParameter> parameters);
  /// What a process has answered: the value in force of a key by its number, the next number behind it whose
  /// value differs from the file (0: none), and why an order was not obeyed, empty when it was.
  void Heard(const std::string& process, int key, double value, int next_changed, std::string_view problem);

  void Take(Client client, const GetParametersRequest& request);
  void Take(Client client, const SetParametersRequest& request);
  void Take(Client client, const WatchParametersRequest& request);
  void Leave(Client client);
  void Step(Time now);

 private:
  /// A client that waits for the outcome of what it has changed, or for the first parameters (no names).
  struct Waiting {
    Client client = 0;
    std::string id;
    std::set<std::string> names;
    Time since{};
    std::vector<std::string> asked{};  ///< names of the answer; none: all
    bool silent = false;               ///< it wants to know only what went wrong
  };

  std::vector<ShownParameter> Values(std::span<const std::string> names) const;
  std::optional<std::string> NameOf(const std::string& process, int key) const;
  void Watch(Client client, std::span<const std::string> names);
  void Ask(Client client, const std::string& process, std::string_view key);
  void AskAll(Client client);
  bool Order(Client client, const ParameterChange& change);
  void Wait(Waiting waiting);
  void Answer(const Waiting& waiting);
  void TellWatchers(const std::string& name);

  Port port_;
  Time now_{};
  std::map<std::string, std::vector<std::string>> keys_;  ///< of a process; number 1 is the first
  std::map<std::string, double> values_;                  ///< by name
  std::map<Client, std::set<std::string>> watched_;       ///< no names: all
  std::vector<Waiting> waiting_;
  std::optional<Client> asker_;  ///< for whom the values in force are being read
  std::set<std::string> asked_;  ///< names that were asked for since it asked
};

}  // namespace priamos::console
