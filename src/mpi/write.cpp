#include "tufted/mpi/write.h"

#include <petscviewer.h>

#include <limits>
#include <memory>
#include <nlohmann/json.hpp>

#include "io/npy.h"
#include "io/output_file.h"
#include "io/report_json.h"
#include "io/result_folder.h"
#include "io/staged_files.h"
#include "mpi/petsc.h"
#include "mpi/point_values.h"
#include "mpi/rows.h"

namespace tufted {
namespace {

using Viewer = PetscHandle<PetscViewer, PetscViewerDestroy>;

/// Calls take(values) in process 0 for the values of each process, in order. @param own of this process
template <class Take>
void forProcesses(MPI_Comm comm, std::vector<double> own, const Take& take) {
  int number = 0, processes = 0;
  MPI_Comm_rank(comm, &number);
  MPI_Comm_size(comm, &processes);
  if (own.size() > std::numeric_limits<int>::max())
    throw InvalidInput("writeDistributed: " + std::to_string(own.size()) + " values of a process, must be less than " +
                       "2^31: take more processes");
  if (number != 0) {
    const auto size = static_cast<int>(own.size());
    MPI_Send(&size, 1, MPI_INT, 0, 0, comm);
    MPI_Send(own.data(), size, MPI_DOUBLE, 0, 0, comm);
    return;
  }
  take(own);
  for (int process = 1; process < processes; ++process) {
    int size = 0;
    MPI_Recv(&size, 1, MPI_INT, process, 0, comm, MPI_STATUS_IGNORE);
    own.resize(static_cast<std::size_t>(size));
    MPI_Recv(own.data(), size, MPI_DOUBLE, process, 0, comm, MPI_STATUS_IGNORE);
    take(own);
  }
}

/// The values of this process's block of points, point by point.
std::vector<double> blockOf(const DistributedLaplacian& laplacian, const DistributedArray& array) {
  std::vector<double> block;
  const std::size_t columns = array.columns.size();
  for (std::size_t c = 0; c < columns; ++c) {
    const std::vector<double> values = localOf(valuesByPoint(laplacian, array.columns[c], array.absent).get());
    block.resize(values.size() * columns);
    for (std::size_t i = 0; i < values.size(); ++i) block[i * columns + c] = values[i];
  }
  return block;
}

/// Writes a matrix or a vector by all processes, at a path that process 0 has chosen.
template <class Object, class View>
void writePetsc(MPI_Comm comm, io::StagedFiles* files, const std::filesystem::path& dir, const char* name,
                Object object, const View& view) try {
  std::string path = files != nullptr ? files->stage(name).path.string() : "";
  auto size = static_cast<int>(path.size());
  MPI_Bcast(&size, 1, MPI_INT, 0, comm);
  path.resize(static_cast<std::size_t>(size));
  MPI_Bcast(path.data(), size, MPI_CHAR, 0, comm);
  Viewer viewer;
  check(PetscViewerCreate(comm, viewer.make()));
  check(PetscViewerSetType(viewer.get(), PETSCVIEWERBINARY));
  check(PetscViewerFileSetMode(viewer.get(), FILE_MODE_WRITE));
  check(PetscViewerBinarySetSkipInfo(viewer.get(), PETSC_TRUE));
  check(PetscViewerFileSetName(viewer.get(), path.c_str()));
  check(view(object, viewer.get()));
  PetscViewer open = viewer.release();
  check(PetscViewerDestroy(&open));  // writes what is still buffered
} catch (const SolverFailure& error) {
  throw IoError((dir / name).string() + ": cannot write: " + error.what());
}

void writeList(io::StagedFiles& files, const std::string& name, const std::vector<double>& values) {
  io::OutputFile file(files.stage(name + ".npy"));
  file.write(io::npyHeader("<f8", {std::ssize(values)}));
  file.write(values.data(), values.size() * sizeof(double));
  file.close();
}

}  // namespace

void writeDistributed(const std::filesystem::path& dir, const DistributedLaplacian& laplacian,
                      const DistributedResult& result) {
  auto report = nlohmann::ordered_json::parse(result.report, nullptr, false);
  if (!report.is_object()) throw InvalidInput("writeDistributed: report must be a JSON object");
  const MPI_Comm comm = commOf(laplacian);
  int number = 0;
  MPI_Comm_rank(comm, &number);
  const std::unique_ptr<io::StagedFiles> files = number == 0 ? std::make_unique<io::StagedFiles>(dir) : nullptr;
  const std::int64_t points = laplacian.report.points;
  if (result.has_matrices) {
    writePetsc(comm, files.get(), dir, "L.petsc", laplacian.L.get(), MatView);
    writePetsc(comm, files.get(), dir, "M.petsc", laplacian.M.get(), VecView);
    std::unique_ptr<io::OutputFile> file;
    if (files) file = std::make_unique<io::OutputFile>(files->stage("row.npy"));
    if (files) file->write(io::npyHeader("<i8", {points}));
    forProcesses(comm, localOf(laplacian.row.get()), [&](const std::vector<double>& rows) {
      const std::vector<std::int64_t> numbers(rows.begin(), rows.end());
      file->write(numbers.data(), numbers.size() * sizeof(std::int64_t));
    });
    if (files) file->close();
  }
  for (const DistributedArray& array : result.arrays) {
    std::vector<std::int64_t> shape = {points};
    if (array.columns.size() > 1) shape.push_back(std::ssize(array.columns));
    std::unique_ptr<io::OutputFile> file;
    if (files) file = std::make_unique<io::OutputFile>(files->stage(array.name + ".npy"));
    if (files) file->write(io::npyHeader("<f8", shape));
    forProcesses(comm, blockOf(laplacian, array), [&](const std::vector<double>& values) {
      file->write(values.data(), values.size() * sizeof(double));
    });
    if (files) file->close();
  }
  if (files) {
    for (const auto& [name, values] : result.lists) writeList(*files, name, values);
    const io::OutputPath path = files->stage(io::report_name);
    report["files"] = files->names();
    io::OutputFile file(path);
    file.write(io::jsonText(report));
    file.close();
    files->commit();
  }
  MPI_Barrier(comm);  // all files are there when any process goes on
}

}  // namespace tufted
