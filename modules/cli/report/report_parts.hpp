#pragma once

#include <cstdint>
#include <initializer_list>
#include <string>
#include <string_view>

#include "cli/report/report_record.hpp"
#include "cli/report/report_summary.hpp"
#include "cli/report/report_timeline.hpp"

/// What the pages of a run and of a log are put together from: HTML that needs no script and no other file.
namespace priamos::cli {

/// RFC 4648, with padding.
std::string Base64(std::string_view bytes);

/// A figure and what it means.
std::string Card(const std::string& figure, const char* meaning);
/// A row of a table; cells are markup, text from messages must be escaped.
std::string Row(std::initializer_list<std::string> cells, const char* tag = "td", const char* style = "");

/// Begin of the page, up to the heading with its verdict.
std::string PageHead(const std::string& title, bool good, const std::string& verdict);
/// A drawing as part of the page.
std::string Picture(const char* description, const std::string& svg);
/// Errors where there is a truth, sigmas, speed and gap, over the time of `span`.
std::string Plots(const RunRecord& record, const MissionSpan& span);
/// Every alarm, when it happened since `begin_utime`, and who took note of it; empty without any.
std::string AlarmTable(const RunRecord& record, std::int64_t begin_utime);
/// What the line carried in both directions, per channel.
std::string RadioSection(const RadioSummary& up, const RadioSummary& down);

}  // namespace priamos::cli
