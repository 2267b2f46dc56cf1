#include "lorica/models/project_model.h"

#include <QFileInfo>
#include <QFont>
#include <QIcon>
#include <QPainter>
#include <QPixmapCache>
#include <algorithm>

#include "lorica/commands/edits.h"
#include "lorica/document/appearance.h"
#include "lorica/models/numbers.h"

namespace lorica::models {

using document::Change;
using document::ItemKind;
using document::ItemRef;

struct ProjectModel::Node {
  Section section = Section::body;
  std::optional<ItemRef> item;  ///< none for heads of sections
  const Node* parent = nullptr;
  int row = 0;
  std::vector<std::unique_ptr<Node>> children;

  Node& add(Section of, std::optional<ItemRef> what) {
    auto child = std::make_unique<Node>();
    child->section = of;
    child->item = std::move(what);
    child->parent = this;
    child->row = static_cast<int>(children.size());
    children.push_back(std::move(child));
    return *children.back();
  }
  bool is(ItemKind kind) const { return item && item->kind == kind; }
  bool isDrawn() const { return is(ItemKind::body) || is(ItemKind::organ) || is(ItemKind::piece); }
  bool sameAs(const Node& other) const {
    return section == other.section && item == other.item &&
           std::equal(children.begin(), children.end(), other.children.begin(), other.children.end(),
                      [](const auto& a, const auto& b) { return a->sameAs(*b); });
  }
};

namespace {

template <class Named>
const Named* named(const std::vector<Named>& all, const std::string& name) {
  const auto found = std::find_if(all.begin(), all.end(), [&](const Named& one) { return one.name == name; });
  return found == all.end() ? nullptr : &*found;
}

const study::ArmorPiece* pieceNamed(const study::Study& study, const std::string& name) {
  for (const study::ArmorSystem& system : study.systems) {
    if (const study::ArmorPiece* piece = named(system.pieces, name)) {
      return piece;
    }
  }
  return nullptr;
}

const document::RunRecord* runNamed(const document::StudyDocument& document, const std::string& name) {
  for (const auto& run : document.runs()) {
    if (run->name == name) {
      return run.get();
    }
  }
  return nullptr;
}

void appendStructures(const study::Study& study, const ItemRef& item, std::vector<std::string>& names) {
  if (item.kind == ItemKind::body) {
    names.emplace_back("body");
  } else if (item.kind == ItemKind::organ || item.kind == ItemKind::piece) {
    names.push_back(item.name);
  } else if (item.kind == ItemKind::system) {
    if (const study::ArmorSystem* system = named(study.systems, item.name)) {
      for (const study::ArmorPiece& piece : system->pieces) {
        names.push_back(piece.name);
      }
    }
  }
}

}  // namespace

QIcon colourSwatch(const QColor& colour) {
  QIcon icon;
  // Several sizes, so that it stays sharp where pixels are scaled.
  for (const int size : {16, 24, 32}) {
    const QString key = QStringLiteral("lorica-swatch-%1-%2").arg(colour.rgba()).arg(size);
    QPixmap pixmap;
    if (!QPixmapCache::find(key, &pixmap)) {
      pixmap = QPixmap(size, size);
      pixmap.fill(Qt::transparent);
      QPainter painter(&pixmap);
      painter.setRenderHint(QPainter::Antialiasing);
      painter.setPen(QPen(colour.darker(150), size / 16.0));
      painter.setBrush(colour);
      const double margin = size * 0.16;
      painter.drawEllipse(QRectF(margin, margin, size - 2 * margin, size - 2 * margin));
      painter.end();
      QPixmapCache::insert(key, pixmap);
    }
    icon.addPixmap(pixmap);
    icon.addPixmap(pixmap, QIcon::Selected);  // a colour stays itself in a selected row
  }
  return icon;
}

namespace {

/// How a source spreads its shots, in a word.
QString spreadOf(const study::Source& source) {
  switch (source.type) {
    case study::SourceType::parallel:
      return ProjectModel::tr("parallel");
    case study::SourceType::band:
      return ProjectModel::tr("band of directions");
    case study::SourceType::sphere:
      return ProjectModel::tr("every direction");
    case study::SourceType::list:
      return ProjectModel::tr("from a file");
    case study::SourceType::point:
      break;
  }
  switch (source.sampler) {
    case study::Sampler::rectangle:
      return ProjectModel::tr("rectangle");
    case study::Sampler::disk:
      return ProjectModel::tr("disk");
    case study::Sampler::thesis:
      return ProjectModel::tr("thesis");
    case study::Sampler::cone:
      break;
  }
  return ProjectModel::tr("cone");
}

QString sourceText(const study::Source& source) {
  const bool ownNumber = source.type == study::SourceType::list || source.sequence == study::Sequence::grid;
  return ownNumber ? spreadOf(source) : ProjectModel::tr("%1, %2 shots").arg(spreadOf(source), grouped(source.shots));
}

}  // namespace

ProjectModel::ProjectModel(document::StudyDocument& document, QObject* parent)
    : QAbstractItemModel(parent), document_(document) {
  root_ = makeTree();
  connect(&document_, &document::StudyDocument::replaced, this, &ProjectModel::follow);
  connect(&document_, &document::StudyDocument::loadedChanged, this, &ProjectModel::follow);
  connect(&document_, &document::StudyDocument::runsChanged, this, &ProjectModel::follow);
  connect(&document_, &document::StudyDocument::studyChanged, this, [this](document::Changes what) {
    if (what == document::Changes(Change::display)) {
      tellDisplayChanged();
    } else {
      follow();
    }
  });
  connect(&document_, &document::StudyDocument::shownPoseChanged, this, [this] {
    if (const QModelIndex poses = indexOf(Section::poses); poses.isValid()) {
      tellChanged(nodeOf(poses), {Qt::FontRole, Qt::ToolTipRole});
    }
  });
}

ProjectModel::~ProjectModel() = default;

std::unique_ptr<ProjectModel::Node> ProjectModel::makeTree() const {
  auto root = std::make_unique<Node>();
  if (!document_.hasStudy()) {
    return root;
  }
  const study::Study& study = document_.study();
  Node& body = root->add(Section::body, ItemRef{ItemKind::body, ""});
  if (document_.loaded() != nullptr) {
    for (const std::string& region : document_.loaded()->body->body().regions.names) {
      body.add(Section::body, ItemRef{ItemKind::region, region});
    }
  }
  Node& organs = root->add(Section::organs, std::nullopt);
  for (const study::Organ& organ : study.organs) {
    organs.add(Section::organs, ItemRef{ItemKind::organ, organ.name});
  }
  Node& armor = root->add(Section::armor, std::nullopt);
  for (const study::ArmorSystem& system : study.systems) {
    Node& head = armor.add(Section::armor, ItemRef{ItemKind::system, system.name});
    for (const study::ArmorPiece& piece : system.pieces) {
      head.add(Section::armor, ItemRef{ItemKind::piece, piece.name});
    }
  }
  Node& poses = root->add(Section::poses, std::nullopt);
  poses.add(Section::poses, ItemRef{ItemKind::pose, "rest"});
  for (const study::Pose& pose : study.poses) {
    poses.add(Section::poses, ItemRef{ItemKind::pose, pose.name});
  }
  Node& sources = root->add(Section::sources, std::nullopt);
  for (const study::Source& source : study.sources) {
    sources.add(Section::sources, ItemRef{ItemKind::source, source.name});
  }
  Node& runs = root->add(Section::runs, std::nullopt);
  for (const auto& run : document_.runs()) {
    runs.add(Section::runs, ItemRef{ItemKind::run, run->name});
  }
  return root;
}

void ProjectModel::follow() {
  std::unique_ptr<Node> now = makeTree();
  if (now->sameAs(*root_)) {
    tellChanged(*root_, {});
    return;
  }
  beginResetModel();
  root_ = std::move(now);
  endResetModel();
}

/// Everything below a node.
void ProjectModel::tellChanged(const Node& node, const QList<int>& roles) {
  if (node.children.empty()) {
    return;
  }
  Q_EMIT dataChanged(indexOf(*node.children.front(), nameColumn), indexOf(*node.children.back(), detailsColumn), roles);
  for (const auto& child : node.children) {
    tellChanged(*child, roles);
  }
}

void ProjectModel::tellDisplayChanged() {
  const QList<int> roles{Qt::CheckStateRole, Qt::DecorationRole, colourRole, opacityRole};
  for (const auto& head : root_->children) {
    if (head->section == Section::body || head->section == Section::organs || head->section == Section::armor) {
      Q_EMIT dataChanged(indexOf(*head, nameColumn), indexOf(*head, nameColumn), roles);
      if (head->section != Section::body) {
        tellChanged(*head, roles);
      }
    }
  }
}

const ProjectModel::Node& ProjectModel::nodeOf(const QModelIndex& index) {
  return *static_cast<const Node*>(index.constInternalPointer());
}

QModelIndex ProjectModel::indexOf(const Node& node, int column) const {
  return node.parent == nullptr ? QModelIndex() : createIndex(node.row, column, &node);
}

const ProjectModel::Node* ProjectModel::find(const Node& below, const ItemRef& item) const {
  for (const auto& child : below.children) {
    if (child->item == item) {
      return child.get();
    }
    if (const Node* found = find(*child, item)) {
      return found;
    }
  }
  return nullptr;
}

std::optional<ItemRef> ProjectModel::itemAt(const QModelIndex& index) const {
  return index.isValid() ? nodeOf(index).item : std::nullopt;
}

QModelIndex ProjectModel::indexOf(const ItemRef& item) const {
  const Node* node = find(*root_, item);
  return node == nullptr ? QModelIndex() : indexOf(*node, nameColumn);
}

QModelIndex ProjectModel::indexOf(Section section) const {
  for (const auto& head : root_->children) {
    if (head->section == section) {
      return indexOf(*head, nameColumn);
    }
  }
  return {};
}

Section ProjectModel::sectionAt(const QModelIndex& index) const {
  LORICA_CHECK(index.isValid(), "a row is needed");
  return nodeOf(index).section;
}

std::vector<std::string> ProjectModel::structuresAt(const QModelIndex& index) const {
  std::vector<std::string> names;
  if (!index.isValid()) {
    return names;
  }
  const Node& node = nodeOf(index);
  if (node.item) {
    appendStructures(document_.study(), *node.item, names);
  } else {
    for (const auto& child : node.children) {
      appendStructures(document_.study(), *child->item, names);
    }
  }
  return names;
}

QModelIndex ProjectModel::index(int row, int column, const QModelIndex& parent) const {
  if (!hasIndex(row, column, parent)) {
    return {};
  }
  const Node& above = parent.isValid() ? nodeOf(parent) : *root_;
  return createIndex(row, column, above.children[static_cast<std::size_t>(row)].get());
}

QModelIndex ProjectModel::parent(const QModelIndex& child) const {
  return child.isValid() ? indexOf(*nodeOf(child).parent, nameColumn) : QModelIndex();
}

int ProjectModel::rowCount(const QModelIndex& parent) const {
  if (parent.column() > nameColumn) {
    return 0;
  }
  return static_cast<int>((parent.isValid() ? nodeOf(parent) : *root_).children.size());
}

int ProjectModel::columnCount(const QModelIndex& /*parent*/) const {
  return columnTotal;
}

Qt::ItemFlags ProjectModel::flags(const QModelIndex& index) const {
  if (!index.isValid()) {
    return Qt::NoItemFlags;
  }
  Qt::ItemFlags flags = Qt::ItemIsEnabled | Qt::ItemIsSelectable;
  if (index.column() == nameColumn) {
    const Node& node = nodeOf(index);
    flags.setFlag(Qt::ItemIsUserCheckable, checkStateOf(node).isValid());
    flags.setFlag(Qt::ItemIsEditable, node.item && commands::canRemove(*node.item));
  }
  return flags;
}

QVariant ProjectModel::data(const QModelIndex& index, int role) const {
  if (!checkIndex(index, CheckIndexOption::IndexIsValid)) {
    return {};
  }
  const Node& node = nodeOf(index);
  if (role == itemRole) {
    return node.item ? QVariant::fromValue(*node.item) : QVariant();
  }
  if (role == keyRole) {
    return node.item ? QStringLiteral("%1/%2").arg(static_cast<int>(node.item->kind)).arg(nameOf(node))
                     : QStringLiteral("#%1").arg(static_cast<int>(node.section));
  }
  if (role == Qt::ToolTipRole) {
    const QString description = descriptionOf(node);
    const QString head = nameOf(node) + (detailsOf(node).isEmpty() ? QString() : ": " + detailsOf(node));
    return description.isEmpty() ? head : head + "\n" + description;
  }
  if (index.column() == detailsColumn) {
    return role == Qt::DisplayRole ? QVariant(detailsOf(node)) : QVariant();
  }
  switch (role) {
    case Qt::DisplayRole:
    case Qt::EditRole:
      return nameOf(node);
    case Qt::CheckStateRole:
      return checkStateOf(node);
    case Qt::FontRole:
      if (node.is(ItemKind::pose) && node.item->name == document_.shownPose()) {
        QFont bold;
        bold.setBold(true);
        return bold;
      }
      return {};
    default:
      break;
  }
  if (!node.isDrawn() || (role != Qt::DecorationRole && role != colourRole && role != opacityRole)) {
    return {};
  }
  const document::Appearance appearance =
      document::appearanceOf(document_.study(), node.is(ItemKind::body) ? "body" : node.item->name);
  if (role == opacityRole) {
    return appearance.opacity;
  }
  return role == colourRole ? QVariant(appearance.colour) : QVariant(colourSwatch(appearance.colour));
}

QVariant ProjectModel::checkStateOf(const Node& node) const {
  std::vector<std::string> names = structuresAt(indexOf(node, nameColumn));
  if (!node.item) {
    for (const auto& child : node.children) {
      if (!child->isDrawn() && !child->is(ItemKind::system)) {
        return {};
      }
    }
  }
  if (names.empty()) {
    return {};
  }
  const auto visible = std::count_if(names.begin(), names.end(), [this](const std::string& name) {
    return document::appearanceOf(document_.study(), name).visible;
  });
  return visible == 0 ? Qt::Unchecked : visible == static_cast<long>(names.size()) ? Qt::Checked : Qt::PartiallyChecked;
}

QString ProjectModel::nameOf(const Node& node) const {
  if (node.is(ItemKind::body)) {
    return tr("Body");
  }
  if (node.item) {
    return QString::fromStdString(node.item->name);
  }
  switch (node.section) {
    case Section::organs:
      return tr("Organs");
    case Section::armor:
      return tr("Armor");
    case Section::poses:
      return tr("Poses");
    case Section::sources:
      return tr("Sources");
    default:
      return tr("Runs");
  }
}

QString ProjectModel::sectionDetails(const Node& node) const {
  const int count = static_cast<int>(node.children.size());
  switch (node.section) {
    case Section::armor:
      return count == 0 ? tr("none") : count == 1 ? tr("1 system") : tr("%1 systems").arg(count);
    default:
      return count == 0 ? tr("none") : QString::number(count);
  }
}

QString ProjectModel::detailsOf(const Node& node) const {
  if (!node.item) {
    return sectionDetails(node);
  }
  const study::Study& study = document_.study();
  const std::string& name = node.item->name;
  switch (node.item->kind) {
    case ItemKind::body:
      if (const auto* file = std::get_if<study::InputFile>(&study.human.from)) {
        return QFileInfo(QString::fromStdString(file->path)).fileName();
      }
      return tr("built-in");
    case ItemKind::organ:
      if (const study::Organ* organ = named(study.organs, name)) {
        return QString::fromStdString(organ->injuryClass);
      }
      return {};
    case ItemKind::system:
      if (const study::ArmorSystem* system = named(study.systems, name)) {
        return system->pieces.size() == 1 ? tr("1 piece") : tr("%1 pieces").arg(system->pieces.size());
      }
      return {};
    case ItemKind::piece:
      if (const study::ArmorPiece* piece = pieceNamed(study, name)) {
        return piece->carriage == study::Carriage::rigid ? tr("rigid") : tr("skinned");
      }
      return {};
    case ItemKind::pose:
      if (const study::Pose* pose = named(study.poses, name)) {
        if (const auto* clip = std::get_if<study::ClipPose>(&pose->what)) {
          return tr("%1 s of %2").arg(clip->seconds).arg(QString::fromStdString(clip->clip));
        }
        const auto turns = std::get<study::TurnedPose>(pose->what).turns.size();
        return turns == 1 ? tr("1 joint turned") : tr("%1 joints turned").arg(turns);
      }
      return {};
    case ItemKind::source:
      if (const study::Source* source = named(study.sources, name)) {
        return sourceText(*source);
      }
      return {};
    case ItemKind::run:
      if (const document::RunRecord* run = runNamed(document_, name)) {
        std::uint64_t shots = 0;
        for (const analysis::SourcePoseResult& part : run->result.results) {
          for (const shotline::Tally& trial : part.trials) {
            shots += trial.shots();
          }
        }
        const auto poses = run->result.poses.size();
        const QString text = poses == 1 ? tr("%1 shots, 1 pose").arg(grouped(shots))
                                        : tr("%1 shots, %2 poses").arg(grouped(shots)).arg(poses);
        // First, so that a narrow column does not hide it.
        return run->result.partial ? tr("partial, %1").arg(text) : text;
      }
      return {};
    default:
      return {};
  }
}

QString ProjectModel::descriptionOf(const Node& node) const {
  if (!node.item) {
    return {};
  }
  const study::Study& study = document_.study();
  const auto from = [](const auto* thing) {
    return thing == nullptr ? QString() : QString::fromStdString(thing->description);
  };
  switch (node.item->kind) {
    case ItemKind::organ:
      return from(named(study.organs, node.item->name));
    case ItemKind::system:
      return from(named(study.systems, node.item->name));
    case ItemKind::piece:
      return from(pieceNamed(study, node.item->name));
    case ItemKind::pose:
      return from(named(study.poses, node.item->name));
    case ItemKind::source:
      return from(named(study.sources, node.item->name));
    default:
      return {};
  }
}

bool ProjectModel::setData(const QModelIndex& index, const QVariant& value, int role) {
  if (!checkIndex(index, CheckIndexOption::IndexIsValid) || index.column() != nameColumn) {
    return false;
  }
  const Node& node = nodeOf(index);
  if (role == Qt::CheckStateRole && checkStateOf(node).isValid()) {
    show(node, value.toInt() != Qt::Unchecked);
    return true;
  }
  if (role == Qt::EditRole && node.item && commands::canRemove(*node.item)) {
    // A copy: the node does not outlive the edit.
    return rename(ItemRef(*node.item), value.toString().trimmed());
  }
  return false;
}

void ProjectModel::show(const Node& node, bool visible) {
  const std::vector<std::string> names = structuresAt(indexOf(node, nameColumn));
  if (node.isDrawn()) {
    commands::setVisible(document_, names.front(), visible);
  } else {
    commands::setAllVisible(
        document_, names, visible,
        (visible ? tr("Show %1") : tr("Hide %1")).arg(node.item ? nameOf(node) : nameOf(node).toLower()));
  }
}

bool ProjectModel::rename(const ItemRef& item, const QString& name) {
  const std::string wanted = name.toStdString();
  if (wanted == item.name) {
    return true;
  }
  const QString trouble = commands::renameTrouble(document_, item, wanted);
  if (!trouble.isEmpty()) {
    Q_EMIT renameRefused(trouble);
    return false;
  }
  commands::renameItem(document_, item, wanted);
  return true;
}

QVariant ProjectModel::headerData(int section, Qt::Orientation orientation, int role) const {
  if (orientation != Qt::Horizontal || role != Qt::DisplayRole) {
    return {};
  }
  return section == nameColumn ? tr("Name") : section == detailsColumn ? tr("Details") : QVariant();
}

}  // namespace lorica::models
