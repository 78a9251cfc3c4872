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

/// Relaxation of the states during compression (consolidation). The φ_J of tetrahedra depends on this choice, see
/// docs/protocol.md.
enum class Consolidation {
  /// each state is relaxed until its forces balance or Compression::evaluations is reached; φ_J is close to the limit
  /// of complete relaxation
  relaxed,
  hasty  ///< at most 50 evaluations per strain step; with this choice φ_J of tetrahedra agrees with the paper
};
template <>
inline constexpr std::array enum_names<Consolidation>{EnumName{Consolidation::relaxed, "relaxed"},
                                                      EnumName{Consolidation::hasty, "hasty"}};

/// Quantity that is prescribed for each state of the decompression.
enum class Control { density, pressure };
template <>
inline constexpr std::array enum_names<Control>{EnumName{Control::density, "density"},
                                                EnumName{Control::pressure, "pressure"}};

/// Relaxation of the shape of the cell.
enum class CellShape {
  isotropic,  ///< the cell remains a cube
  free        ///< the cell shape relaxes in compression and decompression, so that every state has a hydrostatic stress
};
template <>
inline constexpr std::array enum_names<CellShape>{EnumName{CellShape::isotropic, "isotropic"},
                                                  EnumName{CellShape::free, "free"}};

/// Options of compression, the first stage of the jamming protocol. Compression consists of isotropic strain steps,
/// each followed by a minimisation, until the target energy is reached. Energies are in units of Y·V_p.
struct Compression {
  double initial_density = 0.05;  ///< density φ of the random packing
  /// Increase of φ in a step. For 16 packings of 100 particles, steps of 0.005, 0.01 and 0.02 gave the same φ_J, for
  /// octahedra 0.684, with similar standard deviations (0.004, 0.005, 0.003). The longest of these steps is the
  /// default, because it costs least.
  double step = 0.02;
  double target_energy = 3.2e-5;  ///< E/N at which compression ends; the value of the paper
  /// Two interpretations of the target energy of the paper. false: compression ends at the first relaxed state with E/N
  /// ≥ target_energy. This state is then minimised completely. If less than half of its energy remains, compression
  /// continues. true: each strain step is so short that E/N before relaxation stays below target_energy. Compression
  /// ends when relaxation no longer removes the energy.
  bool target_before_relaxation = false;
  /// Upper limit of φ. is_legal() must be true for the cell up to this density. Crystals can exceed 0.9 before they
  /// reach the target energy.
  double max_density = 0.93;
  /// Residual at which L-BFGS stops relaxing a state. It also stops if E/N falls below unjammed_energy, or after
  /// `evaluations` evaluations. Only the state that reaches the target energy is minimised completely.
  double residual = 1e-3;
  double unjammed_energy = 1e-14;                     ///< E/N below which a state counts as unjammed
  int evaluations = 2000;                             ///< largest number of evaluations for each state
  Consolidation relaxation = Consolidation::relaxed;  ///< relaxation of the states
};

/// Options of decompression, the second stage: steps of decreasing density, or decreasing pressure, towards φ_J.
struct Decompression {
  /// Length of a step, as a fraction of φ − φ_J, which is estimated from the last state. A step is shorter if it would
  /// exceed longest_step or go far beyond final_distance. A failed step is repeated at half its length. The fraction
  /// stays reduced after this, and successful steps increase it again.
  double step_fraction = 0.35;
  double longest_step = 0.05;  ///< largest decrease of φ in a step
  /// Resolution of the density at which an event occurs, as a fraction of φ − φ_J. An event is a rearrangement
  /// (rearrangement.hpp) or the loss of jamming. A step with an event is repeated at half its length until it is
  /// shorter than this fraction. 0: steps are not repeated.
  double event_resolution = 0;
  double final_distance = 0.004;  ///< decompression ends when φ − φ_J falls below this
  double fit_window = 0.02;       ///< states with φ − φ_J below this are used to fit φ_J
  /// Prescribed quantity. With Control::pressure, each state has a lower pressure than the last one, and particles and
  /// volume are in equilibrium. In a step that would reduce Δφ by some fraction, the pressure is multiplied by (1 −
  /// fraction)⁵.
  Control control = Control::density;
};

/// Options of the jamming protocol of Smith, Fisher, Alam 2011 (and 2010): compression, then decompression towards φ_J.
/// The keys of manifests and records call these stages consolidation and expansion.
struct JamOptions {
  Compression compression;
  Decompression decompression;
  int max_steps = 400;                    ///< largest number of strain steps of both stages together
  CellShape cell = CellShape::isotropic;  ///< relaxation of the shape of the cell
  MinimiseOptions minimise;               ///< options for the states of the decompression
};

/// Stages of the protocol: compression and decompression.
enum class JamStage { consolidation, expansion };
template <>
inline constexpr std::array enum_names<JamStage>{EnumName{JamStage::consolidation, "consolidation"},
                                                 EnumName{JamStage::expansion, "expansion"}};

/// Difference between two successive states of the decompression. On a smooth solution branch the energy is
/// proportional to Δφ⁶, and all particles move by similar distances. In a rearrangement the packing loses energy, and a
/// few particles move much farther than the others.
struct Rearrangement {
  /// E divided by the expected value (Δφ₁/Δφ₀)⁶ E₀. The index 0 is the first state, 1 the second; Δφ is estimated from
  /// the first state
  double energy_ratio = 0;
  /// numbers of pairs that touch only in the first state, and only in the second state
  int contacts_lost = 0, contacts_gained = 0;
  /// Number of particles that moved: the participation number (Σu²)²/Σu⁴, where u is the length of the non-affine
  /// displacement of a particle, including translation and R·rotation.
  double particles_moved = 0;
};

