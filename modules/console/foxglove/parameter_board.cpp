#include "console/foxglove/parameter_board.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <nlohmann/json.hpp>
#include <utility>

#include "console/core/json_line.hpp"

namespace priamos::console {
namespace {

using Json = nlohmann::ordered_json;

std::string NameFor(std::string_view process, std::string_view key) {
  return fmt::format("{}/{}", process, key);
}

}  // namespace

void ParameterBoard::Know(const std::string& process, std::span<const ShownParameter> parameters) {
  auto& keys = keys_[process];
  keys.clear();
  for (const ShownParameter& parameter : parameters) {
    keys.push_back(parameter.name);
    values_.try_emplace(NameFor(process, parameter.name), parameter.value);
  }
}

void ParameterBoard::Heard(const std::string& process, int key, double value, int next_changed,
                           std::string_view problem) {
  if (const auto next = NameOf(process, next_changed); asker_ && next && asked_.insert(*next).second)
    Ask(*asker_, process, keys_.at(process)[std::size_t(next_changed) - 1]);
  const auto name = NameOf(process, key);
  if (!name) return;
  values_[*name] = value;
  TellWatchers(*name);
  for (Waiting& waiting : waiting_)
    if (waiting.names.erase(*name) > 0 && !problem.empty())
      port_.warn(waiting.client, fmt::format("{}: {}", *name, problem));
  const auto done = std::stable_partition(
      waiting_.begin(), waiting_.end(), [](const Waiting& w) { return !w.names.empty() || w.asked.empty(); });
  for (auto it = done; it != waiting_.end(); ++it) Answer(*it);
  waiting_.erase(done, waiting_.end());
}

/// What is known is answered at once; what differs from the files by now follows to whoever watches it.
void ParameterBoard::Take(Client client, const GetParametersRequest& request) {
  if (keys_.empty()) return Wait({client, request.id, {}, now_, request.names});
  Answer({client, request.id, {}, now_, request.names});
  AskAll(client);
}

void ParameterBoard::Take(Client client, const SetParametersRequest& request) {
  Waiting waiting{client, request.id, {}, now_, {}, request.id.empty()};
  for (const ParameterChange& change : request.changes) {
    waiting.asked.push_back(change.name);
    if (Order(client, change)) waiting.names.insert(change.name);
  }
  if (waiting.names.empty())
    Answer(waiting);
  else
    Wait(std::move(waiting));
}

void ParameterBoard::Take(Client client, const WatchParametersRequest& request) {
  if (request.on) {
    Watch(client, request.names);
    AskAll(client);
    return;
  }
  const auto watched = watched_.find(client);
  if (watched == watched_.end()) return;
  for (const std::string& name : request.names) watched->second.erase(name);
  if (request.names.empty() || watched->second.empty()) watched_.erase(watched);
}

void ParameterBoard::Watch(Client client, std::span<const std::string> names) {
  const auto [watched, is_new] = watched_.try_emplace(client);
  if (names.empty())
    watched->second.clear();
  else if (is_new || !watched->second.empty())
    watched->second.insert(names.begin(), names.end());
}

void ParameterBoard::Leave(Client client) {
  watched_.erase(client);
  std::erase_if(waiting_, [&](const Waiting& waiting) { return waiting.client == client; });
  if (asker_ == client) asker_.reset();
}

void ParameterBoard::Step(Time now) {
  now_ = now;
  const auto over = std::stable_partition(waiting_.begin(), waiting_.end(), [&](const Waiting& waiting) {
    const bool known_now = waiting.names.empty() && !keys_.empty();
    return !known_now && now - waiting.since <= kPatience;
  });
  const std::vector<Waiting> answered(std::make_move_iterator(over), std::make_move_iterator(waiting_.end()));
  waiting_.erase(over, waiting_.end());
  for (const Waiting& waiting : answered) {
    for (const std::string& name : waiting.names)
      port_.warn(waiting.client, fmt::format("{}: the robot has not answered", name));
    Answer(waiting);
    if (waiting.names.empty()) AskAll(waiting.client);
  }
}

std::vector<ShownParameter> ParameterBoard::Values(std::span<const std::string> names) const {
  std::vector<ShownParameter> values;
  for (const auto& [name, value] : values_)
    if (names.empty() || std::find(names.begin(), names.end(), name) != names.end())
      values.push_back({name, value});
  return values;
}

std::optional<std::string> ParameterBoard::NameOf(const std::string& process, int key) const {
  const auto keys = keys_.find(process);
  if (keys == keys_.end() || key < 1 || static_cast<std::size_t>(key) > keys->second.size())
    return std::nullopt;
  return NameFor(process, keys->second[std::size_t(key) - 1]);
}

/// Who may only look on reads what others have had read: the radio is not his.
void ParameterBoard::Ask(Client client, const std::string& process, std::string_view key) {
  Json message = {{"type", "parameter"}, {"action", "read"}, {"process", process}};
  if (!key.empty()) message["key"] = key;
  port_.order(client, JsonLine(message));
}

void ParameterBoard::AskAll(Client client) {
  asker_ = client;
  asked_.clear();
  for (const auto& [process, keys] : keys_) Ask(client, process, "");
}

bool ParameterBoard::Order(Client client, const ParameterChange& change) {
  const std::size_t slash = change.name.find('/');
  std::optional<Refusal> refusal;
  if (!values_.contains(change.name))
    refusal = Refusal{"there is no such parameter"};
  else if (!change.value)
    refusal = Refusal{"expected a number"};
  else
    refusal = port_.order(client, JsonLine({{"type", "parameter"},
                                            {"action", "set"},
                                            {"process", change.name.substr(0, slash)},
                                            {"key", change.name.substr(slash + 1)},
                                            {"value", *change.value}}));
  if (refusal) port_.warn(client, fmt::format("{}: {}", change.name, refusal->reason));
  return !refusal;
}

void ParameterBoard::Wait(Waiting waiting) {
  if (waiting_.size() >= kMostWaiting) {
    Answer(waiting_.front());
    waiting_.erase(waiting_.begin());
  }
  waiting_.push_back(std::move(waiting));
}

void ParameterBoard::Answer(const Waiting& waiting) {
  if (!waiting.silent) port_.values(waiting.client, Values(waiting.asked), waiting.id);
}

void ParameterBoard::TellWatchers(const std::string& name) {
  const ShownParameter value{name, values_.at(name)};
  for (const auto& [client, names] : watched_)
    if (names.empty() || names.contains(name)) port_.values(client, {&value, 1}, "");
}

}  // namespace priamos::console
