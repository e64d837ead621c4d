#include <bit>
#include <initializer_list>
#include <limits>
#include <string>
#include <string_view>

#include "io/errors.h"
#include "io/matrix_writers.h"

namespace tufted::io {
namespace {

// "MAT-File Level 5 File Format" (The MathWorks), chapter 1: numbers of the types of data and of the classes of arrays.
enum class Type : std::uint32_t { int8 = 1, uint8 = 2, int32 = 5, uint32 = 6, float64 = 9, matrix = 14, utf8 = 16 };
enum class Class : std::uint32_t { text = 4, sparse = 5, float64 = 6, uint8 = 9, int32 = 12 };

/// Values of one type, borrowed.
struct Element {
  Type type;
  const void* values;
  std::uint64_t bytes;
};

/// Elements start at multiples of 8 bytes.
std::uint64_t padded(std::uint64_t bytes) {
  return (bytes + 7) / 8 * 8;
}

constexpr std::uint64_t most = std::numeric_limits<std::int32_t>::max();  // bytes of a variable

/// A MATLAB 5 file being written, in this machine's order of bytes.
class MatFile {
 public:
  explicit MatFile(const OutputPath& to) : shown_(to.shown), file_(to) {
    static_assert(std::endian::native == std::endian::little, "the mark IM says so");
    // No date, so that equal matrices give equal files.
    std::string header = "MATLAB 5.0 MAT-file, written by tufted; see the variable `conventions`";
    header.resize(124, ' ');
    file_.write(header + std::string("\0\1IM", 4));  // version 0x0100
  }

  /// Writes a variable. @param nonzeros of a sparse matrix @throws IoError also where it is too large
  void write(std::string_view name, Class kind, Eigen::Index rows, Eigen::Index columns,
             std::initializer_list<Element> values, std::uint32_t nonzeros = 0) {
    const std::uint32_t flags[2] = {static_cast<std::uint32_t>(kind), nonzeros};
    const std::int32_t dimensions[2] = {static_cast<std::int32_t>(rows), static_cast<std::int32_t>(columns)};
    const Element beginning[3] = {{Type::uint32, flags, sizeof flags},
                                  {Type::int32, dimensions, sizeof dimensions},
                                  {Type::int8, name.data(), name.size()}};
    std::uint64_t bytes = 0;
    for (const Element& element : beginning) bytes += 8 + padded(element.bytes);
    for (const Element& element : values) bytes += 8 + padded(element.bytes);
    if (bytes > most)
      refuse(shown_, "cannot write: " + std::string(name) + " takes " + std::to_string(bytes) +
                         " bytes, and a MATLAB 5 file holds at most " + std::to_string(most) +
                         " per variable; other formats have room");
    writeTag(Type::matrix, bytes);
    for (const Element& element : beginning) writeElement(element);
    for (const Element& element : values) writeElement(element);
  }

  void close() { file_.close(); }

 private:
  void writeTag(Type type, std::uint64_t bytes) {
    const std::uint32_t tag[2] = {static_cast<std::uint32_t>(type), static_cast<std::uint32_t>(bytes)};
    file_.write(tag, sizeof tag);
  }

  void writeElement(const Element& element) {
    writeTag(element.type, element.bytes);
    file_.write(element.values, element.bytes);
    file_.write(std::string(padded(element.bytes) - element.bytes, '\0'));
  }

  std::filesystem::path shown_;
  OutputFile file_;
};

}  // namespace

void writeMat(const OutputPath& to, const SparseMatrix& L, const VectorXd& M, const Laplacian& laplacian,
              const std::vector<Convention>& conventions) {
  const std::size_t points = M.size();
  const std::string text = conventionLines(conventions, "");

  const auto nonzeros = static_cast<std::uint64_t>(L.nonZeros()), ends = static_cast<std::uint64_t>(L.cols()) + 1;
  MatFile file(to);
  file.write("L", Class::sparse, L.rows(), L.cols(),
             {{Type::int32, L.innerIndexPtr(), nonzeros * sizeof(int)},
              {Type::int32, L.outerIndexPtr(), ends * sizeof(int)},
              {Type::float64, L.valuePtr(), nonzeros * sizeof(double)}},
             static_cast<std::uint32_t>(nonzeros));
  file.write("M", Class::float64, M.size(), 1, {{Type::float64, M.data(), points * sizeof(double)}});
  file.write("status", Class::uint8, M.size(), 1, {{Type::uint8, laplacian.status.data(), points}});
  file.write("representative", Class::int32, M.size(), 1,
             {{Type::int32, laplacian.representative.data(), points * sizeof(int)}});
  file.write("boundary", Class::uint8, M.size(), 1, {{Type::uint8, laplacian.boundary.data(), points}});
  file.write("conventions", Class::text, 1, std::ssize(text), {{Type::utf8, text.data(), text.size()}});
  file.close();
}

}  // namespace tufted::io
