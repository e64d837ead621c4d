#include <png.h>

#include <new>
#include <string>
#include <vector>

#include "tufted/view/picture.h"

namespace tufted::view {
namespace {

/// Called by libpng for an error; must not return. All arguments are valid, so there was no memory.
[[noreturn]] void fail(png_structp /*png*/, png_const_charp /*message*/) {
  throw std::bad_alloc();
}

/// Called by libpng for a warning, which it would print otherwise.
void ignore(png_structp /*png*/, png_const_charp /*message*/) {}

void append(png_structp png, png_bytep bytes, std::size_t size) {
  static_cast<std::string*>(png_get_io_ptr(png))->append(reinterpret_cast<const char*>(bytes), size);
}

/// Owns the state of libpng.
struct Writer {
  png_structp png = nullptr;
  png_infop info = nullptr;

  Writer() {
    png = png_create_write_struct(PNG_LIBPNG_VER_STRING, nullptr, fail, ignore);
    if (png != nullptr) info = png_create_info_struct(png);
    if (info == nullptr) {
      png_destroy_write_struct(&png, nullptr);
      throw std::bad_alloc();
    }
  }
  ~Writer() { png_destroy_write_struct(&png, &info); }
  Writer(const Writer&) = delete;
  Writer& operator=(const Writer&) = delete;
};

}  // namespace
}  // namespace tufted::view

namespace tufted {

std::string pngOf(const Picture& picture) {
  // Higher levels take longer than drawing and save a few percent.
  constexpr int level = 5;
  bool is_opaque = true;
  for (std::size_t i = 3; i < picture.pixels.size(); i += 4) is_opaque = is_opaque && picture.pixels[i] == 255;
  const int channels = is_opaque ? 3 : 4;
  std::string file;
  const view::Writer writer;
  png_set_write_fn(writer.png, &file, view::append, nullptr);
  png_set_IHDR(writer.png, writer.info, static_cast<png_uint_32>(picture.width),
               static_cast<png_uint_32>(picture.height), 8, is_opaque ? PNG_COLOR_TYPE_RGB : PNG_COLOR_TYPE_RGB_ALPHA,
               PNG_INTERLACE_NONE, PNG_COMPRESSION_TYPE_DEFAULT, PNG_FILTER_TYPE_DEFAULT);
  png_set_compression_level(writer.png, level);
  png_set_filter(writer.png, PNG_FILTER_TYPE_BASE, PNG_FILTER_SUB | PNG_FILTER_UP | PNG_FILTER_PAETH);
  png_write_info(writer.png, writer.info);
  std::vector<std::uint8_t> row(static_cast<std::size_t>(channels) * picture.width);
  for (int y = 0; y < picture.height; ++y) {
    const std::uint8_t* pixel = &picture.pixels[4 * static_cast<std::size_t>(y) * picture.width];
    for (int x = 0; x < picture.width; ++x)
      for (int k = 0; k < channels; ++k) row[static_cast<std::size_t>(x) * channels + k] = pixel[4 * x + k];
    png_write_row(writer.png, row.data());
  }
  png_write_end(writer.png, writer.info);
  return file;
}

}  // namespace tufted
