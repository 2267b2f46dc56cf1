#pragma once

/// \file
/// The words of the study file: the keys each object knows and the texts of its choices. Reader, writer and the JSON
/// Schema speak the same ones; a test holds them together.

#include <array>
#include <string_view>
#include <utility>

#include "lorica/study/reserved_names.h"
#include "lorica/study/study.h"

namespace lorica::study {

inline constexpr auto studyKeys = std::to_array<std::string_view>(
    {"lorica_study", "name",      "description", "human",           "motions",  "organs",   "armor",
     "poses",        "run_poses", "sources",     "threats",         "models",   "trials",   "seed",
     "stop",         "overlap",   "analyses",    "site_spacing_mm", "skinning", "deformer", "display"});
inline constexpr auto stopKeys = std::to_array<std::string_view>({"structures", "half_width", "max_trials"});
inline constexpr auto analysesKeys =
    std::to_array<std::string_view>({"compare", "convergence", "directions", "motion", "gaps", "anatomy"});
inline constexpr auto directionsKeys = std::to_array<std::string_view>({"step_deg", "shots"});
inline constexpr auto motionKeys = std::to_array<std::string_view>({"clip", "every", "frames_per_second"});
inline constexpr auto gapsKeys =
    std::to_array<std::string_view>({"structures", "open_share", "min_shots", "radius_mm", "maps"});
inline constexpr auto anatomyKeys = std::to_array<std::string_view>({"draws", "scale", "verified_only", "sd_mm"});
inline constexpr auto overlapKeys = std::to_array<std::string_view>({"policy", "order"});
inline constexpr auto humanKeys = std::to_array<std::string_view>(
    {"file", "sha256", "units", "up", "builtin", "parts", "sex", "stature_m", "mass_kg", "joint_roles"});
inline constexpr auto recordedKeys =
    std::to_array<std::string_view>({"name", "description", "file", "sha256", "up", "in_place", "joint_roles"});
inline constexpr auto organKeys = std::to_array<std::string_view>(
    {"name", "description", "file", "sha256", "units", "up", "builtin", "parts", "class", "joint", "lattice"});
inline constexpr auto latticeKeys = std::to_array<std::string_view>({"layout", "cells", "cell_mm", "prune"});
inline constexpr auto systemKeys = std::to_array<std::string_view>({"name", "description", "pieces"});
inline constexpr auto pieceKeys =
    std::to_array<std::string_view>({"name", "description", "file", "sha256", "units", "up", "builtin", "parts",
                                     "carriage", "non_protecting", "areal_density_kg_m2", "material"});
inline constexpr auto poseKeys =
    std::to_array<std::string_view>({"name", "description", "clip", "seconds", "turns", "root_offset"});
inline constexpr auto turnKeys = std::to_array<std::string_view>({"joint", "degrees"});
inline constexpr auto sourceKeys = std::to_array<std::string_view>(
    {"name", "description", "type", "position", "target", "target_structure", "sampler", "width_m", "height_m",
     "radius_m", "azimuth_deg", "elevation_deg", "sequence", "cell_mm", "file", "sha256", "shots"});
inline constexpr auto threatKeys = std::to_array<std::string_view>(
    {"name", "description", "file", "sha256", "units", "up", "time_units", "attribute", "builtin", "tnt_kg", "position",
     "threshold", "reach_mm", "time_offset_ms", "offset", "turn_deg", "display"});
inline constexpr auto threatDisplayKeys = std::to_array<std::string_view>({"visible", "range"});
inline constexpr auto displayKeys = std::to_array<std::string_view>({"structure", "visible", "colour", "opacity"});

using shotline::OverlapPolicy;

/// The builtin of threat data.
inline constexpr auto blastBuiltin = "blast";

template <class Value>
using Word = std::pair<std::string_view, Value>;

inline constexpr auto sexWords =
    std::to_array<Word<human::Sex>>({{"male", human::Sex::male}, {"female", human::Sex::female}});
inline constexpr auto layoutWords =
    std::to_array<Word<LatticeSettings::Layout>>({{"bounding_box", LatticeSettings::Layout::boundingBox},
                                                  {"uniform", LatticeSettings::Layout::uniform},
                                                  {"per_axis", LatticeSettings::Layout::perAxis},
                                                  {"cell_size", LatticeSettings::Layout::cellSize}});
inline constexpr auto carriageWords =
    std::to_array<Word<Carriage>>({{"rigid", Carriage::rigid}, {"skinned", Carriage::skinned}});
inline constexpr auto samplerWords = std::to_array<Word<Sampler>>(
    {{"cone", Sampler::cone}, {"rectangle", Sampler::rectangle}, {"disk", Sampler::disk}, {"thesis", Sampler::thesis}});
inline constexpr auto sequenceWords =
    std::to_array<Word<Sequence>>({{"random", Sequence::random}, {"sobol", Sequence::sobol}, {"grid", Sequence::grid}});
inline constexpr auto overlapWords = std::to_array<Word<OverlapPolicy>>({{"all_claim", OverlapPolicy::allClaim},
                                                                         {"outermost", OverlapPolicy::outermost},
                                                                         {"priority", OverlapPolicy::priority}});
inline constexpr auto modelWords = std::to_array<Word<OrganModel>>({{"static_joint", OrganModel::staticJoint},
                                                                    {"static_skin", OrganModel::staticSkin},
                                                                    {"dynamic_thesis", OrganModel::dynamicThesis},
                                                                    {"dynamic", OrganModel::dynamic}});
inline constexpr auto skinningWords =
    std::to_array<Word<Skinning>>({{"rotation_centres", Skinning::rotationCentres}, {"linear", Skinning::linear}});
inline constexpr auto deformerWords =
    std::to_array<Word<Deformer>>({{"soft_body", Deformer::softBody}, {"lattice", Deformer::lattice}});
inline constexpr auto unitWords = std::to_array<Word<base::LengthUnit>>({{"m", base::LengthUnit::metre},
                                                                         {"cm", base::LengthUnit::centimetre},
                                                                         {"mm", base::LengthUnit::millimetre},
                                                                         {"in", base::LengthUnit::inch}});
inline constexpr auto timeUnitWords = std::to_array<Word<TimeUnit>>(
    {{"s", TimeUnit::second}, {"ms", TimeUnit::millisecond}, {"us", TimeUnit::microsecond}});
inline constexpr auto upWords = std::to_array<Word<char>>({{"y", 'y'}, {"z", 'z'}});
inline constexpr auto classWords =
    std::to_array<Word<std::string_view>>({{"essential", "essential"}, {"desirable", "desirable"}});
inline constexpr auto sourceTypeWords = std::to_array<Word<SourceType>>({{"point", SourceType::point},
                                                                         {"parallel", SourceType::parallel},
                                                                         {"band", SourceType::band},
                                                                         {"sphere", SourceType::sphere},
                                                                         {"list", SourceType::list}});

/// The text of a choice. \pre the value is in the table
template <class Value, std::size_t N>
std::string_view wordFor(const Value& value, const std::array<Word<Value>, N>& table) {
  for (const auto& [word, known] : table) {
    if (known == value) {
      return word;
    }
  }
  return table.front().first;
}

}  // namespace lorica::study
