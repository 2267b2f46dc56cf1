#include "lorica/document/recovery.h"

#include <unistd.h>

#include <QDateTime>
#include <QJsonDocument>
#include <QJsonObject>
#include <QLocale>
#include <QStandardPaths>
#include <QUuid>
#include <algorithm>
#include <optional>
#include <utility>

#include "lorica/base/error.h"
#include "lorica/base/files.h"
#include "lorica/study/study_file.h"

namespace lorica::document {

namespace fs = std::filesystem;

namespace {

const char* const formatName = "lorica-recovery-1";
const char* const ending = ".lorica-recovery";

/// A lock that is stale only when its program is gone, however old it is.
std::unique_ptr<QLockFile> lockOf(const fs::path& recoveryFile) {
  auto lock = std::make_unique<QLockFile>(QString::fromStdString(recoveryFile.string() + ".lock"));
  lock->setStaleLockTime(0);
  return lock;
}

std::string recoveryText(const StudyDocument& document) {
  const fs::path& file = document.hasFile() ? document.savedFile() : document.file();
  QJsonObject root;
  root["format"] = formatName;
  root["file"] = QString::fromStdString(file.string());
  root["had_file"] = document.hasFile();
  root["saved_at"] = QDateTime::currentDateTimeUtc().toString(Qt::ISODateWithMs);
  root["study"] = QString::fromStdString(study::studyText(study::rebased(document.study(), document.file(), file)));
  return QJsonDocument(root).toJson().toStdString();
}

struct Dated {
  Recovered recovered;
  QDateTime when;
};

/// Nothing for a file that is damaged, or that belongs to a program that lives.
std::optional<Dated> readRecovered(const fs::path& file) {
  std::shared_ptr<QLockFile> claim = lockOf(file);
  if (!claim->tryLock(0)) {
    return std::nullopt;
  }
  try {
    const QJsonObject root = QJsonDocument::fromJson(QByteArray::fromStdString(base::readFile(file))).object();
    const QDateTime when = QDateTime::fromString(root["saved_at"].toString(), Qt::ISODateWithMs);
    if (root["format"].toString() != formatName || !when.isValid()) {
      return std::nullopt;
    }
    Recovered recovered;
    recovered.recoveryFile = file;
    recovered.study = study::parseStudy(root["study"].toString().toStdString(), file.string());
    recovered.file = root["file"].toString().toStdString();
    recovered.hadFile = root["had_file"].toBool();
    recovered.when = QLocale().toString(when.toLocalTime(), "d MMMM yyyy, HH:mm").toStdString();
    recovered.claim = std::move(claim);
    return Dated{std::move(recovered), when};
  } catch (const base::Error&) {
    return std::nullopt;
  }
}

}  // namespace

Autosave::Autosave(StudyDocument& document, const fs::path& folder, QObject* parent)
    : QObject(parent),
      document_(document),
      file_(folder /
            (std::to_string(::getpid()) + "-" + QUuid::createUuid().toString(QUuid::Id128).toStdString() + ending)) {
  timer_.setSingleShot(true);
  setDelay(std::chrono::seconds(5));
  connect(&timer_, &QTimer::timeout, this, &Autosave::write);
  connect(&document_, &StudyDocument::replaced, this, [this] {
    remove();
    failing_ = false;
  });
  connect(&document_, &StudyDocument::studyChanged, this, &Autosave::documentChanged);
  connect(&document_, &StudyDocument::fileChanged, this, &Autosave::documentChanged);
  documentChanged();
}

Autosave::~Autosave() {
  remove();
}

fs::path Autosave::defaultFolder() {
  return fs::path(QStandardPaths::writableLocation(QStandardPaths::AppDataLocation).toStdString()) / "recovery";
}

void Autosave::setDelay(std::chrono::milliseconds delay) {
  timer_.setInterval(delay);
}

void Autosave::writeNow() {
  if (document_.isModified()) {
    write();
  }
}

void Autosave::documentChanged() {
  if (!document_.isModified()) {
    remove();
  } else if (!timer_.isActive()) {
    // Never put off by the next edit: what is lost in a crash stays within one delay.
    timer_.start();
  }
}

void Autosave::write() {
  timer_.stop();
  try {
    if (lock_ == nullptr) {
      std::error_code failure;
      fs::create_directories(file_.parent_path(), failure);
      auto lock = lockOf(file_);
      if (!lock->tryLock(0)) {
        throw base::InputError(file_.string(), "", "cannot be written; check that its folder is writable");
      }
      lock_ = std::move(lock);
    }
    base::writeFileAtomically(file_, recoveryText(document_));
    failing_ = false;
  } catch (const base::Error& error) {
    timer_.start();
    if (!std::exchange(failing_, true)) {
      Q_EMIT failed(tr("Unsaved work is not being backed up: %1").arg(QString::fromStdString(error.what())));
    }
  }
}

void Autosave::remove() {
  timer_.stop();
  if (lock_ != nullptr) {
    std::error_code failure;
    fs::remove(file_, failure);
    lock_.reset();
  }
}

std::vector<Recovered> findRecovered(const fs::path& folder) {
  std::vector<Dated> found;
  std::error_code failure;
  for (const fs::directory_entry& entry : fs::directory_iterator(folder, failure)) {
    if (entry.path().extension() != ending) {
      continue;
    }
    if (std::optional<Dated> dated = readRecovered(entry.path())) {
      found.push_back(std::move(*dated));
    }
  }
  std::sort(found.begin(), found.end(), [](const Dated& a, const Dated& b) { return a.when > b.when; });
  std::vector<Recovered> recovered;
  recovered.reserve(found.size());
  for (Dated& dated : found) {
    recovered.push_back(std::move(dated.recovered));
  }
  return recovered;
}

void discardRecovered(const Recovered& recovered) {
  std::error_code failure;
  fs::remove(recovered.recoveryFile, failure);
  if (recovered.claim != nullptr) {
    recovered.claim->unlock();
  }
}

}  // namespace lorica::document
