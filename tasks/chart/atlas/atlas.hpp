#pragma once

#include <array>
#include <functional>
#include <stop_token>
#include <string>
#include <string_view>
#include <vector>

#include "engine/names/enum_names.hpp"
#include "tasks/chart/atlas/states.hpp"

namespace isojam {

// Where the methods hold, and where they do not: each known failure regime, in steps of severity, by each method.

enum class AtlasVerdict {
  holds,
  refuses,  ///< no answer, and the reason for it
  fails     ///< an answer that is wrong, or an end without one
};
template <>
inline constexpr std::array enum_names<AtlasVerdict>{EnumName{AtlasVerdict::holds, "holds"},
                                                     EnumName{AtlasVerdict::refuses, "refuses"},
                                                     EnumName{AtlasVerdict::fails, "fails"}};

/// One cell of the atlas.
struct AtlasRow {
  std::string regime;   ///< what is difficult: "depth, edge on face"
  std::string setting;  ///< how difficult: "1e-10"
  std::string method;
  bool standard = false;  ///< the method is what isojam uses there
  AtlasVerdict verdict = AtlasVerdict::fails;
  std::string figure;  ///< what was measured, with its unit
  std::string reason;  ///< for the verdict
};

/// A contact holds if V and S are right to this fraction, the residual that minimisers are asked for, or if its force
/// is right to this fraction of the mean contact force at Δφ = 5e-4.
inline constexpr double atlas_overlap_tolerance = 1e-6;

/// Overlap kernels in double-double (the standard near jamming), in doubles (far from it), and as a plain clip of every
/// face in doubles. References are closed forms, or the clip in quadruple precision. Seconds.
std::vector<AtlasRow> overlap_atlas();

/// Energies: smallest cells against a sum over all images; units, turns, translations, numbering, exchange. Seconds.
std::vector<AtlasRow> packing_atlas();

/// Minimisers from states strained towards jamming, from an equilibrium, from an unjammed start; the protocol with
/// cubes and with starts of either kind. A quarter of a minute; after a stop request, the rows until then.
std::vector<AtlasRow> minimiser_atlas(const AtlasStates& states, const std::stop_token& stop = {});

/// Hessians against central differences, and softest modes by shift-invert, plain Lanczos and the dense solver, as the
/// condition number grows. A quarter of a minute; after a stop request, the rows until then.
std::vector<AtlasRow> modes_atlas(const AtlasStates& states, const std::stop_token& stop = {});

struct AtlasOptions {
  bool jammed_states = true;  ///< also what needs packings to be jammed first: half a minute
  std::stop_token stop{};     ///< leaves the rows until then
  /// Told what is measured next.
  std::function<void(const std::string& part)> progress{};
};

/// All of them, in this order. The same bits every time, unless stopped.
std::vector<AtlasRow> stability_atlas(const AtlasOptions& options = {});

}  // namespace isojam
