#pragma once

#include <array>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "engine/names/enum_names.hpp"
#include "tasks/io/json.hpp"

namespace isojam {

/// Median and range of values, over repetitions, packings or pairs.
struct Spread {
  double median = 0, least = 0, greatest = 0;
  int n = 0;
};

/// The Spread of the finite values; nullopt if there are none. The median of an even number of values is the mean of
/// the middle two.
std::optional<Spread> spread(std::vector<double> values);

/// "budget 2, residual_reached 1": each reason, with its count if there are several.
std::string reasons_text(const std::map<std::string, int>& counts);

/// Cost and error of one method for one task.
// NOLINTNEXTLINE(bugprone-exception-escape): moving a Json is noexcept; the check sees its assertions throw.
struct ChartPoint {
  std::string task;  ///< the task: "octahedron, Δφ = 0.015"
  std::string method;
  std::string setting;            ///< the parameter: "residual 1e-06"
  std::optional<Spread> seconds;  ///< CPU time of one thread; nullopt if it was not measured
  std::optional<Spread> error;    ///< error, which the family defines; nullopt if there is no result
  std::string stopped;            ///< stop reasons of all repetitions: "residual_reached", "budget 1, ..."
  bool failed = false;            ///< true if the method did not reach the requested accuracy
  Json further = Json::object();  ///< other numbers; null if a number is not defined
};

/// Completeness of the points of a family.
enum class FamilyEnd {
  complete,
  cut,         ///< some points are missing, because the time limit of the chart was reached
  interrupted  ///< some points are missing, because a signal stopped the program
};
template <>
inline constexpr std::array enum_names<FamilyEnd>{EnumName{FamilyEnd::complete, "complete"},
                                                  EnumName{FamilyEnd::cut, "cut"},
                                                  EnumName{FamilyEnd::interrupted, "interrupted"}};

/// CPU time of a method as a function of the number of particles: seconds = prefactor · N^exponent.
struct GrowthFit {
  std::string task, method;
  double exponent = 0, prefactor = 0;
  std::optional<double> half_width;  ///< of the exponent's 95 % confidence interval; nullopt for fewer than three
                                     ///< measurements
  int n = 0;                         ///< number of fitted measurements
};

/// A family of points with the same definition of time and error.
// NOLINTNEXTLINE(bugprone-exception-escape): as above.
struct ChartFamily {
  std::string name;
  std::string error_is;  ///< definition of the error, for axes and captions
  std::string note;      ///< method of the measurement
  FamilyEnd ended = FamilyEnd::complete;
  std::vector<ChartPoint> points;
  std::vector<GrowthFit> fits{};  ///< fits to points with different numbers of particles
};

}  // namespace isojam
