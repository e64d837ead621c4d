#include <string>

#include "io/matrix_writers.h"
#include "io/output_file.h"

namespace tufted::io {
namespace {

void writeLine(OutputFile& file, double value) {
  file.writeNumber(value);
  file.write("\n");
}

/// Writes a line with row and column counted from 1.
void writeLine(OutputFile& file, Eigen::Index row, Eigen::Index column, double value) {
  file.writeInteger(row + 1);
  file.write(" ");
  file.writeInteger(column + 1);
  file.write(" ");
  writeLine(file, value);
}

std::string mtxHeader(const std::string& kind, const std::vector<Convention>& conventions) {
  return "%%MatrixMarket matrix " + kind + "\n" + conventionLines(conventions, "% ");
}

/// Calls `visit(row, column, value)` for each stored entry, column by column.
template <class Visitor>
void visitEntries(const SparseMatrix& matrix, Visitor&& visit) {
  for (Eigen::Index column = 0; column < matrix.outerSize(); ++column)
    for (SparseMatrix::InnerIterator entry(matrix, column); entry; ++entry) visit(entry.row(), column, entry.value());
}

}  // namespace

void writeMtx(const OutputPath& to, const SparseMatrix& matrix, const std::vector<Convention>& conventions) {
  std::int64_t lower = 0;
  visitEntries(matrix, [&](Eigen::Index row, Eigen::Index column, double) { lower += row >= column ? 1 : 0; });
  OutputFile file(to);
  file.write(mtxHeader("coordinate real symmetric", conventions));
  file.write(std::to_string(matrix.rows()) + " " + std::to_string(matrix.cols()) + " " + std::to_string(lower) + "\n");
  visitEntries(matrix, [&](Eigen::Index row, Eigen::Index column, double value) {
    if (row >= column) writeLine(file, row, column, value);
  });
  file.close();
}

void writeMtx(const OutputPath& to, const VectorXd& values, const std::vector<Convention>& conventions) {
  OutputFile file(to);
  file.write(mtxHeader("array real general", conventions));
  file.write(std::to_string(values.size()) + " 1\n");
  for (const double value : values) writeLine(file, value);
  file.close();
}

void writeSpmat(const OutputPath& to, const SparseMatrix& matrix) {
  OutputFile file(to);
  const Eigen::Index last = matrix.cols() - 1;
  bool has_last = last < 0;
  visitEntries(matrix, [&](Eigen::Index row, Eigen::Index column, double value) {
    writeLine(file, row, column, value);
    has_last = has_last || (row == last && column == last);
  });
  if (!has_last) writeLine(file, last, last, 0);
  file.close();
}

void writeSpmat(const OutputPath& to, const VectorXd& values) {
  OutputFile file(to);
  for (Eigen::Index i = 0; i < values.size(); ++i) writeLine(file, i, i, values(i));
  file.close();
}

}  // namespace tufted::io
