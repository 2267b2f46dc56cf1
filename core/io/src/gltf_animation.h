#pragma once

#include <vector>

#include "gltf_skin.h"

namespace lorica::io {

/// The animations as clips on the rig's joints. Channels on anything else are noted and left out, and so are
/// animations without a channel on a joint.
/// \throw base::InputError naming the animation and its channel
std::vector<human::Clip> readClips(const tinygltf::Model& model, const Rig& rig, Reading& reading);

}  // namespace lorica::io
