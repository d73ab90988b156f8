#include "console/foxglove/scene_schemas.hpp"

#include <initializer_list>
#include <nlohmann/json.hpp>
#include <utility>

namespace priamos::console {
namespace {

using Json = nlohmann::ordered_json;
using Properties = std::initializer_list<std::pair<const char*, Json>>;

Json Object(const char* title, Properties properties) {
  Json object = {{"title", title}, {"type", "object"}, {"properties", Json::object()}};
  for (const auto& [name, schema] : properties) object["properties"][name] = schema;
  return object;
}
Json ListOf(Json items) {
  return {{"type", "array"}, {"items", std::move(items)}};
}
Json Number() {
  return {{"type", "number"}};
}
Json Integer() {
  return {{"type", "integer"}};
}
Json Text() {
  return {{"type", "string"}};
}
Json Flag() {
  return {{"type", "boolean"}};
}

Json TimeOf(const char* title) {
  return Object(title, {{"sec", Integer()}, {"nsec", Integer()}});
}
Json Vector() {
  return Object("foxglove.Vector3", {{"x", Number()}, {"y", Number()}, {"z", Number()}});
}
Json Quaternion() {
  return Object("foxglove.Quaternion", {{"x", Number()}, {"y", Number()}, {"z", Number()}, {"w", Number()}});
}
Json Pose() {
  return Object("foxglove.Pose", {{"position", Vector()}, {"orientation", Quaternion()}});
}
Json Colour() {
  return Object("foxglove.Color", {{"r", Number()}, {"g", Number()}, {"b", Number()}, {"a", Number()}});
}

Json Lines() {
  return Object("foxglove.LinePrimitive", {{"type", Integer()},
                                           {"pose", Pose()},
                                           {"thickness", Number()},
                                           {"scale_invariant", Flag()},
                                           {"points", ListOf(Vector())},
                                           {"color", Colour()},
                                           {"colors", ListOf(Colour())},
                                           {"indices", ListOf(Integer())}});
}
Json Cubes() {
  return Object("foxglove.CubePrimitive", {{"pose", Pose()}, {"size", Vector()}, {"color", Colour()}});
}
Json Texts() {
  return Object("foxglove.TextPrimitive", {{"pose", Pose()},
                                           {"billboard", Flag()},
                                           {"font_size", Number()},
                                           {"scale_invariant", Flag()},
                                           {"color", Colour()},
                                           {"text", Text()}});
}

Json Entity() {
  const Json unused = ListOf({{"type", "object"}});
  return Object("foxglove.SceneEntity",
                {{"timestamp", TimeOf("time")},
                 {"frame_id", Text()},
                 {"id", Text()},
                 {"lifetime", TimeOf("duration")},
                 {"frame_locked", Flag()},
                 {"metadata", ListOf(Object("foxglove.KeyValuePair", {{"key", Text()}, {"value", Text()}}))},
                 {"arrows", unused},
                 {"cubes", ListOf(Cubes())},
                 {"spheres", unused},
                 {"cylinders", unused},
                 {"lines", ListOf(Lines())},
                 {"triangles", unused},
                 {"texts", ListOf(Texts())},
                 {"models", unused}});
}

Json Update() {
  const Json deletion = Object("foxglove.SceneEntityDeletion",
                               {{"timestamp", TimeOf("time")}, {"type", Integer()}, {"id", Text()}});
  return Object("foxglove.SceneUpdate", {{"deletions", ListOf(deletion)}, {"entities", ListOf(Entity())}});
}

Json Transform() {
  return Object("foxglove.FrameTransform", {{"timestamp", TimeOf("time")},
                                            {"parent_frame_id", Text()},
                                            {"child_frame_id", Text()},
                                            {"translation", Vector()},
                                            {"rotation", Quaternion()}});
}

Json Cloud() {
  const Json field =
      Object("foxglove.PackedElementField", {{"name", Text()}, {"offset", Integer()}, {"type", Integer()}});
  return Object("foxglove.PointCloud", {{"timestamp", TimeOf("time")},
                                        {"frame_id", Text()},
                                        {"pose", Pose()},
                                        {"point_stride", Integer()},
                                        {"fields", ListOf(field)},
                                        {"data", {{"type", "string"}, {"contentEncoding", "base64"}}}});
}

Json Picture() {
  return Object("foxglove.CompressedImage", {{"timestamp", TimeOf("time")},
                                             {"frame_id", Text()},
                                             {"data", {{"type", "string"}, {"contentEncoding", "base64"}}},
                                             {"format", Text()}});
}

Json Annotations() {
  const Json point = Object("foxglove.Point2", {{"x", Number()}, {"y", Number()}});
  const Json points = Object("foxglove.PointsAnnotation", {{"timestamp", TimeOf("time")},
                                                           {"type", Integer()},
                                                           {"points", ListOf(point)},
                                                           {"outline_color", Colour()},
                                                           {"outline_colors", ListOf(Colour())},
                                                           {"fill_color", Colour()},
                                                           {"thickness", Number()}});
  const Json unused = ListOf({{"type", "object"}});
  return Object("foxglove.ImageAnnotations",
                {{"circles", unused}, {"points", ListOf(points)}, {"texts", unused}});
}

}  // namespace

std::string SceneSchema(std::string_view name) {
  if (name == kFrameTransform) return Transform().dump();
  if (name == kSceneUpdate) return Update().dump();
  if (name == kCompressedImage) return Picture().dump();
  if (name == kPointCloud) return Cloud().dump();
  return Annotations().dump();
}

}  // namespace priamos::console
