#pragma once

#include "tasks/commands/command.hpp"

namespace isojam {

void add_export(CLI::App& app, Session& session);
void add_report(CLI::App& app, Session& session);
void add_chart(CLI::App& app, Session& session);

}  // namespace isojam
