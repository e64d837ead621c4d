#include "io/npz_reader.h"

#include <algorithm>
#include <cmath>

#include "io/columns.h"
#include "io/errors.h"
#include "io/file_text.h"

namespace tufted::io {
namespace {

/// Size of a piece: how many numbers are inflated at once.
constexpr std::int64_t piece_numbers = 8192;
/// Most bytes of an array's header; numpy writes one or two hundred.
constexpr std::size_t most_header_bytes = 1 << 16;

int integerOf(double number, double least, double most, std::int64_t place, const std::filesystem::path& shown) {
  if (!(number >= least && number <= most) || number != std::floor(number))
    refuse(shown, "value " + std::to_string(place) + " is none of those expected");
  return static_cast<int>(number);
}

}  // namespace

double NpzArray::next() {
  if (place_ == piece_.size()) readPiece();
  return piece_[place_++];
}

int NpzArray::nextInteger(double least, double most) {
  const double number = next();
  return integerOf(number, least, most, taken_ - std::ssize(piece_) + static_cast<std::int64_t>(place_) - 1, path_);
}

std::string NpzArray::take(std::size_t bytes) {
  std::string content(bytes, '\0');
  if (!stream_.read(content.data(), bytes)) refuseDamaged();
  return content;
}

void NpzArray::takeHeader(std::uint64_t all) {
  std::string bytes = take(static_cast<std::size_t>(std::min<std::uint64_t>(all, npy_beginning)));
  const std::size_t header_bytes = npyHeaderBytes(bytes, path_);
  if (header_bytes > all || header_bytes > most_header_bytes) refuseDamaged();
  if (header_bytes > bytes.size()) bytes += take(header_bytes - bytes.size());
  header_ = parseNpyHeader(bytes, all, path_);
  value_bytes_ = all - header_bytes;
}

void NpzArray::readPiece() {
  const std::int64_t count = std::min(piece_numbers, size() - taken_);
  piece_ = numbersOf(header_, take(static_cast<std::size_t>(count) * sizeOf(numberType(header_, path_))), path_);
  place_ = 0;
  taken_ += count;
}

void NpzArray::refuseDamaged() const {
  refuse(path_, "the array " + quote(name_) + " is damaged");
}

NpzReader::NpzReader(const std::filesystem::path& path) : path_(path), bytes_(readBytes(path)) {
  auto entries = readZipDirectory(bytes_);
  if (!entries) refuse(path_, "is no archive of numpy");
  entries_ = std::move(*entries);
}

NpzArray NpzReader::open(const std::string& name) const {
  const auto found = entries_.find(name + ".npy");
  if (found == entries_.end()) refuse(path_, "has no array " + quote(name));
  const ZipEntry& entry = found->second;
  if (!entry.is_readable)
    refuse(path_, "the array " + quote(name) + " is encrypted, or compressed in another way than by deflate");
  // Deflate shrinks by a factor of at most 1032.
  if (entry.size / 2048 > bytes_.size()) refuse(path_, "the array " + quote(name) + " claims to be too large");
  NpzArray array(path_, name, entry);
  array.takeHeader(entry.size);
  return array;
}

std::vector<double> NpzReader::numbers(const std::string& name, std::int64_t count) const {
  NpzArray array = open(name);
  if (array.size() != count)
    refuse(path_, "the array " + quote(name) + " has " + std::to_string(array.size()) + " values, must have " +
                      std::to_string(count));
  std::vector<double> numbers;
  for (std::int64_t i = 0; i < count; ++i) numbers.push_back(array.next());
  return numbers;
}

std::string NpzReader::text(const std::string& name) const {
  // Most bytes of a text.
  constexpr std::uint64_t most = 64;
  NpzArray array = open(name);
  if (array.value_bytes_ > most) refuse(path_, "the array " + quote(name) + " is no word");
  return array.take(static_cast<std::size_t>(array.value_bytes_));
}

std::vector<int> integersOf(const std::vector<double>& numbers, double least, double most,
                            const std::filesystem::path& shown) {
  std::vector<int> result(numbers.size());
  for (std::size_t i = 0; i < numbers.size(); ++i)
    result[i] = integerOf(numbers[i], least, most, static_cast<std::int64_t>(i), shown);
  return result;
}

}  // namespace tufted::io
