#include "cli/pages/report_comparison.hpp"

#include <fmt/format.h>

#include <cmath>
#include <fstream>
#include <sstream>
#include <stdexcept>

#include "cli/report/report_parts.hpp"
#include "cli/report/report_style.hpp"
#include "common/drawing/svg.hpp"

namespace priamos::cli {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;

/// A value and its place in a summary.
using Leaf = std::pair<std::string, Json>;

std::string ContentOf(const fs::path& file) {
  std::ostringstream text;
  text << std::ifstream(file, std::ios::binary).rdbuf();
  return text.str();
}

void AddLeaves(const Json& value, const std::string& key, std::vector<Leaf>& leaves) {
  if (value.is_object())
    for (const auto& [name, part] : value.items())
      AddLeaves(part, key.empty() ? name : key + "." + name, leaves);
  else if (value.is_array())
    for (std::size_t i = 0; i < value.size(); ++i) AddLeaves(value[i], fmt::format("{}[{}]", key, i), leaves);
  else
    leaves.emplace_back(key, value);
}

std::vector<Leaf> LeavesOf(const Json& summary) {
  std::vector<Leaf> leaves;
  AddLeaves(summary, "", leaves);
  return leaves;
}

const Json* Find(const std::vector<Leaf>& leaves, const std::string& key) {
  for (const auto& [name, value] : leaves)
    if (name == key) return &value;
  return nullptr;
}

std::string TextOf(const Json& value) {
  if (value.is_null()) return "";
  if (value.is_string()) return value.get<std::string>();
  if (value.is_number_float()) return fmt::format("{:.4g}", value.get<double>());
  return value.dump();
}

ComparedFigure Compared(const std::string& key, const Json* a, const Json* b) {
  ComparedFigure figure{key, a ? TextOf(*a) : "", b ? TextOf(*b) : "", ""};
  if (!a || !b || !a->is_number() || !b->is_number()) return figure;
  const double difference = b->get<double>() - a->get<double>();
  if (difference != 0) figure.difference = fmt::format("{:+.4g}", difference);
  return figure;
}

bool Passed(const Json& summary) {
  const auto passed = summary.find("passed"), contacts = summary.find("contacts");
  return passed != summary.end() && *passed == true && (contacts == summary.end() || *contacts == 0);
}

std::string Column(const ComparedRun& run) {
  const bool passed = Passed(run.summary);
  std::string column =
      fmt::format("<div><h2>{} <span class=\"verdict {}\">{}</span></h2>\n", drawing::EscapeMarkup(run.name),
                  passed ? "good" : "bad", passed ? "passed" : "not passed");
  if (const auto reason = run.summary.find("reason"); !passed && reason != run.summary.end())
    column += fmt::format("<p class=\"reason\">{}</p>\n", drawing::EscapeMarkup(TextOf(*reason)));
  if (!run.svg.empty())
    column += fmt::format("<img alt=\"Ground plan of {}\" src=\"data:image/svg+xml;base64,{}\">\n",
                          drawing::EscapeMarkup(run.name), Base64(run.svg));
  return column + "</div>\n";
}

std::string Table(const std::vector<ComparedFigure>& figures, const std::string& a, const std::string& b) {
  std::string table = fmt::format(
      "<div class=\"scroll\"><table><tr><th>figure</th><th>{}</th><th>{}</th><th>difference</th></tr>\n",
      drawing::EscapeMarkup(a), drawing::EscapeMarkup(b));
  for (const ComparedFigure& f : figures)
    table += fmt::format("<tr{}><td>{}</td><td>{}</td><td>{}</td><td>{}</td></tr>\n",
                         f.a == f.b ? "" : " class=\"other\"", drawing::EscapeMarkup(f.key),
                         drawing::EscapeMarkup(f.a), drawing::EscapeMarkup(f.b), f.difference);
  return table + "</table></div>\n";
}

}  // namespace

ComparedRun LoadComparedRun(const fs::path& folder) {
  const fs::path file = folder / "summary.json";
  const Json summary = Json::parse(ContentOf(file), nullptr, false);
  if (!summary.is_object())
    throw std::runtime_error(
        fmt::format("{}: expected the summary of one run; next: name the folder of a run", file.string()));
  const fs::path whole = fs::path(folder / ".").lexically_normal().parent_path();
  return {whole.filename().string(), summary, ContentOf(folder / "run.svg")};
}

std::vector<ComparedFigure> CompareSummaries(const Json& a, const Json& b) {
  const auto of_a = LeavesOf(a), of_b = LeavesOf(b);
  std::vector<ComparedFigure> figures;
  for (const auto& [key, value] : of_a) figures.push_back(Compared(key, &value, Find(of_b, key)));
  for (const auto& [key, value] : of_b)
    if (Find(of_a, key) == nullptr) figures.push_back(Compared(key, nullptr, &value));
  return figures;
}

std::string ComparisonPage(const ComparedRun& a, const ComparedRun& b) {
  std::string page = "<!doctype html>\n<html lang=\"en\"><head><meta charset=\"utf-8\">";
  page += "<meta name=\"viewport\" content=\"width=device-width,initial-scale=1\">";
  page += fmt::format("<title>PRIAMOS: {} and {}</title>\n<style>{}</style></head>\n<body><main>\n",
                      drawing::EscapeMarkup(a.name), drawing::EscapeMarkup(b.name), kReportStyle);
  page += "<header><h1>Two runs</h1></header>\n<div class=\"two\">" + Column(a) + Column(b) + "</div>\n";
  page += "<h2>Figures</h2>\n<p>Bold: they differ.</p>\n";
  page += Table(CompareSummaries(a.summary, b.summary), a.name, b.name);
  return page + "</main></body></html>\n";
}

}  // namespace priamos::cli
