#include "test/bench/vision/bodies/body_scenes.hpp"

#include <fmt/format.h>

#include <array>
#include <cmath>
#include <opencv2/imgproc.hpp>
#include <vector>

#include "common/geometry.hpp"
#include "test/support/quad_scene.hpp"

namespace priamos::bench {
namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;
using test::Quad;

constexpr int kWidth = 768, kHeight = 576;

/// A polygon in (x, z), counter-clockwise seen along y, and the parallelograms and triangles it is made of
/// (corner, u, v); extruded along y it is a body.
struct Profile {
  struct Part {
    Vector2d corner, u, v;
    bool is_triangle = false;
  };
  std::string kind;
  std::vector<Vector2d> outline;
  std::vector<Part> parts;
};

Profile::Part Rectangle(double x, double z, double w, double h) {
  return {{x, z}, {w, 0}, {0, h}};
}

Profile RandomProfile(Rng& rng) {
  const double a = rng.Uniform(0.5, 1.2), c = rng.Uniform(0.4, 1.1);
  const double b = a * rng.Uniform(0.3, 0.65), h = c * rng.Uniform(0.3, 0.7);
  switch (rng.Below(6)) {
    case 0:
      return {"box", {{0, 0}, {a, 0}, {a, c}, {0, c}}, {Rectangle(0, 0, a, c)}};
    case 1:
      return {"angle",
              {{0, 0}, {a, 0}, {a, h}, {b, h}, {b, c}, {0, c}},
              {Rectangle(0, 0, a, h), Rectangle(0, h, b, c - h)}};
    case 2: {
      const double b2 = b * 0.5, h2 = h + (c - h) * 0.5;
      return {"stair",
              {{0, 0}, {a, 0}, {a, h}, {b, h}, {b, h2}, {b2, h2}, {b2, c}, {0, c}},
              {Rectangle(0, 0, a, h), Rectangle(0, h, b, h2 - h), Rectangle(0, h2, b2, c - h2)}};
    }
    case 3:
      return {"house",
              {{0, 0}, {a, 0}, {a, h}, {a / 2, c}, {0, h}},
              {Rectangle(0, 0, a, h),
               {{0, h}, {a / 2, 0}, {a / 2, c - h}, true},
               {{a / 2, h}, {a / 2, 0}, {0, c - h}, true}}};
    case 4: {
      const double wall = 0.25 * a;
      return {"channel",
              {{0, 0}, {a, 0}, {a, c}, {a - wall, c}, {a - wall, h}, {wall, h}, {wall, c}, {0, c}},
              {Rectangle(0, 0, a, h), Rectangle(0, h, wall, c - h), Rectangle(a - wall, h, wall, c - h)}};
    }
    default:
      return {"wedge",
              {{0, 0}, {a, 0}, {a, h * 0.5}, {0, c}},
              {Rectangle(0, 0, a, h * 0.5), {{0, h * 0.5}, {a, 0}, {0, c - h * 0.5}, true}}};
  }
}

/// A profile with its length along y; its frame's origin is the middle of its bottom.
struct Body {
  Profile profile;
  double length = 1;

