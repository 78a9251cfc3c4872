#include "tests/bench/reporter.hpp"

#include <algorithm>
#include <fstream>
#include <iostream>

namespace isojam::bench {

namespace {

/// The first "model name" in /proc/cpuinfo.
std::string cpu_model() {
  std::ifstream info("/proc/cpuinfo");
  for (std::string line; std::getline(info, line);) {
    const std::size_t colon = line.find(": ");
    if (line.starts_with("model name") && colon != std::string::npos) return line.substr(colon + 2);
  }
  return "unknown";
}

std::string compiler() {
#if defined(__clang__)
  return "clang " __VERSION__;
#else
  return "g++ " __VERSION__;
#endif
}

/// Text with three significant digits and a suitable unit.
std::string readable(double value, bool is_time) {
  char text[32];
  if (!is_time) {
    std::snprintf(text, sizeof text, "%.4g", value);
  } else if (value < 1e3) {
    std::snprintf(text, sizeof text, "%.3g ns", value);
  } else if (value < 1e6) {
    std::snprintf(text, sizeof text, "%.3g us", value / 1e3);
  } else if (value < 1e9) {
    std::snprintf(text, sizeof text, "%.3g ms", value / 1e6);
  } else {
    std::snprintf(text, sizeof text, "%.3g s", value / 1e9);
  }
  return text;
}

bool is_time(const std::string& quantity) { return quantity.find('#') == std::string::npos; }

std::string padded(std::string text, std::size_t width) {
  text.resize(std::max(text.size() + 1, width), ' ');
  return text;
}

std::string_view word(const Verdict& verdict) {
  if (verdict.claim.bound == 0) return "";
  return verdict.holds ? "met" : "MISSED";
}

std::string required(const Claim& claim) {
  if (claim.bound == 0) return "";
  return (claim.kind == Claim::Kind::faster ? ">= " : "<= ") +
         readable(claim.bound, claim.kind == Claim::Kind::absolute && is_time(claim.ours));
}

}  // namespace

bool MedianReporter::ReportContext(const Context& context) {
  machine_ = {{"cpu", cpu_model()},
              {"cores", context.cpu_info.num_cpus},
              {"mhz", context.cpu_info.cycles_per_second / 1e6},
              {"compiler", compiler()},
#ifdef __AVX2__
              {"avx2", true}
#else
              {"avx2", false}
#endif
  };
  return true;
}

void MedianReporter::ReportRuns(const std::vector<Run>& runs) {
  for (const Run& run : runs) {
    if (run.run_type != Run::RT_Iteration) continue;
    const std::string& name = run.run_name.function_name;
    if (run.error_occurred) {
      std::cerr << name << ": " << run.error_message << '\n';
      failed_ = true;
      continue;
    }
    const double unit = benchmark::GetTimeUnitMultiplier(run.time_unit) / 1e9;
    // Benchmarks on one thread report their own CPU time, so that other processes have little effect.
    const bool wall_clock = run.run_name.time_type == "real_time";
    samples_[name].push_back((wall_clock ? run.GetAdjustedRealTime() : run.GetAdjustedCPUTime()) / unit);
    if (!run.report_label.empty()) labels_[name] = run.report_label;
    for (const auto& [counter, value] : run.counters) samples_[name + '#' + counter].push_back(value.value);
  }
}

std::map<std::string, double> MedianReporter::medians() const {
  std::map<std::string, double> result;
  for (const auto& [name, values] : samples_) result[name] = median(values);
  return result;
}

void print_medians(std::ostream& out, const MedianReporter& reporter) {
  for (const auto& [name, value] : reporter.medians()) {
    const auto label = reporter.labels().find(name);
    out << padded(name, 52) << padded(readable(value, is_time(name)), 12)
        << (label == reporter.labels().end() ? "" : label->second) << '\n';
  }
}

void print_verdicts(std::ostream& out, const std::vector<Verdict>& verdicts) {
  out << padded("ours", 40) << padded("", 10) << padded("peer", 40) << padded("", 10) << padded("ratio", 9)
      << padded("required", 10) << '\n';
  for (const Verdict& verdict : verdicts) {
    const Claim& claim = verdict.claim;
    const bool time = is_time(claim.ours);
    const std::string peer = claim.peer.empty() ? "" : readable(verdict.peer, time);
    out << padded(claim.ours, 40) << padded(readable(verdict.ours, time), 10) << padded(claim.peer, 40)
        << padded(peer, 10) << padded(claim.peer.empty() ? "" : readable(verdict.ratio, false), 9)
        << padded(required(claim), 10) << word(verdict) << '\n';
  }
}

nlohmann::ordered_json to_json(const MedianReporter& reporter, const std::vector<Verdict>& verdicts) {
  nlohmann::ordered_json ratios = nlohmann::ordered_json::array();
  for (const Verdict& verdict : verdicts) {
    const Claim& claim = verdict.claim;
    nlohmann::ordered_json row = {{"ours", claim.ours}, {"ours_value", verdict.ours}};
    if (!claim.peer.empty()) row.update({{"peer", claim.peer}, {"peer_value", verdict.peer}, {"ratio", verdict.ratio}});
    if (claim.bound != 0) {
      row[claim.kind == Claim::Kind::faster ? "at_least" : "at_most"] = claim.bound;
      row["met"] = verdict.holds;
    }
    ratios.push_back(std::move(row));
  }
  return {{"machine", reporter.machine()}, {"medians", reporter.medians()}, {"ratios", std::move(ratios)}};
}

}  // namespace isojam::bench