/// Free strains of the cell at a prescribed density, that is, during compression, and during decompression with
/// Control::density.
CellControl control_at_density(const JamOptions& options);
/// Free strains of the cell at a prescribed pressure (Y), during decompression with Control::pressure.
CellControl control_at_pressure(const JamOptions& options, double pressure);

/// A strain step and the minimised state after it. Energies are in units of Y·V_p, the pressure in Y.
struct JamStep {
  JamStage stage = JamStage::consolidation;  ///< stage of the protocol
  double density = 0;                        ///< density φ of the state
  double energy_per_particle = 0;            ///< energy per particle E/N
  double pressure = 0;                       ///< pressure p
  double deviator = 0;      ///< largest entry of stress + p·1, divided by p; 0 if there is no pressure
  MinimiseSummary summary;  ///< result of the minimisation of the state
  int descents = 0;         ///< number of saddles that were relaxed along a negative mode before this state was reached
  /// difference from the state before, if it is on the same solution branch
  std::optional<Rearrangement> rearrangement;
  /// True if the solution branch ended in this step of the decompression: the packing lost all contact forces, or slid
  /// without finding an equilibrium.
  bool lost = false;
};

/// Reason for the end of a run.
enum class JamStatus {
  not_called,
  jammed,            ///< states down to final_distance were found, and φ_J was computed
  goal_not_reached,  ///< φ_J was computed, but there are fewer states than requested, or they are farther from φ_J
  not_jammed,        ///< fewer than two jammed states were found
  density_limit,     ///< compression reached max_density before the target energy
  step_limit,        ///< max_steps was reached
  cell_limit,        ///< the cell became so small or skew that a particle could touch two images of another particle
  not_finite,
  interrupted
};
template <>
inline constexpr std::array enum_names<JamStatus>{EnumName{JamStatus::not_called, "not_called"},
                                                  EnumName{JamStatus::jammed, "jammed"},
                                                  EnumName{JamStatus::goal_not_reached, "goal_not_reached"},
                                                  EnumName{JamStatus::not_jammed, "not_jammed"},
                                                  EnumName{JamStatus::density_limit, "density_limit"},
                                                  EnumName{JamStatus::step_limit, "step_limit"},
                                                  EnumName{JamStatus::cell_limit, "cell_limit"},
                                                  EnumName{JamStatus::not_finite, "not_finite"},
                                                  EnumName{JamStatus::interrupted, "interrupted"}};

/// Result of a run of the protocol.
struct JamResult {
  JamStatus status = JamStatus::not_called;  ///< reason for the end of the run
  std::vector<JamStep> path;                 ///< all strain steps with their minimised states
  std::vector<Packing> states;  ///< minimised packings of the last solution branch of the decompression, in order
  /// index in `path` of each element of `states`. These states are equilibria, or their minimisation ended because of
  /// minimise.energy_change
  std::vector<int> state_steps;
  std::optional<JammingPoint> phi_j;  ///< jamming point; nullopt if there are fewer than two states
  long evaluations = 0;               ///< number of evaluations of energy and forces in all steps
  PairCounts counts;                  ///< numbers of pairs that the pair loop processed, summed over all evaluations
  MinimiseWork work;                  ///< work of the minimisers in all steps
};

/// Energies of the states, for fit_jamming_point().
std::vector<EnergyPoint> energy_points(const JamResult& result);

/// State of a run between two strain steps. It is a value type. A run that continues from this state, in any process,
/// gives the same bits as an uninterrupted run.
struct JamProgress {
  Packing packing;  ///< state from which the next step starts: the last minimised state, or the initial configuration
  JamStage stage = JamStage::consolidation;  ///< stage of the next step
  /// present fraction of φ − φ_J for the next step of the decompression; see Decompression::step_fraction
  double step_fraction = 0;
  int halvings = 0;  ///< number of steps of the decompression that failed
  /// If a solution branch has just ended: index in the path of the last equilibrium on this branch. `packing` is then
  /// the state after the branch ended, without contact forces or without equilibrium, and the next steps compress it
  /// again. Otherwise −1.
  int lost = -1;
  JamResult result;  ///< result so far; its status is not_called until the run has ended
  /// True before the first step of begin_expansion(): the packing is treated as jammed, for any energy, so the first
  /// step is a step of the decompression.
  bool jammed = false;

  bool ended() const { return result.status != JamStatus::not_called; }  ///< true if the run has ended
};

/// Progress of a run before its first strain step, with compression and decompression.
JamProgress begin_jam(Packing start, const JamOptions& options);
/// Progress of a run before its first strain step, with only decompression of a jammed packing.
JamProgress begin_expansion(Packing jammed, const JamOptions& options);

/// Makes the next strain step of a run that has not ended, minimises the packing, and appends the step to the path. The
/// state of a decompression step is added to `states` if it is an equilibrium, or if its minimisation ended because of
/// minimise.energy_change. After a stop request, the run ends with the status interrupted and an unfinished step. To
/// continue the run, start from the progress before this call.
void advance(JamProgress& progress, const JamOptions& options, std::stop_token stop = {});

/// Function that jam() calls after every step that was not interrupted.
using OnProgress = std::function<void(const JamProgress&)>;

/// Runs the protocol to its end, from a saved progress or from an initial configuration.
JamResult jam(JamProgress from, const JamOptions& options, std::stop_token stop = {},
              const OnProgress& on_progress = {});
JamResult jam(Packing start, const JamOptions& options, std::stop_token stop = {}, const OnProgress& on_progress = {});

}  // namespace isojam
