#pragma once

#include <tiffio.h>

#include <memory>
#include <string>

#include "head/images/decoded_image.hpp"

namespace priamos::head {

/// The bytes of a TIFF file as libtiff reads them. Not copied: libtiff refers to it.
class TiffStream {
 public:
  /// libtiff takes at most `most_memory` bytes at once: tags that claim more are damaged.
  TiffStream(FileBytes file, std::size_t most_memory);
  TiffStream(const TiffStream&) = delete;
  TiffStream& operator=(const TiffStream&) = delete;

  /// Null when even the header is none.
  TIFF* tiff() const { return tiff_.get(); }
  /// What libtiff found wrong first; empty: nothing yet. It says so of damage that it reads over.
  const std::string& error() const { return error_; }

 private:
  struct Closer {
    void operator()(TIFF* tiff) const { TIFFClose(tiff); }
  };
  static tmsize_t Read(thandle_t self, void* to, tmsize_t size);
  static toff_t Seek(thandle_t self, toff_t offset, int whence);
  static int Note(TIFF*, void* self, const char* module, const char* format, va_list values);

  FileBytes file_;
  std::size_t at_ = 0;
  std::string error_;
  std::unique_ptr<TIFF, Closer> tiff_;
};

}  // namespace priamos::head
