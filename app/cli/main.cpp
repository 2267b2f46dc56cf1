/// \file
/// lorica-cli: the studies of the workbench without a window.

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <charconv>
#include <cstdio>

#include "commands.h"
#include "console.h"
#include "lorica/base/error.h"
#include "lorica/study/provenance.h"
#include "report_command.h"

namespace lorica::cli {

namespace {

const std::vector<std::string> modelNames = {"static_joint", "static_skin", "dynamic_thesis", "dynamic"};

/// "2/8" is the second of eight.
analysis::RunPart partNamed(const std::string& text) {
  constexpr std::uint32_t most = 100000;
  analysis::RunPart part;
  const char* const end = text.data() + text.size();
  const auto number = std::from_chars(text.data(), end, part.index);
  const auto count = number.ptr < end ? std::from_chars(number.ptr + 1, end, part.count) : number;
  if (number.ec != std::errc() || number.ptr == end || *number.ptr != '/' || count.ec != std::errc() ||
      count.ptr != end || part.index < 1 || part.index > part.count || part.count > most) {
    throw CLI::ValidationError("--part", "expected I/N with I from 1 to N and N up to 100000, as 2/8");
  }
  --part.index;
  return part;
}

void addRun(CLI::App& app, int& code) {
  auto* command = app.add_subcommand("run", "run a study: coverage per structure, pose, model and armor system");
  auto arguments = std::make_shared<RunArguments>();
  command->add_option("STUDY", arguments->study, "the study (*.lorica.json)")->required();
  auto* out = command->add_option("--out", arguments->out, "folder for the tables and provenance.json");
  command->add_option("--threads", arguments->threads, "threads to use (default: all)")->check(CLI::Range(1, 1024));
  command->add_option("--seed", arguments->seed, "seed of the shots (default: the study's)")
      ->check([](const std::string& text) {
        return text.starts_with('-') ? std::string("a seed is a whole number from 0 up") : std::string();
      });
  command->add_option("--trials", arguments->trials, "trials (default: the study's)")->check(CLI::Range(1, 100000));
  command->add_option("--shots", arguments->shots, "shots per trial (default: the study's)")
      ->check(CLI::Range(std::uint64_t{1}, std::uint64_t{1000000000000}));
  command->add_option("--pose", arguments->poses, "pose by name or CLIP@SECONDS; may be repeated (default: all)")
      ->take_all()
      ->allow_extra_args(false);
  command->add_option("--model", arguments->models, "organ model; may be repeated (default: the study's)")
      ->take_all()
      ->allow_extra_args(false)
      ->check(CLI::IsMember(modelNames));
  command->add_option("--hits", arguments->hits, "also write what every shot goes through: csv or vtp")
      ->check(CLI::IsMember({"csv", "vtp"}));
  command->add_option("--shot-report", arguments->shotReport,
                      "print all of one shot, SOURCE:TRIAL:SHOT (trials from 1, shots from 0), and run nothing");
  command->add_flag("--pdf", arguments->pdf, "also write the report, report.pdf, and pictures of the poses");
  auto part = std::make_shared<std::string>();
  command->add_option("--part", *part, "shoot part I of N alone, I/N, for lorica-cli merge")
      ->excludes("--hits")
      ->excludes("--pdf")
      ->excludes("--shot-report");
  command->add_flag("--quiet", arguments->quiet, "no progress and no table");
  command->callback([arguments, out, part, &code] {
    if (!part->empty()) {
      arguments->part = partNamed(*part);
    }
    if (out->empty() && arguments->shotReport.empty()) {
      throw CLI::RequiredError("--out");
    }
    if (!out->empty() && arguments->out.empty()) {
      throw CLI::ValidationError("--out", "expected the name of a folder");
    }
    code = runStudy(*arguments);
  });
}

void addMerge(CLI::App& app, int& code) {
  auto* command = app.add_subcommand("merge", "put the parts of a run (run --part) together to the whole run");
  auto arguments = std::make_shared<MergeArguments>();
  command->add_option("DIR", arguments->parts, "folders of all parts")->required();
  auto* out = command->add_option("--out", arguments->out, "folder for the tables and provenance.json")->required();
  command->add_option("--study", arguments->study, "the study (default: where the parts found it)");
  command->add_option("--threads", arguments->threads, "threads to use (default: all)")->check(CLI::Range(1, 1024));
  command->add_flag("--quiet", arguments->quiet, "no progress and no table");
  command->callback([arguments, out, &code] {
    if (arguments->out.empty()) {
      throw CLI::ValidationError(out->get_name(), "expected the name of a folder");
    }
    code = mergeParts(*arguments);
  });
}

void addCheck(CLI::App& app, int& code) {
  auto* command = app.add_subcommand("check", "audit studies and meshes; a line per finding");
  auto files = std::make_shared<std::vector<std::filesystem::path>>();
  auto accept = std::make_shared<bool>(false);
  command->add_option("FILE", *files, "studies or meshes")->required();
  command->add_flag("--accept-inputs", *accept, "take the inputs as they are now: write their hashes into the study");
  command->callback([files, accept, &code] { code = checkFiles(*files, *accept); });
}

void addTemplate(CLI::App& app, int& code) {
  auto* command = app.add_subcommand("template", "print a sample study");
  auto name = std::make_shared<std::string>("sample");
  auto list = std::make_shared<bool>(false);
  command->add_option("NAME", *name, "which one (default: sample)");
  command->add_flag("--list", *list, "list the names");
  command->callback([name, list, &code] { code = printTemplate(*name, *list); });
}

void addGenerate(CLI::App& app, int& code) {
  auto* generate = app.add_subcommand("generate", "make a digital human from published numbers");
  generate->require_subcommand(1);
  auto* command = generate->add_subcommand("human", "body, organs and armor of an adult, as files");
  auto arguments = std::make_shared<GenerateArguments>();
  auto sex = std::make_shared<std::string>();
  command->add_option("--sex", *sex, "male or female")->required()->check(CLI::IsMember({"male", "female"}));
  auto* stature = command->add_option("--stature", arguments->stature, "metres; with --mass (default: the median)");
  auto* mass = command->add_option("--mass", arguments->mass, "kilograms; with --stature (default: the median)");
  stature->needs(mass);
  mass->needs(stature);
  command->add_option("--percentile", arguments->percentile, "of stature and mass, in place of both")
      ->excludes(stature)
      ->excludes(mass);
  command
      ->add_option("--out", arguments->out,
                   "folder for body.glb, organs/NAME.glb, armor/SYSTEM/PIECE.glb and facts.json")
      ->required();
  command->callback([arguments, sex, &code] {
    arguments->sex = *sex == "male" ? human::Sex::male : human::Sex::female;
    code = generateHuman(*arguments);
  });
}

/// What `import` was given, before the order of its armor options is known.
struct ImportArguments {
  analysis::ImportRequest request;
  std::vector<std::string> armor;
  std::vector<std::string> systems;
  std::string units;
  std::string up;
  int plates = 0;
};

/// The files of a folder by their names; anything else is a file itself.
std::vector<std::filesystem::path> filesOf(const std::filesystem::path& place) {
  std::error_code failure;
  if (!std::filesystem::is_directory(place, failure)) {
    return {place};
  }
  std::vector<std::filesystem::path> files;
  for (const auto& entry : std::filesystem::directory_iterator(place, failure)) {
    if (entry.is_regular_file(failure)) {
      files.push_back(entry.path());
    }
  }
  if (files.empty()) {
    throw base::InputError(place.string(), "", "holds no files; armor pieces were expected");
  }
  std::sort(files.begin(), files.end());
  return files;
}

/// --system starts a new system for the --armor and --plates that follow it.
void orderArmor(const CLI::App& command, ImportArguments& arguments) {
  std::string system = "armor";
  std::size_t armorSeen = 0;
  std::size_t systemsSeen = 0;
  for (const CLI::Option* option : command.parse_order()) {
    if (option->check_lname("system")) {
      system = arguments.systems.at(systemsSeen++);
    } else if (option->check_lname("armor")) {
      for (std::filesystem::path& piece : filesOf(arguments.armor.at(armorSeen++))) {
        arguments.request.armor.push_back({system, std::move(piece)});
      }
    } else if (option->check_lname("plates")) {
      arguments.request.armor.push_back({system, study::Builtin{"front_plate"}});
      arguments.request.armor.push_back({system, study::Builtin{"back_plate"}});
    }
  }
}

void addImport(CLI::App& app, int& code) {
  auto* command = app.add_subcommand("import", "make a study from files");
  auto arguments = std::make_shared<ImportArguments>();
  analysis::ImportRequest& request = arguments->request;
  command->add_option("SKIN", request.skin, "the body's skin; with a rig it can be posed")->required();
  command->add_option("ORGANS", request.organs, "one file per organ");
  command->add_option("--armor", arguments->armor, "an armor piece or a folder of them; may be repeated")
      ->take_all()
      ->allow_extra_args(false);
  command->add_option("--system", arguments->systems, "name of the system that following pieces join")
      ->take_all()
      ->allow_extra_args(false);
  command->add_flag("--plates", arguments->plates, "add the generated front and back plates");
  command->add_option("--motion", request.motions, "a recorded motion (BVH) for the body to do; may be repeated")
      ->take_all()
      ->allow_extra_args(false);
  command->add_flag("--split", request.split, "each node of an organ file is a structure of its own");
  command->add_option("--units", arguments->units, "unit of all files")->check(CLI::IsMember({"m", "cm", "mm", "in"}));
  command->add_option("--up", arguments->up, "up axis of all files")->check(CLI::IsMember({"y", "z"}));
  command->add_option("--out", request.studyFile, "the study to write (*.lorica.json)")->required();
  command->callback([arguments, command, &code] {
    orderArmor(*command, *arguments);
    if (!arguments->units.empty()) {
      arguments->request.units = base::lengthUnitNamed(arguments->units);
    }
    if (!arguments->up.empty()) {
      arguments->request.up = arguments->up.front();
    }
    code = importFiles(arguments->request);
  });
}

void addExport(CLI::App& app, int& code) {
  auto* command = app.add_subcommand("export", "write a pose as a scene that other programs open");
  auto arguments = std::make_shared<ExportArguments>();
  arguments->model = "dynamic";
  command->add_option("STUDY", arguments->study, "the study (*.lorica.json)")->required();
  command->add_option("--pose", arguments->pose, "pose by name or CLIP@SECONDS")->required();
  command->add_option("--format", arguments->format, "glb, ply or vtp")
      ->required()
      ->check(CLI::IsMember({"glb", "ply", "vtp"}));
  command->add_option("--model", arguments->model, "organ model (default: dynamic)")->check(CLI::IsMember(modelNames));
  command->add_option("--out", arguments->out, "the file to write")->required();
  command->callback([arguments, &code] { code = exportPose(*arguments); });
}

void addThreat(CLI::App& app, int& code) {
  auto* command = app.add_subcommand("threat", "tell which part of the body threat data reach, when and how much");
  auto arguments = std::make_shared<ThreatArguments>();
  arguments->model = "dynamic";
  command->add_option("STUDY", arguments->study, "a study with threats (*.lorica.json)")->required();
  command->add_option("--out", arguments->out, "folder for threat.csv and fragments.csv")->required();
  command->add_option("--pose", arguments->poses, "pose by name or CLIP@SECONDS; may be repeated (default: all)")
      ->take_all()
      ->allow_extra_args(false);
  command->add_option("--model", arguments->model, "organ model (default: dynamic)")->check(CLI::IsMember(modelNames));
  command->add_option("--time", arguments->timeMs, "ms; the values then (default: the greatest over all times)")
      ->check(CLI::Range(-1e12, 1e12));
  command->add_flag("--vtp", arguments->models, "also write the models with their values, a .vtp per threat and pose");
  command->add_option("--level", arguments->levels, "also write the surface of this value at --time; may be repeated")
      ->take_all()
      ->allow_extra_args(false)
      ->check(CLI::Range(-1e30, 1e30));
  command->add_option("--slice", arguments->slices, "also write a slice at --time, as y@1.2 (metres); may be repeated")
      ->take_all()
      ->allow_extra_args(false)
      ->check([](const std::string& text) {
        return sliceNamed(text) ? std::string() : "expected x@METRES, y@METRES or z@METRES, found \"" + text + "\"";
      });
  command->add_option("--spacing", arguments->spacingMm, "mm, of surfaces and slices (default: that of the data)")
      ->check(CLI::Range(0.01, 1e6));
  command->add_option("--threads", arguments->threads, "threads to use (default: all)")->check(CLI::Range(1, 1024));
  command->add_flag("--quiet", arguments->quiet, "no progress and no table");
  command->callback([arguments, &code] { code = exposeToThreats(*arguments); });
}

void addCompare(CLI::App& app, int& code) {
  auto* command = app.add_subcommand("compare", "compare two finished runs, structure by structure");
  struct Arguments {
    std::filesystem::path first, second, out;
  };
  auto arguments = std::make_shared<Arguments>();
  command->add_option("RUN_A", arguments->first, "folder of the first run")->required();
  command->add_option("RUN_B", arguments->second, "folder of the second run")->required();
  command->add_option("--out", arguments->out, "the CSV to write")->required();
  command->callback([arguments, &code] { code = compareRuns(arguments->first, arguments->second, arguments->out); });
}

void addReport(CLI::App& app, int& code) {
  auto* command = app.add_subcommand("report", "make a report of a finished run, as PDF");
  auto folder = std::make_shared<std::filesystem::path>();
  auto out = std::make_shared<std::filesystem::path>();
  command->add_option("RESULTS_DIR", *folder, "folder that `run` wrote")->required();
  command->add_option("--out", *out, "the PDF to write")->required();
  command->callback([folder, out, &code] {
    requireReports();
    code = reportFolder(*folder, *out);
  });
}

void addUpgrade(CLI::App& app, int& code) {
  auto* command = app.add_subcommand("upgrade", "rewrite a study of an older version");
  auto study = std::make_shared<std::filesystem::path>();
  auto out = std::make_shared<std::filesystem::path>();
  command->add_option("STUDY", *study, "the study (*.lorica.json)")->required();
  command->add_option("--out", *out, "where to write it (default: over the old one)");
  command->callback([study, out, &code] { code = upgradeStudy(*study, *out); });
}

void addBench(CLI::App& app, int& code) {
  auto* command = app.add_subcommand("bench", "measure the engine against bare libraries, as ratios");
  auto json = std::make_shared<std::filesystem::path>();
  command->add_option("--json", *json, "also write the ratios to a file");
  command->callback([json, &code] { code = runBenchmarks(*json); });
}

int parseAndRun(int argc, char** argv) {
  int code = done;
  CLI::App app("Lorica: coverage of the body by armor, in any posture.", "lorica-cli");
  app.set_version_flag("--version", "lorica-cli " + study::version());
  app.require_subcommand(1);
  addRun(app, code);
  addMerge(app, code);
  addCheck(app, code);
  addTemplate(app, code);
  addGenerate(app, code);
  addImport(app, code);
  addExport(app, code);
  addThreat(app, code);
  addCompare(app, code);
  addReport(app, code);
  addUpgrade(app, code);
  addBench(app, code);
  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    if (error.get_exit_code() == 0) {
      app.exit(error);
      return done;
    }
    const std::string_view first = argc > 1 ? argv[1] : "";
    const auto named = app.get_subcommands([&](const CLI::App* command) { return command->get_name() == first; });
    const bool unknown = !first.empty() && !first.starts_with('-') && named.empty();
    fmt::print(stderr, "lorica-cli: {}; see lorica-cli --help\n",
               unknown ? fmt::format("there is no command \"{}\"", first) : error.what());
    return wrongUsage;
  }
  return code;
}

}  // namespace

}  // namespace lorica::cli

int main(int argc, char** argv) {
  namespace cli = lorica::cli;
  cli::catchInterrupts();
  try {
    const int code = cli::parseAndRun(argc, argv);
    if (std::fflush(stdout) != 0) {
      fmt::print(stderr, "lorica-cli: the output cannot be written; is the disk full?\n");
      return cli::badInput;
    }
    return code;
  } catch (const lorica::base::InputError& error) {
    fmt::print(stderr, "{}\n", error.what());
    return cli::badInput;
  } catch (const lorica::base::Cancelled&) {
    fmt::print(stderr, "cancelled: nothing was written\n");
    return cli::cancelled;
  } catch (const std::bad_alloc&) {
    fmt::print(stderr, "there is not enough memory for this\n");
    return cli::ourFault;
  } catch (const std::exception& error) {
    fmt::print(stderr, "internal error: {}\n", error.what());
    return cli::ourFault;
  }
}
