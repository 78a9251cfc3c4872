#include "tasks/extras/chart/data.hpp"

#include <algorithm>
#include <span>

#include "tasks/io/version.hpp"

namespace isojam {
namespace {

bool usable(const ChartPoint& point) { return !point.failed && point.seconds && point.error; }

/// True if the point is on the Pareto front of its case: no other point is better in time or error and not worse in the
/// other quantity. Times and errors are medians. Of several equal points, only the first is on the front.
bool on_front(std::span<const ChartPoint> points, const ChartPoint& point) {
  const auto is_beaten_by = [&](const ChartPoint& other) {
    if (!usable(other) || other.task != point.task) return false;
    const auto here = std::pair(point.seconds->median, point.error->median),
               there = std::pair(other.seconds->median, other.error->median);
    return here == there ? &other < &point : there.first <= here.first && there.second <= here.second;
  };
  return usable(point) && std::none_of(points.begin(), points.end(), is_beaten_by);
}

void describe_program(Fields& field, ChartData& data) {
  field("version", data.version, "Version of isojam.");
  field("git", data.git, "Commit of the sources.");
  field("compiler", data.compiler, "Name and version of the compiler.");
}

constexpr const char* meaning_of_ended =
    "Reason why the part is incomplete. `cut`: The time limit was reached before the last measurement. `interrupted`: "
    "A signal stopped the program.";

}  // namespace

void describe(Fields& field, Spread& spread) {
  field.type("spread", "Median and range of n values.");
  field("median", spread.median, "Median.").range(not_negative).finite();
  field("least", spread.least, "Smallest value.").range(not_negative).finite();
  field("greatest", spread.greatest, "Largest value.").range(not_negative).finite();
  field("n", spread.n, "Number of values.").range({1, count_range.high});
}

void describe(Fields& field, ChartPoint& point) {
  field.type("point", "Cost and error of one method with one setting.");
  field("case", point.task, "Computed case.");
  field("method", point.method, "Method.");
  field("setting", point.setting, "Parameter of the method.");
  field("seconds", point.seconds, "CPU time of one thread; absent if it was not measured.").unit("s");
  field("error", point.error, "Error as the family defines it; absent if there is no result.");
  field("stopped", point.stopped, "Reason why the computation ended, with counts if there are several reasons.");
  field("failed", point.failed, "True if the computation did not reach the requested result.");
  field("on_front", point.on_front, "True if no other point of the same case has both less time and less error.");
  field.custom("further",
               {[&point] { return point.further; },
                nullptr,
                {{"type", "object"}, {"additionalProperties", {{"type", {"number", "null"}}}}},
                "object of numbers"},
               "Other numbers by name; null if a number is not defined.");
}

void describe(Fields& field, ChartFamily& family) {
  field("name", family.name, "Name of the comparison.");
  field("error_is", family.error_is, "Definition of the error.");
  field("note", family.note, "Description of the measurement.");
  field("ended", family.ended, meaning_of_ended);
  field("points", family.points, "One point for each case, method and setting.");
}

void describe(Fields& field, AtlasRow& row) {
  field.type("cell", "One method in a regime of known difficulty, at one severity.");
  field("regime", row.regime, "Difficulty of the regime.");
  field("setting", row.setting, "Severity of the difficulty.");
  field("method", row.method, "Method.");
  field("standard", row.standard, "True if isojam uses this method in this regime.");
  field("verdict", row.verdict,
        "Result of the method. `holds`: It gives a correct result. `refuses`: It gives no result, but states the "
        "reason. `fails`: It gives a wrong result, or ends without a result.");
  field("figure", row.figure, "Measured value.");
  field("reason", row.reason, "Reason for the verdict.");
}

void describe(Fields& field, ChartAtlas& atlas) {
  field("ended", atlas.ended, meaning_of_ended);
  field("rows", atlas.rows, "One row for each method at each severity.");
}

void describe(Fields& field, ChartData& data) {
  field("schema", data.schema, "Name and version of the file format.");
  field.nested(
      "program", [&data](Fields& inner) { describe_program(inner, data); }, "The build of isojam.");
  field("threads", data.threads, "Number of threads. Times are CPU seconds of one thread.");
  field("config", data.config, "Complete configuration.");
  field("families", data.result.families, "Families of points with the same definition of time and error.");
  field("atlas", data.result.atlas, "Stability atlas; absent unless it was requested.");
  const auto costs = [&data] {
    Json json = Json::object();
    for (const PartCost& cost : data.result.costs) json[cost.part] = cost.cpu_seconds;
    return json;
  };
  field
      .custom("cpu_seconds",
              {costs,
               nullptr,
               {{"type", "object"}, {"additionalProperties", {{"type", "number"}, {"minimum", 0}}}},
               "object of numbers"},
              "CPU time of each part of the chart, including computations that are not measured.")
      .unit("s");
}

Json chart_data(const ChartConfig& config, const ChartResult& result) {
  ChartData data{
      "isojam.chart.v3", std::string(version()), std::string(git_hash()), std::string(compiler()), 1, config, result};
  for (ChartFamily& family : data.result.families) {
    for (ChartPoint& point : family.points) point.on_front = on_front(family.points, point);
  }
  return written(data);
}

}  // namespace isojam
