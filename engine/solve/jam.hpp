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

/// How well states are relaxed on the way up, which tetrahedra remember: docs/protocol.md has φ_J by either.
enum class Consolidation {
  relaxed,  ///< until forces balance, or consolidation_evaluations are spent: near the limit of any relaxation
  hasty     ///< at most 50 evaluations a strain step, as fast as the paper's φ_J of tetrahedra suggests
};
template <>
inline constexpr std::array enum_names<Consolidation>{EnumName{Consolidation::relaxed, "relaxed"},
                                                      EnumName{Consolidation::hasty, "hasty"}};

/// What the states of an expansion are given: their density or their pressure.
enum class Control { density, pressure };
template <>
inline constexpr std::array enum_names<Control>{EnumName{Control::density, "density"},
                                                EnumName{Control::pressure, "pressure"}};

/// How the cell may change, beside its volume.
enum class CellShape {
  isotropic,  ///< it stays a cube
  free        ///< it gives way to shear: every state bears a hydrostatic stress, from the way up on
};
template <>
inline constexpr std::array enum_names<CellShape>{EnumName{CellShape::isotropic, "isotropic"},
                                                  EnumName{CellShape::free, "free"}};

/// Jamming protocol of Smith, Fisher, Alam 2011 (and 2010): consolidate in small isotropic strain steps, then expand
/// towards φ_J, minimising after each. Energies in Y·V_p.
struct JamOptions {
  double initial_density = 0.05;  ///< φ of the random packing
  /// Δφ of a strain step on the way up. Over 16 packings of 100 each, steps of .005, .01 and .02 gave the same φ_J and
  /// the same scatter (octahedra .684, .684, .684 with standard deviations .004, .005, .003): the longest costs least.
  double consolidation_step = 0.02;
  double target_energy = 3.2e-5;  ///< E/N at which consolidation ends (the paper's)
  /// Reading of the paper's target. false: consolidation ends at the minimised state with E/N ≥ target_energy, and goes
  /// on if full minimisation leaves it with less than half of that. true: each strain step is as large as keeps the
  /// unrelaxed E/N below target_energy, and consolidation ends when minimisation no longer removes the energy.
  bool target_before_relaxation = false;
  /// Density that is not exceeded; the cell must be legal up to here. Crystals can pass .9 before they reach the target
  /// energy.
  double max_density = 0.93;
  /// An expansion step is this fraction of the distance φ − φ_J as the last state shows it, but no longer than
  /// longest_step, nor far beyond final_distance. A step that failed is tried again at half its length, whichever of
  /// these it was; the fraction that this makes grows back where a step succeeds.
  double step_fraction = 0.35;
  double longest_step = 0.05;  ///< Δφ that no step exceeds
  /// A step in which the packing gives way (rearrangement.hpp), or comes apart, is tried again at half its length until
  /// it is no longer than this fraction of φ − φ_J: so closely is the density of such an event known. 0: no step is.
  double event_resolution = 0;
  double final_distance = 0.004;  ///< expansion ends when φ − φ_J falls below this
  double fit_window = 0.02;       ///< states with φ − φ_J below this give φ_J
  int max_steps = 400;            ///< strain steps in all
  /// Consolidation only passes through its states: L-BFGS relaxes each until forces balance to consolidation_residual,
  /// E/N falls below consolidation_energy, or consolidation_evaluations are spent. The state at the target is then
  /// minimised fully.
  double consolidation_residual = 1e-3;
  double consolidation_energy = 1e-14;                   ///< E/N below which a state on the way up counts as unjammed
  int consolidation_evaluations = 2000;                  ///< that a state on the way up gets at most
  Consolidation consolidation = Consolidation::relaxed;  ///< which of the two ways up
  /// Under pressure control the states of the expansion are those of ever lower pressures, volume and particles in
  /// balance with it: a step in which Δφ is expected to fall by a fraction is one to (1 − fraction)⁵ of the pressure.
  Control control = Control::density;
  CellShape cell = CellShape::isotropic;  ///< whether the cell gives way to shear
  MinimiseOptions minimise;               ///< of the states of the expansion
};

/// Way up, and way down.
enum class JamStage { consolidation, expansion };
template <>
inline constexpr std::array enum_names<JamStage>{EnumName{JamStage::consolidation, "consolidation"},
                                                 EnumName{JamStage::expansion, "expansion"}};

