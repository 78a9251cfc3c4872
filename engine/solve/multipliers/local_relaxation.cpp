#include "engine/solve/multipliers/local_relaxation.hpp"

#include <cmath>
#include <utility>

#include "engine/packing/pair_search.hpp"
#include "engine/solve/multipliers/krylov_model.hpp"

namespace isojam {

namespace {

/// A contact is predicted wrongly if the error of its Φ is more than this fraction of the predicted decrease of the
/// packing.
constexpr double misprediction_tolerance = 0.1;

constexpr int most_steps = 12;

/// The relaxation ends when the predicted decrease of a step is below this fraction of the predicted decrease of the
/// whole packing. The second value applies after a failed step.
constexpr double end_fraction = 0.01, end_fraction_after_failure = 0.001;

constexpr double growth = 4;
constexpr double longest_step = 0.1;  ///< in units of the inradius

std::vector<NeighbourPair> mispredictions(const EnvelopeState& here, const EnvelopeState& there,
                                          const Eigen::VectorXd& step, double tolerance) {
  std::vector<NeighbourPair> found;
  const Eigen::Matrix3d strain = strain_of(step, here.packing.size());
  PairSearch before(std::span<const EnvelopeContact>(here.value.contacts), &EnvelopeContact::pair);
  for (const EnvelopeContact& contact : there.value.contacts) {
    const NeighbourPair& pair = contact.pair;
    const EnvelopeContact* same = before.find(pair);
    const double predicted_decrease =
        same ? same->at->predicted(step.segment<6>(6 * pair.a), step_of_b(*same, step, strain)) : 0;
    if (std::abs(contact.at->value - predicted_decrease) > tolerance) found.push_back(pair);
  }
  return found;
}

/// The flagged particles of a packing.
class Part {
 public:
  explicit Part(const std::vector<char>& flags) : place_(flags.size(), -1) {
    for (std::size_t p = 0; p < flags.size(); ++p) {
      if (flags[p]) place_[p] = static_cast<int>(particles_.size()), particles_.push_back(static_cast<int>(p));
    }
  }

  bool empty() const { return particles_.empty(); }

  BlockMatrix of(const BlockMatrix& matrix) const {
    BlockMatrix part;
    for (const int p : particles_) part.diagonal.push_back(matrix.diagonal[p]);
    for (const BlockMatrix::Block& block : matrix.off_diagonal) {
      if (place_[block.row] >= 0 && place_[block.column] >= 0)
        part.off_diagonal.push_back({place_[block.row], place_[block.column], block.value});
    }
    return part;
  }

  Eigen::VectorXd of(const Eigen::VectorXd& whole) const {
    Eigen::VectorXd part(6 * static_cast<Eigen::Index>(particles_.size()));
    for (std::size_t k = 0; k < particles_.size(); ++k)
      part.segment<6>(static_cast<Eigen::Index>(6 * k)) = whole.segment<6>(6 * particles_[k]);
    return part;
  }

  Eigen::VectorXd embedded(const Eigen::VectorXd& part) const {
    Eigen::VectorXd whole = Eigen::VectorXd::Zero(6 * static_cast<Eigen::Index>(place_.size()));
    for (std::size_t k = 0; k < particles_.size(); ++k)
      whole.segment<6>(6 * particles_[k]) = part.segment<6>(static_cast<Eigen::Index>(6 * k));
    return whole;
  }

 private:
  std::vector<int> place_, particles_;
};

}  // namespace

std::vector<char> mispredicted(const EnvelopeState& here, const EnvelopeState& there, const Eigen::VectorXd& step,
                               double predicted_decrease) {
  const auto found = mispredictions(here, there, step, misprediction_tolerance * predicted_decrease);
  std::vector<char> core(here.packing.poses.size(), 0);
  for (const NeighbourPair& pair : found) core[pair.a] = core[pair.b] = 1;
  std::vector<char> flags = core;
  for (const EnvelopeContact& contact : there.value.contacts) {
    const NeighbourPair& pair = contact.pair;
    if (core[pair.a] || core[pair.b]) flags[pair.a] = flags[pair.b] = 1;
  }
  return flags;
}

bool relax_locally(const std::vector<char>& flags, double shift, double predicted_decrease,
                   EnvelopeEvaluator& evaluator, EnvelopeState& state, MinimiseWork& work) {
  const Part part(flags);
  if (part.empty()) return false;
  const double longest = longest_step * state.packing.solids.least_inradius();
  EnvelopeState here{state.packing, part_of(state.value, flags)};
  MinimiseWork local;
  BlockCholesky complete;
  KrylovModels models(shift, complete);
  std::optional<KrylovModel> model;
  bool moved_at_all = false;
  double more = growth;
  for (int k = 0; k < most_steps; ++k) {
    if (!model) {
      const BlockMatrix matrix = part.of(curvature(here.value, here.packing.size()));
      model = models.model(matrix, part.of(here.value.gradient), shift, local);
      if (!model) break;
    }
    const KrylovStep step = model->step(shift, longest);
    const Eigen::VectorXd whole = part.embedded(step.step);
    EnvelopeState there = evaluator.at(moved(here.packing, whole), forces_after(here, whole), flags);
    const double actual = here.value.value - there.value.value;
    if (actual > 1e-4 * step.predicted_decrease) {
      shift = adapted_shift(shift, actual / step.predicted_decrease);
      here = std::move(there);
      moved_at_all = true;
      model.reset();
      more = growth;
      if (step.predicted_decrease < end_fraction * predicted_decrease) break;
    } else {
      shift = more * step.shift;
      more *= 2;
      if (step.predicted_decrease < end_fraction_after_failure * predicted_decrease) break;
    }
  }
  work.local_factorisations += local.incomplete_factorisations;
  work.krylov_vectors += local.krylov_vectors;
  if (!moved_at_all) return false;
  const EnvelopeEvaluation whole = with_part(state.value, here.value, flags);
  state.value = evaluator.load().of(whole, here.packing);
  state.packing = std::move(here.packing);
  return true;
}

}  // namespace isojam