  Vector3d At(const Vector2d& p, double y) const {
    return {p.x() - profile.outline[1].x() / 2, y - length / 2, p.y()};
  }
};

Body RandomBody(double size_m, Rng& rng) {
  Body body{RandomProfile(rng), size_m * rng.Uniform(0.4, 1.3)};
  for (Vector2d& p : body.profile.outline) p *= size_m;
  for (auto& part : body.profile.parts)
    part = {part.corner * size_m, part.u * size_m, part.v * size_m, part.is_triangle};
  return body;
}

/// The same kind in other proportions: each of its three sides by 10 to 30 % longer or shorter, not all
/// alike.
Body OtherProportions(Body body, Rng& rng) {
  const double x = rng.Uniform(1.1, 1.3), z = 1 / rng.Uniform(1.1, 1.3);
  const Eigen::DiagonalMatrix<double, 2> scale(x, z);
  for (Vector2d& p : body.profile.outline) p = scale * p;
  for (auto& part : body.profile.parts)
    part = {scale * part.corner, scale * part.u, scale * part.v, part.is_triangle};
  if (rng.Chance(0.5)) body.length *= 1.2;
  return body;
}

head::Polyhedron ModelOf(const Body& body) {
  head::Polyhedron model;
  const int n = static_cast<int>(body.profile.outline.size());
  for (const double y : {0.0, body.length})
    for (const Vector2d& p : body.profile.outline) model.points.push_back(body.At(p, y));
  std::vector<int> front, back;
  for (int i = 0; i < n; ++i) {
    front.push_back(i);
    back.push_back(n + (n - 1 - i));
    const int j = (i + 1) % n;
    model.faces.push_back({i, n + i, n + j, j});
  }
  model.faces.push_back(front);
  model.faces.push_back(back);
  return model;
}

/// Labels on a face: flat, of other grey values, a hair before it.
void AddLabels(const Quad& face, double grey, int n, Rng& rng, std::vector<Quad>& quads) {
  const Vector3d lift = 2e-4 * face.u.cross(face.v).normalized();
  for (int i = 0; i < n; ++i) {
    const double w = rng.Uniform(0.1, 0.5), h = rng.Uniform(0.1, 0.5);
    const double x = rng.Uniform(0.05, 0.95 - w), y = rng.Uniform(0.05, 0.95 - h);
    for (const double side : {-1.0, 1.0})
      quads.push_back({face.corner + x * face.u + y * face.v + side * lift, w * face.u, h * face.v,
                       std::clamp(grey + rng.Uniform(-90, 90), 5.0, 250.0)});
  }
}

void AddBody(const Body& body, const Eigen::Isometry3d& at, bool labelled, Rng& rng,
             std::vector<Quad>& quads) {
  const auto& outline = body.profile.outline;
  std::vector<Quad> faces;
  for (const double y : {0.0, body.length}) {
    const double grey = rng.Uniform(40, 230);
    for (const auto& part : body.profile.parts) {
      const Vector3d corner = body.At(part.corner, y);
      faces.push_back({corner, body.At(part.corner + part.u, y) - corner,
                       body.At(part.corner + part.v, y) - corner, grey, part.is_triangle});
    }
  }
  for (std::size_t i = 0; i < outline.size(); ++i) {
    const Vector2d p = outline[i], q = outline[(i + 1) % outline.size()];
    const Vector3d corner = body.At(p, 0);
    faces.push_back({corner, body.At(q, 0) - corner, {0, body.length, 0}, rng.Uniform(40, 230)});
  }
  const int n_labels = labelled ? static_cast<int>(rng.Below(4)) : 0;
  const std::vector<Quad> bare = faces;
  for (const Quad& face : bare)
    if (!face.is_triangle) AddLabels(face, face.grey, n_labels, rng, faces);
  for (const Quad& q : faces)
    quads.push_back({at * q.corner, at.linear() * q.u, at.linear() * q.v, q.grey, q.is_triangle});
}

/// A floor with papers and other bodies, none of them on the body in the middle of radius `clear_m`.
void AddSurroundings(double clear_m, Rng& rng, std::vector<Quad>& quads) {
  const double reach = 20 * clear_m, floor_grey = rng.Uniform(40, 220);
  quads.push_back({{-reach, -reach, -1e-3}, {2 * reach, 0, 0}, {0, 2 * reach, 0}, floor_grey});
  const int papers = 3 + static_cast<int>(rng.Below(12));
  for (int i = 0; i < papers; ++i) {
    const double angle = rng.Uniform(0, 2 * kPi), d = clear_m * rng.Uniform(0.2, 3);
    const double turn = rng.Uniform(0, kPi), w = clear_m * rng.Uniform(0.2, 2),
                 h = clear_m * rng.Uniform(0.1, 1.5);
    quads.push_back({{d * std::cos(angle), d * std::sin(angle), -9e-4 + 3e-5 * i},
                     {w * std::cos(turn), w * std::sin(turn), 0},
                     {-h * std::sin(turn), h * std::cos(turn), 0},
                     rng.Uniform(20, 240)});
  }
  const int others = static_cast<int>(rng.Below(4));
  for (int i = 0; i < others; ++i) {
    const double angle = rng.Uniform(0, 2 * kPi), d = clear_m * rng.Uniform(2.2, 3.5);
    Eigen::Isometry3d at = Eigen::Isometry3d::Identity();
    at.translation() << d * std::cos(angle), d * std::sin(angle), 0;
    at.rotate(Eigen::AngleAxisd(rng.Uniform(0, 2 * kPi), Vector3d::UnitZ()));
    AddBody(RandomBody(clear_m, rng), at, true, rng, quads);
  }
}

/// Looks at the middle of the body from above, the image's horizon nearly level.
Eigen::Isometry3d RandomLook(double distance_m, double height_m, Rng& rng) {
  const double azimuth = rng.Uniform(0, 2 * kPi), elevation = Radians(rng.Uniform(8, 60));
  const Vector3d towards(std::cos(elevation) * std::cos(azimuth), std::cos(elevation) * std::sin(azimuth),
                         std::sin(elevation));
  const Vector3d target =
      Vector3d(rng.Normal(0.04), rng.Normal(0.04), 0) * distance_m + Vector3d(0, 0, height_m / 2);
  const Vector3d eye = target + distance_m * towards, forward = -towards;
  const Vector3d right = forward.cross(Vector3d::UnitZ()).normalized();
  Eigen::Isometry3d model_from_camera = Eigen::Isometry3d::Identity();
  model_from_camera.linear() << right, forward.cross(right), forward;
  model_from_camera.translation() = eye;
  model_from_camera.rotate(Eigen::AngleAxisd(rng.Normal(Radians(6)), Vector3d::UnitZ()));
  return model_from_camera.inverse();
}

head::CameraModel RandomCamera(double focal_px, Rng& rng) {
  head::CameraModel camera;
  const Vector2d centre(kWidth / 2.0 + rng.Normal(8), kHeight / 2.0 + rng.Normal(8));
  camera.image_from_base << focal_px, 0, centre.x(), 0, 0, focal_px, centre.y(), 0, 0, 0, 1, 0;
  camera.centre_px = centre;
  camera.scale_px = focal_px;
  camera.k1 = rng.Uniform(-0.2, 0.08);
  return camera;
}

void Photograph(const BodySceneOptions& options, Rng& rng, cv::Mat& image) {
  cv::Mat grey;
  image.convertTo(grey, CV_32F);
  if (options.blur_px > 0) cv::GaussianBlur(grey, grey, {0, 0}, options.blur_px);
  const double noise = rng.Uniform(0.7, 3);
  for (int y = 0; y < grey.rows; ++y)
    for (int x = 0; x < grey.cols; ++x)
      image.at<unsigned char>(y, x) =
          cv::saturate_cast<unsigned char>(grey.at<float>(y, x) + static_cast<float>(rng.Normal(noise)));
}

}  // namespace

