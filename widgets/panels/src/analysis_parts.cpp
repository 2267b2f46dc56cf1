#include "analysis_parts.h"

#include <QListWidget>

#include "lorica/commands/shot_edits.h"

namespace lorica::panels {

namespace {

void fillNames(QListWidget& list, const Names& offered, const Names& chosen) {
  Names all = offered;
  for (const std::string& name : chosen) {
    if (!holdsName(all, name)) {
      all.push_back(name);
    }
  }
  while (list.count() > static_cast<int>(all.size())) {
    delete list.takeItem(list.count() - 1);
  }
  for (std::size_t i = 0; i < all.size(); ++i) {
    const int at = static_cast<int>(i);
    QListWidgetItem* item = at < list.count() ? list.item(at) : new QListWidgetItem(&list);
    const bool on = holdsName(chosen, all[i]);
    item->setText(i < offered.size() ? shown(all[i]) : Text::tr("%1 (not in the study)").arg(shown(all[i])));
    item->setData(Qt::UserRole, shown(all[i]));
    item->setToolTip(item->text());
    item->setFlags(on && chosen.size() == 1 ? Qt::ItemIsUserCheckable : Qt::ItemIsUserCheckable | Qt::ItemIsEnabled);
    item->setCheckState(on ? Qt::Checked : Qt::Unchecked);
  }
}

Names tickedIn(const QListWidget& list) {
  Names names;
  for (int i = 0; i < list.count(); ++i) {
    if (list.item(i)->checkState() == Qt::Checked) {
      names.push_back(list.item(i)->data(Qt::UserRole).toString().toStdString());
    }
  }
  return names;
}

}  // namespace

bool holdsName(const Names& names, const std::string& name) {
  return std::find(names.begin(), names.end(), name) != names.end();
}

Names namesOf(const std::vector<study::Organ>& organs) {
  Names names;
  names.reserve(organs.size());
  for (const study::Organ& organ : organs) {
    names.push_back(organ.name);
  }
  return names;
}

Names organsToWatch(const study::Study& study) {
  Names names;
  for (const study::Organ& organ : study.organs) {
    if (organ.injuryClass == "essential") {
      names.push_back(organ.name);
    }
  }
  if (names.empty() && !study.organs.empty()) {
    names.push_back(study.organs.front().name);
  }
  return names;
}

QListWidget* makeNameList(PropertyForm& form, const char* id, const QString& label) {
  auto* list = new QListWidget(&form);
  list->setObjectName(QString::fromLatin1(id));
  list->setAccessibleName(label);
  list->setTextElideMode(Qt::ElideMiddle);
  list->setHorizontalScrollBarPolicy(Qt::ScrollBarAlwaysOff);
  list->setFixedHeight(form.fontMetrics().height() * 5);
  return list;
}

QListWidget* addTickedNames(PropertyForm& form, const Field& field, std::function<Names()> offered,
                            std::function<Names()> chosen, std::function<void(const Names&)> set) {
  QListWidget* list = makeNameList(form, field.id, field.tip);
  list->setToolTip(field.tip);
  QObject::connect(list, &QListWidget::itemChanged, &form, [&form, list, set = std::move(set)] {
    if (!form.isRefreshing()) {
      set(tickedIn(*list));
      form.refresh();
    }
  });
  form.row(field.label, list,
           [list, offered = std::move(offered), chosen = std::move(chosen)] { fillNames(*list, offered(), chosen()); });
  return list;
}

void editAnalyses(document::StudyDocument& document, const std::function<void(study::Analyses&)>& change) {
  study::Analyses analyses = document.study().analyses;
  change(analyses);
  if (commands::analysesTroubles(analyses).empty()) {
    commands::setAnalyses(document, analyses);
  }
}

}  // namespace lorica::panels
