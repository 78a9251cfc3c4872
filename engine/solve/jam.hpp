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

/// Relaxation of the states during compression (consolidation). φ_J of tetrahedra depends on it: see docs/protocol.md.
enum class Consolidation {
  relaxed,  ///< until forces balance or consolidation_evaluations are spent: close to the limit of slow relaxation
  hasty     ///< at most 50 evaluations per strain step; suggested by the paper's φ_J of tetrahedra
};
template <>
inline constexpr std::array enum_names<Consolidation>{EnumName{Consolidation::relaxed, "relaxed"},
                                                      EnumName{Consolidation::hasty, "hasty"}};

/// Quantity that the protocol prescribes for each state of the expansion (decompression).
enum class Control { density, pressure };
template <>
inline constexpr std::array enum_names<Control>{EnumName{Control::density, "density"},
                                                EnumName{Control::pressure, "pressure"}};

/// Freedom of the cell, besides its volume.
enum class CellShape {
  isotropic,  ///< the cell remains a cube
  free        ///< the cell shape relaxes in both stages, so that every state has a hydrostatic stress
};
template <>
inline constexpr std::array enum_names<CellShape>{EnumName{CellShape::isotropic, "isotropic"},
                                                  EnumName{CellShape::free, "free"}};

/// Jamming protocol of Smith, Fisher, Alam 2011 (and 2010): compress in small isotropic strain steps, then decompress
/// towards φ_J; minimise after each step. The keys call these stages consolidation and expansion. Energies in Y·V_p.
struct JamOptions {
  double initial_density = 0.05;  ///< φ of the random packing
  /// Δφ of a compression step. For 16 packings of 100 particles, steps of 0.005, 0.01 and 0.02 gave the same φ_J
  /// (octahedra: 0.684 for all) with similar standard deviations (0.004, 0.005, 0.003). The longest step costs least.
  double consolidation_step = 0.02;
  double target_energy = 3.2e-5;  ///< E/N at which compression ends (the paper's)
  /// Interpretation of the paper's target. false: compression ends at the first minimised state with E/N ≥
  /// target_energy, and continues if full minimisation leaves less than half of that energy. true: each strain step is
  /// limited so that the unrelaxed E/N stays below target_energy, and compression ends when minimisation no longer
  /// removes the energy.
  bool target_before_relaxation = false;
  /// Upper limit of the density; the cell must be legal up to here. Crystals can exceed 0.9 before they reach the
  /// target energy.
  double max_density = 0.93;
  /// A decompression step is this fraction of φ − φ_J as estimated from the last state, limited by longest_step and so
  /// that it does not pass far beyond final_distance. A failed step is repeated at half its length, whichever of these
  /// limits applied. Successful steps increase the reduced fraction again.
  double step_fraction = 0.35;
  double longest_step = 0.05;  ///< upper limit of Δφ of a step
  /// A step with a rearrangement (rearrangement.hpp) or loss of jamming is repeated at half its length, until the step
  /// is shorter than this fraction of φ − φ_J. This is the resolution of the density of such an event. 0: no
  /// repetition.
  double event_resolution = 0;
  double final_distance = 0.004;  ///< decompression ends when φ − φ_J falls below this
  double fit_window = 0.02;       ///< states with φ − φ_J below this are used to fit φ_J
  int max_steps = 400;            ///< maximum number of strain steps
  /// During compression L-BFGS relaxes each state only until the residual is below consolidation_residual, E/N falls
  /// below consolidation_energy, or consolidation_evaluations are spent. The state at the target is then minimised
  /// fully.
  double consolidation_residual = 1e-3;
  double consolidation_energy = 1e-14;                   ///< E/N below which a compression state counts as unjammed
  int consolidation_evaluations = 2000;                  ///< limit for each compression state
  Consolidation consolidation = Consolidation::relaxed;  ///< kind of relaxation during compression
  /// With pressure control each state of the expansion has a lower pressure than the last one, in equilibrium of volume
  /// and particles. A step that would reduce Δφ by a given fraction multiplies the pressure by (1 − fraction)⁵.
  Control control = Control::density;
  CellShape cell = CellShape::isotropic;  ///< free: the cell shape relaxes
  MinimiseOptions minimise;               ///< options for the states of the expansion
};

/// Stages of the protocol: compression and decompression.
enum class JamStage { consolidation, expansion };
template <>
inline constexpr std::array enum_names<JamStage>{EnumName{JamStage::consolidation, "consolidation"},
                                                 EnumName{JamStage::expansion, "expansion"}};