BodyScene DrawBody(const BodySceneOptions& options, std::uint64_t seed) {
  Rng rng = Rng::Stream(seed, "body");
  const double focal_px = rng.Uniform(550, 1300), distance_m = rng.Uniform(0.5, 3);
  const double extent_px = rng.Uniform(140, 330);  // of the longest side, about
  const Body body = RandomBody(extent_px / focal_px * distance_m, rng);
  BodyScene scene;
  scene.kind = fmt::format("{} {}", body.profile.kind, seed);
  scene.model = ModelOf(body);
  scene.camera = RandomCamera(focal_px, rng);
  double clear_m = 0, height_m = 0;
  for (const Vector3d& p : scene.model.points) {
    clear_m = std::max(clear_m, p.head<2>().norm());
    height_m = std::max(height_m, p.z());
  }
  scene.truth = RandomLook(distance_m, height_m, rng);
  Rng texture = Rng::Stream(seed, "texture");
  std::vector<Quad> quads;
  AddSurroundings(clear_m, texture, quads);
  const Body shown = options.is_another ? OtherProportions(body, texture) : body;
  if (!options.is_absent) AddBody(shown, Eigen::Isometry3d::Identity(), true, texture, quads);
  scene.image = test::RenderQuads(quads, scene.truth, scene.camera, 0, rng, rng.Uniform(20, 200));
  Photograph(options, rng, scene.image);
  for (Vector3d& p : scene.model.points)
    p += Vector3d(rng.Normal(options.model_error_m), rng.Normal(options.model_error_m),
                  rng.Normal(options.model_error_m));
  return scene;
}

Eigen::Isometry3d Beside(const Eigen::Isometry3d& pose, double shift_m, double turn_rad, Rng& rng) {
  const auto direction = [&]() -> Vector3d {
    return Vector3d(rng.Normal(1), rng.Normal(1), rng.Normal(1)).normalized();
  };
  Eigen::Isometry3d beside = pose;
  beside.pretranslate(Vector3d(shift_m * direction()));
  beside.rotate(Eigen::AngleAxisd(turn_rad, direction()));
  return beside;
}

}  // namespace priamos::bench
