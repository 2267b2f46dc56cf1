#pragma once

#include <gtest/gtest.h>

#include "lorica/manikin/human.h"

namespace lorica::manikin::test {

/// Equal to the bit.
inline void expectSame(const Human& a, const Human& b) {
  EXPECT_EQ(a.body.person, b.body.person);
  EXPECT_TRUE(a.body.skin.positions == b.body.skin.positions);
  EXPECT_TRUE(a.body.skin.triangles == b.body.skin.triangles);
  EXPECT_TRUE(a.body.weights.weights == b.body.weights.weights);
  ASSERT_EQ(a.body.skeleton.size(), b.body.skeleton.size());
  ASSERT_EQ(a.organs.size(), b.organs.size());
  for (std::size_t o = 0; o < a.organs.size(); ++o) {
    EXPECT_EQ(a.organs[o].name, b.organs[o].name);
    EXPECT_TRUE(a.organs[o].mesh.positions == b.organs[o].mesh.positions) << a.organs[o].name;
  }
  ASSERT_EQ(a.systems.size(), b.systems.size());
  for (std::size_t s = 0; s < a.systems.size(); ++s) {
    ASSERT_EQ(a.systems[s].pieces.size(), b.systems[s].pieces.size());
    for (std::size_t p = 0; p < a.systems[s].pieces.size(); ++p) {
      EXPECT_TRUE(a.systems[s].pieces[p].mesh.positions == b.systems[s].pieces[p].mesh.positions);
      EXPECT_EQ(a.systems[s].pieces[p].protecting, b.systems[s].pieces[p].protecting);
      EXPECT_EQ(a.systems[s].pieces[p].carriedAt, b.systems[s].pieces[p].carriedAt);
    }
  }
  ASSERT_EQ(a.clips.size(), b.clips.size());
  EXPECT_EQ(humanBytes(a), humanBytes(b));
}

}  // namespace lorica::manikin::test
