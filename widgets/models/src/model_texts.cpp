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
  return {
      {{OrganModel::staticJoint, Text::tr("Static, by joint"),
        Text::tr("Rigid, carried by one joint: what a plain static organ does.")},
       {OrganModel::staticSkin, Text::tr("Static, by skin"),
        Text::tr("Rigid, carried by the skin around it, position and orientation.")},
       {OrganModel::dynamicThesis, Text::tr("Dynamic, thesis"),
        Text::tr("Deformed by a lattice that follows the nearest interior site, as the thesis has it.")},
       {OrganModel::dynamic, Text::tr("Dynamic"),
        Text::tr("Deformed with all organs as one soft body, or by a lattice that follows blended interior sites, as "
                 "the study says: the best model.")}}};
}

QString modelLabel(viscera::OrganModel model) {
  for (const ModelText& text : modelTexts()) {
    if (text.model == model) {
      return text.label;
    }
  }
  return {};
}

QString modelFromFile(const std::string& name) {
  for (const ModelText& text : modelTexts()) {
    if (viscera::name(text.model) == name) {
      return text.label;
    }
  }
  return QString::fromStdString(name);
}

std::array<DriverText, 5> driverTexts() {
  using document::Driver;
  return {
      {{Driver::lattice, Text::tr("Lattice"),
        Text::tr("Edges of the cells that hold a part of the organ. A rigid organ has none.")},
       {Driver::controlPoints, Text::tr("Control points"),
        Text::tr("Corners of the cells, in the pose: the organ moves with them.")},
       {Driver::sites, Text::tr("Interior sites"),
        Text::tr("Points inside the body that the skin carries; those that carry this organ are larger. A soft body "
                 "follows the skin itself.")},
       {Driver::rays, Text::tr("Anchor rays"),
        Text::tr("From each site that carries this organ to its three anchors on the skin.")},
       {Driver::frames, Text::tr("Reference frames"),
        Text::tr("How each site that carries this organ is turned, as small axes; of a joint where that carries "
                 "it.")}}};
}

std::array<ColouringText, 3> colouringTexts() {
  using document::Colouring;
  return {{{Colouring::own, Text::tr("Which organ it is"), Text::tr("Every organ has a colour of its own.")},
           {Colouring::strain, Text::tr("Edge stretch"),
            Text::tr("How much longer or shorter than at rest the edges of the organ's surface are, those at one "
                     "vertex together.")},
           {Colouring::protrusion, Text::tr("Depth beyond the skin"),
            Text::tr("How far the organ reaches out of the posed skin.")}}};
}

}  // namespace lorica::models
