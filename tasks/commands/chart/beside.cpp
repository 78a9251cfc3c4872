#include "tasks/commands/chart/chart.hpp"
#include "tasks/system/process.hpp"
#include "tasks/system/standard_streams.hpp"

namespace isojam {

ExitCode chart(const ChartArguments&, const Session& session, Console&) {
  flush_output();
  become("isojam-chart", session.words);
}

}  // namespace isojam
