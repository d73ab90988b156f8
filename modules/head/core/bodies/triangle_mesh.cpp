#include "head/core/bodies/triangle_mesh.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <map>
#include <utility>

namespace priamos::head {
namespace {

using Triangle = std::array<int, 3>;

/// Triangles that hang together, and whether each of their edges is shared by two of them.
struct Component {
  std::vector<std::size_t> triangles;
  std::vector<bool> is_turned;  ///< against the file, by triangle of the component
  bool is_closed = true;
};

class Orientation {
 public:
  explicit Orientation(TriangleMesh& mesh) : mesh_(mesh), is_known_(mesh.triangles.size(), false) {
    for (std::size_t t = 0; t < mesh.triangles.size(); ++t)
      for (int i = 0; i < 3; ++i) neighbours_[EdgeOf(mesh.triangles[t], i)].push_back(t);
  }

  void Run() {
    for (std::size_t first = 0; first < is_known_.size(); ++first)
      if (!is_known_[first]) Settle(Collect(first));
  }

 private:
  using Edge = std::pair<int, int>;

  static Edge EdgeOf(const Triangle& t, int i) { return std::minmax(t[i], t[(i + 1) % 3]); }
  static bool Runs(const Triangle& t, int from, int to) {
    for (int i = 0; i < 3; ++i)
      if (t[i] == from && t[(i + 1) % 3] == to) return true;
    return false;
  }
  void Turn(std::size_t t) { std::swap(mesh_.triangles[t][1], mesh_.triangles[t][2]); }

  /// All triangles that can be reached over edges of two, turned as the first one is.
  Component Collect(std::size_t first) {
    Component component{{first}, {false}, true};
    is_known_[first] = true;
    for (std::size_t k = 0; k < component.triangles.size(); ++k) {
      for (int i = 0; i < 3; ++i) {
        const Triangle t = mesh_.triangles[component.triangles[k]];
        const auto& sharing = neighbours_[EdgeOf(t, i)];
        component.is_closed &= sharing.size() == 2;
        if (sharing.size() != 2) continue;
        const std::size_t other = sharing[0] == component.triangles[k] ? sharing[1] : sharing[0];
        if (is_known_[other]) continue;
        is_known_[other] = true;
        component.triangles.push_back(other);
        const bool disagrees = Runs(mesh_.triangles[other], t[i], t[(i + 1) % 3]);
        if (disagrees) Turn(other);
        component.is_turned.push_back(disagrees);
      }
    }
    return component;
  }

  void Settle(const Component& component) {
    double volume = 0, turned = 0, kept = 0;
    const Eigen::Vector3d origin = mesh_.points[mesh_.triangles[component.triangles[0]][0]];
    for (std::size_t k = 0; k < component.triangles.size(); ++k) {
      const Triangle& t = mesh_.triangles[component.triangles[k]];
      const Eigen::Vector3d a = mesh_.points[t[0]] - origin, b = mesh_.points[t[1]] - origin,
                            c = mesh_.points[t[2]] - origin;
      volume += a.dot(b.cross(c));
      (component.is_turned[k] ? turned : kept) += (b - a).cross(c - a).norm();
    }
    if (component.is_closed ? volume < 0 : turned > kept)
      for (const std::size_t t : component.triangles) Turn(t);
  }

  TriangleMesh& mesh_;
  std::vector<bool> is_known_;
  std::map<Edge, std::vector<std::size_t>> neighbours_;
};

}  // namespace

void OrientTriangles(TriangleMesh& mesh) {
  Orientation(mesh).Run();
}

}  // namespace priamos::head
