#include "lorica/document/appearance.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <string_view>
namespace lorica::document {

namespace {

constexpr QRgb skinColour = 0xFFD8AC8E;
constexpr double skinOpacity = 0.25;

struct NamedColour {
  std::string_view word;  ///< of the structure's name; with '*' the beginning of one
  QRgb colour;
};

/// The first that fits decides: what is more special stands before what is more general.
constexpr auto organColours = std::to_array<NamedColour>({
    {"vein*", 0xFF3F5FA8},     {"venous*", 0xFF3F5FA8},   {"vena", 0xFF3F5FA8},       {"cava", 0xFF3F5FA8},
    {"portal*", 0xFF3F5FA8},   {"jugular*", 0xFF3F5FA8},  {"arter*", 0xFFD0312D},     {"aort*", 0xFFD0312D},
    {"carotid*", 0xFFD0312D},  {"heart*", 0xFFB3202A},    {"cardiac*", 0xFFB3202A},   {"ventricle*", 0xFFB3202A},
    {"atrium*", 0xFFB3202A},   {"myocard*", 0xFFB3202A},  {"lung*", 0xFFEE9A8B},      {"pulmo*", 0xFFEE9A8B},
    {"gall*", 0xFF5E8C3A},     {"liver*", 0xFF7E3325},    {"hepat*", 0xFF7E3325},     {"stomach*", 0xFFD9906F},
    {"gastric*", 0xFFD9906F},  {"spleen*", 0xFF6C3A78},   {"adrenal*", 0xFFD6A545},   {"kidney*", 0xFF8C4A3C},
    {"renal*", 0xFF8C4A3C},    {"pancrea*", 0xFFE2C08A},  {"large", 0xFFB98272},      {"colon*", 0xFFB98272},
    {"rectum*", 0xFFB98272},   {"cecum*", 0xFFB98272},    {"caecum*", 0xFFB98272},    {"appendix*", 0xFFB98272},
    {"small", 0xFFE6B0A0},     {"intestin*", 0xFFE6B0A0}, {"bowel*", 0xFFE6B0A0},     {"duoden*", 0xFFE6B0A0},
    {"jejun*", 0xFFE6B0A0},    {"ileum*", 0xFFE6B0A0},    {"bladder*", 0xFFE8C93A},   {"urinary*", 0xFFE8C93A},
    {"ureter*", 0xFFE8C93A},   {"brain*", 0xFFE3B5BC},    {"cerebr*", 0xFFE3B5BC},    {"cerebel*", 0xFFD39FA8},
    {"spinal*", 0xFFF2DC7E},   {"cord", 0xFFF2DC7E},      {"nerve*", 0xFFF2DC7E},     {"trachea*", 0xFF9CC3D6},
    {"bronch*", 0xFF9CC3D6},   {"larynx*", 0xFF9CC3D6},   {"esophag*", 0xFFC88A96},   {"oesophag*", 0xFFC88A96},
    {"thyroid*", 0xFFA84E5E},  {"thymus*", 0xFFCFA0A8},   {"diaphragm*", 0xFFA9504B}, {"muscle*", 0xFFA9504B},
    {"eye", 0xFFF4F4F0},       {"eyes", 0xFFF4F4F0},      {"uterus*", 0xFFC9788C},    {"ovar*", 0xFFC9788C},
    {"prostate*", 0xFFC08A7A}, {"test*", 0xFFC08A7A},     {"bone*", 0xFFE8DFC8},      {"rib", 0xFFE8DFC8},
    {"ribs", 0xFFE8DFC8},      {"sternum*", 0xFFE8DFC8},  {"skull*", 0xFFE8DFC8},     {"crani*", 0xFFE8DFC8},
    {"spine*", 0xFFE8DFC8},    {"vertebr*", 0xFFE8DFC8},  {"pelvis*", 0xFFE8DFC8},    {"sacrum*", 0xFFE8DFC8},
    {"femur*", 0xFFE8DFC8},    {"tibia*", 0xFFE8DFC8},    {"fibula*", 0xFFE8DFC8},    {"humerus*", 0xFFE8DFC8},
    {"radius", 0xFFE8DFC8},    {"ulna", 0xFFE8DFC8},      {"clavic*", 0xFFE8DFC8},    {"scapul*", 0xFFE8DFC8},
    {"skelet*", 0xFFE8DFC8},   {"mandib*", 0xFFE8DFC8},
});

/// Okabe and Ito's colours that a colour-blind eye tells apart, without black.
constexpr auto otherColours =
    std::to_array<QRgb>({0xFFE69F00, 0xFF56B4E9, 0xFF009E73, 0xFFF0E442, 0xFF0072B2, 0xFFD55E00, 0xFFCC79A7});

constexpr auto armorColours =
    std::to_array<QRgb>({0xFF6B7350, 0xFF8A9179, 0xFF4E5A45, 0xFFA3A78C, 0xFF5F6B66, 0xFF7D7A55});

/// Lower-case words of "LungLeft", "lung_left" or "Lung left".
std::vector<std::string> wordsOf(const std::string& name) {
  std::vector<std::string> words(1);
  bool afterSmall = false;
  for (const char letter : name) {
    const auto code = static_cast<unsigned char>(letter);
    const bool capital = std::isupper(code) != 0;
    if (!words.back().empty() && (std::isalpha(code) == 0 || (capital && afterSmall))) {
      words.emplace_back();
    }
    if (std::isalpha(code) != 0) {
      words.back() += static_cast<char>(std::tolower(code));
    }
    afterSmall = std::islower(code) != 0;
  }
  return words;
}

bool fits(const std::string& word, std::string_view wanted) {
  return wanted.ends_with('*') ? word.starts_with(wanted.substr(0, wanted.size() - 1)) : word == wanted;
}

QColor organColour(const std::string& name, std::size_t index) {
  const std::vector<std::string> words = wordsOf(name);
  for (const NamedColour& known : organColours) {
    if (std::any_of(words.begin(), words.end(), [&](const std::string& word) { return fits(word, known.word); })) {
      return QColor(known.colour);
    }
  }
  return QColor(otherColours[index % otherColours.size()]);
}

}  // namespace

std::vector<std::string> drawnStructures(const study::Study& study) {
  std::vector<std::string> names{"body"};
  for (const study::Organ& organ : study.organs) {
    names.push_back(organ.name);
  }
  for (const study::ArmorSystem& system : study.systems) {
    for (const study::ArmorPiece& piece : system.pieces) {
      names.push_back(piece.name);
    }
  }
  return names;
}

Appearance defaultAppearance(const study::Study& study, const std::string& structure) {
  for (std::size_t i = 0; i < study.organs.size(); ++i) {
    if (study.organs[i].name == structure) {
      return {true, organColour(structure, i), 1.0};
    }
  }
  for (std::size_t s = 0; s < study.systems.size(); ++s) {
    const std::vector<study::ArmorPiece>& pieces = study.systems[s].pieces;
    for (std::size_t p = 0; p < pieces.size(); ++p) {
      if (pieces[p].name == structure) {
        return {s == 0, QColor(armorColours[(p + s) % armorColours.size()]), 1.0};
      }
    }
  }
  return {true, QColor(skinColour), skinOpacity};
}

Appearance appearanceOf(const study::Study& study, const std::string& structure) {
  Appearance appearance = defaultAppearance(study, structure);
  const auto entry = std::find_if(study.displays.begin(), study.displays.end(),
                                  [&](const study::Display& display) { return display.structure == structure; });
  if (entry != study.displays.end()) {
    appearance.visible = entry->visible;
    if (entry->colour) {
      const auto& [red, green, blue] = *entry->colour;
      appearance.colour = QColor(red, green, blue);
    }
    appearance.opacity = entry->opacity.value_or(appearance.opacity);
  }
  return appearance;
}

}  // namespace lorica::document
