#include "engine/vibration/mode_statistics.hpp"

#include <algorithm>
#include <cassert>

#include "engine/arithmetic/elementary.hpp"

namespace isojam {

using Eigen::Index;
using Eigen::VectorXd;

double participation_ratio(const Eigen::Ref<const VectorXd>& mode) {
  assert(mode.size() % 6 == 0);
  double squares = 0, fourths = 0;
  for (Index k = 0; k < mode.size(); k += 6) {
    const double square = mode.segment<6>(k).squaredNorm();
    squares += square;
    fourths += square * square;
  }
  const Index particles = mode.size() / 6;
  return squares * squares / (static_cast<double>(particles) * fourths);
}

VectorXd participation_ratios(const ModeSet& modes) {
  VectorXd ratios(modes.size());
  for (Index k = 0; k < modes.size(); ++k) ratios[k] = participation_ratio(modes.vectors.col(k));
  return ratios;
}

std::optional<double> mean_frequency(const ModeSet& modes, double tolerance) {
  if (modes.size() == 0 || !(modes.eigenvalues.minCoeff() > tolerance)) return std::nullopt;
  return modes.eigenvalues.cwiseSqrt().mean();
}

std::optional<AmplitudeShare> amplitude_share(const ModeSet& modes, std::span<const char> marked) {
  if (modes.size() == 0 || marked.empty()) return std::nullopt;
  assert(modes.vectors.rows() == 6 * static_cast<Index>(marked.size()));
  AmplitudeShare share;
  int count = 0;
  for (std::size_t i = 0; i < marked.size(); ++i) {
    if (!marked[i]) continue;
    ++count;
    share.amplitude += modes.vectors.middleRows<6>(6 * static_cast<Index>(i)).squaredNorm();
  }
  share.amplitude /= static_cast<double>(modes.size());
  share.particles = count / static_cast<double>(marked.size());
  return share;
}

std::optional<DensityOfStates> density_of_states(const VectorXd& eigenvalues, double tolerance, int bins) {
  std::vector<double> logs;
  for (const double lambda : eigenvalues) {
    if (lambda > tolerance) logs.push_back(nearest::log10(lambda) / 2);
  }
  std::sort(logs.begin(), logs.end());
  if (bins < 1 || logs.empty() || !(logs.front() < logs.back())) return std::nullopt;
  DensityOfStates states;
  states.without_frequency = static_cast<int>(eigenvalues.size()) - static_cast<int>(logs.size());
  states.edges = VectorXd::LinSpaced(bins + 1, logs.front(), logs.back());
  states.edges[bins] = logs.back();
  const double all = static_cast<double>(eigenvalues.size()), width = (logs.back() - logs.front()) / bins;
  states.cumulative.resize(bins + 1);
  for (int k = 0; k <= bins; ++k) {
    // The last bin is closed: it contains the highest mode.
    const auto below = k < bins ? std::lower_bound(logs.begin(), logs.end(), states.edges[k]) : logs.end();
    states.cumulative[k] = (static_cast<double>(below - logs.begin()) + states.without_frequency) / all;
  }
  states.density = (states.cumulative.tail(bins) - states.cumulative.head(bins)) / width;
  return states;
}

}  // namespace isojam
