#pragma once

/// \file
/// The edits of a study, each one undoable step with a name of its own. Numbers are in the study's units (metres).
/// Names that do not exist and values a study cannot hold are the caller's mistake (base::CallerError). Setting what is
/// set already is no step. After every edit the study can be written and read back as it is.

#include <array>
#include <optional>
#include <string>
#include <vector>

#include "lorica/commands/study_command.h"

namespace lorica::commands {

using document::ItemRef;
using document::StudyDocument;

// --- properties -----------------------------------------------------------------------------------------------------

/// Control characters of the name become spaces.
void setStudyName(StudyDocument& document, const std::string& name);
void setStudyDescription(StudyDocument& document, const std::string& text);
/// Of an organ, system, piece, pose or source.
void setDescription(StudyDocument& document, const ItemRef& item, const std::string& text);
/// Whom the built-in human stands for. Pieces of the built-in armor that have the areal density of the program take
/// that for the new person; one that was put in by hand stays. \pre the study is one of the built-in human, and a body
/// can be made for the person (manikin::checkPerson())
void setPerson(StudyDocument& document, const human::Person& person);
/// What the model `dynamic` stands for.
void setDeformer(StudyDocument& document, study::Deformer deformer);
void setModels(StudyDocument& document, const std::vector<viscera::OrganModel>& models);
/// 1 to 100000.
void setTrials(StudyDocument& document, std::uint32_t trials);
void setSeed(StudyDocument& document, std::uint64_t seed);
/// Poses a run computes; empty means rest and all poses of the study.
void setRunPoses(StudyDocument& document, const std::vector<std::string>& poses);

/// Visibility, colour and opacity that are the program's default are not kept in the study.
/// \param structure "body", an organ or a piece
void setVisible(StudyDocument& document, const std::string& structure, bool visible);
/// Shows or hides many in one step. \param text e.g. "Hide organs"
void setAllVisible(StudyDocument& document, const std::vector<std::string>& structures, bool visible,
                   const QString& text);
/// No colour: the program's default.
void setColour(StudyDocument& document, const std::string& structure,
               const std::optional<std::array<std::uint8_t, 3>>& colour);
/// 0 to 1; merges while it is dragged. None: the program's default.
void setOpacity(StudyDocument& document, const std::string& structure, std::optional<double> opacity);

/// "essential", "desirable" or empty.
void setInjuryClass(StudyDocument& document, const std::string& organ, const std::string& injuryClass);
/// The joint that carries static_joint; none: the nearest.
void setJoint(StudyDocument& document, const std::string& organ, const std::optional<std::string>& joint);
/// Only what the layout uses is kept.
void setLattice(StudyDocument& document, const std::string& organ, const study::LatticeSettings& lattice);

void setCarriage(StudyDocument& document, const std::string& piece, study::Carriage carriage);
/// Empty: not given. Control characters become spaces.
void setMaterial(StudyDocument& document, const std::string& piece, const std::string& material);
/// kg/m2, above 0 and up to `densest`; none: not given. Merges while it is dragged.
inline constexpr double densest = 10000.0;
void setArealDensity(StudyDocument& document, const std::string& piece, std::optional<double> density);
void setNonProtecting(StudyDocument& document, const std::string& piece, const std::vector<std::string>& parts);

/// Of a point. Merges while it is dragged. Kept within 99 km of the origin.
void setSourcePosition(StudyDocument& document, const std::string& source, const geometry::Vec3d& position);
/// None: the centre of the posed body. Merges while it is dragged, kept within 99 km of the origin.
void setSourceTarget(StudyDocument& document, const std::string& source, const std::optional<geometry::Vec3d>& target);
/// Per trial, 1 to 1e12; a grid and a list have their own number.
void setSourceShots(StudyDocument& document, const std::string& source, std::uint64_t shots);

// --- structure ------------------------------------------------------------------------------------------------------

/// Adds a source 5 m ahead of the middle of the loaded body, or of where a standing body has it, to the millimetre,
/// named so that it is unique. Selects and returns it.
std::string addSource(StudyDocument& document);
/// Adds the pose CLIP@SECONDS (or any pose) unless the study has it; selects it.
void addPose(StudyDocument& document, const study::Pose& pose);
/// Takes an imported study's content over as one step. \param text e.g. "Add 3 organs"
void replaceStudy(StudyDocument& document, study::Study study, const QString& text);
/// Whether this item can be removed or renamed: organs, systems, pieces, poses but rest, sources.
bool canRemove(const ItemRef& item);
/// Removes an organ, system, piece, pose or source, with what refers to it (displays, run poses, targets of sources,
/// the rule for stopping, the order of overlaps). What followed the program's default visibility goes on to follow it
/// when another system becomes the first.
/// \pre canRemove()
void removeItem(StudyDocument& document, const ItemRef& item);
/// What is wrong with a new name for the item, one sentence; empty when it can be taken.
QString renameTrouble(const StudyDocument& document, const ItemRef& item, const std::string& name);
/// Renames it everywhere it is referred to, and keeps it selected. \pre canRemove(item), no renameTrouble
void renameItem(StudyDocument& document, const ItemRef& item, const std::string& name);

}  // namespace lorica::commands
