#include "bus/schema/schema.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "bus/schema/fingerprint.hpp"
#include "bus/schema/lcm_parser.hpp"
#include "bus/schema/walk_plan.hpp"

namespace priamos::bus {

Schema::Schema(const std::vector<Source>& sources) {
  Build(sources, nullptr);
}

Schema::Schema(const std::vector<Source>& sources, std::vector<std::string>& problems) {
  Build(sources, &problems);
}

void Schema::Build(const std::vector<Source>& sources, std::vector<std::string>* problems) {
  for (const Source& source : sources) {
    try {
      for (Struct& type : ParseLcm(source.file, source.text)) Insert(std::move(type));
    } catch (const SchemaError& error) {
      if (problems == nullptr) throw;
      problems->emplace_back(error.what());
    }
  }
  Resolve(problems);
  ComputeFingerprints(problems);
  for (auto& [name, type] : types_) type->walk_plan = std::make_shared<const WalkPlan>(MakeWalkPlan(*type));
}

void Schema::Insert(Struct type) {
  const auto [at, added] = types_.try_emplace(type.full_name, nullptr);
  if (!added) {
    throw SchemaError(fmt::format("{}:{}: the type {} is already defined in {}:{}", type.file, type.line,
                                  type.full_name, at->second->file, at->second->line));
  }
  at->second = std::make_unique<Struct>(std::move(type));
}

void Schema::Resolve(std::vector<std::string>* problems) {
  // A type that goes may leave others without theirs, so this repeats until nothing more goes.
  for (bool again = true; again;) {
    again = false;
    for (auto at = types_.begin(); at != types_.end();) {
      const Struct& type = *at->second;
      const auto missing = std::find_if(type.fields.begin(), type.fields.end(), [&](const Field& field) {
        return field.kind == Kind::kStruct && !types_.contains(field.type_name);
      });
      if (missing == type.fields.end()) {
        ++at;
        continue;
      }
      const std::string sentence =
          fmt::format("{}the type {} is not defined", type.Where(*missing), missing->type_name);
      if (problems == nullptr) throw SchemaError(sentence);
      problems->push_back(sentence);
      at = types_.erase(at);
      again = true;
    }
  }
  for (auto& [name, type] : types_) {
    for (Field& field : type->fields) {
      if (field.kind == Kind::kStruct) field.type = types_.find(field.type_name)->second.get();
    }
  }
}

void Schema::ComputeFingerprints(std::vector<std::string>* problems) {
  Fingerprints fingerprints;
  by_fingerprint_.clear();
  for (auto& [name, type] : types_) {
    try {
      type->fingerprint = fingerprints.Of(*type);
    } catch (const SchemaError& error) {
      if (problems == nullptr) throw;
      problems->emplace_back(error.what());
      types_.erase(types_.find(name));
      Resolve(problems);
      return ComputeFingerprints(problems);
    }
    by_fingerprint_.try_emplace(type->fingerprint, type.get());
  }
}

const Struct* Schema::Find(std::uint64_t fingerprint) const {
  const auto found = by_fingerprint_.find(fingerprint);
  return found == by_fingerprint_.end() ? nullptr : found->second;
}

const Struct* Schema::Find(std::string_view name) const {
  if (const auto found = types_.find(name); found != types_.end()) return found->second.get();
  const Struct* match = nullptr;
  for (const auto& [full_name, type] : types_) {
    if (type->name != name) continue;
    if (match != nullptr) return nullptr;
    match = type.get();
  }
  return match;
}

std::vector<const Struct*> Schema::All() const {
  std::vector<const Struct*> all;
  for (const auto& [name, type] : types_) all.push_back(type.get());
  return all;
}

std::uint64_t FingerprintOf(const void* data, std::size_t size) {
  if (size < 8) return 0;
  const auto* bytes = static_cast<const unsigned char*>(data);
  std::uint64_t value = 0;
  for (int i = 0; i < 8; ++i) value = value << 8 | bytes[i];
  return value;
}

}  // namespace priamos::bus
