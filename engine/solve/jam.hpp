#pragma once

#include <array>
#include <functional>
#include <optional>
#include <stop_token>
#include <string_view>
#include <vector>

#include "engine/names/enum_names.hpp"
#include "engine/packing/packing.hpp"
#include "engine/solve/jamming_point.hpp"
#include "engine/solve/minimise/minimise.hpp"

namespace isojam {

/// Version of the protocol. It increases when the same options give other packings, not counting the last bits.
inline constexpr int protocol_version = 2;

/// Quantity that is prescribed for each state of a decompression.
enum class Control { density, pressure };
template <>
inline constexpr std::array enum_names<Control>{EnumName{Control::density, "density"},
                                                EnumName{Control::pressure, "pressure"}};

/// Relaxation of the shape of the cell.
enum class CellShape {
  isotropic,  ///< the cell remains a cube
  free  ///< the cell shape relaxes in compression and decompression, so the stress of an equilibrium is hydrostatic
};
template <>
inline constexpr std::array enum_names<CellShape>{EnumName{CellShape::isotropic, "isotropic"},
                                                  EnumName{CellShape::free, "free"}};

/// Stage until which cohesion acts.
enum class CohesionUntil {
  /// Cohesion acts during compression. Decompression is that of particles without cohesion.
  decompression,
  /// Cohesion always acts. Instead of a decompression, the packing relaxes to zero pressure.
  end
};
template <>
inline constexpr std::array enum_names<CohesionUntil>{EnumName{CohesionUntil::decompression, "decompression"},
                                                      EnumName{CohesionUntil::end, "end"}};

/// Options of compression, the first stage of the protocol. Compression consists of isotropic strain steps, each
/// followed by a minimisation, until the target energy is reached. The last steps are shorter (aimed_strain()).
/// Energies are in units of Y·V_p.
struct Compression {
  double initial_density = 0.05;  ///< density φ of the random packing
  double step = 0.04;             ///< increase of φ in a strain step, see examples/02-strain-step
  double target_energy = 3.2e-5;  ///< target energy per particle E/N; the value of the paper
  /// The paper's target energy can be interpreted in two ways:
  /// - false: compression ends at the first state whose E/N after relaxation is at least target_energy. If the
  ///   minimisation at the start of decompression reduces E/N to less than half of target_energy, compression
  ///   continues.
  /// - true: each strain step is halved, at most six times, until E/N before relaxation is at most target_energy.
  ///   Compression ends at the first state that has contacts and whose residual is at most 1e-3.
  bool target_before_relaxation = false;
  /// Upper limit of φ. The cell must be legal up to this density (is_legal() in packing/cell/periodic_cell.hpp).
  /// Crystals can exceed φ = 0.9 before they reach the target energy.
  double max_density = 0.93;
  /// Largest number of evaluations for a state. L-BFGS relaxes a state until the residual is at most 1e-3, or until E/N
  /// is below 1e-14, the criterion minimise.energy_change is satisfied, or this number of evaluations is reached. More
  /// evaluations do not change φ_J significantly, except for tetrahedra, which need more (examples/02-strain-step).
  int evaluations = 200;
};

/// Options of decompression, the second stage: steps to lower densities, or to lower pressures, towards φ_J.
struct Decompression {
  /// Length of a step as a fraction of φ − φ_J, which is estimated from the last state. A step is shorter if it would
  /// otherwise exceed longest_step, or end at φ − φ_J < 0.95·final_distance. If it finds no equilibrium, it fails, and
  /// the next step is half as long. Each successful step increases the fraction by a factor of 1.5, up to this value,
  /// except below φ − φ_J = 0.001, where a longer step would fail again.
  double step_fraction = 0.35;
  double longest_step = 0.05;     ///< largest decrease of φ in a step
  double final_distance = 0.004;  ///< decompression ends when φ − φ_J falls below this
  double fit_window = 0.02;       ///< states with φ − φ_J below this are used to fit φ_J
  /// Prescribed quantity. With Control::pressure, each step prescribes a lower pressure, and the volume of the cell
  /// relaxes together with the particles. A step of the length f·(φ − φ_J) multiplies the pressure by (1 − f)⁵, because
  /// p is proportional to (φ − φ_J)⁵.
  Control control = Control::density;
};

/// Options of the protocol of Smith, Fisher, Alam 2011 (arXiv:1104.4933): compression, then decompression towards φ_J.
struct JamOptions {
  Compression compression;      ///< options of the first stage
  Decompression decompression;  ///< options of the second stage
  /// Cohesion, by default none. Requires Compression::target_before_relaxation = false. With cohesion, compression ends
  /// when the packing, relaxed without cohesion, has the target energy. With CohesionUntil::end, the result has one
  /// state: the equilibrium at zero pressure, which Newton's method finds, and whose density takes the place of φ_J.
  /// The volume of the cell relaxes, and with CellShape::free also its shape.
  Cohesion cohesion;
  CohesionUntil cohesion_until = CohesionUntil::decompression;  ///< stage until which cohesion acts
  /// Number of training cycles. In each cycle, the packing is decompressed to final_distance and compressed again,
  /// before the decompression that gives the result. A cycle whose decompression ends for another reason counts too.
  int cycles = 0;
  int max_steps = 400;                    ///< largest number of entries of `path`, both stages together
  CellShape cell = CellShape::isotropic;  ///< relaxation of the shape of the cell
  /// Options of the minimisations. In compression, the method is always L-BFGS, Compression::evaluations replaces
  /// max_evaluations, `residual` is at least 1e-3, and `unjammed_energy` at least 1e-14.
  MinimiseOptions minimise;
};

/// Stages of the protocol, and `as_given` for a packing that is measured without them.
enum class JamStage { compression, decompression, as_given };
template <>
inline constexpr std::array enum_names<JamStage>{EnumName{JamStage::compression, "compression"},
                                                 EnumName{JamStage::decompression, "decompression"},
                                                 EnumName{JamStage::as_given, "as_given"}};

/// Difference between two successive states of a solution branch, a family of equilibria that changes continuously with
/// φ. Along a branch, the energy is proportional to Δφ⁶, and all particles move by similar distances. In a
/// rearrangement (is_rearranged()), the packing loses energy, and a few particles move much farther than others.
struct Rearrangement {
  /// E₁ divided by its expected value (Δφ₁/Δφ₀)⁶ E₀. The index 0 means the first state, 1 the second. Δφ₀ is
  /// distance_to_jamming() of the first state, and Δφ₁ = Δφ₀ − (φ₀ − φ₁).
  double energy_ratio = 0;
  /// numbers of pairs that touch only in the first state, and only in the second state
  int contacts_lost = 0, contacts_gained = 0;
  /// Number of particles that moved: the participation number (Σu²)²/Σu⁴ with sums over all particles and u² = |dx|² +
  /// R²|dθ|², where dx is the non-affine displacement of a particle and dθ its rotation.
  double particles_moved = 0;
};

/// True if the run ends with the relaxation to zero pressure: cohesion acts, with CohesionUntil::end.
bool ends_at_zero_pressure(const JamOptions& options);

/// Free strains of the cell in compression, and in decompression with Control::density. There is no load.
CellControl control_at_density(const JamOptions& options);
/// Free strains of the cell and load on the cell in decompression with Control::pressure. `pressure` is in units of Y.
CellControl control_at_pressure(const JamOptions& options, double pressure);

/// A strain step and the minimised state after it. Energies are in units of Y·V_p, the pressure in Y.
struct JamStep {
  JamStage stage = JamStage::compression;  ///< stage of the protocol
  double density = 0;                      ///< density φ of the state
  double energy_per_particle = 0;          ///< energy per particle E/N, with cohesion if it acts in this step
  double pressure = 0;                     ///< pressure p
  double deviator = 0;                     ///< deviation from hydrostatic stress, see deviator_of()
  MinimiseSummary summary;                 ///< result of the minimisation of the state
  int descents = 0;  ///< number of saddles that settle() relaxed to reach this state; jam() leaves it 0
  /// difference from the state before; nullopt in compression, at the beginning of a solution branch, and if the step
  /// failed or a branch ended in it
  std::optional<Rearrangement> rearrangement;
  /// True if the solution branch ended in this step of the decompression. Either the packing is unjammed, or φ − φ_J is
  /// above 0.001 and this step and the step before it, which was twice as long, both ended with StopReason::budget.
  bool lost = false;
};

/// Reason for the end of a run.
enum class JamStatus {
  not_called,
  jammed,            ///< states were found down to final_distance, and φ_J was fitted
  zero_pressure,     ///< with CohesionUntil::end: the only state is the equilibrium at zero pressure
  as_given,          ///< the only state is the given packing, which was not relaxed
  goal_not_reached,  ///< φ_J was fitted, but decompression ended before final_distance
  /// the last solution branch has fewer than two states; with CohesionUntil::end, no equilibrium was found
  not_jammed,
  density_limit,  ///< compression reached max_density before the target energy
  detached,       ///< no particles touch at zero pressure, because cohesion is too weak
  step_limit,     ///< max_steps was reached
  /// the cell became so small or skew that a particle could touch two images of another particle; with cohesion, this
  /// concerns the grown particles
  cell_limit,
  not_finite,
  interrupted
};
template <>
inline constexpr std::array enum_names<JamStatus>{EnumName{JamStatus::not_called, "not_called"},
                                                  EnumName{JamStatus::jammed, "jammed"},
                                                  EnumName{JamStatus::zero_pressure, "zero_pressure"},
                                                  EnumName{JamStatus::as_given, "as_given"},
                                                  EnumName{JamStatus::goal_not_reached, "goal_not_reached"},
                                                  EnumName{JamStatus::not_jammed, "not_jammed"},
                                                  EnumName{JamStatus::density_limit, "density_limit"},
                                                  EnumName{JamStatus::detached, "detached"},
                                                  EnumName{JamStatus::step_limit, "step_limit"},
                                                  EnumName{JamStatus::cell_limit, "cell_limit"},
                                                  EnumName{JamStatus::not_finite, "not_finite"},
                                                  EnumName{JamStatus::interrupted, "interrupted"}};

/// Result of a training cycle.
struct Cycle {
  double energy_per_particle = 0;  ///< E/N of the first state of its decompression; 0 if no state was found
  std::optional<double> phi_j;     ///< jamming density; nullopt if there are fewer than two states
  std::optional<Packing> nearest;  ///< last state of the decompression; nullopt if no state was found
};

/// Result of a run of the protocol.
struct JamResult {
  JamStatus status = JamStatus::not_called;  ///< reason for the end of the run
  std::vector<JamStep> path;                 ///< all strain steps, including failed steps
  /// Minimised packings of the last solution branch of the decompression, in the order of the steps. They are
  /// equilibria, unless minimise.energy_change is set: then they include packings whose minimisation ended with
  /// StopReason::energy_change.
  std::vector<Packing> states;
  std::vector<int> state_steps;       ///< index in `path` of each element of `states`
  std::optional<JammingPoint> phi_j;  ///< jamming density; nullopt if there are fewer than two states
  std::vector<Cycle> cycles;          ///< training cycles, in their order
  long evaluations = 0;               ///< number of evaluations of energy and forces in all steps
  PairCounts counts;                  ///< numbers of pairs that were processed in all evaluations
  MinimiseWork work;                  ///< numbers of operations of all minimisations
};

/// The increase of φ after the state `last` of a compression: Compression::step, or less where this would exceed the
/// target energy by E ∝ (φ − φ_J)⁶.
double aimed_strain(const Compression& compression, const JamStep& last);

/// The data of `states` for fit_jamming_point().
std::vector<EnergyPoint> energy_points(const JamResult& result);

/// The training cycle whose decompression ended with the `states` of this result. φ_J is fitted to the states with
/// φ − φ_J < fit_window.
Cycle cycle_of(const JamResult& result, double fit_window);

/// Everything that a run needs to continue after a strain step. It is a value type, and a run that continues from it,
/// in any process, gives the same bits as an uninterrupted run.
struct JamProgress {
  /// packing from which the next step starts: the last minimised state, or the initial configuration
  Packing packing;
  JamStage stage = JamStage::compression;  ///< stage of the next step
  /// Present value of the step fraction: Decompression::step_fraction at first, and less after steps that failed or
  /// ended a solution branch.
  double step_fraction = 0;
  /// Number of steps of the decompression that failed or ended a solution branch, each of which halves the step
  /// fraction. The fifth ends the decompression.
  int halvings = 0;
  /// Index in `path` of the last equilibrium of a solution branch that has just ended; otherwise −1. After the end of a
  /// branch, `packing` is unjammed or far from equilibrium, and the next steps compress it to an equilibrium of another
  /// branch.
  int lost = -1;
  JamResult result;  ///< result so far; its status is not_called until the run has ended
  /// True if the run began with begin_decompression(). Decompression then begins at any energy. Otherwise the run
  /// returns to compression if the first minimisation of the decompression reduces the energy too far
  /// (Compression::target_before_relaxation).
  bool jammed = false;

