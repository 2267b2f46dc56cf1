#include "lorica/manikin/plain_human.h"

#include "body_shape.h"
#include "plain_parts.h"

namespace lorica::manikin {

PlainHuman plainHuman() {
  PlainHuman human;
  human.skin = skinSurface();
  human.weights = plainWeights(human.skin);
  human.skeleton = plainSkeleton();
  human.clips = plainClips();
  human.organs = plainOrgans();
  return human;
}

}  // namespace lorica::manikin
