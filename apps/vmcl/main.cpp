// SPDX-License-Identifier: BSD-3-Clause
#include <exception>
#include <iostream>
#include <string>

#include "verbs.h"
#include "vmcl/mrpt/error_message.h"

int main(int argc, char** argv) {
  CLI::App app{"Visual Monte Carlo localization of a wheeled robot on flat ground.", "vmcl"};
  app.set_version_flag("--version", VMCL_VERSION);
  app.footer("Each verb explains itself: vmcl VERB --help");
  app.failure_message([](const CLI::App*, const CLI::Error& error) {
    return std::string("vmcl: ") + error.what() + " (see vmcl --help)\n";
  });
  int exit_code = vmcl::exit_done;
  vmcl::addSimulateVerb(app, exit_code);
  vmcl::addImportVerb(app, exit_code);
  vmcl::addMapVerb(app, exit_code);
  vmcl::addLocalizeVerb(app, exit_code);
  vmcl::addRelocalizeVerb(app, exit_code);
  vmcl::addSelectorVerb(app, exit_code);
  vmcl::addEvaluateVerb(app, exit_code);
  vmcl::addEstimateVerb(app, exit_code);
  vmcl::addBenchVerb(app, exit_code);
  try {
    app.parse(argc, argv);
    if (app.get_subcommands().empty()) throw CLI::RequiredError("A verb");
  } catch (const CLI::ParseError& error) {
    return app.exit(error) == 0 ? vmcl::exit_done : vmcl::exit_failed;
  } catch (const std::exception& error) {
    std::cerr << "vmcl: " << vmcl::errorMessage(error) << '\n';
    return vmcl::exit_failed;
  }
  return exit_code;
}
