#pragma once

#include <optional>
#include <string>
#include <utility>
#include <variant>

namespace priamos {

/// Why something cannot be done: one sentence for a person. A check that has nothing else to say returns
/// std::optional<Refusal>, nullopt when all is well. Exceptions are for what ends a program (ConfigError,
/// BusError), and a bare optional is for a value that may be missing without a reason.
struct Refusal {
  std::string reason;
};

/// A value, or the reason why there is none.
template <class T>
class Outcome {
 public:
  Outcome(T value) : content_(std::move(value)) {}            // NOLINT: `return value;` is the point
  Outcome(Refusal refusal) : content_(std::move(refusal)) {}  // NOLINT: `return Refusal{...};` likewise

  explicit operator bool() const { return std::holds_alternative<T>(content_); }
  const T& operator*() const { return std::get<T>(content_); }
  T& operator*() { return std::get<T>(content_); }
  const T* operator->() const { return &std::get<T>(content_); }
  T* operator->() { return &std::get<T>(content_); }
  /// Empty when there is a value.
  std::string reason() const { return *this ? std::string() : std::get<Refusal>(content_).reason; }

 private:
  std::variant<T, Refusal> content_;
};

}  // namespace priamos
