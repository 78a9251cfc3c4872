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

/// Spread over repetitions, packings or pairs.
struct Spread {
  double median = 0, least = 0, greatest = 0;
  int n = 0;
};

/// The spread of finite values; nullopt if there are none. The median of an even number is the mean of the middle two.
std::optional<Spread> spread(std::vector<double> values);

/// "budget 2, residual_reached 1": each reason, with its count if there are several.
std::string reasons_text(const std::map<std::string, int>& counts);

/// One method applied to one task: its cost and its error.
// NOLINTNEXTLINE(bugprone-exception-escape): moving a Json is noexcept; the check sees its assertions throw.
struct ChartPoint {
  std::string task;  ///< the task: "octahedron, Δφ = 0.015"
  std::string method;
  std::string setting;            ///< the parameter: "residual 1e-06"
  std::optional<Spread> seconds;  ///< CPU time of one thread; nullopt if it was never measured
  std::optional<Spread> error;    ///< as the family defines it; nullopt without a result
  std::string stopped;            ///< stop reasons of all repetitions: "residual_reached", "budget 1, ..."
  bool failed = false;            ///< it did not reach the requested accuracy
  Json further = Json::object();  ///< other numbers, null where not defined
};

/// Completeness of a family's points.
enum class FamilyEnd {
  complete,
  cut,         ///< the time limit of the chart was reached
  interrupted  ///< stopped by a signal
};
template <>
inline constexpr std::array enum_names<FamilyEnd>{EnumName{FamilyEnd::complete, "complete"},
                                                  EnumName{FamilyEnd::cut, "cut"},
                                                  EnumName{FamilyEnd::interrupted, "interrupted"}};

/// Growth of the seconds of a method with the number of particles: prefactor · N^exponent.
struct GrowthFit {
  std::string task, method;
  double exponent = 0, prefactor = 0;
  std::optional<double> half_width;  ///< of the exponent's 95 % confidence interval; nullopt for fewer than three
                                     ///< measurements
  int n = 0;                         ///< number of fitted measurements
};

/// Points with a common definition of time and error.
// NOLINTNEXTLINE(bugprone-exception-escape): as above.
struct ChartFamily {
  std::string name;
  std::string error_is;  ///< definition of `error`, for axes and captions
  std::string note;      ///< measuring method
  FamilyEnd ended = FamilyEnd::complete;
  std::vector<ChartPoint> points;
  std::vector<GrowthFit> fits{};  ///< of points at several numbers of particles
};

}  // namespace isojam
