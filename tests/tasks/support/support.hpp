#pragma once

#include <filesystem>
#include <functional>
#include <map>
#include <string>
#include <utility>
#include <vector>

#include "tasks/measure/shared_parts.hpp"
#include "tasks/records/replicate.hpp"

namespace isojam::test {

/// A directory that is removed with its contents.
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

struct Finished {
  int exit_code = -1;  ///< −1 if a signal ended the process
  std::string out, err;
};

/// Runs the isojam executable with `directory` as working directory. `meanwhile` is called with the process id while
/// it runs.
Finished isojam(const std::vector<std::string>& arguments, const std::filesystem::path& directory,
                const std::function<void(int)>& meanwhile = {});

/// The same for a line of a shell, in which $ISOJAM is the executable.
Finished shell(const std::string& line, const std::filesystem::path& directory);

/// Output of `work` on a terminal, in a separate process, and the status of waitpid.
std::pair<std::string, int> on_a_terminal(const std::function<void()>& work, int columns = 80);

/// Collects warnings for a test.
struct Warnings {
  std::vector<std::string> said;
  std::function<void(const std::string&)> warn() {
    return [this](const std::string& message) { said.push_back(message); };
  }
};
inline void unheard(const std::string&) {}

void write_text(const std::filesystem::path& path, const std::string& text);

/// The text with the checksum that it should have.
std::string sealed_again(std::string text);

/// Content of every file below, by relative path.
std::map<std::string, std::string> files_below(const std::filesystem::path& directory);

/// The same for a results directory, records without what may differ between runs, and without what writers that were
/// killed left behind.
std::map<std::string, std::string> results_below(const std::filesystem::path& directory);

/// Real packings in about a second each: 24 or 28 dodecahedra, loosely converged.
Json tiny_manifest();

/// Every specification of a plan, in order.
std::vector<ReplicateSpec> make_plan(const Manifest& manifest);

/// A record or packing without its checksum, and a record without the values that may differ between runs.
Json without_checksum(Json document);

/// The record as it is read back from its file.
Json record_on_disk(const Outcome& outcome);

/// Contacts of which both fits gave a cut-off.
ContactAnalysis made_up_contacts(double z);
/// Replaces the contacts of the state nearest jamming of a made-up outcome.
void set_nearest_contacts(Outcome& outcome, const ContactAnalysis& analysis);

/// A made-up outcome without failure, a function of the specification.
Outcome made_up_outcome(const ReplicateSpec& spec);

}  // namespace isojam::test
