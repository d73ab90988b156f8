#include "head/core/calibration/discs/bright_regions.hpp"

#include <algorithm>
#include <cstdint>

namespace priamos::head {

namespace {

constexpr int kRowStep = 2;

struct Run {
  int u_begin, u_end;  ///< [begin, end)
  int region;
};

/// Cuts one row into bright runs: a run begins where the row rises by `contrast` above its recent minimum
/// and ends where it falls by as much below its recent maximum. Minimum and maximum drift by one level a
/// pixel, so that shading is followed.
void FindRuns(const std::uint8_t* row, int width, int contrast, std::vector<Run>& runs) {
  runs.clear();
  int u = 0, low = 255;
  while (u < width) {
    for (; u < width; ++u) {
      low = std::min<int>(row[u], low + 1);
      if (row[u] > low + contrast) break;
    }
    const int begin = u;
    // A run that barely stood out has also ended when it is back near where it rose from.
    const int floor = low + contrast / 2;
    int high = 0;
    for (; u < width; ++u) {
      high = std::max<int>(row[u], high - 1);
      if (row[u] < high - contrast || row[u] < floor) break;
    }
    if (begin < width) runs.push_back({begin, u, -1});
    low = 255;
  }
}

/// Regions under construction; `parent` joins those that turned out to be one.
class Regions {
 public:
  int Root(int i) {
    while (parent_[i] != i) i = parent_[i] = parent_[parent_[i]];
    return i;
  }
  int Start() {
    parent_.push_back(static_cast<int>(parent_.size()));
    regions_.push_back({1 << 30, -1, 1 << 30, -1, 0});
    return parent_.back();
  }
  void Join(int a, int b) {
    a = Root(a);
    b = Root(b);
    if (a == b) return;
    const BrightRegion& other = regions_[b];
    Extend(a, other.u_min, other.u_max, other.v_min, other.v_max, other.pixels);
    parent_[b] = a;
  }
  void Add(int i, const Run& run, int v) {
    Extend(Root(i), run.u_begin, run.u_end - 1, v, v, run.u_end - run.u_begin);
  }
  std::vector<BrightRegion> Finish() {
    std::vector<BrightRegion> roots;
    for (std::size_t i = 0; i < parent_.size(); ++i) {
      if (parent_[i] == static_cast<int>(i)) roots.push_back(regions_[i]);
    }
    return roots;
  }

 private:
  void Extend(int i, int u_min, int u_max, int v_min, int v_max, int pixels) {
    BrightRegion& r = regions_[i];
    r.u_min = std::min(r.u_min, u_min);
    r.u_max = std::max(r.u_max, u_max);
    r.v_min = std::min(r.v_min, v_min);
    r.v_max = std::max(r.v_max, v_max);
    r.pixels += pixels;
  }

  std::vector<int> parent_;
  std::vector<BrightRegion> regions_;
};

/// Gives every run of `now` the region of the runs of `before` that it touches.
void Connect(const std::vector<Run>& before, std::vector<Run>& now, int v, Regions& regions) {
  std::size_t first = 0;
  for (Run& run : now) {
    while (first < before.size() && before[first].u_end <= run.u_begin) ++first;
    for (std::size_t j = first; j < before.size() && before[j].u_begin < run.u_end; ++j) {
      if (run.region < 0) run.region = before[j].region;
      regions.Join(run.region, before[j].region);
    }
    if (run.region < 0) run.region = regions.Start();
    regions.Add(run.region, run, v);
  }
}

}  // namespace

std::vector<BrightRegion> FindBrightRegions(const GreyImage& image, int min_contrast) {
  Regions regions;
  std::vector<Run> before, now;
  for (int v = 0; v < image.height; v += kRowStep) {
    FindRuns(image.pixels.data() + static_cast<std::size_t>(v) * image.width, image.width, min_contrast, now);
    Connect(before, now, v, regions);
    before.swap(now);
  }
  return regions.Finish();
}

}  // namespace priamos::head
