#include <unistd.h>
#include <zip.h>

#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <string>
#include <string_view>
#include <vector>

#include "tufted/check.h"
#include "tufted/errors.h"
#include "tufted/io/results.h"

// Any folder at all is either a Laplacian that keeps its word about sizes and indices, or refused with an IoError of
// one line that names a file of it. The bytes are pieces, each of a byte that says which file, two of its length, and
// its content. Members of archives are packed here: their checksums would stop every change to them.

namespace {

struct Piece {
  const char* archive;  ///< null: a file of its own
  const char* name;
};
constexpr Piece pieces[] = {{nullptr, "report.json"},
                            {nullptr, "M.npy"},
                            {nullptr, "status.npy"},
                            {nullptr, "representative.npy"},
                            {nullptr, "boundary.npy"},
                            {nullptr, "frames.npy"},
                            {nullptr, "L.npz"},
                            {nullptr, "cover.npz"},
                            {"L.npz", "format.npy"},
                            {"L.npz", "shape.npy"},
                            {"L.npz", "indptr.npy"},
                            {"L.npz", "indices.npy"},
                            {"L.npz", "data.npy"},
                            {"cover.npz", "faces.npy"},
                            {"cover.npz", "glue.npy"},
                            {"cover.npz", "length.npy"},
                            {nullptr, "measured_positions.npy"},
                            {nullptr, "noise.npy"},
                            {nullptr, "component_edges.npy"}};

void require(bool condition) {
  if (!condition) std::abort();
}

std::filesystem::path makeFolder() {
  const std::filesystem::path folder =
      std::filesystem::temp_directory_path() / ("fuzz_laplacian_" + std::to_string(getpid()));
  std::filesystem::create_directory(folder);
  std::atexit([] {
    std::error_code error;
    std::filesystem::remove_all(std::filesystem::temp_directory_path() / ("fuzz_laplacian_" + std::to_string(getpid())),
                                error);
  });
  return folder;
}

void addTo(const std::filesystem::path& archive, const char* name, std::string_view content) {
  int error = 0;
  zip_t* const zip = zip_open(archive.c_str(), ZIP_CREATE, &error);
  if (zip == nullptr) return;  // a piece before was the archive itself, and is not a valid one
  zip_source_t* const source = zip_source_buffer(zip, content.data(), content.size(), 0);
  zip_int64_t index = zip_file_add(zip, name, source, ZIP_FL_OVERWRITE);
  if (index < 0) zip_source_free(source);
  if (index >= 0) zip_set_file_compression(zip, index, ZIP_CM_STORE, 0);
  if (zip_close(zip) != 0) zip_discard(zip);
}

void writeFolder(const std::filesystem::path& folder, std::string_view bytes) {
  for (const Piece& piece : pieces) std::filesystem::remove(folder / piece.name);
  while (bytes.size() >= 3) {
    const auto byte = [&](std::size_t i) { return static_cast<std::size_t>(static_cast<unsigned char>(bytes[i])); };
    const Piece& piece = pieces[byte(0) % std::size(pieces)];
    const std::string_view content = bytes.substr(3, byte(1) | byte(2) << 8);
    bytes.remove_prefix(3 + content.size());
    if (piece.archive != nullptr)
      addTo(folder / piece.archive, piece.name, content);
    else
      std::ofstream(folder / piece.name, std::ios::binary) << content;
  }
}

void checkLaplacian(const tufted::Laplacian& laplacian) {
  const auto n = static_cast<Eigen::Index>(laplacian.status.size());
  require(laplacian.L.rows() == n && laplacian.L.cols() == n && laplacian.M.size() == n);
  require(std::ssize(laplacian.representative) == n && std::ssize(laplacian.boundary) == n);
  for (const int i : laplacian.representative) require(i >= 0 && i < n);
  require(laplacian.frames.normals.rows() == 0 || laplacian.frames.normals.rows() == n);
  require(laplacian.positions.rows() == 0 || laplacian.positions.rows() == n);
  // What the reader judges by itself, validate() finds kept.
  for (const std::string& fault : tufted::validate(laplacian).faults)
    for (const char* promise : {"storage", "status", "boundary", "finite", "off-diagonal sign", "positive diagonal",
                                "mass", "inactive is zero", "symmetry", "row sum", "representative", "position"})
      require(!fault.starts_with(std::string(promise) + ": "));
  if (!laplacian.hasCover()) return;
  const tufted::IntrinsicTriangulation& cover = laplacian.cover();
  for (const auto& face : cover.faces)
    for (const int corner : face) require(corner >= 0 && corner < n);
  const tufted::CoverCheck check = tufted::validate(cover);
  require(check.not_closed + check.not_edge_manifold + check.not_oriented + check.unequal_lengths == 0);
  require(check.triangle_inequality == 0);
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  static const std::filesystem::path folder = makeFolder();
  writeFolder(folder, {reinterpret_cast<const char*>(data), size});
  try {
    checkLaplacian(tufted::readLaplacian(folder));
  } catch (const tufted::IoError& error) {
    const std::string_view message = error.what();
    require(message.starts_with(folder.string() + "/"));
    require(message.find('\n') == std::string_view::npos);
  }
  return 0;
}
