#include "head/video_config.hpp"

namespace priamos::head {

void VideoConfig::Describe(Archive& a) {
  a.Text("address", address,
         "numeric address of this host to listen on; all but 127.0.0.1 and ::1 need a token_file");
  a.Integer("port", port, {"-", 0, 65535, "first TCP port that is tried; 0: there is no video link"});
  a.Integer("ports", ports, {"-", 1, 100, "how many ports are tried, for several robots on one host"});
  a.Text("token_file", token_file,
         "file with lines `driver TOKEN` and `viewer TOKEN`, mode 0600: both may look; empty: everybody on "
         "this host");
  a.Number("rate_hz", rate_hz, {"Hz", 0.5, 25, "pictures while somebody looks"});
  a.Integer("quality", quality, {"-", 10, 95, "of the JPEG: 60 makes about 17 kB of a picture"});
}

}  // namespace priamos::head