/// How a state of the expansion differs from the one before. On a smooth piece of the path energies go as Δφ⁶ and
/// particles move alike; where the packing gives way, at a fold, energy is lost and a few particles move far.
struct Rearrangement {
  double energy_ratio = 0;  ///< E over the one that (Δφ₁/Δφ₀)⁶ lets expect, with Δφ as the state before shows it
  int contacts_lost = 0, contacts_gained = 0;  ///< pairs that touched before alone, and that touch now alone
  /// Participation number (Σu²)²/Σu⁴ of the particles' displacements u beside the affine ones, translation and R·turn.
  double particles_moved = 0;
};

/// The control of the cell in a stage: at the density that the packing has, or under pressure control and once the
/// expansion has begun, at a pressure.
CellControl control_at_density(const JamOptions& options);
/// The same at a pressure (Y).
CellControl control_at_pressure(const JamOptions& options, double pressure);

/// A minimised state on the path; energy in Y·V_p, pressure in Y.
struct JamStep {
  JamStage stage = JamStage::consolidation;  ///< way up or way down
  double density = 0;                        ///< φ
  double energy_per_particle = 0;            ///< E/N
  double pressure = 0;                       ///< p
  double deviator = 0;      ///< largest entry of stress + p·1 over p: what is not hydrostatic; 0 without pressure
  MinimiseSummary summary;  ///< how its minimisation ended
  int descents = 0;         ///< saddles that the state was followed down from before it was kept
  std::optional<Rearrangement> rearrangement;  ///< since the state before; of states that followed one
  /// Of an expansion step: the branch of equilibria came to its end in it. The packing lost all contact forces, or slid
  /// without end.
  bool lost = false;
};

/// How a run ended.
enum class JamStatus {
  not_called,
  jammed,            ///< φ_J was bracketed by states down to final_distance
  goal_not_reached,  ///< fewer or farther states than asked for, yet enough for φ_J
  not_jammed,        ///< fewer than two states above jamming
  density_limit,     ///< max_density reached without the target energy
  step_limit,        ///< max_steps spent
  cell_limit,        ///< the cell came to be so small or skew that a particle could touch two images of another
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

/// What came of a run.
struct JamResult {
  JamStatus status = JamStatus::not_called;  ///< why it ended
  std::vector<JamStep> path;                 ///< every minimised strain step
  std::vector<Packing> states;   ///< minimised packings of the expansion on its last branch, in the order of expansion
  std::vector<int> state_steps;  ///< index in `path` of each: equilibria, or ended by minimise.energy_change
  std::optional<JammingPoint> phi_j;  ///< none with fewer than two states
  long evaluations = 0;               ///< of energy and forces, in all steps
  PairCounts counts;                  ///< work of the pair loop, summed over all evaluations
  MinimiseWork work;                  ///< of the minimisers, summed over all steps
};

/// Energies of the states, as fit_jamming_point() is given them.
std::vector<EnergyPoint> energy_points(const JamResult& result);

/// A run between two strain steps: a value. Whoever goes on from it, in this process or another, gets the same bits as
/// the run that never stopped.
struct JamProgress {
  Packing packing;  ///< minimised, where the next strain step starts; as placed before the first
  JamStage stage = JamStage::consolidation;  ///< of the next step
  double step_fraction = 0;  ///< of the distance φ − φ_J, for the next expansion step; see JamOptions::step_fraction
  int halvings = 0;          ///< expansion steps that failed
  /// Index in the path of the last equilibrium of a branch that came to its end: the packing lost all contact forces in
  /// the strain step from there, or slid without end; `packing` is what it became, and the next steps strain it up
  /// again. −1: none did.
  int lost = -1;
  JamResult result;  ///< so far; not_called while steps remain
  /// Before the first step: the packing counts as jammed, however low its energy, and that step is one of expansion.
  bool jammed = false;

  bool ended() const { return result.status != JamStatus::not_called; }  ///< whether no step is left
};

/// Progress of a run before its first strain step.
JamProgress begin_jam(Packing start, const JamOptions& options);
/// The same of a packing that is jammed already, to be expanded from where it stands.
JamProgress begin_expansion(Packing jammed, const JamOptions& options);

/// Makes the next strain step of a run that has not ended: minimised and appended to the path, its state kept if it is
/// one of the expansion and an equilibrium, or ended by minimise.energy_change. After a stop request the run ends as
/// interrupted, with the step in whatever state it was: to go on, start from the progress before it.
void advance(JamProgress& progress, const JamOptions& options, std::stop_token stop = {});

/// Called after every step that was not interrupted.
using OnProgress = std::function<void(const JamProgress&)>;

/// Runs the protocol to its end, from the beginning or from where it stood.
JamResult jam(JamProgress from, const JamOptions& options, std::stop_token stop = {},
              const OnProgress& on_progress = {});
JamResult jam(Packing start, const JamOptions& options, std::stop_token stop = {}, const OnProgress& on_progress = {});

}  // namespace isojam
