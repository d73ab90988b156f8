#include "world/core/render/renderer.hpp"

#include <algorithm>
#include <opencv2/imgproc.hpp>
#include <stdexcept>

#include "world/core/camera/image_formation.hpp"
#include "world/core/render/laser_line.hpp"
#include "world/core/render/lighting.hpp"
#include "world/core/render/mesh.hpp"
#include "world/core/render/offscreen_scene.hpp"
#include "world/core/render/textures.hpp"

namespace priamos::world {

namespace {

constexpr double kMostLight = 1.6;       // of Lighting: a surface right under a lamp
constexpr double kFarthest_m = 20;       // for the distance to focus
constexpr double kReferenceReach_m = 6;  // a calibration body nearer than this decides it

Viewpoint Between(const Viewpoint& a, const Viewpoint& b, double t) {
  const auto mix = [t](double from, double to) { return from + t * (to - from); };
  Viewpoint v;
  v.map_from_base = {mix(a.map_from_base.x, b.map_from_base.x), mix(a.map_from_base.y, b.map_from_base.y),
                     a.map_from_base.yaw + t * WrapAngle(b.map_from_base.yaw - a.map_from_base.yaw)};
  v.head.pan_rad = mix(a.head.pan_rad, b.head.pan_rad);
  v.head.tilt_rad = mix(a.head.tilt_rad, b.head.tilt_rad);
  for (int i = 0; i < 2; ++i) {
    v.head.vergence_rad[i] = mix(a.head.vergence_rad[i], b.head.vergence_rad[i]);
    v.head.zoom_step[i] = mix(a.head.zoom_step[i], b.head.zoom_step[i]);
    v.head.focus_step[i] = mix(a.head.focus_step[i], b.head.focus_step[i]);
  }
  v.head.lean = {mix(a.head.lean.pitch_rad, b.head.lean.pitch_rad),
                 mix(a.head.lean.roll_rad, b.head.lean.roll_rad)};
  return v;
}

PinholeView FineView(const TrueCamera& camera, const Pose2& map_from_base, const Eigen::Vector2d& sample) {
  PinholeView view;
  view.map_from_camera = Lift(map_from_base) * camera.base_from_camera;
  view.focal_px = Eigen::Vector2d::Constant(FineGrid::kScale * camera.focal_px);
  // The graphics samples in the middle of a cell; shifting the picture makes that the wanted place.
  view.centre_px = FineGrid::FromImage(camera.centre_px) + Eigen::Vector2d::Constant(0.5) - sample;
  return view;
}

}  // namespace

void RendererConfig::Describe(Archive& a) {
  a.Section("scene", scene, "room and light");
  a.Section("imaging", imaging, "lens blur, sensor and noise");
  a.Section("head", head, "how KASTOR was really built");
  DescribeLasers(a, lasers);
}

class Renderer::Impl {
 public:
  Impl() : scene_(FineGrid::kWidth, FineGrid::kHeight) {}

  void SetScene(const RendererConfig& config, const std::vector<Solid>& solids, std::uint64_t seed) {
    Textures textures(seed);
    for (const Solid& s : solids) textures.Find(s.material, s.name);
    config_ = config;
    solids_ = solids;
    reference_.reset();
    textures_ = std::make_unique<Textures>(std::move(textures));
    scene_.SetTextures(textures_->layers());
    Illuminate();
  }

  void MoveSolid(const std::string& name, const Pose2& map_from_solid) {
    for (std::size_t i = 0; i < solids_.size(); ++i)
      if (solids_[i].name == name) return MoveSolids({{i, map_from_solid}});
    throw std::invalid_argument("no solid named \"" + name + "\"");
  }

  void MoveSolids(const std::vector<MovedSolid>& moved) {
    if (moved.empty()) return;
    for (const auto& [solid, pose] : moved) solids_.at(solid).map_from_solid = pose;
    lighting_ = std::make_unique<Lighting>(config_.scene, solids_);
    for (const MovedSolid& m : moved) parts_[m.solid] = Part(solids_[m.solid]);
    Upload();
  }

  void PlaceReference(const std::optional<PlacedReference>& reference) {
    reference_ = reference;
    Upload();
  }

