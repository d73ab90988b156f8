#pragma once

#include <string>

#include "common/outcome.hpp"
#include "head/files/camera_entries.hpp"

namespace priamos::head {

/// Keys, lines and words of entries as one text, an entry a line; of a refusal its reason.
inline std::string EntryText(const Outcome<CameraEntries>& entries) {
  if (!entries) return entries.reason();
  std::string text;
  for (const CameraEntry& entry : *entries) {
    text += entry.key + "@" + std::to_string(entry.line) + ":";
    for (const std::string& word : entry.words) text += " " + word;
    text += "\n";
  }
  return text;
}

}  // namespace priamos::head
