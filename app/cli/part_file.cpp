#include "part_file.h"

#include <fmt/format.h>

#include <algorithm>

#include "lorica/analysis/posed_scene.h"
#include "lorica/analysis/results.h"
#include "lorica/base/error.h"
#include "lorica/base/files.h"

namespace lorica::cli {

namespace {

using Json = nlohmann::ordered_json;

constexpr std::uint64_t format = 1;

template <class Value>
Json orNull(const std::optional<Value>& value) {
  return value ? Json(*value) : Json(nullptr);
}

Json countsOf(const analysis::SourcePoseResult& here) {
  Json trials = Json::array();
  for (const shotline::Tally& trial : here.trials) {
    trials.push_back(trial.numbers());
  }
  return {{"trials", std::move(trials)},
          {"pairs", here.pairs.numbers()},
          {"rays", here.counts.rays},
          {"retraced", here.counts.retraced},
          {"unresolved", here.counts.unresolved},
          {"near_open_edge", here.counts.nearOpenEdge}};
}

}  // namespace

std::string planText(const analysis::LoadedStudy& study, analysis::RunResult planned) {
  for (analysis::SourcePoseResult& here : planned.results) {
    here.trials.clear();
    here.counts = {};
  }
  return Json::parse(analysis::provenanceJson(study, planned)).dump();
}

std::string partText(const RunArguments& arguments, const analysis::LoadedStudy& study,
                     const analysis::RunResult& result) {
  Json counts = Json::array();
  for (const analysis::SourcePoseResult& here : result.results) {
    counts.push_back(countsOf(here));
  }
  const Json file{{"lorica_part", format},
                  {"part", result.part.index + 1},
                  {"of", result.part.count},
                  {"study", std::filesystem::absolute(arguments.study).lexically_normal().string()},
                  {"seed", orNull(arguments.seed)},
                  {"trials", orNull(arguments.trials)},
                  {"shots", orNull(arguments.shots)},
                  {"poses", arguments.poses},
                  {"models", arguments.models},
                  {"run", Json::parse(planText(study, result))},
                  {"counts", std::move(counts)}};
  return file.dump(1, ' ', false, Json::error_handler_t::replace) + "\n";
}

PartFile::PartFile(const std::filesystem::path& folder) : file_((folder / partFileName).string()) {
  const std::string bytes = base::readFile(file_);
  Json json;
  try {
    json = Json::parse(bytes);
  } catch (const Json::parse_error& error) {
    fail(fmt::format("byte {}", error.byte), "is damaged or cut off; run this part again");
  }
  if (!json.is_object() || whole(json, "lorica_part", "") != format) {
    fail("/lorica_part",
         fmt::format("is no part of a run of this version ({} was expected); run this part again", format));
  }
  const std::uint64_t number = whole(json, "part", "");
  const std::uint64_t of = whole(json, "of", "");
  constexpr std::uint64_t most = 100000;
  if (number < 1 || number > of || of > most) {
    fail("/part", fmt::format("{} of {} is no part of a run; run this part again", number, of));
  }
  part_ = {static_cast<std::uint32_t>(number - 1), static_cast<std::uint32_t>(of)};
  readArguments(json);
  plan_ = member(json, "run", "");
  counts_ = member(json, "counts", "");
  if (!plan_.is_object() || !counts_.is_array()) {
    fail("/run", "is not what was to be shot; run this part again");
  }
}

void PartFile::fail(const std::string& place, const std::string& text) const {
  throw base::InputError(file_, place, text);
}

const Json& PartFile::member(const Json& json, const char* key, const std::string& place) const {
  const auto found = json.is_object() ? json.find(key) : json.end();
  if (found == json.end()) {
    fail(fmt::format("{}/{}", place, key), "is missing; run this part again");
  }
  return *found;
}

std::uint64_t PartFile::whole(const Json& json, const char* key, const std::string& place) const {
  const Json& value = member(json, key, place);
  if (!value.is_number_unsigned()) {
    fail(fmt::format("{}/{}", place, key), "expected a whole number from 0; run this part again");
  }
  return value.get<std::uint64_t>();
}

std::vector<std::uint64_t> PartFile::numbers(const Json& json, const std::string& place) const {
  if (!json.is_array() ||
      !std::all_of(json.begin(), json.end(), [](const Json& value) { return value.is_number_unsigned(); })) {
    fail(place, "expected counts, whole numbers from 0; run this part again");
  }
  return json.get<std::vector<std::uint64_t>>();
}

void PartFile::readArguments(const Json& json) {
  const auto given = [&](const char* key) { return !member(json, key, "").is_null(); };
  const auto names = [&](const char* key) {
    const Json& list = member(json, key, "");
    if (!list.is_array() || !std::all_of(list.begin(), list.end(), [](const Json& name) { return name.is_string(); })) {
      fail(fmt::format("/{}", key), "expected a list of names; run this part again");
    }
    return list.get<std::vector<std::string>>();
  };
  if (!member(json, "study", "").is_string()) {
    fail("/study", "expected the path of the study; run this part again");
  }
  arguments_.study = json["study"].get<std::string>();
  arguments_.poses = names("poses");
  arguments_.models = names("models");
  for (const std::string& model : arguments_.models) {
    if (!viscera::organModelNamed(model)) {
      fail("/models", fmt::format("there is no model named \"{}\"; run this part again", model));
    }
  }
  if (given("seed")) {
    arguments_.seed = whole(json, "seed", "");
  }
  if (given("shots")) {
    arguments_.shots = whole(json, "shots", "");
  }
  if (given("trials")) {
    constexpr std::uint64_t mostTrials = 100000;
    const std::uint64_t trials = whole(json, "trials", "");
    if (trials < 1 || trials > mostTrials) {
      fail("/trials", "expected 1 to 100000; run this part again");
    }
    arguments_.trials = static_cast<std::uint32_t>(trials);
  }
}

void PartFile::requireSameRun(const std::string& planText, const std::string& whose) const {
  const Json other = Json::parse(planText);
  if (plan_ == other) {
    return;
  }
  for (const auto& [key, value] : other.items()) {
    const auto mine = plan_.find(key);
    if (mine == plan_.end() || *mine != value) {
      const bool isShort = mine != plan_.end() && mine->is_primitive() && value.is_primitive();
      fail("/run/" + key, isShort ? fmt::format("is a part of another run than {}: {} here, {} there", whose,
                                                mine->dump(), value.dump())
                                  : fmt::format("is a part of another run than {}: \"{}\" differs", whose, key));
    }
  }
  fail("/run", fmt::format("is a part of another run than {}", whose));
}

analysis::RunResult PartFile::counted(const analysis::LoadedStudy& study, analysis::RunResult planned) const {
  const shotline::TargetLayout layout = analysis::layoutOf(study, planned.models.size());
  if (counts_.size() != planned.results.size()) {
    fail("/counts", fmt::format("has {} sources at poses, the run {}; run this part again", counts_.size(),
                                planned.results.size()));
  }
  for (std::size_t r = 0; r < planned.results.size(); ++r) {
    analysis::SourcePoseResult& here = planned.results[r];
    const std::string place = fmt::format("/counts/{}", r);
    const Json& trials = member(counts_[r], "trials", place);
    const std::uint64_t shots = analysis::rangeOf(part_, planned.sources[here.source].shots).count;
    const std::uint32_t expected = analysis::trialsOf(planned, here.source);
    if (!trials.is_array() || trials.size() != expected) {
      fail(place + "/trials", fmt::format("has {} trials, the run {}; run this part again", trials.size(), expected));
    }
    for (std::size_t t = 0; t < trials.size(); ++t) {
      const std::string at = fmt::format("{}/trials/{}", place, t);
      auto tally = shotline::Tally::fromNumbers(layout, numbers(trials[t], at));
      if (!tally || tally->shots() != shots) {
        fail(at, fmt::format("does not hold the counts of {} shots; run this part again", shots));
      }
      here.trials.push_back(*std::move(tally));
    }
    const auto pairs = shotline::PairTally::fromNumbers(
        layout, numbers(member(counts_[r], "pairs", place), place + "/pairs"), shots * trials.size());
    here.counts = {whole(counts_[r], "rays", place), whole(counts_[r], "retraced", place),
                   whole(counts_[r], "unresolved", place), whole(counts_[r], "near_open_edge", place)};
    const std::uint64_t most = std::max({here.counts.unresolved, here.counts.retraced, here.counts.nearOpenEdge});
    if (!pairs || here.counts.rays != shots * trials.size() || most > here.counts.rays) {
      fail(place,
           fmt::format("does not hold the counts of {} trials of {} shots; run this part again", trials.size(), shots));
    }
    here.pairs = *pairs;
  }
  planned.part = part_;
  return planned;
}

}  // namespace lorica::cli
