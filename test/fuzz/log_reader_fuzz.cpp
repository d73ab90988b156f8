#include "bus/log/log_reader.hpp"
#include "bus/log/log_survey.hpp"
#include "fuzz_input.hpp"

/// Whatever the file holds: every byte of it is in a whole event or counted as skipped, and what is read can
/// be written and read again.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace priamos::bus;
  const auto bytes = std::as_bytes(std::span(data, size));
  LogReader reader(bytes);
  std::size_t in_events = 0, events = 0;
  std::string again;
  while (const auto event = reader.Next()) {
    ++events;
    in_events += log_format::kHeaderBytes + event->channel.size() + event->bytes.size();
    AppendEvent(again, event->number, event->utime, event->channel, event->bytes);
  }
  Require(in_events + reader.skipped_bytes() == size);
  LogReader second(std::as_bytes(std::span(again)));
  const LogSurvey survey = Survey(second, FuzzSchema());
  Require(survey.events == events && survey.skipped_bytes == 0);
  return 0;
}
