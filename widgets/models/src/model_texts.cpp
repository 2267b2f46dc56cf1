#include "lorica/models/model_texts.h"

#include <QCoreApplication>

namespace lorica::models {

namespace {

struct Text {
  Q_DECLARE_TR_FUNCTIONS(lorica::models)
};

}  // namespace

std::array<ModelText, 4> modelTexts() {
  using viscera::OrganModel;
  return {{{OrganModel::staticJoint, Text::tr("Static, by joint"),
            Text::tr("Rigid, carried by one joint: what a plain static organ does.")},
           {OrganModel::staticSkin, Text::tr("Static, by skin"),
            Text::tr("Rigid, carried by the skin around it, position and orientation.")},
           {OrganModel::dynamicThesis, Text::tr("Dynamic, thesis"),
            Text::tr("Deformed by a lattice that follows the nearest interior site, as the thesis has it.")},
           {OrganModel::dynamic, Text::tr("Dynamic"),
            Text::tr("Deformed by a lattice that follows blended interior sites: the best model.")}}};
}

}  // namespace lorica::models
