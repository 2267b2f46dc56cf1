#pragma once

/// \file
/// The steps of plainHuman().

#include <vector>

#include "lorica/manikin/plain_human.h"

namespace lorica::manikin {

human::Skeleton plainSkeleton();
human::SkinWeights plainWeights(const geometry::TriangleMesh& skin);
std::vector<human::Clip> plainClips();
std::vector<PlainOrgan> plainOrgans();

}  // namespace lorica::manikin
