#pragma once

#include <array>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "engine/names/enum_names.hpp"
#include "tasks/io/describe.hpp"

namespace isojam {

/// Median and range of n values, such as repetitions, packings or pairs.
struct Spread {
  double median = 0, least = 0, greatest = 0;
  int n = 0;
};

/// The Spread of the finite values; nullopt if there are none. If their number is even, the median is the mean of the
/// two middle values.
std::optional<Spread> spread(std::vector<double> values);

/// Text such as "budget 2, residual_reached 1": each reason with its count. A single reason has no count.
std::string reasons_text(const std::map<std::string, int>& counts);

/// Cost and error of one method with one setting, for one task.
// NOLINTNEXTLINE(bugprone-exception-escape): moving a Json is noexcept; the check sees its assertions throw.
struct ChartPoint {
  std::string task;  ///< the task, such as "octahedron, Δφ = 0.015"
  std::string method;
  std::string setting;            ///< the parameter, such as "residual 1e-06"
  std::optional<Spread> seconds;  ///< CPU time of one thread; nullopt if it was not measured
  std::optional<Spread> error;    ///< error as defined by the family; nullopt if there is no result
  std::string stopped;            ///< reasons_text() of the reasons why the runs stopped
  bool failed = false;            ///< true if a run of the method did not reach the requested accuracy
  Json further = Json::object();  ///< other numbers, by name; null if a number is not defined
  bool on_front = false;          ///< set by chart_data()
};

/// Runs of several methods on the packings of one task.
class TaskRuns {
 public:
  /// Adds a run. `reason` states why it stopped; `error` is nullopt if there is no result.
  void add(const std::string& method, const std::string& setting, double seconds, std::optional<double> error,
           const std::string& reason, bool failed);
  /// Appends a point for each method and setting, in the order of their first runs.
  void append_to(std::vector<ChartPoint>& points, const std::string& task) const;

 private:
  struct Runs {
    std::string method, setting;
    std::vector<double> seconds, errors;
    std::map<std::string, int> reasons;
    bool failed = false;
  };
  std::vector<Runs> all_;
};

/// States whether the points of a family are complete.
enum class FamilyEnd {
  complete,
  cut,         ///< some points are missing, because the time limit of the chart was reached
  interrupted  ///< some points are missing, because a signal stopped the program
};
template <>
inline constexpr std::array enum_names<FamilyEnd>{EnumName{FamilyEnd::complete, "complete"},
                                                  EnumName{FamilyEnd::cut, "cut"},
                                                  EnumName{FamilyEnd::interrupted, "interrupted"}};

/// Points with the same definition of time and error.
// NOLINTNEXTLINE(bugprone-exception-escape): as above.
struct ChartFamily {
  std::string name;
  std::string error_is;  ///< definition of the error, for axes and captions
  std::string note;      ///< description of the measurement
  FamilyEnd ended = FamilyEnd::complete;
  std::vector<ChartPoint> points;
};

}  // namespace isojam
