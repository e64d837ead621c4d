#include "io/ply_body.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstring>

#include "io/columns.h"
#include "io/errors.h"
#include "io/line_scanner.h"
#include "io/unread.h"

namespace tufted::io {
namespace {

/// Values as text, one item per line.
class AsciiPlyBody : public PlyBody {
 public:
  AsciiPlyBody(const std::filesystem::path& path, std::string_view bytes, const PlyHeader& header)
      : path_(path), bytes_(bytes), scanner_(path, bytes) {
    scanner_.seek(header.body, header.line);
  }

  void beginItem(const PlyElement& element) override {
    if (!scanner_.next()) refuse("the file ends inside the element " + quote(element.name));
    token_ = 0;
  }

  void endItem() override {
    if (token_ != scanner_.tokens().size())
      refuse(std::to_string(scanner_.tokens().size()) + " values where " + std::to_string(token_) + " are expected");
  }

  void end(Geometry& geometry) override { noteUnreadLines(path_, bytes_, scanner_, geometry); }

  void value(FieldType type, std::byte* bytes) override {
    if (token_ == scanner_.tokens().size()) refuse("more values expected than " + std::to_string(token_));
    if (!parseInto(scanner_.tokens()[token_], type, bytes))
      refuse(quote(scanner_.tokens()[token_]) + " is not a number of its property's type");
    ++token_;
  }

  std::int64_t place() const override { return scanner_.line(); }
  const char* placeName() const override { return "line"; }
  void refuse(const std::string& reason) const override { scanner_.refuse(reason); }

 protected:
  std::int64_t mostValues(FieldType) const override {
    return static_cast<std::int64_t>(scanner_.tokens().size() - token_);
  }

 private:
  const std::filesystem::path& path_;
  std::string_view bytes_;
  LineScanner scanner_;
  std::size_t token_ = 0;
};

class BinaryPlyBody : public PlyBody {
 public:
  BinaryPlyBody(const std::filesystem::path& path, std::string_view bytes, const PlyHeader& header)
      : path_(path),
        bytes_(bytes),
        offset_(header.body),
        swap_((header.format == PlyHeader::Format::big_endian) != (std::endian::native == std::endian::big)) {}

  void beginItem(const PlyElement&) override { item_ = offset_; }
  void endItem() override {}
  void end(Geometry& geometry) override { noteUnread(path_, bytes_, offset_, geometry); }

  void value(FieldType type, std::byte* bytes) override {
    const std::size_t size = sizeOf(type);
    if (size > bytes_.size() - offset_) refuseByte(path_, bytes_.size(), "the file ends inside an element");
    std::memcpy(bytes, bytes_.data() + offset_, size);
    if (swap_) std::reverse(bytes, bytes + size);
    offset_ += size;
  }

  std::int64_t place() const override { return static_cast<std::int64_t>(item_); }
  const char* placeName() const override { return "byte"; }
  void refuse(const std::string& reason) const override { refuseByte(path_, item_, reason); }

 protected:
  std::int64_t mostValues(FieldType type) const override {
    return static_cast<std::int64_t>((bytes_.size() - offset_) / sizeOf(type));
  }

 private:
  const std::filesystem::path& path_;
  std::string_view bytes_;
  std::size_t offset_;
  std::size_t item_ = 0;
  bool swap_;
};

}  // namespace

std::int64_t PlyBody::integer(FieldType type) {
  std::byte bytes[sizeof(double)];
  value(type, bytes);
  return static_cast<std::int64_t>(valueOf(type, bytes));
}

std::int64_t PlyBody::listLength(const PlyProperty& property) {
  const std::int64_t length = integer(property.count_type);
  if (length < 0 || length > mostValues(property.type))
    refuse("a list of " + std::to_string(length) + " values does not fit");
  return length;
}

void PlyBody::skip(const PlyProperty& property) {
  std::byte bytes[sizeof(double)];
  const std::int64_t values = property.is_list ? listLength(property) : 1;
  for (std::int64_t v = 0; v < values; ++v) value(property.type, bytes);
}

std::unique_ptr<PlyBody> makePlyBody(const std::filesystem::path& path, std::string_view bytes,
                                     const PlyHeader& header) {
  if (header.format == PlyHeader::Format::ascii) return std::make_unique<AsciiPlyBody>(path, bytes, header);
  return std::make_unique<BinaryPlyBody>(path, bytes, header);
}

}  // namespace tufted::io
