#include <QComboBox>
#include <QDoubleSpinBox>
#include <QFileDialog>
#include <QHBoxLayout>
#include <QLabel>
#include <QPushButton>
#include <array>
#include <cmath>

#include "item_form_parts.h"
#include "lorica/base/units.h"
#include "lorica/commands/shot_edits.h"
#include "lorica/document/appearance.h"
#include "lorica/geometry/measures.h"
#include "lorica/models/numbers.h"
#include "lorica/panels/shot_forms.h"

namespace lorica::panels {

namespace {

/// Where a target starts when one is asked for: the middle of the body at rest.
geometry::Vec3d middleOfBody(const document::StudyDocument& document) {
  if (document.loaded() == nullptr) {
    return {0.0, 1.0, 0.0};
  }
  const geometry::Box3d box = geometry::bounds(document.loaded()->body->body().skin.positions);
  const auto millimetres = [](double x) { return std::round(x * 1000.0) / 1000.0; };
  return {millimetres(box.center().x()), millimetres(box.center().y()), millimetres(box.center().z())};
}

/// What a source is aimed at, as far as it is known without the run's poses.
geometry::Vec3d aimOf(const document::StudyDocument& document, const study::Source& source) {
  if (source.target) {
    return *source.target;
  }
  const auto& loaded = document.loaded();
  if (loaded != nullptr && !source.targetStructure.empty()) {
    if (const auto* organ = findNamed(loaded->organs, source.targetStructure)) {
      return geometry::bounds(organ->rig.rest.positions).center();
    }
    if (const auto* piece = findNamed(loaded->pieces, source.targetStructure)) {
      return geometry::bounds(piece->rig.rest.positions).center();
    }
  }
  return middleOfBody(document);
}

/// Azimuth and elevation (degrees) and distance (metres) of a place seen from another.
std::array<double, 3> polar(const geometry::Vec3d& offset) {
  const double level = std::hypot(offset.x(), offset.z());
  return {base::degrees(std::atan2(offset.x(), offset.z())), base::degrees(std::atan2(offset.y(), level)),
          offset.norm()};
}

const QString degreeSign = QStringLiteral("°");

/// The rows of one source form: what its editors read and write.
class SourceRows {
 public:
  SourceRows(PropertyForm& form, std::shared_ptr<SourceDraft> draft) : form_(form), draft_(std::move(draft)) {}

  void add() {
    addType();
    addPlace();
    addTarget();
    addWindow();
    addAngles();
    addFile();
    addSequence();
    addFacts();
  }

 private:
  using Source = study::Source;
  using Type = study::SourceType;

  std::function<bool()> when(std::function<bool(const Source&)> holds) const {
    return [draft = draft_, holds = std::move(holds)] { return holds(draft->source()); };
  }
  std::function<void(double)> set(const char* field, const QString& label,
                                  std::function<void(Source&, double)> change) const {
    return [draft = draft_, field, label, change = std::move(change)](double value) {
      draft->edit(
          QString::fromLatin1(field), label, [&](Source& source) { change(source, value); }, SourceDraft::Drag::yes);
    };
  }
  /// Says what is wrong with a field, below it.
  void addTrouble(const char* field) {
    form_.trouble(field, [draft = draft_, field = QString::fromLatin1(field)] { return draft->troubleOf(field); });
  }

  void addType() {
    const QString label = Text::tr("Kind");
    form_.choice(
        {"type", label, Text::tr("Where the shots come from")},
        [] {
          return std::vector<Choice>{
              {Text::tr("Point"), word(Type::point), Text::tr("One place, near or far")},
              {Text::tr("Parallel beam"), word(Type::parallel), Text::tr("One direction, from far away")},
              {Text::tr("Band of directions"), word(Type::band),
               Text::tr("Every direction between two azimuths and two elevations, from far away")},
              {Text::tr("Every direction"), word(Type::sphere), Text::tr("The full sphere, from far away")},
              {Text::tr("List from a file"), word(Type::list), Text::tr("Shots that a CSV file gives one by one")}};
        },
        [draft = draft_] { return word(draft->source().type); },
        [draft = draft_, label](const QString& id) {
          draft->edit("type", label, [&](Source& source) { source = commands::asType(source, Type(id.toInt())); });
        });
  }

