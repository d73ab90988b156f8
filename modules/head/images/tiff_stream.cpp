#include "head/images/tiff_stream.hpp"

#include <algorithm>
#include <cstdarg>
#include <cstdio>
#include <cstring>

namespace priamos::head {
namespace {

TiffStream& StreamOf(thandle_t self) {
  return *static_cast<TiffStream*>(self);
}

}  // namespace

tmsize_t TiffStream::Read(thandle_t self, void* to, tmsize_t size) {
  TiffStream& stream = StreamOf(self);
  const std::size_t left = stream.file_.size() - std::min(stream.at_, stream.file_.size());
  const std::size_t n = std::min(left, static_cast<std::size_t>(std::max<tmsize_t>(size, 0)));
  if (n > 0) std::memcpy(to, stream.file_.data() + stream.at_, n);
  stream.at_ += n;
  return static_cast<tmsize_t>(n);
}

toff_t TiffStream::Seek(thandle_t self, toff_t offset, int whence) {
  TiffStream& stream = StreamOf(self);
  if (whence == SEEK_SET) stream.at_ = offset;
  if (whence == SEEK_CUR) stream.at_ += offset;
  if (whence == SEEK_END) stream.at_ = stream.file_.size() + offset;
  return stream.at_;
}

int TiffStream::Note(TIFF*, void* self, const char*, const char* format, va_list values) {
  TiffStream& stream = StreamOf(self);
  if (!stream.error_.empty()) return 1;
  char text[200];
  std::vsnprintf(text, sizeof text, format, values);
  stream.error_ = text;
  while (stream.error_.ends_with('.')) stream.error_.pop_back();
  return 1;
}

TiffStream::TiffStream(FileBytes file, std::size_t most_memory) : file_(file) {
  const std::unique_ptr<TIFFOpenOptions, void (*)(TIFFOpenOptions*)> options(TIFFOpenOptionsAlloc(),
                                                                             TIFFOpenOptionsFree);
  TIFFOpenOptionsSetMaxSingleMemAlloc(options.get(), static_cast<tmsize_t>(most_memory));
  TIFFOpenOptionsSetErrorHandlerExtR(options.get(), Note, this);
  TIFFOpenOptionsSetWarningHandlerExtR(
      options.get(), [](TIFF*, void*, const char*, const char*, va_list) { return 1; }, nullptr);
  // "m": not mapped, so that every read is checked against the end of the file.
  tiff_.reset(TIFFClientOpenExt(
      "image", "rm", this, Read, [](thandle_t, void*, tmsize_t) { return tmsize_t{0}; }, Seek,
      [](thandle_t) { return 0; }, [](thandle_t self) { return toff_t{StreamOf(self).file_.size()}; },
      [](thandle_t, void**, toff_t*) { return 0; }, [](thandle_t, void*, toff_t) {}, options.get()));
}

}  // namespace priamos::head
