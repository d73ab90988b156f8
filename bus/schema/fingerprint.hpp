#pragma once

#include <map>
#include <set>

#include "bus/schema/model.hpp"

namespace priamos::bus {

/// LCM's fingerprints of types whose nested types are resolved: a hash over member names, primitive types
/// and dimensions, plus the hashes of nested types, rotated by one bit; inside itself a type counts 0.
/// Equal to what lcm-gen writes into generated code.
class Fingerprints {
 public:
  /// Fingerprint of `type`. Throws SchemaError when types nest deeper than 256 or so densely in themselves
  /// that the sum has over a million terms. Keeps what it computed for the next type; the types must not
  /// change meanwhile.
  std::uint64_t Of(const Struct& type);

 private:
  std::uint64_t Sum(const Struct& type);

  std::set<const Struct*> parents_;
  std::map<const Struct*, std::uint64_t> known_;
  int terms_ = 0;
};

/// True when the type can contain itself.
bool IsRecursive(const Struct& type);
/// True when the type, or one nested in it, can contain itself.
bool ReachesRecursion(const Struct& type);

}  // namespace priamos::bus
