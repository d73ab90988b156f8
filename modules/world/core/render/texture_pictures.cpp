#include "world/core/render/texture_pictures.hpp"

#include <opencv2/imgproc.hpp>

namespace priamos::world {

namespace {

constexpr int kSide = kTextureSide;

/// Drawing is done on bytes, where OpenCV smooths its lines.
cv::Mat ToBytes(const cv::Mat& picture) {
  cv::Mat bytes;
  picture.convertTo(bytes, CV_8U, 255);
  return bytes;
}

cv::Mat ToAlbedo(const cv::Mat& bytes) {
  cv::Mat picture;
  bytes.convertTo(picture, CV_32F, 1 / 255.0);
  return picture;
}

cv::Point Somewhere(Rng& rng, const cv::Rect& area) {
  return {static_cast<int>(rng.Uniform(area.x, area.x + area.width)),
          static_cast<int>(rng.Uniform(area.y, area.y + area.height))};
}

void DrawFigure(Rng& rng, cv::Mat& image, const cv::Rect& area) {
  const cv::Scalar grey(rng.Uniform(20, 235));
  switch (rng.Below(4)) {
    case 0:
      cv::rectangle(image, Somewhere(rng, area), Somewhere(rng, area), grey, cv::FILLED, cv::LINE_AA);
      break;
    case 1:
      cv::ellipse(image, Somewhere(rng, area),
                  cv::Size(static_cast<int>(rng.Uniform(15, 110)), static_cast<int>(rng.Uniform(15, 110))),
                  rng.Uniform(0, 180), 0, 360, grey, cv::FILLED, cv::LINE_AA);
      break;
    case 2: {
      const std::vector<cv::Point> corners{Somewhere(rng, area), Somewhere(rng, area), Somewhere(rng, area)};
      cv::fillConvexPoly(image, corners, grey, cv::LINE_AA);
      break;
    }
    default:
      cv::line(image, Somewhere(rng, area), Somewhere(rng, area), grey, static_cast<int>(rng.Uniform(3, 14)),
               cv::LINE_AA);
  }
}

void DrawWriting(Rng& rng, cv::Mat& image, const cv::Rect& area) {
  const int step = static_cast<int>(rng.Uniform(14, 26));
  for (int y = area.y + step; y < area.y + area.height; y += step) {
    int x = area.x;
    const int end = area.x + static_cast<int>(area.width * rng.Uniform(0.6, 1));
    while (x < end) {
      const int word = static_cast<int>(rng.Uniform(10, 60));
      cv::rectangle(image, cv::Rect(x, y, std::min(word, end - x), step / 3), cv::Scalar(60), cv::FILLED);
      x += word + 8;
    }
  }
}

}  // namespace

cv::Mat PosterPicture(Rng& rng) {
  cv::Mat image(kSide, kSide, CV_8U, cv::Scalar(225));
  const int border = static_cast<int>(rng.Uniform(12, 30));
  const cv::Rect sheet(border, border, kSide - 2 * border, kSide - 2 * border);
  cv::rectangle(image, sheet, cv::Scalar(rng.Uniform(60, 215)), cv::FILLED);
  const double split = rng.Uniform(0.5, 0.9);
  const cv::Rect upper(sheet.x, sheet.y, sheet.width, static_cast<int>(sheet.height * split));
  cv::Mat drawing = image(sheet);
  const auto figures = 4 + rng.Below(6);
  for (std::uint64_t i = 0; i < figures; ++i) {
    DrawFigure(rng, drawing, cv::Rect(0, 0, upper.width, upper.height));
  }
  const cv::Rect lower(sheet.x, sheet.y + upper.height, sheet.width, sheet.height - upper.height);
  cv::rectangle(image, lower, cv::Scalar(215), cv::FILLED);
  DrawWriting(rng, image, cv::Rect(lower.x + 15, lower.y, lower.width - 30, lower.height - 20));
  cv::GaussianBlur(image, image, {0, 0}, 0.8);
  return ToAlbedo(image);
}

cv::Mat LeafPicture(const cv::Mat& surface) {
  cv::Mat image = ToBytes(surface);
  const int lock = static_cast<int>(kSide * (1 - 1.05 / 2.0));
  const int column = static_cast<int>(kSide * 0.93);
  cv::rectangle(image, cv::Rect(column - 10, lock - 16, 20, 60), cv::Scalar(150), cv::FILLED);
  cv::rectangle(image, cv::Rect(column - 60, lock - 4, 64, 7), cv::Scalar(60), cv::FILLED);
  cv::circle(image, {column, lock + 28}, 4, cv::Scalar(30), cv::FILLED, cv::LINE_AA);
  cv::GaussianBlur(image, image, {0, 0}, 0.8);
  return ToAlbedo(image);
}

cv::Mat CupboardPicture(const cv::Mat& surface) {
  cv::Mat image = ToBytes(surface);
  const int plinth = static_cast<int>(kSide * 0.95);
  cv::rectangle(image, cv::Rect(0, plinth, kSide, kSide - plinth), cv::Scalar(45), cv::FILLED);
  cv::rectangle(image, cv::Rect(8, 8, kSide / 2 - 10, plinth - 16), cv::Scalar(90), 2);
  cv::rectangle(image, cv::Rect(kSide / 2 + 2, 8, kSide / 2 - 10, plinth - 16), cv::Scalar(90), 2);
  for (const int x : {kSide / 2 - 30, kSide / 2 + 22}) {
    cv::rectangle(image, cv::Rect(x, kSide / 2 - 25, 8, 50), cv::Scalar(190), cv::FILLED);
  }
  cv::GaussianBlur(image, image, {0, 0}, 0.8);
  return ToAlbedo(image);
}

}  // namespace priamos::world
