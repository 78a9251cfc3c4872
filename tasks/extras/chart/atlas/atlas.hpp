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

// The stability atlas shows in which range each method is valid. A regime is a known difficulty, and a cell of the
// atlas is this difficulty at one severity. For each regime, cells of increasing severity are tested with each method.

enum class AtlasVerdict {
  holds,
  refuses,  ///< the method gives no result, but states the reason
  fails     ///< the method gives a wrong result, or ends without a result or reason
};
template <>
inline constexpr std::array enum_names<AtlasVerdict>{EnumName{AtlasVerdict::holds, "holds"},
                                                     EnumName{AtlasVerdict::refuses, "refuses"},
                                                     EnumName{AtlasVerdict::fails, "fails"}};

/// A test of one method in one cell.
struct AtlasRow {
  std::string regime;   ///< the difficulty, such as "depth, edge on face"
  std::string setting;  ///< the severity of the cell, such as "1e-10"
  std::string method;
  bool standard = false;  ///< true if isojam uses this method in this regime
  AtlasVerdict verdict = AtlasVerdict::fails;
  std::string figure;  ///< the measured value and its name
  std::string reason;  ///< reason for the verdict
};

/// Largest error of an overlap with the verdict `holds`. It is equal to the residual that is requested of minimisers.
/// The verdict is `holds` if the relative errors of V and S are at most this value. It is also `holds` if the error of
/// the force is at most this fraction of the mean contact force at Δφ = 5e-4.
inline constexpr double atlas_overlap_tolerance = 1e-6;

/// Tests of overlaps by three methods: the contact loop in double-double, which isojam uses near jamming; the contact
/// loop in double, which it uses far from jamming; and clipping of every face in double. The contact loop is the closed
/// line in which the surfaces intersect, see overlap.hpp. The references are closed forms, or clipping in quadruple
/// precision. Takes seconds.
std::vector<AtlasRow> overlap_atlas();

/// Tests of energies in the smallest periodic cells, which are compared with a sum over all images. Takes seconds.
std::vector<AtlasRow> packing_atlas();

/// Tests of minimisers that start from strained states, from an equilibrium, from a packing with a vacancy and from an
/// unjammed state. Tests of the protocol with cubes, and with octahedra that start above or below φ_J. Takes a
/// quarter of a minute. After a stop request, returns the complete rows.
std::vector<AtlasRow> minimiser_atlas(const AtlasStates& states, const std::stop_token& stop = {});

/// Tests of the softest modes by the shift-invert method and by the Lanczos method without inversion, for increasing
/// condition numbers. The reference is the dense solver. Tests of Hessians by central differences with several steps.
/// The reference is the analytic Hessian. Takes a quarter of a minute. After a stop request, returns the complete rows.
std::vector<AtlasRow> modes_atlas(const AtlasStates& states, const std::stop_token& stop = {});

struct AtlasOptions {
  bool jammed_states = true;  ///< include the tests that need jammed packings, which take half a minute
  std::stop_token stop{};     ///< after a stop request, the complete rows are returned
  /// called before each part, with its name
  std::function<void(const std::string& part)> progress{};
};

/// Makes all these tests, in this order. The rows have the same bits in each run, unless a run was stopped.
std::vector<AtlasRow> stability_atlas(const AtlasOptions& options = {});

}  // namespace isojam
