#include <cmath>
#include <nlohmann/json.hpp>

#include "human_files.h"
#include "lorica/geometry/measures.h"
#include "lorica/manikin/body_measures.h"
#include "lorica/study/provenance.h"

namespace lorica::cli {

namespace {

using Json = nlohmann::ordered_json;

/// No more digits than a reader can use.
double rounded(double value, int decimals) {
  const double scale = std::pow(10.0, decimals);
  return std::round(value * scale) / scale + 0.0;  // no -0
}

/// Null where nothing was wanted.
Json orNull(double target, double scale, int decimals) {
  return target > 0.0 ? Json(rounded(scale * target, decimals)) : Json(nullptr);
}

Json differencePct(double value, double target) {
  return target > 0.0 ? Json(rounded(100.0 * (value / target - 1.0), 2)) : Json(nullptr);
}

Json personFacts(const human::Person& person) {
  return {{"sex", person.sex == human::Sex::male ? "male" : "female"},
          {"stature_m", rounded(person.stature, 4)},
          {"mass_kg", rounded(person.mass, 2)}};
}

Json bodyFacts(const manikin::Human& human) {
  Json clips = Json::array();
  for (const human::Clip& clip : human.clips) {
    clips.push_back({{"name", clip.name}, {"duration_s", rounded(clip.duration(), 3)}});
  }
  return {{"file", "body.glb"},
          {"triangles", human.body.skin.triangles.size()},
          {"joints", human.body.skeleton.size()},
          {"clips", std::move(clips)}};
}

Json dimensionFacts(const manikin::Body& body) {
  Json facts = Json::array();
  for (const manikin::BodyMeasure& measure : manikin::measureBody(body)) {
    facts.push_back({{"name", measure.name},
                     {"measured_m", rounded(measure.value, 4)},
                     {"target_m", rounded(measure.target, 4)},
                     {"difference_pct", differencePct(measure.value, measure.target)},
                     {"survey_dimension", measure.dimension},
                     {"source", measure.source}});
  }
  return facts;
}

Json massFacts(const manikin::Body& body) {
  const double mass = manikin::measuredMass(body);
  return {{"measured_kg", rounded(mass, 2)},
          {"target_kg", rounded(body.person.mass, 2)},
          {"difference_pct", differencePct(mass, body.person.mass)},
          {"volume_m3", rounded(geometry::signedVolume(body.skin), 6)},
          {"lung_air_m3", rounded(manikin::lungAir(body.person), 6)},
          {"density_kg_m3", rounded(manikin::meanDensity(body.person.sex), 1)},
          {"method",
           "(volume inside the skin - air in the lungs) x mean density of the body without that air; the air is the "
           "reference adult's lung volume less its tissue, with the cube of stature"},
          {"source", "ICRP publication 89 (mean density, lung volume and mass of the reference adult)"}};
}

Json organFacts(const std::vector<manikin::Organ>& organs) {
  Json facts = Json::array();
  for (const manikin::Organ& organ : organs) {
    const double volume = geometry::signedVolume(organ.mesh);
    facts.push_back({{"name", organ.name},
                     {"file", "organs/" + organ.name + ".glb"},
                     {"volume_cm3", rounded(1e6 * volume, 3)},
                     {"target_cm3", orNull(organ.targetVolume, 1e6, 3)},
                     {"difference_pct", differencePct(volume, organ.targetVolume)},
                     {"density_kg_m3", orNull(organ.density, 1.0, 1)},
                     {"mass_kg", orNull(organ.density * volume, 1.0, 5)},
                     {"source", organ.source}});
  }
  return facts;
}

Json pieceFacts(const manikin::ArmorPiece& piece, const std::string& system) {
  return {{"name", piece.name},
          {"file", "armor/" + system + "/" + piece.name + ".glb"},
          {"material", piece.material},
          {"carriage", piece.carriage == armor::Carriage::skinned ? "skinned" : "rigid"},
          {"protecting", piece.protecting},
          {"areal_density_kg_m2", rounded(piece.arealDensity, 3)},
          {"area_m2", rounded(piece.area, 5)},
          {"mass_kg", rounded(piece.mass, 4)},
          {"source", piece.source}};
}

Json armorFacts(const std::vector<manikin::ArmorSystem>& systems) {
  Json facts = Json::array();
  for (const manikin::ArmorSystem& system : systems) {
    Json pieces = Json::array();
    double mass = 0.0;
    double protecting = 0.0;
    for (const manikin::ArmorPiece& piece : system.pieces) {
      pieces.push_back(pieceFacts(piece, system.name));
      mass += piece.mass;
      protecting += piece.protecting ? piece.mass : 0.0;
    }
    facts.push_back({{"system", system.name},
                     {"mass_kg", rounded(mass, 3)},
                     {"protecting_mass_kg", rounded(protecting, 3)},
                     {"pieces", std::move(pieces)}});
  }
  return facts;
}

}  // namespace

std::string humanFacts(const manikin::Human& human) {
  const Json facts{{"lorica_version", study::version()},
                   {"person", personFacts(human.body.person)},
                   {"frame", "metres, y up, the person faces +z, x to the person's left, soles at y = 0, A-pose"},
                   {"body", bodyFacts(human)},
                   {"dimensions", dimensionFacts(human.body)},
                   {"mass", massFacts(human.body)},
                   {"organs", organFacts(human.organs)},
                   {"armor", armorFacts(human.systems)}};
  return facts.dump(2) + "\n";
}

}  // namespace lorica::cli