  GreyImage Expose(Camera camera, const Viewpoint& opening, const Viewpoint& closing,
                   const Exposure& exposure, Rng& rng) {
    MoveSolids(closing.moved);
    const Viewpoint middle = Between(opening, closing, 0.5);
    const TrueCamera middle_camera = CameraAt(config_.head, camera, middle.head);
    const Eigen::Isometry3d map_from_camera = Lift(middle.map_from_base) * middle_camera.base_from_camera;
    scene_.SortFrom(map_from_camera.translation());
    Collect(camera, opening, closing, exposure);
    const LensMap& lens = lenses_.Of(middle_camera, config_.imaging.vignetting);
    const double px_per_dioptre = config_.imaging.defocus_px * middle_camera.focal_px / 1000;
    const double focus = middle_camera.focus_dioptre + exposure.defocus_dioptre;
    if (config_.imaging.focus_by_distance && !reference_) {
      const cv::Mat defocus = px_per_dioptre * (focus - Dioptres(map_from_camera, middle_camera));
      return FormImage(config_.imaging, lens, defocus, light_, exposure, rng);
    }
    const double defocus = px_per_dioptre * (focus - SceneDioptre(map_from_camera));
    return FormImage(config_.imaging, lens, defocus, light_, exposure, rng);
  }

  const RendererConfig& config() const { return config_; }

 private:
  Mesh Part(const Solid& solid) const {
    Mesh mesh;
    if (IsGlass(solid.material)) return mesh;
    AppendSolid(solid, textures_->Find(solid.material, solid.name), *lighting_, kMostLight, mesh);
    return mesh;
  }

  void Illuminate() {
    lighting_ = std::make_unique<Lighting>(config_.scene, solids_);
    room_.clear();
    AppendRoom(config_.scene, *textures_, *lighting_, kMostLight, room_);
    parts_.clear();
    for (const Solid& s : solids_) parts_.push_back(Part(s));
    Upload();
  }

  void Upload() {
    mesh_ = room_;
    for (const Mesh& part : parts_) mesh_.insert(mesh_.end(), part.begin(), part.end());
    if (reference_) AppendReference(*reference_, mesh_);
    scene_.SetMesh(mesh_);
  }

  /// The lines lie elsewhere for every pose of the robot.
  void UploadWithLasers(const Pose2& map_from_base, const Eigen::Vector3d& eye) {
    Mesh mesh = mesh_;
    for (const LaserBuild& laser : config_.lasers) AppendLaser(laser, map_from_base, *lighting_, mesh);
    scene_.SetMesh(mesh);
    scene_.SortFrom(eye);
  }

  /// Sums the sub-exposures into light_.
  void Collect(Camera camera, const Viewpoint& opening, const Viewpoint& closing, const Exposure& exposure) {
    const int n = config_.imaging.sub_exposures;
    light_.create(FineGrid::kHeight, FineGrid::kWidth, CV_32F);
    light_.setTo(0);
    for (int k = 0; k < n; ++k) {
      const Viewpoint at = Between(opening, closing, (k + 0.5) / n);
      const TrueCamera lens = CameraAt(config_.head, camera, at.head);
      const PinholeView view = FineView(lens, at.map_from_base, SubSample(k, n));
      if (exposure.laser > 0) UploadWithLasers(at.map_from_base, view.map_from_camera.translation());
      const cv::Mat& picture = scene_.Render(view);
      AddChannel(picture, 2, kMostLight / (255.0 * n));
      if (reference_ && exposure.camera_light > 0)
        AddChannel(picture, 1, exposure.camera_light / (255.0 * n));
      if (exposure.laser > 0) AddChannel(picture, 0, exposure.laser / (255.0 * n));
    }
    if (exposure.laser > 0) scene_.SetMesh(mesh_);
  }

  void AddChannel(const cv::Mat& picture, int channel, double weight) {
    const auto w = static_cast<float>(weight);
    for (int y = 0; y < picture.rows; ++y) {
      const std::uint8_t* from = picture.ptr<std::uint8_t>(y) + channel;
      float* to = light_.ptr<float>(y);
      for (int x = 0; x < picture.cols; ++x) to[x] += w * from[std::ptrdiff_t{3} * x];
    }
  }

