#include "console/console_config.hpp"

#include <iterator>
#include <sstream>

#include "common/web/picture_client.hpp"
#include "common/web/web_request.hpp"

namespace priamos::console {

void DrawnBody::Describe(Archive& a) {
  a.Number("length_m", length_m, {"m", 0.1, 3, "along the base's x axis"});
  a.Number("width_m", width_m, {"m", 0.1, 3, "along the base's y axis"});
}

void ConsoleConfig::Describe(Archive& a) {
  a.Text("map", map, "ground plan that the page draws: the planner's");
  a.Text("link", link, "channels of the radio: which come only on request, and how old each may be");
  a.Text("address", address,
         "numeric address of this host to listen on; all but 127.0.0.1 and ::1 need a token_file");
  a.Integer("port", port, {"-", 0, 65535, "first TCP port that is tried; 0: any"});
  a.Integer("ports", ports, {"-", 1, 100, "how many ports are tried, for several robots on one host"});
  a.Text(
      "token_file", token_file,
      "file with lines `driver TOKEN` and `viewer TOKEN`, mode 0600; empty: everybody on this host drives");
  a.Text(
      "certificate_file", certificate_file,
      "certificate of this host, PEM, with those that vouch for it: pages are then served by https; empty: "
      "by http, which everybody on the way can read");
  a.Text("key_file", key_file, "private key of that certificate, PEM, mode 0600");
  if (certificate_file.empty() != key_file.empty())
    a.Refuse(key_file.empty() ? "key_file" : "certificate_file", "both files or none");
  a.Text("foxglove_origins", foxglove_origins,
         "foreign pages, separated by blanks, that may connect as Foxglove does: https://app.foxglove.dev; "
         "file:// "
         "is what Foxglove and Lichtblick on the desktop name, and every page that is opened from a disk");
  for (const std::string& origin : WordsOf(foxglove_origins))
    if (!IsOrigin(origin)) a.Refuse("foxglove_origins", "https://HOST[:PORT], http://HOST[:PORT] or file://");
  a.Text("audit_file", audit_file,
         "file to which a line is added for everything that somebody did at the station; empty: none");
  a.Text("video", video,
         "http://HOST:PORT of the head's video link (`[video]` of head.toml); empty: the robot has none");
  if (!video.empty() && !ReadPictureAddress(video)) a.Refuse("video", "http://HOST:PORT");
  a.Text("video_token_file", video_token_file,
         "copy of the token_file of the head's video link; empty: it needs none");
  a.Integer("pages", pages, {"-", 1, 100, "most pages at once"});
  a.Number("rate_hz", rate_hz, {"Hz", 50, 500, "how often connections and bus are looked at"});
  a.Number("beat_hz", beat_hz, {"Hz", 10, 50, "how often pages are sent what is new"});
  a.Number("freshness_s", freshness_s,
           {"s", 0.1, 0.5, "a page's wish that is proven no younger than this is not obeyed"});
  a.Number("place_sigma_m", place_sigma_m,
           {"m", 0.01, 2, "how well a person tells on the plan where the robot stands, one sigma"});
  a.Number("place_sigma_deg", place_sigma_deg, {"deg", 0.3, 90, "how well he tells its heading, one sigma"});
  a.Section("body", body, "the robot as it is drawn");
  a.Section("pilot", pilot, "from the page's stick to wishes");
}

std::vector<std::string> WordsOf(const std::string& text) {
  std::istringstream words(text);
  return {std::istream_iterator<std::string>(words), {}};
}

}  // namespace priamos::console
