#include <memory>

#include "tasks/commands/command.hpp"

// The commands of a build that found no libraries for pages.

namespace isojam {
namespace {

/// The words that the command would take: what is said is to be what it lacks, not that one of them is unknown.
struct Unread {
  std::string place, output;
  bool full = false;
};

void add_absent(CLI::App& app, Session& session, const std::string& name, const std::string& place) {
  const auto unread = std::make_shared<Unread>();
  auto options =
      add_command(app, session, name, "Not in this build: no vega/ and three/ were there when it was configured",
                  [name, unread](Console& console) {
                    console.error("this build has no `" + name +
                                  "`: install libjs-vega and libjs-three (or set ISOJAM_JAVASCRIPT) and configure "
                                  "again with -DISOJAM_PAGES=ON");
                    return ExitCode::usage;
                  });
  options.text(place, unread->place, "Not read", "FILE");
  options.text("-o,--output", unread->output, "Not read", "FILE");
  options.flag("--full", unread->full, "Not read");
}

}  // namespace

void add_report(CLI::App& app, Session& session) { add_absent(app, session, "report", "directory"); }
void add_chart(CLI::App& app, Session& session) { add_absent(app, session, "chart", "config"); }

}  // namespace isojam
