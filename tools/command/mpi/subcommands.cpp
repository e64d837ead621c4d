#include "subcommands.h"

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cmath>
#include <filesystem>
#include <limits>

#include "../numbers.h"
#include "../options.h"
#include "tufted/errors.h"
#include "tufted/io/results.h"

namespace {
constexpr double nan = std::numeric_limits<double>::quiet_NaN();
constexpr double infinity = std::numeric_limits<double>::infinity();
}  // namespace

void MpiResults::add(const std::string& name, std::vector<tufted::PetscVector> columns, double absent) {
  tufted::DistributedArray array = {name, {}, absent};
  for (tufted::PetscVector& column : columns) {
    array.columns.push_back(column.get());
    kept.push_back(std::move(column));
  }
  files.arrays.push_back(std::move(array));
}

namespace {

void add(MpiResults& results, const std::string& name, tufted::PetscVector values, double absent = nan) {
  std::vector<tufted::PetscVector> one;
  one.push_back(std::move(values));
  results.add(name, std::move(one), absent);
}

/// One coordinate of each point, by row.
tufted::PetscVector coordinateOf(const tufted::DistributedLaplacian& laplacian, const tufted::PointSource& source,
                                 int axis) {
  tufted::PetscVector by_point;
  VecDuplicate(laplacian.row.get(), by_point.make());
  PetscInt first = 0, last = 0;
  VecGetOwnershipRange(by_point.get(), &first, &last);
  PetscScalar* values = nullptr;
  VecGetArray(by_point.get(), &values);
  std::int64_t done = 0;
  source.pass([&](const tufted::PointsRef& batch) {
    for (Eigen::Index i = 0; i < batch.rows(); ++i, ++done)
      if (done >= first && done < last) values[done - first] = batch(i, axis);
  });
  VecRestoreArray(by_point.get(), &values);
  return valuesByRow(laplacian, by_point.get());
}

/// Values of the points, by row. @param given N x 1 in process 0; not used in the others
tufted::PetscVector valuesByRowOf(const tufted::DistributedLaplacian& laplacian, const Eigen::MatrixXd& given) {
  tufted::PetscVector by_point;
  VecDuplicate(laplacian.row.get(), by_point.make());
  for (Eigen::Index i = 0; i < given.rows(); ++i)
    VecSetValue(by_point.get(), static_cast<PetscInt>(i), given(i, 0), INSERT_VALUES);
  VecAssemblyBegin(by_point.get());
  VecAssemblyEnd(by_point.get());
  return valuesByRow(laplacian, by_point.get());
}

/// The index of a point. @param name option or line that gives it, for messages
std::int64_t pointOf(double number, std::int64_t points, const std::string& name) {
  if (!(number >= 0 && number < static_cast<double>(points) && number == std::floor(number)))
    throw tufted::InvalidInput(name + " is no index in [0, " + std::to_string(points) + "), the number of points");
  return static_cast<std::int64_t>(number);
}

struct LaplacianByRanks : MpiSubcommand {
  LaplacianByRanks()
      : MpiSubcommand("laplacian", "Write L and M as files of PETSc.", {"L.petsc", "M.petsc", "row.npy"}) {}
  void compute(const tufted::DistributedLaplacian&, const tufted::PointSource&, MpiResults& results) override {
    results.files.has_matrices = true;
  }
};

struct PoissonByRanks : MpiSubcommand {
  PoissonByRanks() : MpiSubcommand("poisson", "Solve L u = M f; writes u.npy.", {"u.npy"}) {}

  void addOptions(CLI::App& command) override {
    const CLI::Option* const by_file =
        addText(command, "--values NPY", file, "f, a .npy file of N values; process 0 reads it as a whole");
    const CLI::Option* const by_axis = command.add_option("--coordinate", axis, "f is a coordinate of the points")
                                           ->check(CLI::IsMember({"x", "y", "z"}));
    command.parse_complete_callback([by_file, by_axis] {
      if (by_file->count() + by_axis->count() != 1)
        throw CLI::RequiredError("exactly one of --values and --coordinate");
    });
  }

  void check(std::int64_t points) override {
    if (file.empty()) return;
    values = tufted::readArray(file);
    if (values.rows() != points || values.cols() != 1)
      throw tufted::InvalidInput(file.string() + " has " + std::to_string(values.rows()) + " x " +
                                 std::to_string(values.cols()) + " values, must have " + std::to_string(points) +
                                 " x 1, one per point");
  }

  void compute(const tufted::DistributedLaplacian& laplacian, const tufted::PointSource& source,
               MpiResults& results) override {
    const tufted::PetscVector f =
        file.empty() ? coordinateOf(laplacian, source, axis[0] - 'x') : valuesByRowOf(laplacian, values);
    add(results, "u", poisson(laplacian, f.get(), &results.solve.emplace()));
  }