/// Difference between two subsequent states of the expansion. On a smooth piece of the path energies are proportional
/// to Δφ⁶ and particles move similarly. In a rearrangement, at a fold, the packing loses energy and a few particles
/// move far.
struct Rearrangement {
  double energy_ratio = 0;  ///< E divided by the expected (Δφ₁/Δφ₀)⁶ E₀, with Δφ estimated from the state before
  int contacts_lost = 0, contacts_gained = 0;  ///< pairs that touch only before, only after
  /// Participation number (Σu²)²/Σu⁴ of the non-affine displacements u of the particles, translation and R·rotation.
  double particles_moved = 0;
};

/// Freedom of the cell during compression, and during expansion with density control: the density is fixed.
CellControl control_at_density(const JamOptions& options);
/// Freedom and load of the cell during expansion with pressure control, at a pressure (Y).
CellControl control_at_pressure(const JamOptions& options, double pressure);

/// A minimised state of the path; energy in Y·V_p, pressure in Y.
struct JamStep {
  JamStage stage = JamStage::consolidation;  ///< stage of the protocol
  double density = 0;                        ///< φ
  double energy_per_particle = 0;            ///< E/N
  double pressure = 0;                       ///< p
  double deviator = 0;                       ///< largest entry of stress + p·1, divided by p; 0 without pressure
  MinimiseSummary summary;                   ///< result of its minimisation
  int descents = 0;  ///< number of saddles that were relaxed along a negative mode before this state
  std::optional<Rearrangement> rearrangement;  ///< difference from the state before, if there is one on the same branch
  /// True for an expansion step in which the branch of equilibria ended: the packing lost all contact forces, or slid
  /// without finding an equilibrium.
  bool lost = false;
};

/// Reason for the end of a run.
enum class JamStatus {
  not_called,
  jammed,            ///< φ_J is bracketed by states down to final_distance
  goal_not_reached,  ///< fewer states than requested, or farther from φ_J, but enough for φ_J
  not_jammed,        ///< fewer than two states above jamming
  density_limit,     ///< max_density was reached before the target energy
  step_limit,        ///< max_steps were spent
  cell_limit,        ///< the cell became so small or skew that a particle could touch two images of another one
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

/// Result of a run.
struct JamResult {
  JamStatus status = JamStatus::not_called;  ///< reason for its end
  std::vector<JamStep> path;                 ///< every minimised strain step
  std::vector<Packing> states;               ///< minimised packings of the last branch of the expansion, in order
  std::vector<int> state_steps;       ///< index in `path` of each state; equilibria, or ended by minimise.energy_change
  std::optional<JammingPoint> phi_j;  ///< nullopt with fewer than two states
  long evaluations = 0;               ///< evaluations of energy and forces in all steps
  PairCounts counts;                  ///< work of the pair loop, summed over all evaluations
  MinimiseWork work;                  ///< work of the minimisers in all steps
};

/// Energies of the states, as input of fit_jamming_point().
std::vector<EnergyPoint> energy_points(const JamResult& result);

/// State of a run between two strain steps: a value. Continuing from it, in any process, gives the same bits as an
/// uninterrupted run.
struct JamProgress {
  Packing packing;                           ///< minimised state from which the next step starts; initially as placed
  JamStage stage = JamStage::consolidation;  ///< stage of the next step
  double step_fraction = 0;  ///< fraction of φ − φ_J for the next expansion step; see JamOptions::step_fraction
  int halvings = 0;          ///< number of failed expansion steps
  /// Index in the path of the last equilibrium before a branch ended: in the next strain step the packing lost all
  /// contact forces, or slid without finding an equilibrium. `packing` is the resulting state, and the next steps
  /// compress it again. −1: no branch has ended.
  int lost = -1;
  JamResult result;  ///< result so far; its status is not_called while steps remain
  /// Before the first step: true if the packing counts as jammed, for any energy, so that this step is one of
  /// expansion.
  bool jammed = false;

  bool ended() const { return result.status != JamStatus::not_called; }  ///< true if no step is left
};

/// Progress of a run before its first strain step.
JamProgress begin_jam(Packing start, const JamOptions& options);
/// Progress of a run that starts with a jammed packing and only decompresses it.
JamProgress begin_expansion(Packing jammed, const JamOptions& options);

/// Makes the next strain step of a run that has not ended: minimises and appends it to the path. The state of an
/// expansion step is kept if it is an equilibrium or ended by minimise.energy_change. After a stop request the run ends
/// as interrupted with an unfinished step; to continue, start from the progress before this call.
void advance(JamProgress& progress, const JamOptions& options, std::stop_token stop = {});

/// Called after every step that was not interrupted.
using OnProgress = std::function<void(const JamProgress&)>;

/// Runs the protocol to its end, from its beginning or from a saved progress.
JamResult jam(JamProgress from, const JamOptions& options, std::stop_token stop = {},
              const OnProgress& on_progress = {});
JamResult jam(Packing start, const JamOptions& options, std::stop_token stop = {}, const OnProgress& on_progress = {});

}  // namespace isojam
