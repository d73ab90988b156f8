#include "world/core/head/camera_server.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <bit>
#include <utility>

#include "common/robot/camera_bits.hpp"

namespace priamos::world {

void CameraConfig::Describe(Archive& a) {
  a.Number("trigger_delay_s", trigger_delay_s,
           {"s", 0, 0.5, "from the trigger to the opening of the shutter"});
  a.Number("exposure_s", exposure_s, {"s", 0.0001, 0.2, "time the shutter is open"});
  a.Number("gain", gain, {"-", 0.1, 16, "amplification; multiplies noise too"});
  a.Number("readout_s", readout_s,
           {"s", 0, 1, "from the closing of the shutter to the picture in the store"});
  a.Number("laser", laser, {"-", 0, 10, "brightness of the line laser; 1: white on white paper in 10 ms"});
  a.Integer("max_pending", max_pending, {"-", 3, 8, "pictures that may be pending at once"});
}

DrawnPicture Draw(const RenderFunction& render, const RenderJob& job) {
  try {
    return {render(job), nullptr};
  } catch (...) {
    return {{}, std::current_exception()};
  }
}

std::optional<GreyImage> TakeFrom(std::map<std::int64_t, DrawnPicture>& done, std::int64_t number) {
  const auto node = done.extract(number);
  if (node.empty()) return std::nullopt;
  if (node.mapped().error) std::rethrow_exception(node.mapped().error);
  return node.mapped().image;
}

void InlineRenderExecutor::Submit(const RenderJob& job) {
  done_[job.number] = Draw(render_, job);
}

std::optional<GreyImage> InlineRenderExecutor::Take(std::int64_t number) {
  return TakeFrom(done_, number);
}

CameraServer::CameraServer(const CameraConfig& config, double camera_light, RenderExecutor& executor,
                           std::uint64_t seed, const CameraQuirks& quirks)
    : config_(config),
      camera_light_(camera_light),
      executor_(executor),
      seed_(seed),
      quirks_(quirks),
      gain_(quirks, Rng::Stream(seed, "camera gain")) {}

bool CameraServer::Trigger(Time now, std::int32_t frame_id, int cameras) {
  const bool laser = (cameras & kLaserBit) != 0;
  cameras &= CameraBits(kCameras);
  auto count = static_cast<std::size_t>(std::popcount(static_cast<unsigned>(cameras))) + pending_.size();
  for (const auto& shot : shots_)
    count += static_cast<std::size_t>(std::popcount(static_cast<unsigned>(shot.cameras)));
  if (cameras == 0 || count > static_cast<std::size_t>(config_.max_pending)) return false;
  Time opening = now + FromSeconds(config_.trigger_delay_s);
  // A shutter that is open opens again only after it has closed.
  if (!shots_.empty()) opening = std::max(opening, shots_.back().closing + Duration(1));
  shots_.push_back(
      {opening, opening + FromSeconds(config_.exposure_s), frame_id, cameras, laser, std::nullopt});
  return true;
}

std::optional<Time> CameraServer::NextSample() const {
  if (shots_.empty()) return std::nullopt;
  return shots_.front().opened ? shots_.front().closing : shots_.front().opening;
}

void CameraServer::Sample(const Viewpoint& viewpoint) {
  Shot& shot = shots_.front();
  if (!shot.opened) {
    shot.opened = viewpoint;
    return;
  }
  const Shot closed = shot;
  shots_.pop_front();
  Submit(closed, viewpoint);
}

void CameraServer::Submit(const Shot& shot, const Viewpoint& closed) {
  const Time middle = shot.opening + (shot.closing - shot.opening) / 2;
  for (int c = 0; c < kCameras; ++c) {
    if (!(shot.cameras >> c & 1)) continue;
    RenderJob job;
    job.number = next_number_++;
    job.camera = static_cast<Camera>(c);
    job.opening = *shot.opened;
    job.closing = closed;
    job.exposure = {config_.exposure_s, config_.gain, camera_light_, shot.laser ? config_.laser : 0};
    job.exposure.gain *= gain_.At(job.camera, shot.opening);
    job.exposure.defocus_dioptre = quirks_.cameras[static_cast<std::size_t>(c)].defocus_dioptre;
    job.noise_seed = Rng::Stream(seed_, fmt::format("picture {}", job.number)).engine()();
    pending_.push_back(
        {job.number, shot.closing + FromSeconds(config_.readout_s), {middle, shot.frame_id, job.camera, {}}});
    executor_.Submit(job);
  }
}

std::optional<Frame> CameraServer::Collect(Time now) {
  if (pending_.empty() || pending_.front().ready > now) return std::nullopt;
  std::optional<GreyImage> image;
  try {
    image = executor_.Take(pending_.front().number);
  } catch (...) {
    pending_.pop_front();
    throw;
  }
  if (!image) return std::nullopt;
  Frame frame = std::move(pending_.front().frame);
  frame.image = std::move(*image);
  pending_.pop_front();
  return frame;
}

}  // namespace priamos::world
