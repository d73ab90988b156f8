#include "world/core/reference_object.hpp"

namespace priamos::world {

namespace {

void Vector(Archive& a, std::string_view key, Eigen::Vector3d& value, const ValueSpec& spec) {
  std::vector<double> numbers(value.data(), value.data() + 3);
  a.Numbers(key, numbers, spec);
  value = Eigen::Vector3d(numbers[0], numbers[1], numbers[2]);
}

}  // namespace

void ReferenceDisc::Describe(Archive& a) {
  Vector(a, "centre_m", centre_m, {"m", -10, 10, "centre in the object's frame"});
  Vector(a, "normal", normal, {"-", -1, 1, "direction out of the visible side, of any length"});
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
  a.List("block", blocks, "black solids that carry the discs");
}

}  // namespace priamos::world
