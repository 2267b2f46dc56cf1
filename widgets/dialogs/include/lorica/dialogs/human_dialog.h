#pragma once

/// \file
/// Asks which person the built-in human is: for a new study, with organs and armor, or for the one that is open. The
/// person is seen while sizes are chosen, made beside the window; nothing here waits.

#include <QDialog>
#include <QList>
#include <optional>

#include "lorica/study/human_study.h"

class QCheckBox;
class QComboBox;
class QDoubleSpinBox;
class QLabel;
class QRadioButton;
class QSlider;
class QSpinBox;

namespace lorica::dialogs {

class HumanPreview;

class HumanDialog : public QDialog {
  Q_OBJECT

 public:
  enum class Purpose {
    newStudy,     ///< a study of the built-in human
    changePerson  ///< another person for the open one
  };

  /// \param person the first choice; sizes beyond manikin::PersonLimits are brought within them
  explicit HumanDialog(Purpose purpose, const human::Person& person = {}, QWidget* parent = nullptr);
  ~HumanDialog() override;

  /// Whom the choices stand for: whole millimetres and tenths of a kilogram, or the first choice while nothing was
  /// changed. A body can be made for it.
  const human::Person& person() const { return person_; }
  /// Chooses a percentile of stature and mass, 1 to 99.
  void setPercentile(int percentile);
  /// Chooses stature (m) and mass (kg), brought within the limits.
  void setSizes(double stature, double mass);
  void setSex(human::Sex sex);
  /// The new study. \pre Purpose::newStudy
  study::Study study() const;
  /// Whose picture is shown now; none before the first one is there.
  std::optional<human::Person> shownPerson() const;

  void done(int result) override;

 Q_SIGNALS:
  /// The picture of a person is there.
  void previewArrived();

 private:
  QWidget* makePersonForm();
  QWidget* makeStudyForm();
  void takePercentile();
  void takeSizes();
  /// Limits of the mass for the stature.
  void limitMass();
  void changed();
  void showState();

  Purpose purpose_;
  human::Person person_;
  bool taking_ = false;  ///< editors are being set from the person

  QRadioButton* male_ = nullptr;
  QRadioButton* female_ = nullptr;
  QRadioButton* byPercentile_ = nullptr;
  QRadioButton* bySizes_ = nullptr;
  QSlider* slider_ = nullptr;
  QSpinBox* percentile_ = nullptr;
  QDoubleSpinBox* stature_ = nullptr;
  QDoubleSpinBox* mass_ = nullptr;
  QLabel* massLimits_ = nullptr;
  QLabel* bmi_ = nullptr;
  QList<QCheckBox*> systems_;
  QComboBox* organs_ = nullptr;
  HumanPreview* preview_ = nullptr;
};

}  // namespace lorica::dialogs
