#include "lorica/base/error.h"
#include "report_command.h"

namespace lorica::cli {

void requireReports() {
  throw base::InputError("lorica-cli", "",
                         "was built without reports, which need Qt; build with the window (LORICA_WINDOW=ON), or read "
                         "the tables");
}

void writeRunReport(const analysis::LoadedStudy& /*study*/, const analysis::RunResult& /*result*/,
                    const std::filesystem::path& /*folder*/, base::Threads /*threads*/, bool /*quiet*/) {
  requireReports();
}

int reportFolder(const std::filesystem::path& /*folder*/, const std::filesystem::path& /*out*/) {
  requireReports();
  return 0;
}

}  // namespace lorica::cli
