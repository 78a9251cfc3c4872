#pragma once

#include <filesystem>
#include <functional>
#include <map>
#include <string>
#include <utility>
#include <vector>

#include "tasks/measure/contact_fields.hpp"
#include "tasks/records/replicate.hpp"

namespace isojam::test {

/// A temporary directory. The destructor removes it with its contents.
class TemporaryDirectory {
 public:
  TemporaryDirectory();
  ~TemporaryDirectory();
  TemporaryDirectory(const TemporaryDirectory&) = delete;
  TemporaryDirectory& operator=(const TemporaryDirectory&) = delete;

  const std::filesystem::path& path() const { return path_; }
  std::filesystem::path operator/(const std::string& name) const { return path_ / name; }

 private:
  std::filesystem::path path_;
};

/// Result of a process that has ended.
struct Finished {
  int exit_code = -1;  ///< exit code; −1 if a signal ended the process
  std::string out, err;
};

/// Runs the isojam executable with `directory` as working directory, and waits until it ends. Meanwhile calls
/// `meanwhile` with its process number.
Finished isojam(const std::vector<std::string>& arguments, const std::filesystem::path& directory,
                const std::function<void(int)>& meanwhile = {});

/// Runs a line of shell commands in the same way. In this line, $ISOJAM is the path of the executable.
Finished shell(const std::string& line, const std::filesystem::path& directory);

/// Calls `work` in a separate process on a terminal with this number of columns. Returns the output and the status of
/// waitpid().
std::pair<std::string, int> on_a_terminal(const std::function<void()>& work, int columns = 80);

/// Collects the warnings that a function passes to warn().
struct Warnings {
  std::vector<std::string> said;
  std::function<void(const std::string&)> warn() {
    return [this](const std::string& message) { said.push_back(message); };
  }
};
/// Ignores a warning.
inline void unheard(const std::string&) {}

void write_text(const std::filesystem::path& path, const std::string& text);

/// The text with its checksum replaced by the correct one.
std::string sealed_again(std::string text);

/// The content of every file in a directory and its subfolders, by relative path.
std::map<std::string, std::string> files_below(const std::filesystem::path& directory);

/// The same for a results directory, without everything that may differ between two runs: the checksums and times in
/// records, the dates of manifests, and temporary files of processes that were killed.
std::map<std::string, std::string> results_below(const std::filesystem::path& directory);

/// A manifest of real packings that take about one second each: 24 or 28 dodecahedra, minimised to large residuals.
Json tiny_manifest();

/// The text of the error of this manifest; empty if it is accepted.
std::string refusal(const Json& manifest, const std::string& file = "m.json");

/// Every specification of the plan of a manifest, in order.
std::vector<ReplicateSpec> make_plan(const Manifest& manifest);

/// A document without its checksum and its time.
Json without_checksum(Json document);

/// The record of an outcome as it is read from its file.
/// The state nearest jamming of a record.
const Json& nearest_of(const Json& record);
Json record_on_disk(const Outcome& outcome);

/// Artificial contacts with the contact number Z = z, for which both fits gave a cut-off.
ContactAnalysis made_up_contacts(double z);
/// Sets the histogram of the angles in the record of a state, and the troughs.
void set_angles(Json& state, const AngleHistogram& histogram, int particles);
/// Replaces the contacts of the nearest state of an artificial outcome.
void set_nearest_contacts(Outcome& outcome, const ContactAnalysis& analysis);

/// An artificial outcome without failure. It depends only on the specification.
Outcome made_up_outcome(const ReplicateSpec& spec);

}  // namespace isojam::test
