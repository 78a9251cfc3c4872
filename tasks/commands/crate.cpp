#include "tasks/crate/crate.hpp"

#include <array>
#include <cctype>
#include <charconv>
#include <chrono>
#include <filesystem>

#include "tasks/commands/command.hpp"
#include "tasks/system/atomic_file.hpp"
#include "tasks/system/standard_streams.hpp"

namespace isojam {
namespace {

struct Arguments {
  std::string directory;
  CrateOptions options;
};

bool is_address(std::string_view text) { return text.starts_with("https://") || text.starts_with("http://"); }

/// "2026-01-31", a day that there is.
bool is_date(const std::string& text) {
  constexpr std::string_view pattern = "0000-00-00";
  if (text.size() != pattern.size()) return false;
  for (std::size_t k = 0; k < pattern.size(); ++k) {
    const bool digit = std::isdigit(static_cast<unsigned char>(text[k])) != 0;
    if (pattern[k] == '0' ? !digit : text[k] != pattern[k]) return false;
  }
  const auto number = [&](std::size_t at, std::size_t length) { return std::stoi(text.substr(at, length)); };
  return std::chrono::year_month_day{std::chrono::year(number(0, 4)),
                                     std::chrono::month(static_cast<unsigned>(number(5, 2))),
                                     std::chrono::day(static_cast<unsigned>(number(8, 2)))}
      .ok();
}

/// An address, or an identifier of SPDX such as "CC-BY-4.0".
std::optional<std::string> read_license(const std::string& text, CrateOptions& options) {
  constexpr auto problem = "not a license: an identifier of spdx.org/licenses, as CC-BY-4.0, or an address";
  if (text.empty() || text.find_first_of(" \"<>\\^`{|}") != std::string::npos) return problem;
  if (!is_address(text)) {
    if (text.find_first_of("/:") != std::string::npos) return problem;
    options.license = "https://spdx.org/licenses/" + text;
  } else {
    options.license = text;
  }
  return std::nullopt;
}

/// "Name" or "Name <https://orcid.org/…>".
std::optional<std::string> read_agent(const std::string& text, CrateOptions& options) {
  constexpr auto problem = "not a name, nor a name and an address: 'Ada Lovelace <https://orcid.org/…>'";
  const auto begin = text.find('<');
  auto name = text.substr(0, begin);
  name.erase(name.find_last_not_of(' ') + 1);
  if (name.empty()) return problem;
  if (begin != std::string::npos) {
    const auto address = text.substr(begin + 1, text.size() - begin - 2);
    if (text.back() != '>' || !is_address(address) || address.find_first_of(" <>\"") != std::string::npos)
      return problem;
    options.agent_address = address;
  }
  options.agent = name;
  return std::nullopt;
}

std::optional<std::string> read_date(const std::string& text, CrateOptions& options) {
  if (!is_date(text)) return "not a day: YYYY-MM-DD, as 2026-01-31";
  options.date = text;
  return std::nullopt;
}

/// Describes a results directory for readers who do not know isojam; the path of the description goes to stdout.
ExitCode crate(const Arguments& arguments, Console& console) {
  const std::filesystem::path directory = arguments.directory;
  const auto metadata =
      crate_metadata(directory, arguments.options, [&](const std::string& message) { console.warn(message); });
  write_atomically(directory / crate_name, pretty(metadata));
  print((directory / crate_name).string() + "\n");
  return ExitCode::done;
}

}  // namespace

void add_crate(CLI::App& app, Session& session) {
  Arguments* arguments = nullptr;
  auto options =
      add_command(app, session, "crate", "Describe a results directory as an RO-Crate, in DIR/ro-crate-metadata.json",
                  crate, arguments);
  options.results_directory(arguments->directory);
  CrateOptions& crate = arguments->options;
  const auto absent = [] {};
  options.parsed(
      "--date", [&crate](const std::string& text) { return read_date(text, crate); }, absent,
      "Day of publication; records hold no times of day", "YYYY-MM-DD", Options::Need::required);
  options.parsed(
      "--license", [&crate](const std::string& text) { return read_license(text, crate); }, absent,
      "License of the data: an SPDX identifier or an address", "LICENSE");
  options.parsed(
      "--agent", [&crate](const std::string& text) { return read_agent(text, crate); }, absent,
      "Who ran it: a name, and an address such as an ORCID in <>", "NAME");
}

}  // namespace isojam
