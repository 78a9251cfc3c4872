#include "engine/solve/factor/ordering.hpp"

#include <metis.h>

#include <Eigen/OrderingMethods>
#include <Eigen/SparseCore>
#include <array>
#include <mutex>
#include <new>

namespace isojam {

namespace {

/// Number of particles from which nested dissection is used. The table gives the ratio of the numbers of operations of
/// a factorisation, minimum degree to dissection, for octahedra with 8.4 contacts each:
///   N       100   150   200   300   400   800   1000  2000  4000
///   ratio   0.89  0.88  1.09  1.30  1.39  1.47  1.78  2.1   2.8
/// Dissection itself takes 3 to 9 times as long as minimum degree, 1 ms for N = 300. If the order is used for only one
/// factorisation, both methods take the same total time for N = 300, and dissection is faster from N = 400 on.
constexpr int dissected_from = 300;

/// The neighbours of every particle, in the format of METIS.
struct Graph {
  std::vector<idx_t> begin, neighbours;
};

Graph graph_of(const BlockMatrix& matrix) {
  Graph graph{std::vector<idx_t>(matrix.diagonal.size() + 1, 0), std::vector<idx_t>(2 * matrix.off_diagonal.size())};
  for (const BlockMatrix::Block& block : matrix.off_diagonal) {
    ++graph.begin[block.row + 1];
    ++graph.begin[block.column + 1];
  }
  for (int i = 0; i < matrix.size(); ++i) graph.begin[i + 1] += graph.begin[i];
  std::vector<idx_t> end(graph.begin.begin(), graph.begin.end() - 1);
  for (const BlockMatrix::Block& block : matrix.off_diagonal) {
    graph.neighbours[end[block.row]++] = block.column;
    graph.neighbours[end[block.column]++] = block.row;
  }
  return graph;
}

}  // namespace

std::vector<int> minimum_degree_order(const BlockMatrix& matrix) {
  // Columns of the lower half: the blocks are already in this order.
  Eigen::SparseMatrix<double> graph(matrix.size(), matrix.size());
  graph.reserve(matrix.size() + static_cast<Eigen::Index>(matrix.off_diagonal.size()));
  auto block = matrix.off_diagonal.begin();
  for (int i = 0; i < matrix.size(); ++i) {
    graph.startVec(i);
    graph.insertBack(i, i) = 1;
    for (; block != matrix.off_diagonal.end() && block->row == i; ++block) graph.insertBack(block->column, i) = 1;
  }
  graph.finalize();
  Eigen::AMDOrdering<int>::PermutationType order;
  Eigen::AMDOrdering<int>()(graph.selfadjointView<Eigen::Lower>(), order);
  return {order.indices().begin(), order.indices().end()};
}

std::vector<int> dissection_order(const BlockMatrix& matrix) {
  if (matrix.off_diagonal.empty()) return minimum_degree_order(matrix);
  idx_t size = matrix.size();
  Graph graph = graph_of(matrix);
  std::array<idx_t, METIS_NOPTIONS> options{};
  METIS_SetDefaultOptions(options.data());
  options[METIS_OPTION_SEED] = 1;
  std::vector<idx_t> order(matrix.diagonal.size()), place_of(matrix.diagonal.size());
  // METIS 5.1 seeds and uses rand(), which all threads share; one call at a time gives the same numbers in all. It also
  // installs its own handlers for SIGABRT and SIGTERM during the call, and raises the first if it runs out of memory.
  static std::mutex one_at_a_time;
  const std::lock_guard lock(one_at_a_time);
  const int status = METIS_NodeND(&size, graph.begin.data(), graph.neighbours.data(), nullptr, options.data(),
                                  order.data(), place_of.data());
  if (status != METIS_OK) throw std::bad_alloc();
  return {order.begin(), order.end()};
}

std::vector<int> fill_reducing_order(const BlockMatrix& matrix) {
  return matrix.size() < dissected_from ? minimum_degree_order(matrix) : dissection_order(matrix);
}

}  // namespace isojam
