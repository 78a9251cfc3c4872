#include "tests/tasks/support/support.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <gtest/gtest.h>
#include <pty.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cmath>
#include <fstream>

#include "tasks/io/file.hpp"
#include "tasks/io/hash.hpp"
#include "tasks/io/input_error.hpp"
#include "tasks/io/parse.hpp"
#include "tasks/io/sealed.hpp"
#include "tasks/records/record.hpp"

namespace isojam::test {
namespace fs = std::filesystem;

TemporaryDirectory::TemporaryDirectory() {
  auto name = (fs::temp_directory_path() / "isojam-test-XXXXXX").string();
  if (!mkdtemp(name.data())) throw std::runtime_error("no temporary directory");
  path_ = name;
}

TemporaryDirectory::~TemporaryDirectory() {
  std::error_code error;
  fs::remove_all(path_, error);
  EXPECT_FALSE(error) << error.message();
}

namespace {

Finished finished(std::vector<std::string> words, const fs::path& directory,
                  const std::function<void(int)>& meanwhile) {
  const TemporaryDirectory capture;
  const auto out = capture / "out", err = capture / "err";
  std::vector<char*> argv;
  for (auto& word : words) argv.push_back(word.data());
  argv.push_back(nullptr);

  const pid_t child = fork();
  if (child == 0) {
    const int out_fd = ::open(out.c_str(), O_WRONLY | O_CREAT, 0600);
    const int err_fd = ::open(err.c_str(), O_WRONLY | O_CREAT, 0600);
    if (dup2(out_fd, 1) < 0 || dup2(err_fd, 2) < 0 || chdir(directory.c_str()) != 0) _exit(126);
    ::close(out_fd), ::close(err_fd);
    execv(argv[0], argv.data());
    _exit(127);
  }
  if (meanwhile) meanwhile(child);
  int status = 0;
  waitpid(child, &status, 0);
  return {WIFEXITED(status) ? WEXITSTATUS(status) : -1, read_text(out.string()), read_text(err.string())};
}

}  // namespace

Finished isojam(const std::vector<std::string>& arguments, const fs::path& directory,
                const std::function<void(int)>& meanwhile) {
  std::vector<std::string> words{ISOJAM_EXECUTABLE};
  words.insert(words.end(), arguments.begin(), arguments.end());
  return finished(std::move(words), directory, meanwhile);
}

Finished shell(const std::string& line, const fs::path& directory) {
  return finished({"/bin/sh", "-c", fmt::format("ISOJAM={}; {}", ISOJAM_EXECUTABLE, line)}, directory, {});
}

void write_text(const fs::path& path, const std::string& text) {
  std::ofstream stream(path, std::ios::binary);
  stream << text;
  if (!stream.flush()) throw std::runtime_error("cannot write " + path.string());
}

std::pair<std::string, int> on_a_terminal(const std::function<void()>& work, int columns) {
  int terminal = -1;
  const winsize size{24, static_cast<unsigned short>(columns), 0, 0};
  std::fflush(nullptr);
  const pid_t child = forkpty(&terminal, nullptr, nullptr, &size);
  if (child == 0) {
    work();
    _exit(0);
  }
  std::string text;
  char buffer[4096];
  for (ssize_t n = 0; (n = ::read(terminal, buffer, sizeof buffer)) > 0;)
    text.append(buffer, static_cast<std::size_t>(n));
  int status = 0;
  waitpid(child, &status, 0);
  close(terminal);
  return {text, status};
}

std::string sealed_again(std::string text) {
  const std::string before = "\"checksum\": \"", blank(16, '0');
  const auto at = text.find(before) + before.size();
  text.replace(at, blank.size(), blank);
  return text.replace(at, blank.size(), hex_hash(text));
}

std::map<std::string, std::string> files_below(const fs::path& directory) {
  std::map<std::string, std::string> files;
  for (const auto& entry : fs::recursive_directory_iterator(directory)) {
    if (!entry.is_regular_file()) continue;
    files[fs::relative(entry.path(), directory).string()] = read_text(entry.path().string());
  }
  return files;
}

std::map<std::string, std::string> results_below(const fs::path& directory) {
  auto files = files_below(directory);
  std::erase_if(files, [](const auto& file) {
    return fs::path(file.first).filename().string().starts_with('.') || file.first.starts_with("manifests/");
  });
  for (auto& [name, content] : files) {
    if (name.rfind("records/", 0) == 0) content = pretty(without_checksum(parse_json(content, name)));
  }
  return files;
}

std::string refusal(const Json& manifest, const std::string& file) {
  try {
    parse_manifest(manifest.dump(), file);
    return "";
  } catch (const InputError& error) {
    return error.what();
  }
}

std::vector<ReplicateSpec> make_plan(const Manifest& manifest) {
  const Plan plan(manifest);
  std::vector<ReplicateSpec> specs;
  for (std::size_t i = 0; i < plan.size(); ++i) specs.push_back(plan[i]);
  return specs;
}

Json without_checksum(Json document) {
  document.erase("checksum");
  document.erase("timing");
  return document;
}

const Json& nearest_of(const Json& record) { return record.at("states").at(record.at("nearest").get<std::size_t>()); }

Json record_on_disk(const Outcome& outcome) { return parse_sealed(sealed(make_record(outcome)), "record"); }

Json tiny_manifest() {
  return parse_json(R"({
    "name": "tiny", "seed": 7,
    "sweep": {"solid": ["dodecahedron"], "particles": [24, 28]},
    "replicates": 2,
    "protocol": {"initial_density": 0.3, "compression_step": 0.07, "target_energy": 3e-7, "longest_step": 0.03,
                 "step_fraction": 0.4, "final_distance": 0.03, "fit_window": 0.1},
    "minimiser": {"residual": 1e-3, "max_evaluations": 2000},
    "measure": ["contacts", "order", "clusters", "modes", "moduli", "rigidity"]
  })",
                    "tiny");
}

