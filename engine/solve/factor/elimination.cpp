#include "engine/solve/factor/elimination.hpp"

#include <algorithm>

namespace isojam {

namespace {

std::vector<int> inverse(const std::vector<int>& permutation) {
  std::vector<int> result(permutation.size());
  for (std::size_t k = 0; k < permutation.size(); ++k) result[permutation[k]] = static_cast<int>(k);
  return result;
}

/// A supernode during the construction: its own positions, and the later positions to which it couples, ascending.
struct Step {
  std::vector<int> own, rows;
  std::vector<int> children;
  int parent = -1;
};

/// One step per particle.
std::vector<Step> single_steps(const BlockMatrix& matrix, const std::vector<int>& place_of) {
  std::vector<Step> steps(place_of.size());
  for (const BlockMatrix::Block& block : matrix.off_diagonal) {
    const auto [low, high] = std::minmax(place_of[block.row], place_of[block.column]);
    steps[low].rows.push_back(high);
  }
  for (std::size_t k = 0; k < steps.size(); ++k) {
    std::vector<int>& rows = steps[k].rows;
    std::sort(rows.begin(), rows.end());
    rows.erase(std::unique(rows.begin(), rows.end()), rows.end());
    steps[k].own = {static_cast<int>(k)};
    if (rows.empty()) continue;
    steps[k].parent = rows.front();
    steps[rows.front()].children.push_back(static_cast<int>(k));
    // By fill-in, the parent couples to all other positions to which this particle couples.
    steps[rows.front()].rows.insert(steps[rows.front()].rows.end(), rows.begin() + 1, rows.end());
  }
  return steps;
}

/// Number of ways to choose three of n objects.
double choose_three(double n) { return n * (n - 1) * (n - 2) / 6; }

/// Time to eliminate `columns` particles that couple to `rows` later particles, in units of a product of two 6×6
/// blocks. A column with h rows takes (h + 1)(h + 2)/2.
double cost(std::size_t columns, std::size_t rows) {
  const auto c = static_cast<double>(columns), r = static_cast<double>(rows);
  constexpr double hand_up = 1.5;  // cost of passing a block to the parent
  constexpr double overhead = 40;
  return choose_three(r + c + 2) - choose_three(r + 2) + hand_up * r * (r + 1) / 2 + overhead;
}

/// Merges steps with their parents where one merged step takes less time than two separate steps.
void merge(std::vector<Step>& steps) {
  for (std::size_t k = 0; k < steps.size(); ++k) {
    Step& step = steps[k];
    std::vector<int> kept;
    // Children of a merged child become candidates too.
    std::vector<int> candidates(step.children.rbegin(), step.children.rend());
    while (!candidates.empty()) {
      Step& child = steps[candidates.back()];
      const std::size_t together = step.own.size() + child.own.size();
      if (cost(together, step.rows.size()) <=
          cost(step.own.size(), step.rows.size()) + cost(child.own.size(), child.rows.size())) {
        step.own.insert(step.own.end(), child.own.begin(), child.own.end());
        kept.insert(kept.end(), child.children.begin(), child.children.end());
        child.own.clear();
      } else {
        kept.push_back(candidates.back());
      }
      candidates.pop_back();
    }
    std::sort(kept.begin(), kept.end());
    step.children = std::move(kept);
  }
}

/// The steps that remain after merge(). Children come directly before their parents.
std::vector<int> postorder(const std::vector<Step>& steps) {
  std::vector<int> order, stack;
  std::vector<char> is_child(steps.size(), 0);
  for (const Step& step : steps) {
    if (step.own.empty()) continue;
    for (const int child : step.children) is_child[child] = 1;
  }
  for (std::size_t k = 0; k < steps.size(); ++k) {
    if (!steps[k].own.empty() && !is_child[k]) stack.push_back(static_cast<int>(k));
  }
  // A preorder that visits the last child first, reversed.
  while (!stack.empty()) {
    const int k = stack.back();
    stack.pop_back();
    order.push_back(k);
    for (const int child : steps[k].children) stack.push_back(child);
  }
  std::reverse(order.begin(), order.end());
  return order;
}

}  // namespace

Elimination plan_elimination(const BlockMatrix& matrix, const std::vector<int>& order) {
  std::vector<Step> steps = single_steps(matrix, inverse(order));
  merge(steps);
  const std::vector<int> left = postorder(steps);
  Elimination plan;
  std::vector<int> place_of(order.size()), supernode_of(steps.size());
  for (const int k : left) {
    Step& step = steps[k];
    std::sort(step.own.begin(), step.own.end());
    supernode_of[k] = static_cast<int>(plan.supernodes.size());
    plan.supernodes.push_back({static_cast<int>(plan.node_of.size()), static_cast<int>(step.own.size()), {}, {}});
    for (const int place : step.own) {
      place_of[place] = static_cast<int>(plan.node_of.size());
      plan.node_of.push_back(order[place]);
    }
    for (const int child : step.children) plan.supernodes.back().children.push_back(supernode_of[child]);
  }
  for (const int k : left) {
    std::vector<int>& rows = plan.supernodes[supernode_of[k]].rows;
    for (const int place : steps[k].rows) rows.push_back(place_of[place]);
    std::sort(rows.begin(), rows.end());
  }
  return plan;
}

}  // namespace isojam
