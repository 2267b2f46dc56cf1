#include <QPushButton>

#include "item_form_parts.h"
#include "item_forms.h"
#include "lorica/geometry/measures.h"
#include "lorica/models/numbers.h"
#include "lorica/study/human_study.h"

namespace lorica::panels {

using document::StudyDocument;

namespace {

double regionArea(const StudyDocument& document, const std::string& region) {
  const parenting::Body& body = document.loaded()->body->body();
  const auto& names = body.regions.names;
  const auto index = std::find(names.begin(), names.end(), region) - names.begin();
  double sum = 0.0;
  for (std::size_t t = 0; t < body.skin.triangles.size(); ++t) {
    if (body.regions.ofTriangle[t] == index) {
      const geometry::Vec3d a = body.skin.corner(t, 0);
      sum += 0.5 * (body.skin.corner(t, 1) - a).cross(body.skin.corner(t, 2) - a).norm();
    }
  }
  return sum;
}

}  // namespace

void fillBody(PropertyForm& form) {
  StudyDocument& document = form.document();
  const FindMesh mesh = [&document]() -> std::pair<const geometry::TriangleMesh*, const raycast::MeshTopology*> {
    if (document.loaded() == nullptr) {
      return {};
    }
    const parenting::BodyRig& body = *document.loaded()->body;
    return {&body.body().skin, body.skinTopology().get()};
  };
  form.section(Text::tr("Body"));
  form.fact({"file", Text::tr("File")}, [&document] { return sourceText(document.study().human); });
  if (std::holds_alternative<study::Builtin>(document.study().human.from)) {
    form.fact({"person", Text::tr("Person")}, [&document] { return shown(study::describe(document.study().person)); });
    auto* change = new QPushButton(Text::tr("Change the person..."));
    change->setObjectName(QStringLiteral("change_person"));
    QObject::connect(change, &QPushButton::clicked, &form, &PropertyForm::personRequested);
    form.row({}, change);
  }
  form.fact({"size", Text::tr("Size at rest")},
            [&document] {
              if (document.loaded() == nullptr) {
                return unknown();
              }
              const geometry::Vec3d size = geometry::bounds(document.loaded()->body->body().skin.positions).sizes();
              return Text::tr("%1 × %2 × %3 m")
                  .arg(models::fixed(size.x(), 3), models::fixed(size.y(), 3), models::fixed(size.z(), 3));
            })
      ->setToolTip(Text::tr("Wide, high and deep"));
  addMeshRows(form, mesh);
  form.fact({"joints", Text::tr("Joints")}, [&document] {
    if (document.loaded() == nullptr) {
      return unknown();
    }
    const auto& skeleton = document.loaded()->body->body().skeleton;
    return skeleton ? models::grouped(skeleton->size()) : Text::tr("no skeleton: shot at rest only");
  });
  form.note({"clips", Text::tr("Clips")}, [&document] {
    QStringList clips;
    if (document.loaded() != nullptr) {
      for (const human::Clip& clip : document.loaded()->clips) {
        clips.append(Text::tr("%1, %2 s").arg(shown(clip.name), models::fixed(clip.duration(), 2)));
      }
    }
    return clips.isEmpty() ? unknown() : clips.join(u'\n');
  });
  form.fact({"sites", Text::tr("Interior sites")}, [&document] {
    return document.loaded() == nullptr ? unknown()
                                        : Text::tr("%1, %2 mm apart")
                                              .arg(models::grouped(document.loaded()->body->sites().size()),
                                                   readable(1000.0 * document.study().siteSpacing, 1));
  });
  addLookRows(form, "body");
}

void fillRegion(PropertyForm& form, const std::string& name) {
  StudyDocument& document = form.document();
  form.section(Text::tr("Body region"));
  form.fact({"name", Text::tr("Name")}, [name] { return shown(name); });
  form.fact({"area", Text::tr("Area at rest")}, [&document, name] {
    return document.loaded() == nullptr ? unknown() : areaText(regionArea(document, name));
  });
}

}  // namespace lorica::panels