ContactAnalysis made_up_contacts(double z) {
  ContactAnalysis analysis;
  analysis.face_face.verdict = analysis.edge_face.verdict = FitVerdict::fitted;
  analysis.numbers = {z, 0.5, 2, z - 2.5, z - 2.5 + 1.5 + 4};
  return analysis;
}

namespace {

/// The state has no angles.
Json state_of(const ContactAnalysis& analysis) {
  ContactsOfState state{contact_record(analysis)};
  state.contacts.trough = troughs_of({}, 1);
  return written(state);
}

}  // namespace

void set_nearest_contacts(Outcome& outcome, const ContactAnalysis& analysis) {
  auto& measured = outcome.measured.at(Measure::contacts);
  measured.states.back() = state_of(analysis);
  measured.flags = contact_flags(analysis);
}

void set_angles(Json& state, const AngleHistogram& histogram, int particles) {
  state["contacts"]["angle_bins"] = written(bins_of(histogram));
  state["contacts"]["trough"] = written(troughs_of(histogram, particles));
}

Outcome made_up_outcome(const ReplicateSpec& spec) {
  // Unlike real replicates, made-up ones have other values at every value of a swept parameter, so that rows differ.
  RandomStream random{spec.seed, hash_of(point_text(spec)), static_cast<std::uint64_t>(spec.replicate),
                      static_cast<std::uint64_t>(Purpose::placement)};
  const auto start = random_packing(spec.solid.particles(spec.particles), 0.5, random);
  Outcome outcome;
  outcome.spec = spec;
  outcome.timing = {random.uniform(), random.uniform()};
  auto& jam = outcome.jam;
  JammingPoint point;
  point.density = 0.68 + 0.01 * random.normal();
  point.single_state = point.density + 1e-4;
  for (int i = 4; i > 0; --i) {
    const double distance = 0.01 * i;
    JamStep step;
    step.stage = JamStage::decompression;
    step.density = point.density + distance;
    step.energy_per_particle = std::pow(distance, 6);
    step.pressure = std::pow(distance, 5);
    step.summary.reason = StopReason::residual_reached;
    step.summary.residual = 1e-7 * random.uniform();
    step.summary.evaluations = 10 * i;
    point.states.insert(point.states.begin(), static_cast<int>(jam.states.size()));
    jam.state_steps.push_back(static_cast<int>(jam.path.size()));
    jam.path.push_back(step);
    jam.states.push_back(strained_to(start, step.density));
    for (const auto what : {Measure::order, Measure::clusters}) outcome.measured[what].states.push_back(Json::object());
    outcome.measured[Measure::contacts].states.push_back(state_of(made_up_contacts(9 + random.uniform())));
  }
  jam.phi_j = point;
  jam.status = JamStatus::jammed;
  jam.evaluations = 100;
  return outcome;
}

}  // namespace isojam::test
