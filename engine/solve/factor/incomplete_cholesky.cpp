#include "engine/solve/factor/incomplete_cholesky.hpp"

#include <cmath>
#include <cstring>

namespace isojam {

namespace {

// Vectors have eight lanes even if the processor has only shorter ones: a lane is a row, so no sum depends on the
// length. The products are not fused multiply-adds, which some x86-64 processors lack.
constexpr int lanes = 8;
using Floats = float __attribute__((vector_size(lanes * sizeof(float))));
using Doubles = double __attribute__((vector_size(lanes * sizeof(double))));

/// Computes sum += block · x. `block` has six columns of eight rows.
inline void add_product(const float* block, const Floats& x, Floats& sum) {
  // NOLINTNEXTLINE(cppcoreguidelines-pro-type-reinterpret-cast): from memory, an entry is copied to all lanes at once
  const auto* const entries = reinterpret_cast<const float*>(&x);
#pragma GCC unroll 6
  for (int k = 0; k < 6; ++k) {
    Floats column;
    std::memcpy(&column, block + lanes * k, sizeof column);
    sum += column * entries[k];
  }
}

/// A 6×6 block by columns that are padded to eight rows.
struct Padded {
  Doubles columns[6];

  explicit Padded(const Matrix6d& m) {
    for (int c = 0; c < 6; ++c) {
      columns[c] = Doubles{};
      std::memcpy(&columns[c], m.data() + 6 * c, 6 * sizeof(double));
    }
  }
};

/// Computes c −= a · b.
inline void subtract_product(const Padded& a, const Matrix6d& b, Matrix6d& c) {
  for (int j = 0; j < 6; ++j) {
    Doubles sum{};
#pragma GCC unroll 6
    for (int k = 0; k < 6; ++k) sum += a.columns[k] * b(k, j);
    for (int i = 0; i < 6; ++i) c(i, j) -= sum[i];
  }
}

template <class Block>
void store(const Matrix6d& m, Block& single) {
  single.setZero();
  single.template topRows<6>() = m.cast<float>();
}

/// L⁻¹ for the Cholesky factor L of `a`. Returns false if `a` is not positive definite.
bool invert_root(const Matrix6d& a, Matrix6d& inverse) {
  constexpr double least_pivot = 1e-8;  // smaller ones consist of rounding errors of the preceding eliminations
  Matrix6d l = Matrix6d::Zero();
  for (int j = 0; j < 6; ++j) {
    double pivot = a(j, j);
    for (int k = 0; k < j; ++k) pivot -= l(j, k) * l(j, k);
    if (!(pivot > least_pivot * a(j, j))) return false;
    l(j, j) = std::sqrt(pivot);
    for (int i = j + 1; i < 6; ++i) {
      double sum = a(i, j);
      for (int k = 0; k < j; ++k) sum -= l(i, k) * l(j, k);
      l(i, j) = sum / l(j, j);
    }
  }
  inverse = l.triangularView<Eigen::Lower>().solve(Matrix6d::Identity());
  return inverse.allFinite();
}

}  // namespace

bool IncompleteCholesky::eliminate(int k) {
  Matrix6d inverse;
  if (!invert_root(pivots_[k], inverse)) return false;
  store(inverse, inverse_[k]);
  store(inverse.transpose(), inverse_transposed_[k]);
  const Padded left(inverse);
  const int first = begin_[k], last = begin_[k + 1];
  for (int b = first; b < last; ++b) {
    Matrix6d scaled = Matrix6d::Zero();
    subtract_product(left, -upper_[b], scaled);
    upper_[b] = scaled;
    store(scaled, upper_single_[b]);
    store(scaled.transpose(), upper_transposed_[b]);
  }
  for (int b = first; b < last; ++b) {
    const Padded transposed(upper_[b].transpose());
    const int row = columns_[b];
    subtract_product(transposed, upper_[b], pivots_[row]);
    // Blocks of both rows that have the same column; where row `row` has none, the product is dropped.
    int at = begin_[row];
    for (int c = b + 1; c < last; ++c) {
      while (at < begin_[row + 1] && columns_[at] < columns_[c]) ++at;
      if (at == begin_[row + 1]) break;
      if (columns_[at] == columns_[c]) subtract_product(transposed, upper_[c], upper_[at]);
    }
  }
  return true;
}

bool IncompleteCholesky::factorise(const BlockMatrix& matrix, double shift) {
  const auto n = static_cast<std::size_t>(matrix.size()), blocks = matrix.off_diagonal.size();
  begin_.assign(n + 1, 0);
  columns_.resize(blocks);
  upper_.resize(blocks);
  for (std::size_t b = 0; b < blocks; ++b) {
    ++begin_[static_cast<std::size_t>(matrix.off_diagonal[b].row) + 1];
    columns_[b] = matrix.off_diagonal[b].column;
    upper_[b] = matrix.off_diagonal[b].value;
  }
  for (std::size_t k = 0; k < n; ++k) begin_[k + 1] += begin_[k];
  pivots_ = matrix.diagonal;
  for (Matrix6d& block : pivots_) block.diagonal().array() += shift;
  inverse_.resize(n), inverse_transposed_.resize(n);
  upper_single_.resize(blocks), upper_transposed_.resize(blocks);
  for (int k = 0; k < matrix.size(); ++k) {
    if (!eliminate(k)) return false;
  }
  if (matrix.strains() == 0) return true;
  corner_.compute(matrix.corner + shift * Eigen::MatrixXd::Identity(matrix.strains(), matrix.strains()));
  return corner_.info() == Eigen::Success;
}

Eigen::VectorXd IncompleteCholesky::solve(const Eigen::VectorXd& b) const {
  const auto n = static_cast<int>(inverse_.size());
  Eigen::VectorXd x(b.size());
  const double scale = b.lpNorm<Eigen::Infinity>();  // single precision has a small range
  if (!(scale > 0)) return Eigen::VectorXd::Zero(b.size());
  std::vector<Floats> work(static_cast<std::size_t>(n));
  for (int k = 0; k < n; ++k) {
    work[k] = Floats{};
    for (int c = 0; c < rows; ++c) work[k][c] = static_cast<float>(b[6 * k + c] / scale);
  }
  for (int k = 0; k < n; ++k) {
    Floats y{};
    add_product(inverse_[k].data(), work[k], y);
    work[k] = y;
    const Floats minus = -y;
    for (int at = begin_[k]; at < begin_[k + 1]; ++at)
      add_product(upper_transposed_[at].data(), minus, work[columns_[at]]);
  }
  for (int k = n - 1; k >= 0; --k) {
    Floats sum{}, y{};
    for (int at = begin_[k]; at < begin_[k + 1]; ++at) add_product(upper_single_[at].data(), work[columns_[at]], sum);
    const Floats rest = work[k] - sum;
    add_product(inverse_transposed_[k].data(), rest, y);
    work[k] = y;
    for (int c = 0; c < rows; ++c) x[6 * k + c] = scale * static_cast<double>(y[c]);
  }
  const Eigen::Index strains = b.size() - 6 * Eigen::Index{n};
  if (strains > 0) x.tail(strains) = corner_.solve(b.tail(strains));
  return x;
}

}  // namespace isojam
