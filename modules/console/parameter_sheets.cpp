#include "console/parameter_sheets.hpp"

#include <fmt/format.h>

#include <array>
#include <chrono>
#include <cstdio>
#include <memory>
#include <utility>

#include "bus/parameters/parameter_messages.hpp"

namespace priamos::console {
namespace {

namespace fs = std::filesystem;

constexpr int kPatience_s = 5;
constexpr std::size_t kLongest = 200'000;

/// A path as one word for the shell.
std::string Quoted(const fs::path& path) {
  std::string word = "'";
  for (const char c : path.string()) c == '\'' ? word += "'\\''" : word += c;
  return word + "'";
}

/// What a command prints, on both outputs; empty when it cannot be started.
std::string OutputOf(const std::string& command) {
  const std::unique_ptr<FILE, int (*)(FILE*)> pipe(popen((command + " 2>&1").c_str(), "r"), pclose);
  std::string output;
  std::array<char, 4096> buffer{};
  while (pipe && output.size() < kLongest) {
    const std::size_t n = fread(buffer.data(), 1, buffer.size(), pipe.get());
    if (n == 0) break;
    output.append(buffer.data(), n);
  }
  return output;
}

}  // namespace

ParameterSheets AskForParameters(const fs::path& programs, const fs::path& folder) {
  ParameterSheets sheets;
  std::error_code nothing_there;
  for (const auto& entry : fs::directory_iterator(folder, nothing_there)) {
    const std::string name = entry.path().stem().string();
    const fs::path program = programs / ("priamos-" + name);
    if (entry.path().extension() != ".toml" || !fs::is_regular_file(program)) continue;
    const auto print = [&](const char* what) {
      return OutputOf(fmt::format("timeout {} {} --config {} {}", kPatience_s, Quoted(program),
                                  Quoted(entry.path()), what));
    };
    ProcessSheet sheet{print("--print-config")};
    // A refusal is a sentence, and no line of TOML.
    if (sheet.text.find(" = ") == std::string::npos) sheet.text = "# " + sheet.text;
    if (bus::ParameterProcess(name))
      if (const auto live = bus::ParameterSheetOf(print("--print-parameters"))) sheet.live = *live;
    sheets.emplace(name, std::move(sheet));
  }
  return sheets;
}

void ParameterQuestion::Ask(const fs::path& programs, const fs::path& folder) {
  if (std::exchange(asked_, true)) return;
  answer_ = std::async(std::launch::async, AskForParameters, programs, folder);
}

std::optional<ParameterSheets> ParameterQuestion::Take() {
  if (!answer_.valid() || answer_.wait_for(std::chrono::seconds(0)) != std::future_status::ready)
    return std::nullopt;
  return answer_.get();
}

}  // namespace priamos::console