  void addPlace() {
    const auto isPoint = when([](const Source& source) { return source.type == Type::point; });
    const NumberRange metres{-1000.0, 1000.0, 0.01, 3, {}};
    QWidget* position = form_.triple(
        {"position", Text::tr("Position (m)"), Text::tr("x to the person's left, y up, z ahead of the person")}, metres,
        [draft = draft_] { return draft->source().position; },
        [draft = draft_](const geometry::Vec3d& point) {
          draft->edit(
              "position", Text::tr("Position"), [&](Source& source) { source.position = point; },
              SourceDraft::Drag::yes);
        });
    form_.showRowWhile(position, isPoint);
    QWidget* seen = form_.numbers(
        {"seen", Text::tr("Direction"),
         Text::tr("Seen from the target: azimuth (0 ahead of the person, 90 on the person's left), elevation above "
                  "level, and distance")},
        {{"azimuth", {-360.0, 360.0, 5.0, 2, degreeSign}, Text::tr("az ")},
         {"elevation", {-90.0, 90.0, 5.0, 2, degreeSign}, Text::tr("el ")},
         {"distance", {0.001, 1000.0, 0.1, 3, Text::tr(" m")}, {}}},
        [draft = draft_, &document = form_.document()] {
          const Source& source = draft->source();
          const auto where = polar(source.position - aimOf(document, source));
          return std::vector<double>(where.begin(), where.end());
        },
        [draft = draft_, &document = form_.document()](std::size_t which, double value) {
          draft->edit(
              "position", Text::tr("Position"),
              [&](Source& source) {
                const geometry::Vec3d aim = aimOf(document, source);
                auto where = polar(source.position - aim);
                where[which] = value;
                const geometry::Vec3d out = shotline::towards(base::radians(where[0]), base::radians(where[1]));
                source.position = ((aim + where[2] * out) * 1e6).array().round().matrix() / 1e6;
              },
              SourceDraft::Drag::yes);
        });
    form_.showRowWhile(seen, isPoint);
    addTrouble("position");
  }

  void addTarget() {
    PropertyForm& form = form_;
    QWidget* target = form.choice(
        {"target", Text::tr("Aimed at"), Text::tr("Where the middle of the shots goes")},
        [draft = draft_, &form] { return targets(form.document(), draft->source()); },
        [draft = draft_] {
          const Source& source = draft->source();
          return !source.targetStructure.empty() ? u':' + shown(source.targetStructure)
                 : source.target                 ? QStringLiteral("point")
                                                 : QStringLiteral("body");
        },
        [draft = draft_, &form](const QString& id) {
          draft->edit("target", Text::tr("Target"), [&](Source& source) {
            const geometry::Vec3d aim = aimOf(form.document(), source);
            source.target.reset();
            if (id == u"point") {
              source.target = (aim * 1000.0).array().round().matrix() / 1000.0;
            }
            source.targetStructure = id.startsWith(u':') ? id.mid(1).toStdString() : std::string();
          });
        });
    form.showRowWhile(target, when([](const Source& source) { return source.type != Type::list; }));
    QWidget* point = form.triple(
        {"target_point", Text::tr("Target point (m)"), QString()}, {-1000.0, 1000.0, 0.01, 3, {}},
        [draft = draft_] { return draft->source().target.value_or(geometry::Vec3d::Zero()); },
        [draft = draft_](const geometry::Vec3d& to) {
          draft->edit(
              "target_point", Text::tr("Target"), [&](Source& source) { source.target = to; }, SourceDraft::Drag::yes);
        });
    form.showRowWhile(point, when([](const Source& source) { return source.target.has_value(); }));
    addTrouble("target");
  }

  void addWindow() {
    const auto samples = [](study::Sampler sampler) {
      return [sampler](const Source& source) { return source.type == Type::point && source.sampler == sampler; };
    };
    using study::Sampler;
    const QString label = Text::tr("Spread over");
    QWidget* sampler = form_.choice(
        {"sampler", label, Text::tr("Which directions from the point are shot in")},
        [] {
          return std::vector<Choice>{
              {Text::tr("The whole body"), word(Sampler::cone),
               Text::tr("Even over the cone that bounds the posed body")},
              {Text::tr("A disk"), word(Sampler::disk), Text::tr("Around the target, across the line to it")},
              {Text::tr("A rectangle"), word(Sampler::rectangle), Text::tr("Around the target, across the line to it")},
              {Text::tr("Thesis (Eq 15)"), word(Sampler::thesis), Text::tr("For comparison with the thesis only")}};
        },
        [draft = draft_] { return word(draft->source().sampler); },
        [draft = draft_, label](const QString& id) {
          draft->edit("sampler", label, [&](Source& source) { setSampler(source, Sampler(id.toInt())); });
        });
    form_.showRowWhile(sampler, when([](const Source& source) { return source.type == Type::point; }));
    QLabel* warning = form_.note({"sampler_warning", QLatin1String("")}, [] {
      return Text::tr(
          "The thesis' sampler sends half of its shots backwards and its hit rate depends on the world's "
          "axes; use it for comparison only.");
    });
    form_.showRowWhile(warning, when(samples(Sampler::thesis)));
    addMetres("radius", Text::tr("Radius"), &Source::radius, samples(Sampler::disk));
    addMetres("width", Text::tr("Width"), &Source::width, samples(Sampler::rectangle));
    addMetres("height", Text::tr("Height"), &Source::height, samples(Sampler::rectangle));
  }

