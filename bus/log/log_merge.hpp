#pragma once

#include <string>
#include <vector>

#include "bus/log/clock_fit.hpp"
#include "bus/log/log_reader.hpp"

namespace priamos::bus {

class LogWriter;
class Schema;

/// Messages that are in both logs because the radio link carried them, with their time stamp on each side.
///
/// The link knows both clocks: a stamp travels as its age, and the receiver restores it in its own clock less
/// the transmission time. So a message that crossed is in one log with the sender's stamp and in the other
/// one with the receiver's. Two messages are the same when their packed bits, without stamps, are; only
/// messages that are unique in both logs count. The side that recorded a message sooner after its stamp sent
/// it.
std::vector<StampPair> FindStampPairs(LogReader& a, LogReader& b, const Schema& schema);

/// Writes the events of `a`, and those of `b` in the clock of `a`, in the order of time. Channels of `b` get
/// `prefix_b` before their names. Stamps inside the messages stay as they were recorded. Returns the number
/// of events.
std::uint64_t MergeLogs(LogReader& a, LogReader& b, const ClockFit& b_to_a, const std::string& prefix_b,
                        LogWriter& writer);

}  // namespace priamos::bus
