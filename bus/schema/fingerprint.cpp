#include "bus/schema/fingerprint.hpp"

#include <fmt/format.h>

#include <map>
#include <set>
#include <vector>

namespace priamos::bus {
namespace {

/// lcm-gen's string hash works on int64_t: the shift to the right is arithmetic, characters are signed.
class MemberHash {
 public:
  void Add(char c) {
    const auto shifted = static_cast<std::uint64_t>(static_cast<std::int64_t>(value_) >> 55);
    value_ = ((value_ << 8) ^ shifted) + static_cast<std::uint64_t>(static_cast<signed char>(c));
  }
  void Add(std::string_view text) {
    Add(static_cast<char>(text.size()));
    for (const char c : text) Add(c);
  }
  std::uint64_t value() const { return value_; }

 private:
  std::uint64_t value_ = 0x12345678;
};

std::uint64_t OwnHash(const Struct& type) {
  MemberHash hash;
  for (const Field& field : type.fields) {
    hash.Add(field.name);
    if (field.kind != Kind::kStruct) hash.Add(field.type_name);
    hash.Add(static_cast<char>(field.dims.size()));
    for (const Dimension& dimension : field.dims) {
      hash.Add(static_cast<char>(dimension.variable ? 1 : 0));
      hash.Add(dimension.text);
    }
  }
  return hash.value();
}

std::set<const Struct*> Nested(const Struct& type) {
  std::set<const Struct*> seen;
  std::vector<const Struct*> open{&type};
  while (!open.empty()) {
    const Struct* next = open.back();
    open.pop_back();
    for (const Field& field : next->fields) {
      if (field.type != nullptr && seen.insert(field.type).second) open.push_back(field.type);
    }
  }
  return seen;
}

/// Depth first search for a path back to a type that is still open.
class CycleSearch {
 public:
  bool From(const Struct& type) {
    State& state = states_[&type];
    if (state != State::kNew) return state == State::kOpen;
    state = State::kOpen;
    for (const Field& field : type.fields) {
      if (field.type != nullptr && From(*field.type)) return true;
    }
    states_[&type] = State::kDone;
    return false;
  }

 private:
  enum class State : std::uint8_t { kNew, kOpen, kDone };
  std::map<const Struct*, State> states_;
};

}  // namespace

bool IsRecursive(const Struct& type) {
  return Nested(type).contains(&type);
}

bool ReachesRecursion(const Struct& type) {
  return CycleSearch().From(type);
}

std::uint64_t Fingerprints::Of(const Struct& type) {
  parents_.clear();
  terms_ = 0;
  return Sum(type);
}

std::uint64_t Fingerprints::Sum(const Struct& type) {
  if (parents_.contains(&type)) return 0;
  if (const auto known = known_.find(&type); known != known_.end()) return known->second;
  if (parents_.size() > 256 || ++terms_ > 1'000'000) {
    throw SchemaError(
        fmt::format("{}:{}: the types around {} nest too deeply", type.file, type.line, type.full_name));
  }
  parents_.insert(&type);
  std::uint64_t hash = OwnHash(type);
  for (const Field& field : type.fields) {
    if (field.type != nullptr) hash += Sum(*field.type);
  }
  parents_.erase(&type);
  hash = (hash << 1) + (hash >> 63);
  // Only a type that reaches no recursion has the same hash under every parent.
  if (!ReachesRecursion(type)) known_.emplace(&type, hash);
  return hash;
}

}  // namespace priamos::bus
