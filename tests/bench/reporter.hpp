#pragma once

#include <benchmark/benchmark.h>

#include <iosfwd>
#include <map>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "tests/bench/ratios.hpp"

namespace isojam::bench {

/// Collects the results of all repetitions of all benchmarks.
class MedianReporter : public benchmark::BenchmarkReporter {
 public:
  bool ReportContext(const Context& context) override;
  void ReportRuns(const std::vector<Run>& runs) override;

  /// Median of each quantity, by its name as in Claim.
  std::map<std::string, double> medians() const;
  const std::map<std::string, std::string>& labels() const { return labels_; }
  bool failed() const { return failed_; }
  /// Description of the machine: processor, number of cores, compiler.
  const nlohmann::ordered_json& machine() const { return machine_; }

 private:
  std::map<std::string, std::vector<double>> samples_;
  std::map<std::string, std::string> labels_;
  nlohmann::ordered_json machine_;
  bool failed_ = false;
};

void print_medians(std::ostream& out, const MedianReporter& reporter);
void print_verdicts(std::ostream& out, const std::vector<Verdict>& verdicts);
nlohmann::ordered_json to_json(const MedianReporter& reporter, const std::vector<Verdict>& verdicts);

}  // namespace isojam::bench
