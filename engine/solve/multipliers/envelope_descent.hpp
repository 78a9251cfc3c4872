#pragma once

#include <functional>
#include <optional>

#include "engine/solve/multipliers/envelope_state.hpp"
#include "engine/solve/multipliers/krylov_model.hpp"

namespace isojam {

/// Minimises the envelope Φ (EnvelopeEvaluation) by Levenberg–Marquardt steps in Krylov spaces (KrylovModel). If
/// contacts form or break in a step, the model of the step is wrong for a few pairs. The particles of these pairs are
/// relaxed separately before the step is accepted or rejected (local_relaxation.hpp). This relaxation costs little, and
/// few steps are then rejected.
class EnvelopeDescent {
 public:
  /// `complete` is the memory for complete factorisations (DefiniteSolver).
  EnvelopeDescent(EnvelopeEvaluator& evaluator, BlockCholesky& complete, MinimiseWork& work);

  /// Sets the stiffness k₀ = f/Δφ of soft contacts, where f is the mean contact force. The Levenberg–Marquardt shift λ
  /// keeps its ratio to k₀.
  void set_stiffness(double k0);
  double stiffness() const { return k0_; }  ///< k₀
  /// True if λ has become so large that further steps would not move the particles.
  bool failed() const;

  /// Makes one step from `here`, in which no particle moves farther than `longest`. Increases the shift until Φ
  /// decreases enough. Returns nullopt if must_stop() is true before that, or if the second derivatives are not finite.
  std::optional<EnvelopeState> step(const EnvelopeState& here, double longest, const std::function<bool()>& must_stop);

 private:
  void adapt(const EnvelopeState& from, const EnvelopeState& to, const KrylovStep& step, bool relaxed, bool repeated);

  EnvelopeEvaluator& evaluator_;
  MinimiseWork& work_;
  KrylovModels models_;
  double k0_ = 1;  ///< stiffness of soft contacts
  double shift_;   ///< λ
};

}  // namespace isojam
