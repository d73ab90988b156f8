#pragma once

#include <fmt/format.h>

#include <nlohmann/json.hpp>
#include <stdexcept>
#include <string_view>

#include "common/outcome.hpp"

namespace priamos::console {

/// Ends the reading of a client's message; what() becomes the refusal.
using Wrong = std::runtime_error;

/// What `read` makes of a client's text of at most `most` bytes as JSON; refused when it is longer, no JSON,
/// or when `read` throws Wrong. `read` takes the json and returns a Message.
template <class Message, class Read>
Outcome<Message> ReadJson(std::string_view text, std::size_t most, Read read) {
  if (text.size() > most) return Refusal{fmt::format("expected at most {} bytes, got {}", most, text.size())};
  try {
    return read(nlohmann::json::parse(text));
  } catch (const nlohmann::json::exception&) {
    return Refusal{"expected JSON"};
  } catch (const Wrong& wrong) {
    return Refusal{wrong.what()};
  }
}

}  // namespace priamos::console
