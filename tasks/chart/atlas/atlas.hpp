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

// Range of validity of the methods: each known failure regime, in steps of severity, for each method.

enum class AtlasVerdict {
  holds,
  refuses,  ///< no answer, and the reason for it
  fails     ///< a false answer, or an end without an answer
};
template <>
inline constexpr std::array enum_names<AtlasVerdict>{EnumName{AtlasVerdict::holds, "holds"},
                                                     EnumName{AtlasVerdict::refuses, "refuses"},
                                                     EnumName{AtlasVerdict::fails, "fails"}};

/// One cell of the atlas.
struct AtlasRow {
  std::string regime;   ///< the difficulty: "depth, edge on face"
  std::string setting;  ///< its severity: "1e-10"
  std::string method;
  bool standard = false;  ///< isojam uses this method here
  AtlasVerdict verdict = AtlasVerdict::fails;
  std::string figure;  ///< the measured figure, with its unit
  std::string reason;  ///< reason for the verdict
};

/// A contact holds if V and S are accurate to this fraction, the residual that minimisers are asked for, or if its
/// force is accurate to this fraction of the mean contact force at Δφ = 5e-4.
inline constexpr double atlas_overlap_tolerance = 1e-6;

/// Overlap kernels in double-double (the standard near jamming), in doubles (far from it), and as a plain clip of every
/// face in doubles. References are closed forms, or the clip in quadruple precision. Seconds.
std::vector<AtlasRow> overlap_atlas();

/// Energies: smallest cells against a sum over all images; units, rotations, translations, numbering, exchange. Takes
/// seconds.
std::vector<AtlasRow> packing_atlas();

/// Minimisers from states strained towards jamming, from an equilibrium and from an unjammed start; the protocol with
/// cubes and with both kinds of start. Takes a quarter of a minute. After a stop request returns the rows completed so
/// far.
std::vector<AtlasRow> minimiser_atlas(const AtlasStates& states, const std::stop_token& stop = {});

/// Hessians against central differences, and softest modes by shift-invert, plain Lanczos and the dense solver, for
/// increasing condition numbers. Takes a quarter of a minute. After a stop request returns the rows completed so far.
std::vector<AtlasRow> modes_atlas(const AtlasStates& states, const std::stop_token& stop = {});

struct AtlasOptions {
  bool jammed_states = true;  ///< include the parts that need jammed packings: half a minute
  std::stop_token stop{};     ///< on a stop request the rows completed so far are returned
  /// Called with the name of the next part.
  std::function<void(const std::string& part)> progress{};
};

/// All of them, in this order. Bitwise reproducible, unless stopped.
std::vector<AtlasRow> stability_atlas(const AtlasOptions& options = {});

}  // namespace isojam