  /// Inverse distances over the fine grid, a ray for each 8 pixels of the image. Where something ends, what
  /// is behind it is as sharp as it for some pixels: the edge is the nearer one's.
  cv::Mat Dioptres(const Eigen::Isometry3d& map_from_camera, const TrueCamera& camera) const {
    constexpr int kCell = 8 * FineGrid::kScale;
    cv::Mat dioptres(FineGrid::kHeight / kCell, FineGrid::kWidth / kCell, CV_64F);
    const Eigen::Vector3d eye = map_from_camera.translation();
    const Eigen::Vector2d centre = FineGrid::FromImage(camera.centre_px);
    const double focal = FineGrid::kScale * camera.focal_px;
    for (int y = 0; y < dioptres.rows; ++y) {
      for (int x = 0; x < dioptres.cols; ++x) {
        const Eigen::Vector2d at = (Eigen::Vector2d(x + 0.5, y + 0.5) * kCell - centre) / focal;
        const Eigen::Vector3d ray = map_from_camera.linear() * at.homogeneous().normalized();
        dioptres.at<double>(y, x) = 1 / std::max(lighting_->Distance(eye, ray, kFarthest_m), 0.1);
      }
    }
    cv::dilate(dioptres, dioptres, cv::Mat::ones(5, 5, CV_8U));
    return dioptres;
  }

  /// Inverse distance of what is in view: the lens has one blur for the whole picture.
  double SceneDioptre(const Eigen::Isometry3d& map_from_camera) const {
    const Eigen::Vector3d eye = map_from_camera.translation();
    if (reference_) {
      const double distance = (reference_->map_from_object.translation() - eye).norm();
      if (distance < kReferenceReach_m) return 1 / std::max(distance, 0.1);
    }
    std::vector<double> dioptres;
    for (double x = -0.3; x < 0.31; x += 0.1) {
      for (double y = -0.2; y < 0.21; y += 0.1) {
        const Eigen::Vector3d ray = map_from_camera.linear() * Eigen::Vector3d(x, y, 1).normalized();
        dioptres.push_back(1 / std::max(lighting_->Distance(eye, ray, kFarthest_m), 0.1));
      }
    }
    std::nth_element(dioptres.begin(), dioptres.begin() + dioptres.size() / 2, dioptres.end());
    return dioptres[dioptres.size() / 2];
  }

  OffscreenScene scene_;
  RendererConfig config_;
  std::vector<Solid> solids_;
  std::optional<PlacedReference> reference_;
  std::unique_ptr<Textures> textures_;
  std::unique_ptr<Lighting> lighting_;
  Mesh room_;
  std::vector<Mesh> parts_;  ///< meshes of solids_
  Mesh mesh_;                ///< room, parts and reference object together
  LensMaps lenses_;
  cv::Mat light_;  ///< sum of the sub-exposures on the fine grid
};

Renderer::Renderer(const RendererConfig& config, const std::vector<Solid>& solids, std::uint64_t seed)
    : impl_(std::make_unique<Impl>()) {
  impl_->SetScene(config, solids, seed);
}

Renderer::~Renderer() = default;

void Renderer::SetScene(const RendererConfig& config, const std::vector<Solid>& solids, std::uint64_t seed) {
  impl_->SetScene(config, solids, seed);
}

void Renderer::MoveSolid(const std::string& name, const Pose2& map_from_solid) {
  impl_->MoveSolid(name, map_from_solid);
}

void Renderer::PlaceReference(const std::optional<PlacedReference>& reference) {
  impl_->PlaceReference(reference);
}

GreyImage Renderer::Expose(Camera camera, const Viewpoint& opening, const Viewpoint& closing,
                           const Exposure& exposure, Rng& rng) {
  return impl_->Expose(camera, opening, closing, exposure, rng);
}

const RendererConfig& Renderer::config() const {
  return impl_->config();
}

std::shared_ptr<void> Renderer::HoldGraphics() {
  return world::HoldGraphics(FineGrid::kWidth, FineGrid::kHeight);
}

}  // namespace priamos::world
