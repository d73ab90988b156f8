#include "bus/schema/schema.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "bus/schema/fingerprint.hpp"
#include "bus/schema/lcm_parser.hpp"
#include "bus/schema/walk_plan.hpp"

namespace priamos::bus {
namespace {

bool SameDimensions(const std::vector<Dimension>& a, const std::vector<Dimension>& b) {
  return std::equal(a.begin(), a.end(), b.begin(), b.end(), [](const Dimension& x, const Dimension& y) {
    return x.text == y.text && x.variable == y.variable && x.size == y.size;
  });
}

/// A comment is a part of the definition when it says how the radio packs the field.
bool SameField(const Field& a, const Field& b) {
  const bool packed = !a.annotation.unit.empty() || !b.annotation.unit.empty();
  return a.name == b.name && a.type_name == b.type_name && SameDimensions(a.dims, b.dims) &&
         (!packed || a.comment == b.comment);
}

bool SameDefinition(const Struct& a, const Struct& b) {
  const auto same_constant = [](const Constant& x, const Constant& y) {
    return x.name == y.name && x.kind == y.kind && x.text == y.text;
  };
  return std::equal(a.fields.begin(), a.fields.end(), b.fields.begin(), b.fields.end(), SameField) &&
         std::equal(a.constants.begin(), a.constants.end(), b.constants.begin(), b.constants.end(),
                    same_constant);
}

}  // namespace

Schema::Schema(const std::vector<Source>& sources) {
  Build(sources, nullptr);
}

Schema::Schema(const std::vector<Source>& sources, std::vector<std::string>& problems) {
  Build(sources, &problems);
}

void Schema::Build(const std::vector<Source>& sources, std::vector<std::string>* problems) {
  for (const Source& source : sources) {
    std::vector<TypeProblem> unreadable;
    auto types = ParseLcm(source.file, source.text, unreadable);
    for (const TypeProblem& problem : unreadable) Refuse(problem.type, problem.sentence, problems);
    for (Struct& type : types) Insert(std::move(type), problems);
  }
  for (const std::string& name : ambiguous_) types_.erase(name);
  RemoveIncomplete(problems);
  for (auto& [name, type] : types_)
    for (Field& field : type->fields)
      if (field.kind == Kind::kStruct) field.type = types_.find(field.type_name)->second.get();
  ComputeFingerprints(problems);
  for (auto& [name, type] : types_) {
    by_fingerprint_.try_emplace(type->fingerprint, type.get());
    type->walk_plan = std::make_shared<const WalkPlan>(MakeWalkPlan(*type));
  }
}

void Schema::Refuse(const std::string& name, const std::string& sentence,
                    std::vector<std::string>* problems) {
  if (problems == nullptr) throw SchemaError(sentence);
  problems->push_back(sentence);
  if (!name.empty()) refused_.insert(name);
}

/// The same definition in two places is one. Of two different ones nobody knows which is meant.
void Schema::Insert(Struct type, std::vector<std::string>* problems) {
  const auto [at, added] = types_.try_emplace(type.full_name, nullptr);
  if (added) {
    at->second = std::make_unique<Struct>(std::move(type));
  } else if (!SameDefinition(*at->second, type)) {
    Refuse(type.full_name,
           fmt::format("{}:{}: expected one definition of {}, got another one than in {}:{}", type.file,
                       type.line, type.full_name, at->second->file, at->second->line),
           problems);
    ambiguous_.insert(type.full_name);
  }
}

/// Refuses what has a field of a type that is not there, and what has a field of a type refused so.
void Schema::RemoveIncomplete(std::vector<std::string>* problems) {
  std::map<std::string, std::vector<std::string>> users;  // of a type
  std::vector<std::string> open;
  for (const auto& [name, type] : types_) {
    open.push_back(name);
    for (const Field& field : type->fields)
      if (field.kind == Kind::kStruct) users[field.type_name].push_back(name);
  }
  for (std::size_t i = 0; i < open.size(); ++i) {
    const auto at = types_.find(open[i]);
    if (at == types_.end()) continue;
    const auto& fields = at->second->fields;
    const auto missing = std::find_if(fields.begin(), fields.end(), [&](const Field& field) {
      return field.kind == Kind::kStruct && !types_.contains(field.type_name);
    });
    if (missing == fields.end()) continue;
    Refuse(
        open[i],
        fmt::format("{}expected a type that {}, got {}", at->second->Where(*missing),
                    refused_.contains(missing->type_name) ? "can be used" : "is defined", missing->type_name),
        problems);
    const auto affected = users.find(open[i]);
    if (affected != users.end()) open.insert(open.end(), affected->second.begin(), affected->second.end());
    types_.erase(at);
  }
}

/// A type whose fingerprint cannot be computed goes, and all that contain it.
void Schema::ComputeFingerprints(std::vector<std::string>* problems) {
  Fingerprints fingerprints;
  std::vector<Types::iterator> without;
  for (auto at = types_.begin(); at != types_.end(); ++at) {
    try {
      at->second->fingerprint = fingerprints.Of(*at->second);
    } catch (const SchemaError& error) {
      Refuse(at->first, error.what(), problems);
      without.push_back(at);
    }
  }
  if (without.empty()) return;
  for (const auto at : without) types_.erase(at);
  RemoveIncomplete(problems);
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

const Struct* Schema::Of(std::span<const std::byte> bytes) const {
  return Find(FingerprintOf(bytes.data(), bytes.size()));
}

bool Schema::Refused(std::string_view name) const {
  return std::any_of(refused_.begin(), refused_.end(), [&](std::string_view full_name) {
    return full_name == name || full_name.substr(full_name.rfind('.') + 1) == name;
  });
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
