#include "head/core/bodies/cao.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <sstream>

#include "common/text/number_text.hpp"

namespace priamos::head {
namespace {

constexpr int kMaxDepth = 8, kMaxCount = 100000;

/// A line of the file without comments.
struct Line {
  int number = 0;
  std::vector<std::string> words;
};

struct Trouble {
  std::string sentence;
};

class Reader {
 public:
  using Read = std::function<Outcome<std::string>(const std::string& file)>;

  Reader(const std::string& name, const std::string& text, const Read& read, int depth, Polyhedron& body)
      : name_(name), read_(read), depth_(depth), body_(body), lines_(Split(text)) {}

  void Parse() {
    Expect("V1");
    while (next_ < lines_.size() && lines_[next_].words[0].starts_with("load(")) Load();
    first_point_ = static_cast<int>(body_.points.size());
    const int n_points = Count("points");
    for (int i = 0; i < n_points; ++i) Point();
    const int n_lines = Count("lines");
    for (int i = 0; i < n_lines; ++i) lines_read_.push_back(LineOf());
    const int n_line_faces = Count("faces of lines");
    for (int i = 0; i < n_line_faces; ++i) FaceOfLines();
    const int n_faces = Count("faces of points");
    for (int i = 0; i < n_faces; ++i) FaceOfPoints();
    if (next_ < lines_.size() && Count("cylinders") > 0) Fail("expected no cylinders: they have no edges");
    if (next_ < lines_.size() && Count("circles") > 0) Fail("expected no circles: they have no edges");
    if (next_ < lines_.size())
      Fail(fmt::format("expected the end, got \"{}\"", lines_[next_].words[0]), true);
    for (std::size_t i = 0; i < lines_read_.size(); ++i)
      if (std::find(in_face_.begin(), in_face_.end(), static_cast<int>(i)) == in_face_.end())
        body_.lines.push_back(lines_read_[i]);
  }

 private:
  static std::vector<Line> Split(const std::string& text) {
    std::vector<Line> lines;
    std::istringstream in(text);
    std::string row;
    for (int number = 1; std::getline(in, row); ++number) {
      Line line{number, {}};
      std::istringstream words(row.substr(0, row.find('#')));
      for (std::string word; words >> word;) line.words.push_back(word);
      if (!line.words.empty()) lines.push_back(line);
    }
    return lines;
  }

  /// Throws `sentence` with file and line. `here`: at the next line, else at the one just read.
  [[noreturn]] void Fail(const std::string& sentence, bool here = false) const {
    const std::size_t at = here ? next_ : next_ - (next_ > 0);
    const int number = lines_.empty() ? 1 : lines_[std::min(at, lines_.size() - 1)].number;
    throw Trouble{fmt::format("{}:{}: {}", name_, number, sentence)};
  }

  const Line& Take(const std::string& what) {
    if (next_ >= lines_.size()) Fail(fmt::format("expected {}, got the end of the file", what));
    return lines_[next_++];
  }

  void Expect(const std::string& word) {
    const Line& line = Take(word);
    if (line.words[0] != word) Fail(fmt::format("expected {}, got \"{}\"", word, line.words[0]));
  }

  int Whole(const std::string& word, const std::string& what) const {
    const auto value = NumberOf<int>(WithoutPlus(word));
    if (!value || *value < 0 || *value > kMaxCount)
      Fail(fmt::format("expected {} (0 to {}), got \"{}\"", what, kMaxCount, word));
    return *value;
  }

  int Count(const std::string& what) {
    return Whole(Take("the number of " + what).words[0], "the number of " + what);
  }

  void Point() {
    const Line& line = Take("a point");
    if (line.words.size() < 3) Fail("expected a point X Y Z");
    Eigen::Vector3d point;
    for (int k = 0; k < 3; ++k) {
      const auto value = NumberOf<double>(WithoutPlus(line.words[k]));
      if (!value || !std::isfinite(*value))
        Fail(fmt::format("expected a coordinate [m], got \"{}\"", line.words[k]));
      point[k] = *value;
    }
    body_.points.push_back(point);
  }