  void addMetres(const char* field, const QString& label, double Source::*member,
                 std::function<bool(const Source&)> holds) {
    QWidget* row = form_.number(
        {field, label}, {0.0, 1000.0, 0.05, 3, Text::tr(" m")},
        [draft = draft_, member] { return draft->source().*member; },
        set(field, label, [member](Source& source, double value) { source.*member = value; }));
    form_.showRowWhile(row, when(std::move(holds)));
    addTrouble(field);
  }

  void addAngles() {
    addAngle("azimuth", Text::tr("Azimuth"), 360.0, &Source::azimuth,
             Text::tr("Where shots come from: 0 ahead of the person, 90 on the person's left, 180 behind"));
    addAngle("elevation", Text::tr("Elevation"), 90.0, &Source::elevation,
             Text::tr("Where shots come from: 0 level, 90 above, -90 below"));
  }

  void addAngle(const char* field, const QString& label, double most, study::DegreeRange Source::*member,
                const QString& tip) {
    const NumberRange degrees{-most, most, 5.0, 2, degreeSign};
    QWidget* one = form_.number(
        {field, label, tip}, degrees, [draft = draft_, member] { return (draft->source().*member).from; },
        set(field, label, [member](Source& source, double value) { (source.*member).from = value; }));
    form_.showRowWhile(one, when([](const Source& source) { return source.type == Type::parallel; }));
    const QByteArray id = QByteArray(field) + "_band";
    QWidget* band = form_.numbers(
        {id.constData(), label, tip}, {{"from", degrees, Text::tr("from ")}, {"to", degrees, Text::tr("to ")}},
        [draft = draft_, member] {
          const study::DegreeRange& range = draft->source().*member;
          return std::vector<double>{range.from, range.to};
        },
        [draft = draft_, member, field, label](std::size_t which, double value) {
          draft->edit(
              QString::fromLatin1(field), label,
              [&](Source& source) { (which == 0 ? (source.*member).from : (source.*member).to) = value; },
              SourceDraft::Drag::yes);
        });
    form_.showRowWhile(band, when([](const Source& source) { return source.type == Type::band; }));
    addTrouble(field);
  }

  void addFile() {
    auto* group = new QWidget(&form_);
    auto* row = new QHBoxLayout(group);
    row->setContentsMargins(0, 0, 0, 0);
    auto* path = new ElidedLabel(group);
    path->setObjectName(QStringLiteral("file_path"));
    row->addWidget(path, 1);
    auto* choose = new QPushButton(Text::tr("Choose..."), group);
    choose->setObjectName(QStringLiteral("file"));
    choose->setAutoDefault(false);
    row->addWidget(choose);
    QObject::connect(choose, &QPushButton::clicked, &form_, [draft = draft_, &form = form_] {
      const QString file = QFileDialog::getOpenFileName(&form, Text::tr("File of shots"), {},
                                                        Text::tr("Lists of shots (*.csv);;All files (*)"));
      if (!file.isEmpty()) {
        draft->setFile(file);
      }
    });
    form_.row(Text::tr("File"), group, [draft = draft_, path] {
      const QString text = shown(draft->source().list.path);
      path->setText(text.isEmpty() ? Text::tr("none yet") : text);
    });
    const auto isList = when([](const Source& source) { return source.type == Type::list; });
    form_.showRowWhile(group, isList);
    addTrouble("file");
    QLabel* format = form_.note({"file_format", QLatin1String("")}, [] {
      return Text::tr("A line of names, x,y,z,dx,dy,dz or x,y,z,az,el (metres, degrees), then a line for each shot.");
    });
    form_.showRowWhile(format, isList);
  }

