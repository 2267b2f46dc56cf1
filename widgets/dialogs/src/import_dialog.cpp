#include "lorica/dialogs/import_dialog.h"

#include <QCheckBox>
#include <QComboBox>
#include <QDialogButtonBox>
#include <QDragEnterEvent>
#include <QFileDialog>
#include <QFormLayout>
#include <QHBoxLayout>
#include <QLabel>
#include <QMimeData>
#include <QProgressBar>
#include <QPushButton>
#include <QRadioButton>
#include <QVBoxLayout>
#include <algorithm>
#include <cmath>

#include "import_file_table.h"
#include "import_parts.h"
#include "import_preview.h"
#include "lorica/base/error.h"

namespace lorica::dialogs {

namespace fs = std::filesystem;

namespace {

std::vector<fs::path> droppedFiles(const QMimeData& data) {
  std::vector<fs::path> files;
  for (const QUrl& url : data.urls()) {
    if (url.isLocalFile()) {
      files.push_back(pathOf(url.toLocalFile()));
    }
  }
  return files;
}

std::size_t pieceCount(const study::Study& study) {
  std::size_t count = 0;
  for (const study::ArmorSystem& system : study.systems) {
    count += system.pieces.size();
  }
  return count;
}

QString organsText(std::size_t count) {
  return count == 1 ? ImportDialog::tr("1 organ") : ImportDialog::tr("%1 organs").arg(count);
}

QString piecesText(std::size_t count) {
  return count == 1 ? ImportDialog::tr("1 armor piece") : ImportDialog::tr("%1 armor pieces").arg(count);
}

}  // namespace

ImportDialog::ImportDialog(const document::StudyDocument& document, QWidget* parent)
    : QDialog(parent), document_(document) {
  setWindowTitle(tr("Import"));
  setModal(true);
  setAcceptDrops(true);
  auto* column = new QVBoxLayout(this);
  column->addWidget(makeModeRow());
  column->addWidget(makeFileTable(), 1);
  column->addWidget(makeOptions());
  column->addWidget(makePreview(), 1);
  auto* buttons = new QDialogButtonBox(QDialogButtonBox::Ok | QDialogButtonBox::Cancel, this);
  accept_ = buttons->button(QDialogButtonBox::Ok);
  accept_->setObjectName(QStringLiteral("accept"));
  connect(buttons, &QDialogButtonBox::accepted, this, &ImportDialog::accept);
  connect(buttons, &QDialogButtonBox::rejected, this, &QDialog::reject);
  column->addWidget(buttons);
  delay_.setSingleShot(true);
  delay_.setInterval(300);
  connect(&delay_, &QTimer::timeout, this, &ImportDialog::read);
  resize(fontMetrics().averageCharWidth() * 110, fontMetrics().height() * 36);
  guess();
  showState();
}

ImportDialog::~ImportDialog() = default;

QWidget* ImportDialog::makeModeRow() {
  auto* group = new QWidget(this);
  auto* row = new QHBoxLayout(group);
  row->setContentsMargins(0, 0, 0, 0);
  newStudy_ = new QRadioButton(tr("New study"), group);
  newStudy_->setObjectName(QStringLiteral("new_study"));
  openStudy_ = new QRadioButton(
      document_.hasStudy() ? tr("Add to %1").arg(document_.displayName()) : tr("Add to the open study"), group);
  openStudy_->setObjectName(QStringLiteral("open_study"));
  openStudy_->setEnabled(document_.hasStudy());
  newStudy_->setChecked(true);
  row->addWidget(newStudy_);
  row->addWidget(openStudy_);
  row->addStretch(1);
  connect(newStudy_, &QRadioButton::toggled, this, [this] {
    guess();
    changed();
  });
  return group;
}

QWidget* ImportDialog::makeFileTable() {
  auto* group = new QWidget(this);
  auto* row = new QHBoxLayout(group);
  row->setContentsMargins(0, 0, 0, 0);
  files_ = new ImportFileTable(group);
  files_->setObjectName(QStringLiteral("files"));
  connect(files_, &ImportFileTable::edited, this, &ImportDialog::changed);
  row->addWidget(files_, 1);
  auto* side = new QVBoxLayout;
  row->addLayout(side);
  auto* add = new QPushButton(tr("Add files..."), group);
  add->setAutoDefault(false);
  remove_ = new QPushButton(tr("Remove"), group);
  remove_->setObjectName(QStringLiteral("remove"));
  remove_->setAutoDefault(false);
  side->addWidget(add);
  side->addWidget(remove_);
  side->addStretch(1);
  connect(add, &QPushButton::clicked, this, &ImportDialog::chooseFiles);
  connect(remove_, &QPushButton::clicked, this, &ImportDialog::removeChosen);
  connect(files_, &QTableWidget::itemSelectionChanged, this,
          [this] { remove_->setEnabled(!files_->selectionModel()->selectedRows().isEmpty()); });
  return group;
}

QWidget* ImportDialog::makeOptions() {
  auto* group = new QWidget(this);
  auto* row = new QHBoxLayout(group);
  row->setContentsMargins(0, 0, 0, 0);
  auto* checks = new QVBoxLayout;
  row->addLayout(checks);
  plates_ = new QCheckBox(tr("Add generated front and back plates"), group);
  plates_->setObjectName(QStringLiteral("plates"));
  plates_->setToolTip(tr("Two medium SAPI plates, laid on the chest and the back; they join the system \"armor\""));
  split_ = new QCheckBox(tr("Each part of an organ file is a structure"), group);
  split_->setObjectName(QStringLiteral("split"));
  checks->addWidget(plates_);
  checks->addWidget(split_);
  row->addStretch(1);
  auto* form = new QFormLayout;
  row->addLayout(form);
  units_ = new QComboBox(group);
  units_->setObjectName(QStringLiteral("units"));
  units_->addItem(tr("as in the file, or guessed"), QString());
  for (const auto unit :
       {base::LengthUnit::metre, base::LengthUnit::centimetre, base::LengthUnit::millimetre, base::LengthUnit::inch}) {
    units_->addItem(QString::fromStdString(base::name(unit)), QString::fromStdString(base::name(unit)));
  }
  form->addRow(tr("Unit of lengths"), units_);
  up_ = new QComboBox(group);
  up_->setObjectName(QStringLiteral("up"));
  up_->addItem(tr("as in the file, or guessed"), QString());
  up_->addItem(tr("y"), QStringLiteral("y"));
  up_->addItem(tr("z"), QStringLiteral("z"));
  form->addRow(tr("Axis that points up"), up_);
  connect(plates_, &QCheckBox::toggled, this, &ImportDialog::changed);
  connect(split_, &QCheckBox::toggled, this, &ImportDialog::changed);
  connect(units_, &QComboBox::currentIndexChanged, this, &ImportDialog::changed);
  connect(up_, &QComboBox::currentIndexChanged, this, &ImportDialog::changed);
  return group;
}

QWidget* ImportDialog::makePreview() {
  auto* group = new QWidget(this);
  auto* column = new QVBoxLayout(group);
  column->setContentsMargins(0, 0, 0, 0);
  preview_ = new ImportPreview(group);
  preview_->setObjectName(QStringLiteral("preview"));
  column->addWidget(preview_, 1);
  auto* row = new QHBoxLayout;
  column->addLayout(row);
  message_ = new QLabel(group);
  message_->setObjectName(QStringLiteral("message"));
  message_->setWordWrap(true);
  message_->setTextFormat(Qt::PlainText);
  row->addWidget(message_, 1);
  progress_ = new QProgressBar(group);
  progress_->setRange(0, 1000);
  row->addWidget(progress_, 1);
  cancelReading_ = new QPushButton(tr("Stop reading"), group);
  cancelReading_->setObjectName(QStringLiteral("stop"));
  cancelReading_->setAutoDefault(false);
  row->addWidget(cancelReading_);
  read_ = new QPushButton(tr("Read again"), group);
  read_->setObjectName(QStringLiteral("read"));
  read_->setToolTip(tr("Reads the files as they are now"));
  read_->setAutoDefault(false);
  row->addWidget(read_);
  connect(cancelReading_, &QPushButton::clicked, this, [this] {
    again_ = false;
    if (job_ != nullptr) {
      job_->cancel();
      failure_ = tr("Reading was stopped.");
    }
  });
  connect(read_, &QPushButton::clicked, this, [this] {
    changed();
    delay_.stop();
    read();
  });
  return group;
}

void ImportDialog::addFiles(const std::vector<fs::path>& files) {
  const bool first = files_->entries().empty();
  QStringList refused;
  for (const fs::path& file : files) {
    if (isMeshFile(file)) {
      files_->add(file);
    } else if (isStudyFile(file)) {
      refused.append(tr("%1 is a study; open it instead.").arg(textOf(file.filename())));
    } else {
      refused.append(tr("%1 is no mesh that can be read; those are glb, gltf, obj, stl, ply and off files.")
                         .arg(textOf(file.filename())));
    }
  }
  refused_ = refused.join(u'\n');
  if (first && !files_->entries().empty() && document_.hasStudy()) {
    // Files without a body among them are meant for the study that is open.
    const std::vector<FileRole> guessed = guessRoles(files, false);
    if (std::find(guessed.begin(), guessed.end(), FileRole::ignore) == guessed.end()) {
      openStudy_->setChecked(true);
    }
  }
  guess();
  changed();
}

std::vector<FileRole> ImportDialog::roles() const {
  std::vector<FileRole> all;
  const auto& entries = files_->entries();
  std::transform(entries.begin(), entries.end(), std::back_inserter(all), [](const auto& entry) { return entry.role; });
  return all;
}

void ImportDialog::setRole(std::size_t file, FileRole role) {
  files_->setRole(file, role);
  remove_->setEnabled(false);
  changed();
}

void ImportDialog::guess() {
  files_->guess(!addsToOpenStudy());
  remove_->setEnabled(false);
}

void ImportDialog::changed() {
  imported_.reset();
  failure_.clear();
  if (job_ != nullptr) {
    job_->cancel();
  }
  again_ = job_ != nullptr;
  if (trouble().isEmpty()) {
    delay_.start();
  } else {
    delay_.stop();
    again_ = false;
    preview_->setRowCount(0);
  }
  showState();
}

bool ImportDialog::addsToOpenStudy() const {
  return openStudy_->isChecked();
}

QString ImportDialog::trouble() const {
  const auto& entries = files_->entries();
  const auto with = [&entries](FileRole role) {
    return std::count_if(entries.begin(), entries.end(), [role](const auto& entry) { return entry.role == role; });
  };
  if (std::any_of(entries.begin(), entries.end(),
                  [](const auto& entry) { return entry.role == FileRole::armor && entry.system.empty(); })) {
    return tr("Give every armor piece a system.");
  }
  if (addsToOpenStudy()) {
    const bool any = with(FileRole::organ) > 0 || with(FileRole::armor) > 0 || plates_->isChecked();
    return any ? QString() : tr("Add files of organs or armor, or drop them here.");
  }
  if (entries.empty()) {
    return tr("Add the files of a body, its organs and armor, or drop them here.");
  }
  if (with(FileRole::skin) != 1) {
    return with(FileRole::skin) == 0 ? tr("Say which file holds the skin of the body.")
                                     : tr("Only one file can hold the skin of the body.");
  }
  return {};
}

analysis::ImportRequest ImportDialog::request() const {
  analysis::ImportRequest wanted;
  for (const ImportFileTable::Entry& entry : files_->entries()) {
    switch (entry.role) {
      case FileRole::skin:
        wanted.skin = entry.file;
        break;
      case FileRole::organ:
        wanted.organs.push_back(entry.file);
        break;
      case FileRole::armor:
        wanted.armor.push_back({entry.system, entry.file});
        break;
      case FileRole::ignore:
        break;
    }
  }
  if (plates_->isChecked()) {
    wanted.armor.push_back({"armor", study::Builtin{"front_plate"}});
    wanted.armor.push_back({"armor", study::Builtin{"back_plate"}});
  }
  wanted.split = split_->isChecked();
  wanted.units = base::lengthUnitNamed(units_->currentData().toString().toStdString());
  if (const QString up = up_->currentData().toString(); !up.isEmpty()) {
    wanted.up = up.front().toLatin1();
  }
  wanted.studyFile =
      addsToOpenStudy() ? document_.file() : freeStudyFile(wanted.skin.parent_path(), wanted.skin.stem().string());
  return wanted;
}

void ImportDialog::read() {
  if (job_ != nullptr) {
    again_ = true;
    job_->cancel();
    return;
  }
  again_ = false;
  if (!trouble().isEmpty()) {
    return;
  }
  struct Outcome {
    std::optional<analysis::ImportedStudy> imported;
    base::Issues trouble;
  };
  auto outcome = std::make_shared<Outcome>();
  analysis::ImportRequest wanted = request();
  studyFile_ = wanted.studyFile;
  std::shared_ptr<const study::Study> base;
  std::shared_ptr<const analysis::LoadedStudy> loaded;
  if (addsToOpenStudy()) {
    base = std::make_shared<const study::Study>(document_.study());
    loaded = document_.loaded();
  }
  job_ = std::make_unique<jobs::Job>(
      tr("Reading"), [outcome, wanted = std::move(wanted), base, loaded](const base::Progress& progress) mutable {
        wanted.addTo = base.get();
        wanted.previous = loaded.get();
        try {
          outcome->imported = analysis::importStudy(wanted, {}, progress);
        } catch (const base::InputError& error) {
          outcome->trouble = {{base::Severity::error, error.file(), error.place(), error.text()}};
        }
      });
  connect(job_.get(), &jobs::Job::progressed, this,
          [this](double share) { progress_->setValue(static_cast<int>(std::lround(1000.0 * share))); });
  connect(job_.get(), &jobs::Job::finished, this, [this, outcome] {
    if (job_->isCancelled()) {
      return;  // what was read is not asked for any more
    }
    if (outcome->imported) {
      preview_->showIssues(outcome->imported->issues);
      imported_ = std::move(outcome->imported);
    } else {
      preview_->showIssues(outcome->trouble);
      failure_ = tr("The files cannot be read as chosen.");
    }
  });
  connect(job_.get(), &jobs::Job::failed, this, [this](const QString& text) {
    failure_ = text;
    preview_->setRowCount(0);
  });
  connect(job_.get(), &jobs::Job::ended, this, &ImportDialog::readEnded);
  failure_.clear();
  progress_->setValue(0);
  job_->start();
  showState();
}

void ImportDialog::readEnded() {
  job_.release()->deleteLater();
  if (again_) {
    read();
  }
  showState();
}

void ImportDialog::showState() {
  const bool reading = job_ != nullptr || delay_.isActive();
  const QString why = trouble();
  QStringList said;
  for (const QString& text : {refused_, why, reading ? QString() : failure_}) {
    if (!text.isEmpty()) {
      said.append(text);
    }
  }
  if (reading) {
    said.append(tr("Reading the files..."));
  } else if (imported_) {
    const study::Study& made = imported_->study;
    said.append(tr("The study will have %1 and %2.").arg(organsText(made.organs.size()), piecesText(pieceCount(made))));
  }
  message_->setText(said.join(u'\n'));
  progress_->setVisible(job_ != nullptr);
  cancelReading_->setVisible(job_ != nullptr);
  read_->setVisible(job_ == nullptr);
  read_->setEnabled(why.isEmpty());
  accept_->setText(addsToOpenStudy() ? tr("Add") : tr("Create study"));
  accept_->setEnabled(imported_.has_value() && !reading);
}

void ImportDialog::chooseFiles() {
  const auto& entries = files_->entries();
  const QStringList names =
      QFileDialog::getOpenFileNames(this, tr("Add files"), entries.empty() ? QString() : textOf(entries.back().file),
                                    tr("Meshes (*.glb *.gltf *.obj *.stl *.ply *.off);;All files (*)"));
  std::vector<fs::path> files;
  std::transform(names.begin(), names.end(), std::back_inserter(files), pathOf);
  if (!files.empty()) {
    addFiles(files);
  }
}

void ImportDialog::removeChosen() {
  files_->removeSelected();
  refused_.clear();
  guess();
  changed();
}

void ImportDialog::accept() {
  if (imported_ && job_ == nullptr && !delay_.isActive()) {
    QDialog::accept();
  }
}

study::Study ImportDialog::study() const {
  LORICA_CHECK(imported_.has_value(), "the dialog was accepted");
  return imported_->study;
}

QString ImportDialog::addText() const {
  LORICA_CHECK(imported_.has_value(), "the dialog was accepted");
  const std::size_t organs = imported_->study.organs.size() - document_.study().organs.size();
  const std::size_t pieces = pieceCount(imported_->study) - pieceCount(document_.study());
  const QString someOrgans = organsText(organs);
  const QString somePieces = piecesText(pieces);
  if (pieces == 0) {
    return tr("Add %1").arg(someOrgans);
  }
  return organs == 0 ? tr("Add %1").arg(somePieces) : tr("Add %1 and %2").arg(someOrgans, somePieces);
}

void ImportDialog::dragEnterEvent(QDragEnterEvent* event) {
  if (!droppedFiles(*event->mimeData()).empty()) {
    event->acceptProposedAction();
  }
}

void ImportDialog::dropEvent(QDropEvent* event) {
  addFiles(droppedFiles(*event->mimeData()));
  event->acceptProposedAction();
}

}  // namespace lorica::dialogs
