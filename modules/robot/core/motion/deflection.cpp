#include "robot/core/motion/deflection.hpp"

#include <algorithm>

namespace priamos::robot {
namespace {

/// Parts of the components of a wish, each 0 to 1: vx, vy, wz.
using Parts = Eigen::Vector3d;

/// Steps of the parts in the search: first all combinations in coarse steps, in denser ones where next to
/// nothing was found, for coarse ones miss a narrow passage; then ever smaller steps from the best.
constexpr double kCoarse = 1.0 / 4, kDense = 1.0 / 8, kLeast = 1.0 / 32;
constexpr double kNextToNothing = 0.1;

class Search {
 public:
  Search(const Twist2& wish, double reach_m, const JudgeMotion& judge)
      : wish_(wish), speeds_(wish.vx, wish.vy, wish.wz * reach_m), judge_(judge) {
    Try(Parts::Ones());
  }

  bool finished() const { return scale_ >= 1 && best_ == Parts::Ones(); }
  Twist2 found() const { return Motion(best_ * scale_); }
  bool FoundNextToNothing() const { return gained_ < kNextToNothing * speeds_.squaredNorm(); }
  void Everywhere(double step);
  void AroundBest(double step);

 private:
  Twist2 Motion(const Parts& parts) const {
    return {parts.x() * wish_.vx, parts.y() * wish_.vy, parts.z() * wish_.wz};
  }
  bool Wished(int i) const { return speeds_(i) != 0; }
  void Try(const Parts& parts);

  Twist2 wish_;
  Eigen::Vector3d speeds_;
  const JudgeMotion& judge_;
  Parts best_ = Parts::Zero();
  double scale_ = 0;   ///< scale of the best motion
  double gained_ = 0;  ///< the best motion's part along the wish [m/s times the size of the wish]
};

/// The judge is asked only about what would be better than the best so far.
void Search::Try(const Parts& parts) {
  const double most = parts.dot(speeds_.cwiseAbs2());
  if (most <= gained_) return;
  const double scale = std::clamp(judge_(Motion(parts)), 0.0, 1.0);
  if (scale * most <= gained_) return;
  best_ = parts;
  scale_ = scale;
  gained_ = scale * most;
}

void Search::Everywhere(double step) {
  for (double x = 1; x >= 0; x -= step)
    for (double y = 1; y >= 0; y -= step)
      for (double z = 1; z >= 0; z -= step) {
        if ((!Wished(0) && x < 1) || (!Wished(1) && y < 1) || (!Wished(2) && z < 1)) continue;
        // The rest are slower versions of one of these directions, and the judge scales by itself.
        if (std::max({x * Wished(0), y * Wished(1), z * Wished(2)}) == 1) Try({x, y, z});
      }
}

void Search::AroundBest(double step) {
  const Parts from = best_;
  for (int i = 0; i < 3; ++i)
    for (const double change : {-step, step}) {
      Parts parts = from;
      parts(i) = std::clamp(parts(i) + change, 0.0, 1.0);
      if (Wished(i)) Try(parts);
    }
}

}  // namespace

Twist2 Deflected(const Twist2& wish, double reach_m, const JudgeMotion& judge) {
  Search search(wish, reach_m, judge);
  if (search.finished()) return wish;
  search.Everywhere(kCoarse);
  if (search.FoundNextToNothing()) search.Everywhere(kDense);
  for (double step = kDense; step >= kLeast; step /= 2) search.AroundBest(step);
  return search.found();
}

}  // namespace priamos::robot
