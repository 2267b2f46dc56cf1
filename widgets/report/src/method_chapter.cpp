#include <QCoreApplication>
#include <array>
#include <cmath>

#include "chapters.h"
#include "words.h"

namespace lorica::report {

namespace {

struct Text {
  Q_DECLARE_TR_FUNCTIONS(lorica::report)
};

void arrow(Sheet& sheet, QPointF from, QPointF to, const QColor& colour, double thickness = 0.35) {
  QPainter& painter = sheet.painter();
  const QPointF a = 100.0 * from;
  const QPointF b = 100.0 * to;
  const QPointF along = (b - a) / std::hypot((b - a).x(), (b - a).y());
  const QPointF across(-along.y(), along.x());
  painter.setPen(QPen(colour, Sheet::unit(thickness), Qt::SolidLine, Qt::FlatCap));
  painter.drawLine(a, b - 120.0 * along);
  painter.setPen(Qt::NoPen);
  painter.setBrush(colour);
  painter.drawPolygon(QPolygonF({b, b - 200.0 * along + 75.0 * across, b - 200.0 * along - 75.0 * across}));
  painter.setBrush(Qt::NoBrush);
}

void label(Sheet& sheet, QPointF at, const QString& words, Qt::Alignment alignment = Qt::AlignHCenter) {
  constexpr double width = 40.0;
  const double x = alignment == Qt::AlignHCenter ? at.x() - 0.5 * width
                   : alignment == Qt::AlignRight ? at.x() - width
                                                 : at.x();
  sheet.line({x, at.y() - 1.8, width, 3.6}, words, styles::note, alignment);
}

/// The person from above: where azimuths lie.
void drawAzimuths(Sheet& sheet, QPointF centre) {
  QPainter& painter = sheet.painter();
  constexpr double radius = 15.0;
  painter.setPen(QPen(ink::rule, Sheet::unit(0.2)));
  painter.drawEllipse(100.0 * centre, Sheet::unit(radius), Sheet::unit(radius));
  painter.setPen(QPen(ink::text, Sheet::unit(0.3)));
  painter.setBrush(ink::faint);
  painter.drawEllipse(100.0 * centre, Sheet::unit(6.0), Sheet::unit(2.6));
  painter.setBrush(QColor(Qt::white));
  painter.drawEllipse(100.0 * centre, Sheet::unit(1.9), Sheet::unit(2.1));
  painter.drawPolygon(QPolygonF({100.0 * (centre + QPointF(-0.6, 2.0)), 100.0 * (centre + QPointF(0.6, 2.0)),
                                 100.0 * (centre + QPointF(0.0, 3.0))}));
  painter.setBrush(Qt::NoBrush);
  arrow(sheet, centre + QPointF(0, radius), centre + QPointF(0, 5.0), ink::accent);
  arrow(sheet, centre + QPointF(radius, 0), centre + QPointF(8.0, 0), ink::accent);
  label(sheet, centre + QPointF(0, radius + 2.4), Text::tr("azimuth 0\u00b0: ahead (+z)"));
  label(sheet, centre + QPointF(radius + 1.2, 0), Text::tr("90\u00b0: its left (+x)"), Qt::AlignLeft);
  label(sheet, centre + QPointF(0, -radius - 2.4), Text::tr("180\u00b0: behind"));
  label(sheet, centre + QPointF(-radius - 1.2, 0), Text::tr("\u221290\u00b0: its right"), Qt::AlignRight);
}

/// The person from its left: where elevations lie.
void drawElevations(Sheet& sheet, QPointF centre) {
  QPainter& painter = sheet.painter();
  constexpr double radius = 15.0;
  painter.setPen(QPen(ink::rule, Sheet::unit(0.2)));
  painter.drawEllipse(100.0 * centre, Sheet::unit(radius), Sheet::unit(radius));
  painter.setPen(QPen(ink::text, Sheet::unit(0.3)));
  painter.setBrush(ink::faint);
  painter.drawRoundedRect(Sheet::units({centre.x() - 1.7, centre.y() - 4.0, 3.4, 10.0}), 120.0, 120.0);
  painter.drawEllipse(100.0 * (centre + QPointF(-0.3, -6.0)), Sheet::unit(1.6), Sheet::unit(1.9));
  painter.setBrush(Qt::NoBrush);
  arrow(sheet, centre + QPointF(-radius, 0), centre + QPointF(-4.0, 0), ink::accent);
  arrow(sheet, centre + QPointF(0, -radius), centre + QPointF(0, -8.8), ink::accent);
  const double slant = radius * std::sqrt(0.5);
  arrow(sheet, centre + QPointF(-slant, -slant), centre + QPointF(-3.6, -3.6), ink::muted, 0.25);
  label(sheet, centre + QPointF(-radius - 1.2, 0), Text::tr("elevation 0\u00b0"), Qt::AlignRight);
  label(sheet, centre + QPointF(-slant - 1.2, -slant), Text::tr("45\u00b0"), Qt::AlignRight);
  label(sheet, centre + QPointF(0, -radius - 2.4), Text::tr("90\u00b0: above (+y)"));
}

QString samplerWords(const study::RunFacts::Source& source) {
  if (source.type == "point" && source.sampler == "cone") {
    return Text::tr("a point; its shots fill the cone that bounds the skin over all poses, evenly in solid angle");
  }
  if (source.type == "point" && source.sampler == "thesis") {
    return Text::tr(
        "a point with the thesis' sampler (Eq 15), kept for comparison: half of its shots go backwards and its hit "
        "rate depends on the axes");
  }
  if (source.type == "point") {
    return Text::tr("a point; its shots fill a %1").arg(text(source.sampler));
  }
  if (source.type == "parallel") {
    return Text::tr("a parallel beam, for far threats, as wide as the skin over all poses");
  }
  if (source.type == "band") {
    return Text::tr("parallel shots from a band of directions");
  }
  return Text::tr("listed shots, chosen and not drawn");
}

}  // namespace

void writeMethods(const Report& report) {
  Sheet& sheet = report.sheet;
  const study::RunFacts& facts = report.run.facts;
  sheet.chapter(Text::tr("How the numbers are made"));
  sheet.section(Text::tr("What the numbers are for"));
  sheet.paragraph(
      Text::tr("They say how armor covers the body and the organs in the postures of a task: which part of a person "
               "is exposed, and how surely that is known. They are coverage, not lethality: nothing here says "
               "what a hit does, and no armor is taken to stop anything in particular."));
  sheet.section(Text::tr("Shots"));
  sheet.paragraph(
      Text::tr("A shot is a straight line without end from an origin in a direction. All its crossings with skin, "
               "armor pieces and organs are found in order and paired into entries and exits, decided in double "
               "precision. A shot whose crossings do not add up is traced again; what stays wrong is counted in "
               "the record of the run. Every model, pose and armor system is met by the same shots."));
  constexpr std::size_t most = 8;
  for (std::size_t i = 0; i < facts.sources.size() && i < most; ++i) {
    const study::RunFacts::Source& source = facts.sources[i];
    const QString basis =
        source.basis.empty() ? QString() : Text::tr(" Percentages are of %1.").arg(text(source.basis));
    sheet.bullet(Text::tr("%1: %2; sequence: %3; intervals: %4.")
                     .arg(text(source.name), samplerWords(source), text(source.sequence), text(source.interval)) +
                 basis);
  }
  sheet.section(Text::tr("Directions"), 52.0);
  sheet.need(48.0);
  const double y = sheet.y() + 21.0;
  drawAzimuths(sheet, {Sheet::left + 46.0, y});
  drawElevations(sheet, {Sheet::left + 132.0, y});
  label(sheet, {Sheet::left + 46.0, y + 21.5}, Text::tr("seen from above"));
  label(sheet, {Sheet::left + 132.0, y + 18.5}, Text::tr("seen from its left"));
  sheet.space(46.0);
  sheet.paragraph(
      Text::tr("Azimuth and elevation say where a shot comes from. Lengths are metres; x points to the person's "
               "left, y up, z ahead."));
  sheet.section(Text::tr("What is counted"));
  sheet.bullet(Text::tr("Body hit: the shot crosses the skin. All else is a miss."));
  sheet.bullet(
      Text::tr("Any hit of a structure: the shot crosses it. Numerator: any hits; denominator: all shots (per cent "
               "of shots) or the shots that hit the body (per cent of body hits)."));
  sheet.bullet(
      Text::tr("First hit: of the skin, it is met before any armor; of an organ, before any other organ, skin and "
               "armor ignored; of armor, before the skin."));
  sheet.bullet(
      Text::tr("Protected: armor is crossed before the structure is first entered. Coverage: protected hits over "
               "any hits of the structure; a dash where there is no hit."));
  sheet.bullet(
      Text::tr("Essential and desirable organs are classes of the study (after Breeze et al. 2016 unless changed); a "
               "shot that crosses several organs of a class counts once, so rows must not be added up."));
  sheet.bullet(
      Text::tr("Protection counts for the whole organ or none of it: a shot that grazes a covered organ and one "
               "through its middle count alike."));
  sheet.section(Text::tr("Intervals and tests"));
  sheet.paragraph(
      Text::tr("Intervals are 95 %. Where shots are independent and of equal weight they are Wilson's; for grids, "
               "low-discrepancy and weighted samplers they are taken across the trials (Student t, jackknife). "
               "They tell how far more shots could move a number, not whether the person, the armor or the pose "
               "is modelled right. Comparisons on the same shots are paired over the trials, their p-values "
               "corrected for the number of structures (Holm). Differences marked in bold without a p are those "
               "whose intervals have no value in common."));
  sheet.section(Text::tr("Organs in a pose"));
  sheet.bullet(Text::tr("%1: rigid, carried by one joint, as is common today.").arg(modelLabel("static_joint")));
  sheet.bullet(Text::tr("%1: rigid, carried by the skin around it.").arg(modelLabel("static_skin")));
  sheet.bullet(
      Text::tr("%1: deformed by a lattice that follows the nearest interior site.").arg(modelLabel("dynamic_thesis")));
  sheet.bullet(Text::tr("%1: deformed with all organs as one soft body inside the skin, or by a lattice that follows "
                        "blended sites, as the study says (here: %2).")
                   .arg(modelLabel("dynamic"), text(facts.deformer).replace(u'_', u' ')));
  sheet.section(Text::tr("Sources"));
  sheet.paragraph(
      Text::tr("J. T. Kersten, Digital Human Modeling Capabilities for Task-Based Survivability, MS thesis, "
               "University of Iowa, 2016. Classes of organs: J. Breeze et al., 2016. Sizes and masses of the built-in "
               "human, armor "
               "and motions: the tables that come with Lorica name their sources row by row."));
}

}  // namespace lorica::report
