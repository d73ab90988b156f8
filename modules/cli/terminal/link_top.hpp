#pragma once

#include <map>
#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>

#include "cli/options/bus_options.hpp"
#include "cli/terminal/text_table.hpp"
#include "common/time.hpp"
#include "priamos/link_status_t.hpp"

namespace priamos::cli {

/// What `priamos link top` shows: one end of the radio link, put together from its LINK_STATUS reports.
/// Pure: time is given.
class LinkTopView {
 public:
  /// A report that arrived at `now`. Reports of a link with many channels bring some of them each.
  void Add(const link_status_t& report, Time now);
  /// The screen as lines of text. With a size they fit: columns of the table go by worth, then the lines on
  /// quality, then channels, which are counted. Before the first report it shows what is missing.
  std::string Render(Time now, std::optional<ScreenSize> size) const;
  /// Content of the screen as JSON.
  nlohmann::ordered_json Json(Time now) const;
  bool empty() const { return !last_.has_value(); }
  /// Whether every channel was reported twice, so that its rates are known.
  bool complete() const;

 private:
  struct Row {
    link_channel_t channel{};
    Time at{};
    std::optional<double> messages_per_s{};  ///< between the last two reports of the channel
    std::optional<double> bytes_per_s{};
  };
  std::string Head(Time now, int columns) const;
  std::string Quality(int columns) const;
  TextTable Table() const;

  std::optional<link_status_t> last_;
  Time last_at_{};
  std::map<int, Row> rows_;  ///< rows by the channel's number in the table
};

/// Options of `priamos link top` and `priamos link listen`.
struct LinkTopOptions {
  BusOptions bus;
  bool once = false;      ///< print one screen and end
  bool json = false;      ///< a line of JSON instead of a screen
  double seconds = 0;     ///< end after so long; 0: at Ctrl-C
  std::string channel{};  ///< `listen`: the on-request channel that is wanted
};

/// Shows the link until Ctrl-C, or with --once as soon as its rates are known. Returns 0, or 1 when --once
/// heard nothing within 10 s.
int RunLinkTop(const LinkTopOptions& options);
/// Asks the other end for an on-request channel for as long as it runs. Returns 0; throws ConfigError when a
/// radio on this bus reports that the link has no such channel, or that this end sends it.
int RunLinkListen(const LinkTopOptions& options);

}  // namespace priamos::cli
