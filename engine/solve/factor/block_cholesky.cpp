#include "engine/solve/factor/block_cholesky.hpp"

#include <Eigen/Cholesky>
#include <Eigen/OrderingMethods>
#include <Eigen/SparseCore>
#include <algorithm>

namespace isojam {

namespace {

/// Supernodes may take in this many block rows of zeros for the sake of larger dense fronts.
constexpr std::size_t relaxation = 2;

/// Fill-reducing order of the graph of particles: node of each column.
std::vector<int> minimum_degree_order(const BlockMatrix& matrix) {
  std::vector<Eigen::Triplet<double>> entries;
  for (int i = 0; i < matrix.size(); ++i) entries.emplace_back(i, i, 1.0);
  for (const BlockMatrix::Block& block : matrix.off_diagonal) {
    entries.emplace_back(block.row, block.column, 1.0);
    entries.emplace_back(block.column, block.row, 1.0);
  }
  Eigen::SparseMatrix<double> graph(matrix.size(), matrix.size());
  graph.setFromTriplets(entries.begin(), entries.end());
  Eigen::AMDOrdering<int>::PermutationType order;
  Eigen::AMDOrdering<int>()(graph, order);
  std::vector<int> node_of(static_cast<std::size_t>(matrix.size()));
  for (int k = 0; k < matrix.size(); ++k) node_of[k] = order.indices()[k];
  return node_of;
}

std::vector<int> inverse(const std::vector<int>& permutation) {
  std::vector<int> result(permutation.size());
  for (std::size_t k = 0; k < permutation.size(); ++k) result[permutation[k]] = static_cast<int>(k);
  return result;
}

/// Rows below the diagonal of every column of the factor, and the elimination tree (−1: a root).
void eliminate(const BlockMatrix& matrix, const std::vector<int>& place_of, std::vector<std::vector<int>>& structure,
               std::vector<int>& parent) {
  const std::size_t n = place_of.size();
  structure.assign(n, {});
  parent.assign(n, -1);
  for (const BlockMatrix::Block& block : matrix.off_diagonal) {
    const auto [low, high] = std::minmax(place_of[block.row], place_of[block.column]);
    structure[low].push_back(high);
  }
  for (std::size_t k = 0; k < n; ++k) {
    std::vector<int>& rows = structure[k];
    std::sort(rows.begin(), rows.end());
    rows.erase(std::unique(rows.begin(), rows.end()), rows.end());
    if (rows.empty()) continue;
    parent[k] = rows.front();
    // Everything else that this column couples to fills in its parent.
    structure[rows.front()].insert(structure[rows.front()].end(), rows.begin() + 1, rows.end());
  }
}

/// Postorder of a forest whose parents have larger numbers than their children: column at each place.
std::vector<int> postorder(const std::vector<int>& parent) {
  std::vector<std::vector<int>> children(parent.size());
  std::vector<int> order, stack;
  for (int k = static_cast<int>(parent.size()) - 1; k >= 0; --k) {
    if (parent[k] >= 0) {
      children[parent[k]].push_back(k);
    } else {
      stack.push_back(k);
    }
  }
  // A preorder that visits the last child first, reversed.
  while (!stack.empty()) {
    const int k = stack.back();
    stack.pop_back();
    order.push_back(k);
    for (const int child : children[k]) stack.push_back(child);
  }
  std::reverse(order.begin(), order.end());
  return order;
}

}  // namespace

void BlockCholesky::analyse(const BlockMatrix& matrix) {
  size_ = matrix.size();
  pattern_.clear();
  for (const BlockMatrix::Block& block : matrix.off_diagonal) pattern_.emplace_back(block.row, block.column);
  std::vector<std::vector<int>> structure;
  std::vector<int> parent;
  node_of_ = minimum_degree_order(matrix);
  eliminate(matrix, inverse(node_of_), structure, parent);
  std::vector<int> ordered;
  for (const int k : postorder(parent)) ordered.push_back(node_of_[k]);
  node_of_ = std::move(ordered);
  place_of_ = inverse(node_of_);
  eliminate(matrix, place_of_, structure, parent);
  build_fronts(structure, parent);
  place_entries(matrix);
  place_children();
}

void BlockCholesky::build_fronts(const std::vector<std::vector<int>>& structure, const std::vector<int>& parent) {
  fronts_.clear();
  std::vector<int> front_of(structure.size());
  for (std::size_t k = 0; k < structure.size(); ++k) {
    const bool chained = k > 0 && parent[k - 1] == static_cast<int>(k);
    if (!chained || structure[k].size() + 1 > structure[k - 1].size() + relaxation) {
      fronts_.emplace_back();
      fronts_.back().first = static_cast<int>(k);
    }
    Front& front = fronts_.back();
    ++front.columns;
    front.rows = structure[k];
    front_of[k] = static_cast<int>(fronts_.size()) - 1;
  }
  for (std::size_t f = 0; f < fronts_.size(); ++f) {
    if (!fronts_[f].rows.empty()) fronts_[front_of[fronts_[f].rows.front()]].children.push_back(static_cast<int>(f));
  }
}

namespace {

/// Place of permuted column k among the columns and rows of a front.
int place_in(int first, int columns, const std::vector<int>& rows, int k) {
  if (k < first + columns) return k - first;
  return columns + static_cast<int>(std::lower_bound(rows.begin(), rows.end(), k) - rows.begin());
}

}  // namespace

void BlockCholesky::place_entries(const BlockMatrix& matrix) {
  std::vector<int> front_of(static_cast<std::size_t>(size_));
  for (std::size_t f = 0; f < fronts_.size(); ++f) {
    for (int c = 0; c < fronts_[f].columns; ++c) front_of[fronts_[f].first + c] = static_cast<int>(f);
  }
  for (std::size_t e = 0; e < matrix.off_diagonal.size(); ++e) {
    const int row = place_of_[matrix.off_diagonal[e].row], column = place_of_[matrix.off_diagonal[e].column];
    const int low = std::min(row, column), high = std::max(row, column);
    Front& front = fronts_[front_of[low]];
    front.entries.emplace_back(static_cast<int>(e), place_in(front.first, front.columns, front.rows, high));
    front.entry_column.push_back(low - front.first);
    // A block is stored as (row, column); the front wants (high, low).
    front.entry_transposed.push_back(row == low ? 1 : 0);
  }
}

void BlockCholesky::place_children() {
  for (Front& front : fronts_) {
    for (const int child : front.children) {
      std::vector<int> places;
      for (const int row : fronts_[child].rows) places.push_back(place_in(front.first, front.columns, front.rows, row));
      front.child_places.push_back(std::move(places));
    }
  }
}

void BlockCholesky::assemble(Front& front, const BlockMatrix& matrix, double shift) {
  const int rows = static_cast<int>(front.rows.size());
  front.factor.setZero(6 * (front.columns + rows), 6 * front.columns);
  front.update.setZero(6 * rows, 6 * rows);
  for (int c = 0; c < front.columns; ++c) {
    auto block = front.factor.block<6, 6>(6 * c, 6 * c);
    block = matrix.diagonal[node_of_[front.first + c]];
    block.diagonal().array() += shift;
  }
  for (std::size_t e = 0; e < front.entries.size(); ++e) {
    const Matrix6d& value = matrix.off_diagonal[front.entries[e].first].value;
    auto block = front.factor.block<6, 6>(6 * front.entries[e].second, 6 * front.entry_column[e]);
    if (front.entry_transposed[e]) {
      block = value.transpose();
    } else {
      block = value;
    }
  }
  for (std::size_t k = 0; k < front.children.size(); ++k) {
    const Eigen::MatrixXd& update = fronts_[front.children[k]].update;
    const std::vector<int>& places = front.child_places[k];
    for (std::size_t j = 0; j < places.size(); ++j) {
      for (std::size_t i = j; i < places.size(); ++i) {
        const auto value = update.block<6, 6>(6 * static_cast<int>(i), 6 * static_cast<int>(j));
        if (places[j] < front.columns) {
          front.factor.block<6, 6>(6 * places[i], 6 * places[j]) += value;
        } else {
          front.update.block<6, 6>(6 * (places[i] - front.columns), 6 * (places[j] - front.columns)) += value;
        }
      }
    }
  }
}

bool BlockCholesky::factorise(const BlockMatrix& matrix, double shift) {
  const bool same_pattern =
      size_ == matrix.size() &&
      std::equal(pattern_.begin(), pattern_.end(), matrix.off_diagonal.begin(), matrix.off_diagonal.end(),
                 [](const auto& p, const auto& block) { return p.first == block.row && p.second == block.column; });
  if (!same_pattern) analyse(matrix);
  for (Front& front : fronts_) {
    assemble(front, matrix, shift);
    const int width = 6 * front.columns, height = static_cast<int>(front.factor.rows());
    Eigen::Ref<Eigen::MatrixXd> top = front.factor.topRows(width);
    const Eigen::LLT<Eigen::Ref<Eigen::MatrixXd>> pivot(top);
    if (pivot.info() != Eigen::Success || !pivot.matrixLLT().diagonal().allFinite()) return false;
    if (height == width) continue;
    auto below = front.factor.bottomRows(height - width);
    top.triangularView<Eigen::Lower>().transpose().solveInPlace<Eigen::OnTheRight>(below);
    front.update.selfadjointView<Eigen::Lower>().rankUpdate(below, -1);
  }
  return true;
}

Eigen::VectorXd BlockCholesky::solve(const Eigen::VectorXd& b) const {
  Eigen::VectorXd x(b.size());
  for (int k = 0; k < size_; ++k) x.segment<6>(6 * k) = b.segment<6>(6 * node_of_[k]);
  Eigen::VectorXd gathered;
  for (const Front& front : fronts_) {
    const int width = 6 * front.columns;
    auto own = x.segment(6 * front.first, width);
    front.factor.topRows(width).triangularView<Eigen::Lower>().solveInPlace(own);
    gathered.noalias() = front.factor.bottomRows(front.factor.rows() - width) * own;
    for (std::size_t r = 0; r < front.rows.size(); ++r)
      x.segment<6>(6 * front.rows[r]) -= gathered.segment<6>(6 * static_cast<int>(r));
  }
  for (auto front = fronts_.rbegin(); front != fronts_.rend(); ++front) {
    const int width = 6 * front->columns;
    auto own = x.segment(6 * front->first, width);
    gathered.resize(6 * static_cast<int>(front->rows.size()));
    for (std::size_t r = 0; r < front->rows.size(); ++r)
      gathered.segment<6>(6 * static_cast<int>(r)) = x.segment<6>(6 * front->rows[r]);
    own.noalias() -= front->factor.bottomRows(front->factor.rows() - width).transpose() * gathered;
    front->factor.topRows(width).triangularView<Eigen::Lower>().transpose().solveInPlace(own);
  }
  Eigen::VectorXd result(b.size());
  for (int k = 0; k < size_; ++k) result.segment<6>(6 * node_of_[k]) = x.segment<6>(6 * k);
  return result;
}

}  // namespace isojam
