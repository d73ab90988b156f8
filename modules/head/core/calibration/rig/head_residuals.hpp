#pragma once

#include <Eigen/Core>
#include <array>
#include <cmath>

#include "head/core/camera/head_model.hpp"

// What SolveHead minimises, as Ceres differentiates it.

namespace priamos::head {

inline constexpr int kHead = 8;    ///< x y z roll pitch yaw, tilt axis x and roll
inline constexpr int kMount = 9;   ///< in the order of CameraMount
inline constexpr int kLens = 6;    ///< log focal, centre u v, k1, k2, pupil
inline constexpr int kJitter = 4;  ///< errors of pan, tilt, left and right vergence

template <class T>
using Point = Eigen::Matrix<T, 3, 1>;

template <class T>
Point<T> UnturnX(const T& angle, const Point<T>& p) {
  const T c = cos(angle), s = sin(angle);
  return {p.x(), c * p.y() + s * p.z(), c * p.z() - s * p.y()};
}
template <class T>
Point<T> UnturnY(const T& angle, const Point<T>& p) {
  const T c = cos(angle), s = sin(angle);
  return {c * p.x() - s * p.z(), p.y(), c * p.z() + s * p.x()};
}
template <class T>
Point<T> UnturnZ(const T& angle, const Point<T>& p) {
  const T c = cos(angle), s = sin(angle);
  return {c * p.x() + s * p.y(), c * p.y() - s * p.x(), p.z()};
}
template <class T>
Point<T> Unturn(const T* roll_pitch_yaw, const Point<T>& p) {
  return UnturnX(roll_pitch_yaw[0], UnturnY(roll_pitch_yaw[1], UnturnZ(roll_pitch_yaw[2], p)));
}

/// The chain of HeadGeometry::BaseFromCamera backwards, then the lens.
struct HeadReprojection {
  HeadSetting setting;
  int camera;
  Eigen::Vector3d point_m;
  Eigen::Vector2d image_px;
  double sigma_px;

  template <class T>
  bool operator()(const T* head, const T* mount, const T* lens, const T* jitter, T* residual) const {
    Point<T> p = point_m.cast<T>() - Point<T>(head[0], head[1], head[2]);
    p = UnturnZ(T(setting.pan_rad) + jitter[0], Unturn(head + 3, p));
    p.x() -= head[6];
    p = UnturnY(T(setting.tilt_rad) + jitter[1], UnturnX(head[7], p));
    p -= Point<T>(mount[0], mount[1], mount[2]);
    p = UnturnX(mount[3], UnturnY(mount[4], p));
    if (camera != kThird) p = UnturnZ(T(setting.vergence_rad[camera]) + jitter[2 + camera], p);
    p.y() -= mount[5];
    p = Unturn(mount + 6, p);
    p.x() -= lens[5];
    if (p.x() < T(1e-3)) return false;
    const T x = -p.y() / p.x(), y = -p.z() / p.x(), r2 = x * x + y * y;
    const T scale = exp(lens[0]) * (T(1) + r2 * (lens[3] + r2 * lens[4]));
    residual[0] = (lens[1] + scale * x - T(image_px.x())) / T(sigma_px);
    residual[1] = (lens[2] + scale * y - T(image_px.y())) / T(sigma_px);
    return true;
  }
};

/// Keeps a parameter block near a mean.
template <int N>
struct Near {
  std::array<double, N> mean, sigma;

  template <class T>
  bool operator()(const T* x, T* residual) const {
    for (int i = 0; i < N; ++i) residual[i] = (x[i] - T(mean[i])) / T(sigma[i]);
    return true;
  }
};

/// Lenses change smoothly from node to node.
struct Smooth {
  template <class T>
  bool operator()(const T* before, const T* here, const T* after, T* residual) const {
    for (int i = 0; i < kLens - 1; ++i)
      residual[i] = (after[i + 1] - T(2) * here[i + 1] + before[i + 1]) / T(kBend[i]);
    return true;
  }
  /// How much centre u v, k1, k2 and pupil bend between three neighbours: 1 sigma. The focal length is free.
  static constexpr double kBend[kLens - 1] = {1, 1, 0.003, 0.003, 0.0005};
};

}  // namespace priamos::head
