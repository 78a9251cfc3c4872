#pragma once

#include <array>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "engine/names/enum_names.hpp"
#include "tasks/json/json.hpp"

namespace isojam {

/// What repetitions, packings or pairs gave.
struct Spread {
  double median = 0, least = 0, greatest = 0;
  int n = 0;
};

/// The spread of finite values; nullopt if there are none. The median of an even number is the mean of the middle two.
std::optional<Spread> spread(std::vector<double> values);

/// "budget 2, residual_reached 1": each reason, with its count where there are several.
std::string reasons_text(const std::map<std::string, int>& counts);

/// One way to compute one thing: what it cost and how far it was off.
// NOLINTNEXTLINE(bugprone-exception-escape): moving a Json is noexcept; the check sees its assertions throw.
struct ChartPoint {
  std::string task;               ///< what was computed: "octahedron, Δφ = 0.015"
  std::string method;             ///< how
  std::string setting;            ///< with which parameter: "residual 1e-06"
  std::optional<Spread> seconds;  ///< CPU time of one thread; nullopt if it was never measured
  std::optional<Spread> error;    ///< as the family defines it; nullopt if there is no result to be off
  std::string stopped;            ///< why it ended, of all repetitions: "residual_reached", "budget 1, ..."
  bool failed = false;            ///< it did not reach what it was asked for
  Json further = Json::object();  ///< other numbers, null where not defined
};

/// How many of a family's points there are.
enum class FamilyEnd {
  complete,
  cut,         ///< the time for all of the chart was over
  interrupted  ///< a signal
};
template <>
inline constexpr std::array enum_names<FamilyEnd>{EnumName{FamilyEnd::complete, "complete"},
                                                  EnumName{FamilyEnd::cut, "cut"},
                                                  EnumName{FamilyEnd::interrupted, "interrupted"}};

/// How the seconds of a method grow with the number of particles: as prefactor · N^exponent.
struct GrowthFit {
  std::string task, method;
  double exponent = 0, prefactor = 0;
  std::optional<double> half_width;  ///< of the exponent's 95 % interval; nullopt for fewer than three measurements
  int n = 0;                         ///< measurements fitted
};

/// Points that are measured alike.
// NOLINTNEXTLINE(bugprone-exception-escape): as above.
struct ChartFamily {
  std::string name;
  std::string error_is;  ///< what `error` is, for axes and captions
  std::string note;      ///< how it was measured
  FamilyEnd ended = FamilyEnd::complete;
  std::vector<ChartPoint> points;
  std::vector<GrowthFit> fits{};  ///< of points at several numbers of particles
};

}  // namespace isojam
