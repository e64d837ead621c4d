#include "view/text.h"

#include <ft2build.h>
#include FT_FREETYPE_H

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <new>

#include "view/font_data.h"

namespace tufted::view {
namespace {

/// The characters of a UTF-8 text.
std::u32string charactersOf(const std::string& text) {
  // Unicode's replacement character, for bytes that are not UTF-8.
  constexpr char32_t unknown = 0xfffd;
  std::u32string characters;
  for (std::size_t i = 0; i < text.size();) {
    const auto first = static_cast<unsigned char>(text[i++]);
    const int more = first < 0x80 ? 0 : first >> 5 == 6 ? 1 : first >> 4 == 14 ? 2 : first >> 3 == 30 ? 3 : -1;
    char32_t character = more <= 0 ? first : first & (0x3f >> more);
    int k = 0;
    for (; k < more && i < text.size() && (static_cast<unsigned char>(text[i]) & 0xc0) == 0x80; ++k, ++i)
      character = character << 6 | (static_cast<unsigned char>(text[i]) & 0x3f);
    if (more < 0 || k < more) character = unknown;
    characters += character < 0x20 ? U' ' : character;
  }
  return characters;
}

}  // namespace

struct Canvas::Font {
  FT_Library library = nullptr;
  FT_Face face = nullptr;

  Font() {
    FT_Error error = FT_Init_FreeType(&library);
    if (error == 0) {
      error = FT_New_Memory_Face(library, font_data, static_cast<FT_Long>(font_size), 0, &face);
      if (error != 0) FT_Done_FreeType(library);
    }
    if (error != 0) throw std::bad_alloc();  // the font is part of the library and valid
  }
  ~Font() {
    FT_Done_Face(face);
    FT_Done_FreeType(library);
  }
  Font(const Font&) = delete;
  Font& operator=(const Font&) = delete;

  void setSize(double size) { FT_Set_Char_Size(face, 0, static_cast<FT_F26Dot6>(std::lround(size * 64)), 72, 72); }
  /// Renders a character; null if that fails.
  FT_GlyphSlot load(char32_t character) {
    const FT_Error error = FT_Load_Char(face, character, FT_LOAD_RENDER | FT_LOAD_NO_HINTING);
    if (error == FT_Err_Out_Of_Memory) throw std::bad_alloc();
    return error == 0 ? face->glyph : nullptr;
  }
};

Canvas::Canvas(Picture& picture) : picture_(picture), font_(new Font) {}
Canvas::~Canvas() {
  delete font_;
}

void Canvas::blend(int x, int y, double share, const Rgb& color) {
  if (x < 0 || y < 0 || x >= picture_.width || y >= picture_.height || !(share > 0)) return;
  std::uint8_t* const pixel = &picture_.pixels[4 * (static_cast<std::size_t>(y) * picture_.width + x)];
  const double below = pixel[3] / 255.0 * (1 - std::min(share, 1.0));
  const double alpha = std::min(share, 1.0) + below;
  for (std::size_t k = 0; k < 3; ++k)
    pixel[k] = static_cast<std::uint8_t>(std::lround((color[k] * std::min(share, 1.0) + pixel[k] * below) / alpha));
  pixel[3] = static_cast<std::uint8_t>(std::lround(255 * alpha));
}

void Canvas::fill(int left, int top, int right, int bottom, const Rgb& color) {
  for (int y = top; y < bottom; ++y)
    for (int x = left; x < right; ++x) blend(x, y, 1, color);
}

void Canvas::line(double x0, double y0, double x1, double y1, double width, const Rgb& color) {
  const Eigen::Vector2d start(x0, y0);
  const Eigen::Vector2d along = Eigen::Vector2d(x1, y1) - start;
  const double square = along.squaredNorm();
  const auto low = [width](double a, double b) { return static_cast<int>(std::floor(std::min(a, b) - width - 1)); };
  const auto high = [width](double a, double b) { return static_cast<int>(std::ceil(std::max(a, b) + width + 1)); };
  for (int y = std::max(low(y0, y1), 0); y < std::min(high(y0, y1), picture_.height); ++y)
    for (int x = std::max(low(x0, x1), 0); x < std::min(high(x0, x1), picture_.width); ++x) {
      const Eigen::Vector2d from(x + 0.5 - x0, y + 0.5 - y0);
      const double share = square > 0 ? std::clamp(from.dot(along) / square, 0.0, 1.0) : 0;
      blend(x, y, 0.5 * width + 0.5 - (from - share * along).norm(), color);
    }
}

void Canvas::triangle(const std::array<Eigen::Vector2d, 3>& corners, const Rgb& color) {
  Eigen::Vector2d low = corners[0];
  Eigen::Vector2d high = corners[0];
  for (const Eigen::Vector2d& corner : corners) {
    low = low.cwiseMin(corner);
    high = high.cwiseMax(corner);
  }
  const auto cross = [](const Eigen::Vector2d& a, const Eigen::Vector2d& b) { return a.x() * b.y() - a.y() * b.x(); };
  const double sign = cross(corners[1] - corners[0], corners[2] - corners[0]) < 0 ? -1 : 1;
  for (int y = std::max(static_cast<int>(low.y()) - 1, 0);
       y < std::min<int>(static_cast<int>(high.y()) + 2, picture_.height); ++y)
    for (int x = std::max(static_cast<int>(low.x()) - 1, 0);
         x < std::min<int>(static_cast<int>(high.x()) + 2, picture_.width); ++x) {
      double inside = 1;
      for (std::size_t k = 0; k < 3; ++k) {
        const Eigen::Vector2d side = corners[(k + 1) % 3] - corners[k];
        const double length = side.norm();
        if (!(length > 0)) return;
        inside = std::min(inside, sign * cross(side, Eigen::Vector2d(x + 0.5, y + 0.5) - corners[k]) / length + 0.5);
      }
      blend(x, y, inside, color);
    }
}

void Canvas::text(const std::string& text, double x, double y, double size, const Rgb& color) {
  font_->setSize(size);
  double at = x;
  for (const char32_t character : charactersOf(text)) {
    const FT_GlyphSlot glyph = font_->load(character);
    if (glyph == nullptr) continue;
    const int left = static_cast<int>(std::lround(at)) + glyph->bitmap_left;
    const int top = static_cast<int>(std::lround(y)) - glyph->bitmap_top;
    for (unsigned int row = 0; row < glyph->bitmap.rows; ++row)
      for (unsigned int column = 0; column < glyph->bitmap.width; ++column)
        blend(left + static_cast<int>(column), top + static_cast<int>(row),
              glyph->bitmap.buffer[static_cast<std::ptrdiff_t>(row) * glyph->bitmap.pitch + column] / 255.0, color);
    at += static_cast<double>(glyph->linearHoriAdvance) / 65536;
  }
}

double Canvas::widthOf(const std::string& text, double size) {
  font_->setSize(size);
  double width = 0;
  for (const char32_t character : charactersOf(text))
    if (const FT_GlyphSlot glyph = font_->load(character); glyph != nullptr)
      width += static_cast<double>(glyph->linearHoriAdvance) / 65536;
  return width;
}

std::string Canvas::shorten(const std::string& text, double size, double width) {
  if (widthOf(text, size) <= width) return text;
  std::string shorter = text;
  while (!shorter.empty()) {
    while (shorter.size() > 1 && (static_cast<unsigned char>(shorter.back()) & 0xc0) == 0x80) shorter.pop_back();
    shorter.pop_back();
    if (widthOf(shorter + "\u2026", size) <= width) return shorter + "\u2026";
  }
  return "";
}

}  // namespace tufted::view
