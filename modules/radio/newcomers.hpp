#pragma once

#include <cstddef>
#include <map>
#include <optional>
#include <vector>

#include "common/time.hpp"

namespace priamos::radio {

/// Connections that have not proven to be the other end's: few, for a short time, for few bytes. Pure: who
/// calls it closes what it names.
class Newcomers {
 public:
  /// Room for 80 connections per second. One that leaves before its first fresh frame, which the other end
  /// may send only after a second of silence, has to begin anew.
  static constexpr std::size_t kMost = 240;
  static constexpr std::size_t kMostBytes = 2048;  ///< without a fresh frame
  static constexpr Duration kPatience{3'000'000};

  /// Takes a connection. Returns the one to be closed for it when there is no room: the oldest that has said
  /// nothing, or else the oldest.
  std::optional<int> Admit(int id, Time now);
  /// Notes bytes from a connection. Returns whether it may stay.
  bool OnBytes(int id, std::size_t count);
  /// Notes that the other end made a frame that came from there.
  void OnGenuine(int id);
  void Remove(int id) { all_.erase(id); }
  /// Connections whose time is over.
  std::vector<int> Expired(Time now) const;
  /// Those from which a frame of the other end came: one of them may be the other end.
  std::vector<int> Genuine() const;
  std::size_t size() const { return all_.size(); }

 private:
  struct Newcomer {
    Time since{};
    std::size_t bytes = 0;
    bool genuine = false;
  };
  int WorstOne() const;

  std::map<int, Newcomer> all_;
};

}  // namespace priamos::radio