  /// Indices up to `limit`, words such as name=... left out.
  std::vector<int> Indices(const Line& line, std::size_t from, int limit, const char* what) const {
    std::vector<int> indices;
    for (std::size_t k = from; k < line.words.size() && line.words[k].find('=') == std::string::npos; ++k) {
      indices.push_back(Whole(line.words[k], what));
      if (indices.back() >= limit)
        Fail(fmt::format("expected {} (0 to {}), got {}", what, limit - 1, indices.back()));
    }
    return indices;
  }

  int NPoints() const { return static_cast<int>(body_.points.size()) - first_point_; }

  std::array<int, 2> LineOf() {
    const auto ends = Indices(Take("a line"), 0, NPoints(), "the number of a point");
    if (ends.size() != 2) Fail(fmt::format("expected a line of 2 points, got {}", ends.size()));
    return {first_point_ + ends[0], first_point_ + ends[1]};
  }

  std::vector<int> Polygon(const char* what, int limit) {
    const Line& line = Take("a face");
    const int n = Whole(line.words[0], "the number of corners");
    auto corners = Indices(line, 1, limit, what);
    if (static_cast<int>(corners.size()) != n || n < 3)
      Fail(fmt::format("expected a face of {} corners, at least 3, got {}", n, corners.size()));
    for (auto c = corners.begin(); c != corners.end(); ++c)
      if (std::find(corners.begin(), c, *c) != c)
        Fail(fmt::format("expected {} once in a face, got {} twice", what, *c));
    return corners;
  }

  void FaceOfPoints() {
    auto corners = Polygon("the number of a point", NPoints());
    for (int& c : corners) c += first_point_;
    body_.faces.push_back(corners);
  }

  /// Lines one after the other around the face, each in either direction.
  void FaceOfLines() {
    const auto sides = Polygon("the number of a line", static_cast<int>(lines_read_.size()));
    std::vector<int> corners;
    for (std::size_t i = 0; i < sides.size(); ++i) {
      const auto &a = lines_read_[sides[i]], &b = lines_read_[sides[(i + 1) % sides.size()]];
      const bool second_is_common = a[1] == b[0] || a[1] == b[1];
      if (!second_is_common && a[0] != b[0] && a[0] != b[1]) Fail("expected lines that meet in corners");
      corners.push_back(second_is_common ? a[1] : a[0]);
      in_face_.push_back(sides[i]);
    }
    body_.faces.push_back(corners);
  }

  void Load() {
    const std::string word = Take("load").words[0];
    const auto open = word.find('"'), close = word.rfind('"');
    if (open == std::string::npos || close <= open) Fail("expected load(\"file.cao\")");
    if (depth_ >= kMaxDepth) Fail("expected no file that loads itself");
    const auto slash = name_.rfind('/');
    const std::string folder = slash == std::string::npos ? std::string() : name_.substr(0, slash + 1);
    const std::string file = folder + word.substr(open + 1, close - open - 1);
    const auto text = read_(file);
    if (!text) Fail(text.reason());
    Reader(file, *text, read_, depth_ + 1, body_).Parse();
  }

  std::string name_;
  const Read& read_;
  int depth_;
  Polyhedron& body_;
  std::vector<Line> lines_;
  std::size_t next_ = 0;
  int first_point_ = 0;
  std::vector<std::array<int, 2>> lines_read_;
  std::vector<int> in_face_;
};

}  // namespace

Outcome<Polyhedron> ParseCao(const std::string& name, const std::string& text,
                             const std::function<Outcome<std::string>(const std::string& file)>& read) {
  Polyhedron body;
  try {
    Reader(name, text, read, 0, body).Parse();
  } catch (const Trouble& trouble) {
    return Refusal{trouble.sentence};
  }
  if (const auto refusal = CheckPolyhedron(body)) return Refusal{name + ": " + refusal->reason};
  return body;
}

}  // namespace priamos::head
