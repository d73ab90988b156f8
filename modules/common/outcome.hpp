#pragma once

#include <string>
#include <utility>
#include <variant>

namespace priamos {

/// Why something could not be done: one sentence for a person.
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
