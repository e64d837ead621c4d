#include "io/matrix_text.h"

#include <string>

#include "io/output_buffer.h"

namespace tufted::io {
namespace {

/// Writes lines of text with rows and columns counted from 1.
class MatrixText {
 public:
  explicit MatrixText(const OutputPath& to) : file_(to), buffer_(file_) {}

  void text(std::string_view text) { buffer_.append(text); }

  void value(double value) {
    buffer_.appendNumber(value);
    buffer_.append("\n");
  }

  void entry(Eigen::Index row, Eigen::Index column, double value) {
    buffer_.appendInteger(row + 1);
    buffer_.append(" ");
    buffer_.appendInteger(column + 1);
    buffer_.append(" ");
    this->value(value);
  }

  void close() {
    buffer_.flush();
    file_.close();
  }

 private:
  OutputFile file_;
  OutputBuffer buffer_;
};

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
  MatrixText out(to);
  out.text(mtxHeader("coordinate real symmetric", conventions));
  out.text(std::to_string(matrix.rows()) + " " + std::to_string(matrix.cols()) + " " + std::to_string(lower) + "\n");
  visitEntries(matrix, [&](Eigen::Index row, Eigen::Index column, double value) {
    if (row >= column) out.entry(row, column, value);
  });
  out.close();
}

void writeMtx(const OutputPath& to, const VectorXd& values, const std::vector<Convention>& conventions) {
  MatrixText out(to);
  out.text(mtxHeader("array real general", conventions));
  out.text(std::to_string(values.size()) + " 1\n");
  for (const double value : values) out.value(value);
  out.close();
}

void writeSpmat(const OutputPath& to, const SparseMatrix& matrix) {
  MatrixText out(to);
  const Eigen::Index last = matrix.cols() - 1;
  bool has_last = last < 0;
  visitEntries(matrix, [&](Eigen::Index row, Eigen::Index column, double value) {
    out.entry(row, column, value);
    has_last = has_last || (row == last && column == last);
  });
  if (!has_last) out.entry(last, last, 0);
  out.close();
}

void writeSpmat(const OutputPath& to, const VectorXd& values) {
  MatrixText out(to);
  for (Eigen::Index i = 0; i < values.size(); ++i) out.entry(i, i, values(i));
  out.close();
}

}  // namespace tufted::io
