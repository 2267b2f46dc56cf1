#pragma once

/// \file
/// The measures of a body that armor is cut by.

#include <vector>

#include "lorica/manikin/body.h"

namespace lorica::manikin {

using geometry::Vec3d;

/// Shares of a skin vertex' weights.
struct BodyShares {
  std::vector<double> arms;  ///< of the shoulder joints and what hangs on them
  std::vector<double> legs;  ///< of the hips and what hangs on them
  std::vector<double> head;  ///< of head_C0C1 and what hangs on it
};

/// Heights and places at rest, metres. Sideways measures are means of both sides; x counts from the midline.
struct ArmorLandmarks {
  double stature = 0.0;
  double midline = 0.0;  ///< x
  Vec3d notch;           ///< skin at the suprasternal notch
  Vec3d nape;            ///< skin over the seventh cervical vertebra
  double neckHalfBreadth = 0.0;
  double chin = 0.0;          ///< lowest y of the head before the neck
  Vec3d shoulder;             ///< glenohumeral joint, left
  Vec3d elbow;                ///< left
  double shoulderTop = 0.0;   ///< y of the skin over the middle of a shoulder strap
  double ridge = 0.0;         ///< z of the shoulder's ridge there
  double strap = 0.0;         ///< |x| of the middle of a shoulder strap
  double armpit = 0.0;        ///< y of the fold below the arm
  double hem = 0.0;           ///< y of a vest's lower edge, above the iliac crest
  double crotch = 0.0;        ///< y
  double hemMiddle = 0.0;     ///< z of the middle of the trunk at the hem
  double armpitMiddle = 0.0;  ///< and at the armpit
  double waistHalf = 0.0;     ///< half the trunk's breadth where it is least between hem and armpit
  double flankHalf = 0.0;     ///< and where it is most between crotch and armpit

  /// z of the plane between front and back at a height.
  double coronal(double y) const;
};

BodyShares bodyShares(const Body& body);

/// \pre the skeleton has the joints of the joint table
ArmorLandmarks armorLandmarks(const Body& body, const BodyShares& shares);

/// The skin without the triangles of the arms; open at the shoulders.
geometry::TriangleMesh withoutArms(const geometry::TriangleMesh& skin, const BodyShares& shares);

}  // namespace lorica::manikin
