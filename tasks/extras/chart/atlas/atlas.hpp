#pragma once

#include <array>
#include <functional>
#include <stop_token>
#include <string>
#include <string_view>
#include <vector>

#include "engine/names/enum_names.hpp"
#include "tasks/extras/chart/atlas/states.hpp"

namespace isojam {

// The stability atlas: the range in which each method is valid. For each known difficulty, cells of increasing severity
// are tested with each method.

enum class AtlasVerdict {
  holds,
  refuses,  ///< the method gives no result, but states the reason
  fails     ///< the method gives a wrong result, or ends without a result
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
  bool standard = false;  ///< true if isojam uses this method in this regime
  AtlasVerdict verdict = AtlasVerdict::fails;
  std::string figure;  ///< the measured value with its unit
  std::string reason;  ///< reason for the verdict
};

/// Largest error for the verdict `holds` of an overlap. It is the residual that is requested of minimisers. The
/// relative errors of V and S must be at most this value, or the error of the force must be at most this fraction of
/// the mean contact force at Δφ = 5e-4.
inline constexpr double atlas_overlap_tolerance = 1e-6;

/// Tests of overlaps: in double-double (which isojam uses near jamming), in double (which it uses far from jamming),
/// and by simple clipping of every face in double. The references are closed forms, or clipping in quadruple precision.
/// Takes seconds.
std::vector<AtlasRow> overlap_atlas();

/// Tests of energies: the smallest cells, compared with a sum over all images; and changes of units, rotations,
/// translations, other numbering and exchange of particles. Takes seconds.
std::vector<AtlasRow> packing_atlas();

/// Tests of minimisers that start from states strained towards jamming, from an equilibrium and from an unjammed state.
/// Tests of the protocol with cubes and with both kinds of initial configurations. Takes a quarter of a minute. After a
/// stop request, returns the rows that are complete.
std::vector<AtlasRow> minimiser_atlas(const AtlasStates& states, const std::stop_token& stop = {});

/// Tests of Hessians, compared with central differences, and of the softest modes by the shift-invert method, the
/// simple Lanczos method and the dense solver, for increasing condition numbers. Takes a quarter of a minute. After a
/// stop request, returns the rows that are complete.
std::vector<AtlasRow> modes_atlas(const AtlasStates& states, const std::stop_token& stop = {});

struct AtlasOptions {
  bool jammed_states = true;  ///< include the tests that need jammed packings, which take half a minute
  std::stop_token stop{};     ///< after a stop request, the rows that are complete are returned
  /// Called with the name of the next part.
  std::function<void(const std::string& part)> progress{};
};

/// Makes all these tests, in this order. The rows have the same bits in each run, unless it was stopped.
std::vector<AtlasRow> stability_atlas(const AtlasOptions& options = {});

}  // namespace isojam
