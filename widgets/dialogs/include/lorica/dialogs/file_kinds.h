#pragma once

/// \file
/// What a file is, told by its name and, where that says nothing, by a look into it.

#include <filesystem>
#include <span>
#include <string>
#include <vector>

namespace lorica::dialogs {

/// *.lorica.json, *.json
bool isStudyFile(const std::filesystem::path& file);
/// The kinds of meshes that can be read: glb, gltf, obj, stl, ply, off.
bool isMeshFile(const std::filesystem::path& file);

enum class FileRole { skin, organ, armor, ignore };

/// What each file is likely to hold. Armor and organs are told by their names; the body's skin is a file with a
/// skeleton, else one named like a body, else the only file there is. At most one file is the skin.
/// \param wantsSkin false: there is a body already, and what looks like one is ignored
std::vector<FileRole> guessRoles(std::span<const std::filesystem::path> files, bool wantsSkin);

/// `folder/stem.lorica.json`, with a number where that name is taken on the disk.
std::filesystem::path freeStudyFile(const std::filesystem::path& folder, const std::string& stem);

}  // namespace lorica::dialogs
