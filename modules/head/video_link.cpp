#include "head/video_link.hpp"

#include <opencv2/core.hpp>
#include <opencv2/imgcodecs.hpp>
#include <vector>

#include "common/web/token_file.hpp"

namespace priamos::head {
namespace {

WebServerOptions OptionsOf(const VideoConfig& config, const std::string& camera,
                           const std::string& token_file) {
  WebServerOptions options;
  options.address = config.address;
  options.port = config.port;
  options.ports = config.ports;
  options.max_connections = 8;
  options.max_sockets = 0;
  options.access = LoadAccess(config.address, token_file);
  options.camera = camera;
  return options;
}

}  // namespace

VideoLink::VideoLink(const VideoConfig& config, const std::string& robot, const std::string& token_file)
    : camera_(robot + "/third"),
      quality_(config.quality),
      rhythm_(config.rate_hz),
      server_(OptionsOf(config, camera_, token_file), files_, *this) {}

bool VideoLink::Step(bool needed, Time now) {
  server_.Poll(now);
  return rhythm_.Step(server_.is_watched(), needed, now);
}

void VideoLink::Show(Time exposed, const GreyImage& picture) {
  // OpenCV does not write to what it encodes.
  const cv::Mat grey(picture.height, picture.width, CV_8UC1,
                     const_cast<std::uint8_t*>(picture.pixels.data()));
  std::vector<std::uint8_t> jpeg;
  if (cv::imencode(".jpg", grey, jpeg, {cv::IMWRITE_JPEG_QUALITY, quality_}))
    server_.ShowPicture(exposed, {jpeg.begin(), jpeg.end()});
}

}  // namespace priamos::head
