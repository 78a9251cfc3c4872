#include <CLI/CLI.hpp>
#include <csignal>
#include <cstdio>
#include <map>

#include "tasks/chart/chart_command.hpp"
#include "tasks/commands.hpp"
#include "tasks/export/export_command.hpp"
#include "tasks/input_error.hpp"
#include "tasks/report/report_command.hpp"
#include "tasks/version.hpp"

namespace isojam {
namespace {

constexpr auto exit_codes =
    "Exit codes: 0 all done; 1 some replicates failed, or results could no longer be written; 2 usage, or a path on "
    "the command line that cannot be read or written; 65 bad manifest or record, or a directory of another manifest; "
    "75 interrupted, the same command continues.";

struct Arguments {
  ConsoleOptions console;
  RunCommand run;
  ValidateCommand validate;
  AggregateCommand aggregate;
  StatusCommand status;
  RerunCommand rerun;
  ExportCommand exporting;
  ReportCommand report;
  ChartCommand chart;
};

/// An option that takes one of a few names.
template <class T>
CLI::Option* add_choice(CLI::App& app, const std::string& name, T& value, const std::map<std::string, T>& choices,
                        const std::string& description) {
  std::string names;
  for (const auto& [choice, meaning] : choices) names += (names.empty() ? "" : ", ") + choice;
  return app
      .add_option_function<std::string>(
          name, [&value, choices](const std::string& choice) { value = choices.at(choice); }, description)
      ->check(CLI::IsMember(choices).description(""))
      ->type_name(names);
}

void add_options(CLI::App& app, ConsoleOptions& options) {
  app.add_flag("--quiet", options.quiet, "Errors only on stderr");
  app.add_flag("-v,--verbose", options.verbose, "A line for each replicate");
  add_choice<Colour>(app, "--color", options.colour,
                     {{"auto", Colour::automatic}, {"always", Colour::always}, {"never", Colour::never}},
                     "Colour on stderr");
}

void add_run(CLI::App& app, RunCommand& command) {
  auto* run = app.add_subcommand("run", "Run what a manifest plans and the results directory does not hold yet");
  run->add_option("manifest", command.manifest, "Manifest of the sweep")->required()->type_name("MANIFEST");
  run->add_option("-o,--output", command.directory, "Results directory (default: results/<name>)")->type_name("DIR");
  run->add_option("-j,--threads", command.threads, "Threads (default: as many as the machine gives)")
      ->check(CLI::Range(1, 4096).description(""))
      ->type_name("N");
  run->add_option_function<std::string>(
         "--shard", [&command](const std::string& text) { command.shard = *parse_shard(text); },
         "Run part I of N of the sweep; within a Slurm array, by default, the part of the task")
      ->check([](const std::string& text) {
        return parse_shard(text) ? "" : "not I/N with whole numbers 1 <= I <= N <= 100000: " + text;
      })
      ->type_name("I/N");
  run->add_option("--memory", command.memory_gib, "Memory for replicates in flight (default: what is available)")
      ->check(CLI::PositiveNumber.description(""))
      ->type_name("GIB");
  run->add_flag("--dry-run", command.dry_run, "Print the plan and what it will cost, and do nothing");
}

void add_status(CLI::App& app, StatusCommand& command) {
  auto* status = app.add_subcommand("status", "Say what a results directory holds and what is under way in it");
  status->add_option("directory", command.directory, "Results directory")->required()->type_name("DIR");
}

void add_rerun(CLI::App& app, RerunCommand& command) {
  auto* rerun = app.add_subcommand("rerun", "Redo one replicate, with a line for every strain step");
  rerun->add_option("directory", command.directory, "Results directory")->required()->type_name("DIR");
  rerun->add_option("replicate", command.replicate, "Its name, as its files are called")
      ->required()
      ->type_name("REPLICATE");
  rerun->add_option("-j,--threads", command.threads, "Threads (default: as many as the machine gives)")
      ->check(CLI::Range(1, 4096).description(""))
      ->type_name("N");
}

void add_validate(CLI::App& app, ValidateCommand& command) {
  auto* validate = app.add_subcommand("validate", "Check a manifest and say how many replicates it plans");
  validate->add_option("manifest", command.manifest, "Manifest of the sweep")->required()->type_name("MANIFEST");
}

void add_aggregate(CLI::App& app, AggregateCommand& command) {
  auto* aggregate = app.add_subcommand("aggregate", "Make a table of the records in results directories");
  aggregate->add_option("directories", command.directories, "Results directories")->required()->type_name("DIR");
  aggregate->add_option("-o,--output", command.output, "Write the table as JSON to this file as well")
      ->type_name("FILE");
  add_choice<TableFormat>(*aggregate, "--format", command.format,
                          {{"text", TableFormat::text},
                           {"json", TableFormat::json},
                           {"csv", TableFormat::csv},
                           {"latex", TableFormat::latex}},
                          "Format on stdout");
  aggregate->add_flag("--series", command.series, "Quantities against the distance above jamming (JSON has both)");
}

void add_export(CLI::App& app, ExportCommand& command) {
  auto* exporting = app.add_subcommand("export", "Write packings for HOOMD-blue and OVITO, ParaView, or as text");
  exporting->add_option("directory", command.directory, "Results directory")->required()->type_name("DIR");
  exporting->add_option("replicate", command.replicate, "Name of a replicate, as its record's file has it, or all")
      ->required()
      ->type_name("REPLICATE");
  add_choice<ExportFormat>(*exporting, "--format", command.format,
                           {{"gsd", ExportFormat::gsd}, {"vtp", ExportFormat::vtp}, {"xyz", ExportFormat::xyz}},
                           "Format of the files")
      ->required();
  exporting->add_option("-o,--output", command.output, "File to write; of all replicates, the directory for them")
      ->required()
      ->type_name("FILE");
  exporting->add_flag("--path", command.path, "Every state of the expansion (of manifests with keep_path)");
}

void add_report(CLI::App& app, ReportCommand& command) {
  auto* report = app.add_subcommand("report", "Write a results directory as one interactive HTML file");
  report->add_option("directory", command.directory, "Results directory")->required()->type_name("DIR");
  report->add_option("-o,--output", command.output, "File to write (default: DIR/report.html)")->type_name("FILE");
}

void add_chart(CLI::App& app, ChartCommand& command) {
  auto* chart = app.add_subcommand("chart", "Compare methods on this machine: accuracy against speed, and what fails");
  auto* config = chart->add_option("config", command.config, "What to compare (default: five minutes of everything)")
                     ->type_name("CONFIG");
  chart->add_flag("--full", command.full, "An hour of everything")->excludes(config);
  chart->add_option("-o,--output", command.directory, "Directory for data.json, table.txt and chart.html")
      ->required()
      ->type_name("DIR");
}

ExitCode dispatch(const CLI::App& app, const Arguments& arguments, Console& console) {
  if (app.got_subcommand("run")) return run(arguments.run, console);
  if (app.got_subcommand("status")) return status(arguments.status);
  if (app.got_subcommand("rerun")) return rerun(arguments.rerun, console);
  if (app.got_subcommand("validate")) return validate(arguments.validate);
  if (app.got_subcommand("export")) return export_packings(arguments.exporting, console);
  if (app.got_subcommand("report")) return report(arguments.report);
  if (app.got_subcommand("chart")) return chart(arguments.chart, console);
  return aggregate_directories(arguments.aggregate);
}

ExitCode parse_and_run(int argc, char** argv) {
  CLI::App app("isojam: jammed packings of soft frictionless Platonic solids, in batches", "isojam");
  Arguments arguments;
  app.require_subcommand(1);
  app.fallthrough();
  app.set_version_flag("--version", "isojam " + std::string(version()) + " (" + std::string(git_hash()) + ")");
  app.footer(exit_codes);
  add_options(app, arguments.console);
  add_run(app, arguments.run);
  add_validate(app, arguments.validate);
  add_aggregate(app, arguments.aggregate);
  add_status(app, arguments.status);
  add_rerun(app, arguments.rerun);
  add_export(app, arguments.exporting);
  add_report(app, arguments.report);
  add_chart(app, arguments.chart);
  try {
    app.parse(argc, argv);
    if (app.got_subcommand("run") && app.get_subcommand("run")->count("--shard") == 0)
      arguments.run.shard = shard_of_environment();
  } catch (const std::invalid_argument& error) {
    std::fprintf(stderr, "isojam: error: %s\n", error.what());
    return ExitCode::usage;
  } catch (const CLI::ParseError& error) {
    return app.exit(error) == 0 ? ExitCode::done : ExitCode::usage;
  }

  Console console(arguments.console);
  try {
    return dispatch(app, arguments, console);
  } catch (const InputError& error) {
    console.error(error.what());
    return ExitCode::bad_input;
  } catch (const FileError& error) {
    console.error(error.what());
    return ExitCode::usage;
  }
}

}  // namespace
}  // namespace isojam

int main(int argc, char** argv) {
  // A file that may not grow is a failed write like any other, not the end.
  std::signal(SIGXFSZ, SIG_IGN);
  try {
    return static_cast<int>(isojam::parse_and_run(argc, argv));
  } catch (const std::exception& error) {
    std::fprintf(stderr, "isojam: error: %s\n", error.what());
    return static_cast<int>(isojam::ExitCode::some_failed);
  }
}