  bool ended() const { return result.status != JamStatus::not_called; }  ///< true if the run has ended
};

/// Progress of a run before its first step, for compression and decompression.
JamProgress begin_jam(Packing start, const JamOptions& options);
/// Progress of a run before its first step, for decompression of a jammed packing only.
JamProgress begin_decompression(Packing jammed, const JamOptions& options);

/// Progress of a run that has ended: its only state is the packing, which is not relaxed.
JamProgress begin_as_given(Packing packing);

/// Makes the next step of a run that has not ended: changes the density or pressure, minimises the packing, and appends
/// the step to the path. The first step of a run and the first step of a decompression only minimise. If a step of the
/// decompression succeeds, its packing is appended to `states`. After a stop request, the run ends with the status
/// `interrupted`, and the last step is unfinished. To continue the run, start from the progress before this call.
void advance(JamProgress& progress, const JamOptions& options, std::stop_token stop = {});

/// Function that jam() calls after every step that was not interrupted.
using OnProgress = std::function<void(const JamProgress&)>;

/// Runs the protocol to its end, from a saved progress or from an initial configuration.
JamResult jam(JamProgress from, const JamOptions& options, std::stop_token stop = {},
              const OnProgress& on_progress = {});
JamResult jam(Packing start, const JamOptions& options, std::stop_token stop = {}, const OnProgress& on_progress = {});

}  // namespace isojam
