#include "item_form_parts.h"
#include "item_forms.h"
#include "lorica/models/model_texts.h"
#include "lorica/models/numbers.h"

namespace lorica::panels {

namespace {

QString joined(const std::vector<std::string>& names) {
  QStringList all;
  for (const std::string& one : names) {
    all.append(shown(one));
  }
  return all.join(u'\n');
}

}  // namespace

void fillRun(PropertyForm& form, const std::string& name) {
  const auto& runs = form.document().runs();
  const auto found = std::find_if(runs.begin(), runs.end(), [&](const auto& run) { return run->name == name; });
  form.section(Text::tr("Run"));
  if (found == runs.end()) {
    return;
  }
  const document::RunRecord& run = **found;
  const analysis::RunResult& result = run.result;
  raycast::CastCounts counts;
  std::size_t finished = 0;
  for (const analysis::SourcePoseResult& part : result.results) {
    counts.add(part.counts);
    finished += part.trials.size();
  }
  const auto fixedFact = [&form](const char* id, const QString& label, const QString& text, const QString& tip = {}) {
    ElidedLabel* value = form.fact({id, label}, [text] { return text; });
    if (!tip.isEmpty()) {
      value->setToolTip(tip);
    }
  };
  fixedFact("name", Text::tr("Name"), shown(run.name));
  fixedFact("state", Text::tr("State"), result.partial ? Text::tr("partial: it was cancelled") : Text::tr("complete"));
  std::vector<std::string> sources;
  for (const analysis::ShotSource& source : result.sources) {
    sources.push_back(
        Text::tr("%1, %2 shots per trial").arg(shown(source.source.name), models::grouped(source.shots)).toStdString());
  }
  form.note({"sources", Text::tr("Sources")}, [text = joined(sources)] { return text; });
  form.note({"poses", Text::tr("Poses")}, [text = joined(result.poses)] { return text; });
  form.note({"systems", Text::tr("Armor")}, [text = joined(result.systems)] { return text; });
  std::vector<std::string> organModels;
  for (const study::OrganModel model : result.models) {
    organModels.push_back(models::modelLabel(model).toStdString());
  }
  form.note({"models", Text::tr("Organ models")}, [text = joined(organModels)] { return text; });
  fixedFact("trials", Text::tr("Trials"),
            Text::tr("%1 of %2 finished")
                .arg(models::grouped(finished), models::grouped(std::uint64_t{result.trials} * result.results.size())));
  fixedFact("seed", Text::tr("Seed"), QString::number(result.seed));
  form.section(Text::tr("Rays"));
  fixedFact("rays", Text::tr("Traced"), models::grouped(counts.rays));
  fixedFact("retraced", Text::tr("Traced again"), models::grouped(counts.retraced),
            Text::tr("Crossings of a closed surface did not add up at first."));
  fixedFact("unresolved", Text::tr("Unresolved"), models::grouped(counts.unresolved),
            Text::tr("Crossings of a closed surface did not add up even then."));
  fixedFact("near_open", Text::tr("Near open edges"), models::grouped(counts.nearOpenEdge),
            Text::tr("Passed an open edge so closely that rounding may decide."));
}

}  // namespace lorica::panels
