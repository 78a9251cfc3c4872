#include "tasks/commands/command.hpp"

namespace isojam {

void add_results_directory(CLI::App& command, std::string& directory) {
  command.add_option("directory", directory, "Results directory")->required()->type_name("DIR");
}

void add_threads(CLI::App& command, int& threads) {
  command.add_option("-j,--threads", threads, "Threads (default: as many as the machine gives)")
      ->check(CLI::Range(1, 4096).description(""))
      ->type_name("N");
}

}  // namespace isojam
