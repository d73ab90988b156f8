#include "common/reference_object.hpp"

#include "common/vector_key.hpp"

namespace priamos {

namespace {

constexpr std::size_t kFewestDiscs = 6;  // of the DLT
constexpr double kSmallestGap_m = 1e-4;

bool AnyCoincide(const std::vector<ReferenceDisc>& discs) {
  for (std::size_t i = 0; i < discs.size(); ++i) {
    for (std::size_t j = 0; j < i; ++j) {
      if ((discs[i].centre_m - discs[j].centre_m).norm() < kSmallestGap_m) return true;
    }
  }
  return false;
}

}  // namespace

void ReferenceDisc::Describe(Archive& a) {
  Vector(a, "centre_m", centre_m, {"m", -10, 10, "centre in the object's frame"});
  Vector(a, "normal", normal, {"-", -1e3, 1e3, "direction out of the visible side, of any length"});
  if (normal.norm() < 1e-6) {
    a.Refuse("normal", "a direction that is not zero");
    return;
  }
  normal.normalize();
  a.Number("radius_m", radius_m, {"m", 0.001, 1, "radius"});
}

void ReferenceBlock::Describe(Archive& a) {
  Vector(a, "centre_m", centre_m, {"m", -10, 10, "centre in the object's frame"});
  Vector(a, "size_m", size_m, {"m", 0.001, 10, "full length along x, y and z"});
}

void ReferenceObject::Describe(Archive& a) {
  a.Text("name", name, "what it is, for messages");
  a.List("disc", discs, "the retro-reflective discs");
  if (discs.size() < kFewestDiscs) a.Refuse("disc", "at least 6 discs");
  if (AnyCoincide(discs)) a.Refuse("disc", "discs in different places");
  a.List("block", blocks, "black solids that carry the discs");
}

ReferenceObject ReferenceObject::Moved(const Eigen::Isometry3d& a_from_object) const {
  ReferenceObject moved{name, discs, {}};
  for (ReferenceDisc& disc : moved.discs) {
    disc.centre_m = a_from_object * disc.centre_m;
    disc.normal = a_from_object.linear() * disc.normal;
  }
  return moved;
}

}  // namespace priamos
