#pragma once

#include <map>
#include <optional>
#include <string>

#include "priamos/link_status_t.hpp"

namespace priamos::cli {

/// The channels of the radio link by what one end's LINK_STATUS says of them: whether asking the other end
/// for one can bring anything. Pure.
class LinkChannels {
 public:
  /// Reports of a link with many channels bring some of them each.
  void Add(const link_status_t& report);
  /// True before the first report: then nothing is known, and nothing refused.
  bool empty() const { return n_all_ == 0; }
  /// Whether every channel of the link is known.
  bool complete() const { return n_all_ > 0 && outgoing_.size() >= n_all_; }
  /// Why asking for `channel` brings nothing, one sentence; nullopt when it may, or is not known yet.
  std::optional<std::string> WhyNot(const std::string& channel) const;

 private:
  std::map<std::string, bool> outgoing_;  ///< by channel: whether this end sends it
  std::size_t n_all_ = 0;
};

}  // namespace priamos::cli
