#include "io/pcd_binary.h"

#include <pcl/PCLPointCloud2.h>
#include <pcl/console/print.h>
#include <pcl/io/pcd_io.h>

#include <cstring>
#include <exception>
#include <mutex>

#include "io/errors.h"

namespace tufted::io {
namespace {

/// PCL's console is one per process: it is silent while this lives, and one reader at a time changes it.
class QuietPcl {
 public:
  QuietPcl() : lock_(mutex()), before_(pcl::console::getVerbosityLevel()) {
    pcl::console::setVerbosityLevel(pcl::console::L_ALWAYS);
  }
  ~QuietPcl() { pcl::console::setVerbosityLevel(before_); }
  QuietPcl(const QuietPcl&) = delete;
  QuietPcl& operator=(const QuietPcl&) = delete;

 private:
  static std::mutex& mutex() {
    static std::mutex shared;
    return shared;
  }

  std::scoped_lock<std::mutex> lock_;
  pcl::console::VERBOSITY_LEVEL before_;
};

void checkSize(const std::filesystem::path& path, std::string_view bytes, const PcdHeader& header) {
  const std::size_t rest = bytes.size() - std::min(header.body, bytes.size());
  // Both factors are checked: points < 2^31, row_bytes < 8e6 per field.
  const std::uint64_t expected = static_cast<std::uint64_t>(header.points) * header.row_bytes;
  if (header.data == PcdHeader::Data::binary) {
    if (expected > rest)
      refuseByte(path, bytes.size(),
                 "ends there; " + std::to_string(header.points) + " points of " + std::to_string(header.row_bytes) +
                     " bytes need " + std::to_string(header.body + expected));
    return;
  }
  std::uint32_t sizes[2];  // compressed, uncompressed
  if (rest < sizeof(sizes)) refuseByte(path, bytes.size(), "ends before the compressed data");
  std::memcpy(sizes, bytes.data() + header.body, sizeof(sizes));
  if (sizes[0] > rest - sizeof(sizes))
    refuseByte(path, bytes.size(),
               "ends there; the compressed data need " + std::to_string(header.body + sizeof(sizes) + sizes[0]));
  if (sizes[1] > expected)
    refuseByte(path, header.body + 4,
               "the compressed data hold " + std::to_string(sizes[1]) + " bytes, not the " + std::to_string(expected) +
                   " of the header");
  // LZF turns three bytes into 264 at best.
  if (static_cast<double>(sizes[1]) > 88.0 * sizes[0] + 264)
    refuseByte(path, header.body, "the compressed data are too short for what they are said to hold");
}

pcl::PCLPointCloud2 decode(const std::filesystem::path& path) {
  pcl::PCLPointCloud2 cloud;
  const QuietPcl quiet;
  int code = 0;
  try {
    code = pcl::PCDReader().read(path.string(), cloud);
  } catch (const std::bad_alloc&) {
    throw;
  } catch (const std::exception& error) {
    refuse(path, std::string("PCL cannot read it: ") + error.what());
  }
  if (code < 0) refuse(path, "PCL cannot read it");
  return cloud;
}

}  // namespace

void readPcdBinary(const std::filesystem::path& path, std::string_view bytes, PcdHeader& header) {
  checkSize(path, bytes, header);
  allocate(header.columns, header.points);
  if (header.points == 0) return;
  const pcl::PCLPointCloud2 cloud = decode(path);
  const std::size_t step = cloud.point_step;
  if (static_cast<std::int64_t>(cloud.width) * cloud.height != header.points ||
      cloud.data.size() != header.points * step)
    refuse(path, "PCL read another number of points than the header says");
  // PCL leaves padding out of its list of fields.
  std::size_t next = 0;
  for (Field& field : header.columns.fields) {
    if (field.name == "_") continue;
    while (next < cloud.fields.size() && cloud.fields[next].name == "_") ++next;
    const std::size_t size = sizeOf(field.type) * field.count;
    if (next >= cloud.fields.size() || cloud.fields[next].name != field.name || cloud.fields[next].offset + size > step)
      refuse(path, "PCL does not read the field " + quote(field.name));
    const std::uint8_t* source = cloud.data.data() + cloud.fields[next++].offset;
    for (std::int64_t i = 0; i < header.points; ++i)
      std::memcpy(field.bytes.data() + i * size, source + i * step, size);
  }
}

}  // namespace tufted::io
