#include <QCoreApplication>
#include <algorithm>
#include <filesystem>

#include "chapters.h"
#include "lorica/models/numbers.h"
#include "table.h"
#include "words.h"

namespace lorica::report {

namespace {

struct Text {
  Q_DECLARE_TR_FUNCTIONS(lorica::report)
};

QString labels(const std::vector<std::string>& models) {
  QStringList all;
  for (const std::string& model : models) {
    all.push_back(modelLabel(model));
  }
  return all.join(QStringLiteral("; "));
}

/// Of a path its last part; where the file stands is in the record of the run.
QString nameOf(const std::string& file) {
  return text(std::filesystem::path(file).filename().string());
}

QString sourceText(const study::RunFacts::Source& source) {
  const auto several = [](const std::vector<double>& degrees) {
    QStringList all;
    for (const double one : degrees) {
      all.push_back(number(one, 1));
    }
    return all.join(QStringLiteral(" to "));
  };
  QString what;
  if (source.type == "point" && source.position.size() == 3) {
    what = Text::tr("point at x %1, y %2, z %3 m")
               .arg(number(source.position[0], 2), number(source.position[1], 2), number(source.position[2], 2));
  } else if (source.type == "parallel") {
    what = Text::tr("parallel beam from azimuth %1\u00b0, elevation %2\u00b0")
               .arg(several(source.azimuth), several(source.elevation));
  } else if (source.type == "band") {
    what = Text::tr("directions from azimuth %1\u00b0, elevation %2\u00b0")
               .arg(several(source.azimuth), several(source.elevation));
  } else {
    what = Text::tr("listed shots");
  }
  const QString shots = Text::tr("%1 shots a trial").arg(models::grouped(source.shotsPerTrial));
  const QString size = source.solidAngle ? Text::tr(" over %1 sr").arg(number(source.solidAngle, 4))
                       : source.area     ? Text::tr(" over %1 m\u00b2").arg(number(source.area, 3))
                                         : QString();
  return QStringLiteral("%1: %2, %3%4").arg(text(source.name), what, shots, size);
}

void banner(Sheet& sheet, const QString& text) {
  const double height = sheet.lines(0, 0, Sheet::width - 8.0, text, {9.5, true}, 4, {}, false) + 4.0;
  sheet.fill({Sheet::left, sheet.y(), Sheet::width, height}, QColor(0xfb, 0xec, 0xec));
  sheet.fill({Sheet::left, sheet.y(), 1.4, height}, ink::warning);
  sheet.lines(Sheet::left + 4.5, sheet.y() + 2.0, Sheet::width - 8.0, text, {9.5, true, ink::warning}, 4);
  sheet.space(height + 4.0);
}

void writeBanners(const Report& report) {
  const study::RunFacts& facts = report.run.facts;
  if (facts.partial) {
    std::uint64_t finished = 0;
    for (const study::RunFacts::Run& run : facts.runs) {
      finished += run.trials;
    }
    banner(
        report.sheet,
        Text::tr("PARTIAL RESULT. The run was stopped after %1 of %2 trials over its sources and poses. Numbers below "
                 "are of the trials that were finished; what was not shot is missing from tables and figures.")
            .arg(finished)
            .arg(facts.trials * facts.sources.size() * facts.poses.size()));
  }
  const auto missed = std::count_if(facts.runs.begin(), facts.runs.end(),
                                    [](const study::RunFacts::Run& run) { return run.goalReached == false; });
  if (missed > 0) {
    banner(report.sheet, Text::tr("The wanted precision was not reached in %1 of %2 source and pose pairs.")
                             .arg(missed)
                             .arg(facts.runs.size()));
  }
  if (!report.run.missing.empty()) {
    banner(report.sheet,
           Text::tr("Not in this report, since the analyses were stopped: %1. Run the study again for them.")
               .arg(listed(report.run.missing)));
  }
}

QString retracedText(const study::RunFacts& facts) {
  std::uint64_t shots = 0;
  std::uint64_t retraced = 0;
  std::uint64_t unresolved = 0;
  std::uint64_t open = 0;
  for (const study::RunFacts::Run& run : facts.runs) {
    shots += run.shots;
    retraced += run.retraced;
    unresolved += run.unresolved;
    open += run.nearOpenEdge;
  }
  return Text::tr("%1 traced; %2 traced again, %3 unresolved, %4 near an open edge")
      .arg(models::grouped(shots), models::grouped(retraced), models::grouped(unresolved), models::grouped(open));
}

void writeContents(Sheet& sheet, const std::vector<ContentsLine>& contents) {
  constexpr double height = 4.6;
  const std::size_t half = (contents.size() + 1) / 2;
  const double wanted = 9.0 + height * static_cast<double>(half);
  if (contents.empty() || !sheet.fits(wanted)) {
    return;
  }
  sheet.moveTo(Sheet::bottom - wanted);
  sheet.line({Sheet::left, sheet.y(), Sheet::width, 5.0}, Text::tr("Contents"), styles::section);
  const double y = sheet.y() + 7.0;
  constexpr double gutter = 8.0;
  constexpr double column = 0.5 * (Sheet::width - gutter);
  for (std::size_t i = 0; i < contents.size(); ++i) {
    const double x = Sheet::left + (i < half ? 0.0 : column + gutter);
    const double at = y + height * static_cast<double>(i % half);
    sheet.line({x, at, column - 10.0, height}, contents[i].text, styles::body);
    sheet.line({x, at, column, height}, QString::number(contents[i].page), styles::body, Qt::AlignRight);
    sheet.rule(x, at + height, column, ink::rule, 0.1);
  }
}

}  // namespace

void writeTitle(const Report& report, const std::vector<ContentsLine>& contents) {
  Sheet& sheet = report.sheet;
  const study::RunFacts& facts = report.run.facts;
  sheet.line({Sheet::left, 16.0, Sheet::width, 5.0}, Text::tr("LORICA %1   COVERAGE REPORT").arg(text(facts.version)),
             {8.5, true, ink::muted});
  sheet.moveTo(24.0);
  sheet.space(sheet.lines(Sheet::left, sheet.y(), Sheet::width, text(facts.study), styles::title, 2) + 2.0);
  if (!facts.description.empty()) {
    sheet.space(sheet.lines(Sheet::left, sheet.y(), Sheet::width, text(facts.description), styles::lead, 6) + 2.0);
  }
  sheet.rule(Sheet::left, sheet.y(), Sheet::width, ink::accent, 0.6);
  sheet.space(4.0);
  writeBanners(report);
  if (!report.pictures.poses.empty()) {
    drawPoseRow(sheet, report.pictures, report.pictures.poses.front(), 86.0);
    const PosePictures& first = report.pictures.poses.front();
    sheet.line({Sheet::left, sheet.y(), Sheet::width, 4.0},
               Text::tr("Pose %1 under %2, from the front, from the person's left and from the back; organs: %3.")
                   .arg(text(first.pose), text(first.system), modelLabel(report.pictures.model)),
               styles::caption);
    sheet.space(7.0);
  }
  sheet.fact(Text::tr("Armor systems"),
             facts.systems.size() > 1
                 ? Text::tr("%1; the unarmored body as the baseline").arg(listed(report.view.armored))
                 : Text::tr("none: the unarmored body alone"));
  sheet.fact(Text::tr("Organ models"), labels(facts.models));
  sheet.fact(Text::tr("Poses"), listed(facts.poses, 12));
  constexpr std::size_t mostSources = 4;
  for (std::size_t i = 0; i < facts.sources.size() && i < mostSources; ++i) {
    sheet.fact(i == 0 ? Text::tr("Sources") : QString(), sourceText(facts.sources[i]));
  }
  if (facts.sources.size() > mostSources) {
    sheet.fact({}, Text::tr("and %1 more, listed in the record of the run").arg(facts.sources.size() - mostSources));
  }
  sheet.fact(Text::tr("Structures"),
             Text::tr("%1 organs, %2 body regions").arg(report.view.organs.size()).arg(report.view.regions.size()));
  sheet.fact(Text::tr("Trials and seed"),
             facts.stop ? Text::tr("%1 trials or more, up to %2; seed %3")
                              .arg(facts.trials)
                              .arg(facts.stop->maxTrials)
                              .arg(facts.seed)
                        : Text::tr("%1 trials of every source and pose; seed %2").arg(facts.trials).arg(facts.seed));
  sheet.fact(Text::tr("Shots"), retracedText(facts));
  QStringList inputs;
  constexpr std::size_t mostInputs = 3;
  for (std::size_t i = 0; i < facts.inputs.size() && i < mostInputs; ++i) {
    inputs.push_back(QStringLiteral("%1 (%2)").arg(nameOf(facts.inputs[i].file), shortHash(facts.inputs[i].sha256)));
  }
  if (facts.inputs.size() > mostInputs) {
    inputs.push_back(Text::tr("and %1 more, listed in the record of the run").arg(facts.inputs.size() - mostInputs));
  }
  sheet.fact(Text::tr("Study and inputs"),
             Text::tr("study %1; %2")
                 .arg(shortHash(facts.studyHash), inputs.isEmpty() ? Text::tr("no input files: all is built in")
                                                                   : inputs.join(QStringLiteral(", "))));
  writeContents(sheet, contents);
}

void writeRecord(const Report& report) {
  Sheet& sheet = report.sheet;
  const study::RunFacts& facts = report.run.facts;
  sheet.chapter(Text::tr("Record of the run"));
  sheet.paragraph(
      Text::tr("Enough to compute the run again: the same study and seed give the same tables, byte for "
               "byte, at any number of threads. All of it stands in provenance.json beside the tables."));
  sheet.fact(Text::tr("Lorica"), text(facts.version));
  sheet.fact(Text::tr("Study"), text(facts.study));
  sheet.fact(Text::tr("SHA-256 of the study"), text(facts.studyHash));
  sheet.fact(Text::tr("Seed"), QString::number(facts.seed));
  sheet.fact(Text::tr("Skinning, deformer"), QStringLiteral("%1, %2").arg(text(facts.skinning), text(facts.deformer)));
  sheet.fact(Text::tr("Interior sites"), models::grouped(facts.interiorSites));
  for (std::size_t i = 0; i < facts.sources.size(); ++i) {
    sheet.fact(i == 0 ? Text::tr("Sources") : QString(), sourceText(facts.sources[i]));
  }
  sheet.space(2.0);
  Table runs(sheet, {{34.0, Qt::AlignLeft}, {50.0, Qt::AlignLeft}, {16.0}, {24.0}, {16.0}, {17.0}, {17.0}},
             {{{Text::tr("Source")},
               {Text::tr("Pose")},
               {Text::tr("Trials")},
               {Text::tr("Shots")},
               {Text::tr("Retraced")},
               {Text::tr("Unresolved")},
               {Text::tr("Open edge")}}});
  runs.setCaption(
      Text::tr("What was shot. Retraced: the crossings of a shot did not add up and it was traced again in double "
               "precision; unresolved: they still did not."));
  for (const study::RunFacts::Run& run : facts.runs) {
    runs.row({{text(run.source)},
              {text(run.pose)},
              {QString::number(run.trials)},
              {models::grouped(run.shots)},
              {models::grouped(run.retraced)},
              {models::grouped(run.unresolved)},
              {models::grouped(run.nearOpenEdge)}});
  }
  runs.end();
  sheet.section(Text::tr("Inputs"));
  if (facts.inputs.empty()) {
    sheet.paragraph(
        Text::tr("The study names no files: body, organs and armor are built into Lorica, made from the "
                 "published numbers that the user guide lists."));
  } else {
    sheet.paragraph(
        Text::tr("Files that the study reads. Their licences and sources are not known to Lorica; state "
                 "them where you hand this report on."));
    Table inputs(sheet, {{60.0, Qt::AlignLeft}, {114.0, Qt::AlignLeft}}, {{{Text::tr("File")}, {Text::tr("SHA-256")}}});
    for (const study::RunFacts::Input& input : facts.inputs) {
      inputs.row({{text(input.file)}, {input.sha256.empty() ? Text::tr("no hash") : text(input.sha256)}});
    }
    inputs.end();
  }
  sheet.section(Text::tr("Findings about the inputs"));
  if (facts.issues.empty()) {
    sheet.paragraph(Text::tr("None."));
  }
  constexpr std::size_t most = 60;
  for (std::size_t i = 0; i < facts.issues.size() && i < most; ++i) {
    sheet.bullet(text(facts.issues[i]), {8.0});
  }
  if (facts.issues.size() > most) {
    sheet.paragraph(Text::tr("%1 more stand in provenance.json.").arg(facts.issues.size() - most));
  }
}

}  // namespace lorica::report