  std::filesystem::path file;
  std::string axis;
  Eigen::MatrixXd values;  ///< in process 0
};

struct HarmonicByRanks : MpiSubcommand {
  HarmonicByRanks()
      : MpiSubcommand("harmonic", "Interpolate values of some points harmonically; writes values.npy.",
                      {"values.npy"}) {}

  void addOptions(CLI::App& command) override {
    addText(command, "--pins TEXT", file, "Text file of pins, lines INDEX VALUE")->required();
  }

  void check(std::int64_t number) override {
    for (const Row& row : readRows(file)) {
      if (row.numbers.size() != 2) throw tufted::IoError(row.name + ": is not INDEX VALUE");
      points.push_back(pointOf(row.numbers[0], number, row.name + ": " + numberText(row.numbers[0])));
      values.push_back(row.numbers[1]);
      names.push_back(row.name);
    }
  }

  void compute(const tufted::DistributedLaplacian& laplacian, const tufted::PointSource&,
               MpiResults& results) override {
    const std::vector<PetscInt> rows = rowsOf(laplacian, points);
    for (std::size_t i = 0; i < rows.size(); ++i)
      if (rows[i] < 0) throw tufted::InvalidInput(names[i] + " is a point that takes no part, must take part");
    add(results, "values", harmonic(laplacian, rows, values, &results.solve.emplace()));
  }

  std::filesystem::path file;
  // In process 0; empty in the others.
  std::vector<std::int64_t> points;
  std::vector<double> values;
  std::vector<std::string> names;
};

struct DistanceByRanks : MpiSubcommand {
  DistanceByRanks()
      : MpiSubcommand("distance", "Compute geodesic distances by the heat method; writes distance.npy.",
                      {"distance.npy"}) {}

  void addOptions(CLI::App& command) override {
    const auto check = [](const std::string& word) {
      double number = 0;
      return parseNumber(word, number) ? std::string() : word + " is no index";
    };
    addList(command, "--source", "Indices of the points from which distances are measured", check,
            [this](const std::vector<std::string>& words) { given = words; })
        ->type_name("I,J,...")
        ->required();
  }

  bool needsFaces() const override { return true; }

  void check(std::int64_t number) override {
    for (const std::string& word : given)
      points.push_back(pointOf(parseNumbers(word, "--source")[0], number, "--source " + word));
  }

  void compute(const tufted::DistributedLaplacian& laplacian, const tufted::PointSource&,
               MpiResults& results) override {
    std::vector<PetscInt> rows = rowsOf(laplacian, points);
    for (std::size_t i = 0; i < rows.size(); ++i)
      if (rows[i] < 0) results.warnings.push_back("--source " + given[i] + " takes no part, and is left out");
    rows.erase(std::remove(rows.begin(), rows.end(), -1), rows.end());
    if (rows.empty() && !points.empty())  // in process 0
      throw tufted::InvalidInput("--source: none of the points takes part");
    add(results, "distance", distance(laplacian, rows, &results.solve.emplace()), infinity);
  }

  std::vector<std::string> given;
  std::vector<std::int64_t> points;  ///< in process 0
};

struct SpectrumByRanks : MpiSubcommand {
  SpectrumByRanks()
      : MpiSubcommand("spectrum", "Find the smallest positive eigenvalues; writes evals.npy and evecs.npy.",
                      {"evals.npy", "evecs.npy"}) {}

  void addOptions(CLI::App& command) override {
    command.add_option("--count", count, "Number of eigenpairs")->check(CLI::PositiveNumber)->capture_default_str();
    command.add_option("--tolerance", tolerance, "Tolerance on their residual, below 1")
        ->check(CLI::Range(1e-15, 0.999))
        ->capture_default_str();
  }

  void compute(const tufted::DistributedLaplacian& laplacian, const tufted::PointSource&,
               MpiResults& results) override {
    tufted::DistributedSpectrum found = spectrum(laplacian, count, tolerance);
    results.solve = found.report;
    results.add("evecs", std::move(found.vectors), nan);
    results.files.lists = {{"evals", std::move(found.values)}};
  }

  int count = 10;
  double tolerance = 1e-9;
};

}  // namespace

std::vector<std::unique_ptr<MpiSubcommand>> mpiSubcommands() {
  std::vector<std::unique_ptr<MpiSubcommand>> all;
  all.push_back(std::make_unique<LaplacianByRanks>());
  all.push_back(std::make_unique<PoissonByRanks>());
  all.push_back(std::make_unique<HarmonicByRanks>());
  all.push_back(std::make_unique<DistanceByRanks>());
  all.push_back(std::make_unique<SpectrumByRanks>());
  return all;
}