  void addSequence() {
    using study::Sequence;
    const QString label = Text::tr("Sequence");
    QWidget* sequence = form_.choice(
        {"sequence", label, Text::tr("Where the numbers behind the shots come from")},
        [draft = draft_] {
          std::vector<Choice> choices{
              {Text::tr("Random"), word(Sequence::random), Text::tr("Shots are independent of each other")},
              {Text::tr("Sobol points"), word(Sequence::sobol),
               Text::tr("Spread more evenly: the same width of interval with a fraction of the shots")}};
          if (draft->source().type == Type::parallel) {
            choices.push_back({Text::tr("Grid"), word(Sequence::grid), Text::tr("Squares, shifted in each trial")});
          }
          return choices;
        },
        [draft = draft_] { return word(draft->source().sequence); },
        [draft = draft_, label](const QString& id) {
          draft->edit("sequence", label, [&](Source& source) {
            source.sequence = Sequence(id.toInt());
            source.cell = source.sequence == Sequence::grid && source.cell == 0.0 ? 0.01 : source.cell;
          });
        });
    form_.showRowWhile(sequence, when([](const Source& source) {
                         return source.type != Type::list &&
                                !(source.type == Type::point && source.sampler == study::Sampler::thesis);
                       }));
    const auto isGrid = [](const Source& source) { return source.sequence == Sequence::grid; };
    QWidget* cell = form_.number(
        {"cell", Text::tr("Cell size"), Text::tr("At most this wide; the cells decide the number of shots")},
        {0.0, 10000.0, 1.0, 2, Text::tr(" mm")}, [draft = draft_] { return 1000.0 * draft->source().cell; },
        set("cell", Text::tr("Cell size"), [](Source& source, double value) { source.cell = value / 1000.0; }));
    form_.showRowWhile(cell, when(isGrid));
    addTrouble("cell");
    QWidget* shots = form_.number(
        {"shots", Text::tr("Shots per trial")}, {1.0, 1e12, 10000.0, 0, {}},
        [draft = draft_] { return static_cast<double>(draft->source().shots); },
        set("shots", Text::tr("Shots"),
            [](Source& source, double value) { source.shots = static_cast<std::uint64_t>(value); }));
    form_.showRowWhile(shots,
                       when([isGrid](const Source& source) { return !isGrid(source) && source.type != Type::list; }));
    addTrouble("shots");
  }

  void addFacts() {
    QLabel* measure = form_.note({"measure", Text::tr("Shares are of")},
                                 [draft = draft_, &form = form_] { return sharesText(form.document(), *draft); });
    measure->setToolTip(Text::tr("Each shot of a source weighs the same"));
  }

  template <class Enum>
  static QString word(Enum value) {
    return QString::number(static_cast<int>(value));
  }

  static void setSampler(Source& source, study::Sampler sampler) {
    source.sampler = sampler;
    if (sampler == study::Sampler::disk && source.radius == 0.0) {
      source.radius = 0.25;
    }
    if (sampler == study::Sampler::rectangle && source.width == 0.0) {
      source.width = 0.5;
      source.height = 0.7;
    }
  }

  static std::vector<Choice> targets(const document::StudyDocument& document, const Source& source) {
    std::vector<Choice> choices{{Text::tr("Centre of the body"), QStringLiteral("body")},
                                {Text::tr("A point"), QStringLiteral("point")}};
    bool known = source.targetStructure.empty();
    for (const std::string& structure : document::drawnStructures(document.study())) {
      if (structure != "body") {
        choices.push_back({shown(structure), u':' + shown(structure), Text::tr("The middle of the box around it")});
        known = known || structure == source.targetStructure;
      }
    }
    if (!known) {
      choices.push_back(
          {Text::tr("%1 (not in the study)").arg(shown(source.targetStructure)), u':' + shown(source.targetStructure)});
    }
    return choices;
  }

  static QString sharesText(const document::StudyDocument& document, SourceDraft& draft) {
    const Source& source = draft.source();
    if (draft.isPending()) {
      return unknown();
    }
    const analysis::ShotSource* planned = plannedSource(document, source.name);
    QString text;
    if (source.type == Type::list) {
      text = Text::tr("shots alone");
    } else if (source.type == Type::point && source.sampler == study::Sampler::thesis) {
      text = Text::tr("shots alone: Eq 15 has no solid angle");
    } else if (planned != nullptr) {
      text = measureText(planned->measure);
    } else {
      text = source.type == Type::point ? Text::tr("solid angle") : Text::tr("presented area");
    }
    if (planned == nullptr) {
      return text;
    }
    if (source.type == Type::list) {
      return Text::tr("%1; %2 shots, shot once").arg(text, models::grouped(planned->shots));
    }
    return source.sequence == study::Sequence::grid
               ? Text::tr("%1; %2 shots per trial").arg(text, models::grouped(planned->shots))
               : text;
  }

  PropertyForm& form_;
  std::shared_ptr<SourceDraft> draft_;
};

}  // namespace

void addSourceRows(PropertyForm& form, const std::shared_ptr<SourceDraft>& draft) {
  SourceRows(form, draft).add();
}

}  // namespace lorica::panels
