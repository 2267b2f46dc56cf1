#include <initializer_list>

#include "armor_sizes.h"
#include "lorica/manikin/armor_systems.h"

namespace lorica::manikin {

namespace {

void addSoft(SystemFacts& system, const SheetSpec& sheet, bool protecting, std::initializer_list<const char*> names) {
  for (const char* name : names) {
    system.pieces.push_back({name, armor::Carriage::skinned, sheet.material, sheet.arealDensity, protecting});
  }
}

void addPlates(SystemFacts& system, const armor::PlateSpec& spec, std::initializer_list<const char*> names) {
  for (const char* name : names) {
    system.pieces.push_back({name, armor::Carriage::rigid, kPlateMaterial, spec.mass / armor::frontalArea(spec), true});
  }
}

SystemFacts joined(std::string name, const SystemFacts& first, const SystemFacts& second) {
  SystemFacts system{std::move(name), first.pieces};
  system.pieces.insert(system.pieces.end(), second.pieces.begin(), second.pieces.end());
  return system;
}

}  // namespace

std::vector<SystemFacts> armorFacts(const human::Person& person) {
  const armor::PlateSpec plate = plateFor(person.sex, person.stature);
  const SheetSpec fabric = carrierFabric();
  SystemFacts vest{"full_torso", {}};
  addSoft(vest, softArmor(), true,
          {"vest_front", "vest_back", "side_left", "side_right", "collar", "shoulder_left", "shoulder_right", "groin"});
  addPlates(vest, plate, {"plate_front", "plate_back"});
  addPlates(vest, sidePlateBeside(plate), {"side_plate_left", "side_plate_right"});
  SystemFacts carrier{"plate_carrier", {}};
  addSoft(carrier, fabric, false, {"carrier_front", "carrier_back", "cummerbund_left", "cummerbund_right"});
  addPlates(carrier, plate, {"plate_front", "plate_back"});
  for (const char* name : {"bag_front", "bag_back"}) {
    carrier.pieces.push_back({name, armor::Carriage::rigid, fabric.material, fabric.arealDensity, false});
  }
  for (const char* name : {"pouch_1", "pouch_2", "pouch_3"}) {
    carrier.pieces.push_back({name, armor::Carriage::rigid, kPouchMaterial, fabric.arealDensity, false});
  }
  const SystemFacts helmet{"helmet", {{"helmet", armor::Carriage::rigid, kHelmetMaterial, std::nullopt, true}}};
  return {vest, carrier, helmet, joined("full_torso_helmet", vest, helmet),
          joined("plate_carrier_helmet", carrier, helmet)};
}

}  // namespace lorica::manikin
