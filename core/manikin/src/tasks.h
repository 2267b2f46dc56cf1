#pragma once

/// \file
/// The steps of taskClips(): one motion each, as a stance at every share of its duration.

#include <functional>
#include <optional>
#include <string>

#include "figure.h"

namespace lorica::manikin {

struct Task {
  std::string name;
  double duration = 0.0;  ///< s
  double keysPerSecond = 30.0;
  std::function<Stance(const Figure&, double u)> stance;  ///< u from 0 to 1
};

// On both feet, from the tables.
Task toeTouch(const Figure& figure);
Task bellyTwist();
Task lateralTwist();
Task squat();
Task armRaise();
Task sit();
// With a rifle.
Task kneelAim();
Task proneAim(const Figure& figure);
// In a cycle.
Task walk(const Figure& figure);
double walkSpeed(const Figure& figure);

// What the tasks share.

/// Angles of the knees' and hips' way in the plane of walking (degrees, positive: the upper end leans forward), feet
/// where they rest; sets place and the legs' angles.
void standOn(const Figure& figure, Attitude& attitude, double shankLean, double thighLean);
/// Share of the rest posture that is left: 1 at both ends of a task, 0 in its middle 60 %.
double restLeft(double u);
/// What a task says about limbs over what is left of the rest posture.
void addRest(const Figure& figure, Attitude& attitude, double left);
/// Takes the attitude with both feet flat where they rest.
Stance standing(const Figure& figure, const Attitude& attitude);
/// 0 at both ends, 1 from 0.42 to 0.58 of the duration, least jerk between.
double upHoldDown(double u);

struct Aim {
  double weight = 1.0;        ///< 0 leaves the arms as they are
  double supportReach = 0.0;  ///< trigger hand to support hand, m
  /// Radians by which left and right arm are turned about the line from shoulder to wrist; else the elbows hang.
  std::optional<std::array<double, 2>> swivels;
};

/// Lays hands, forearms and elbows to the rifle that the eye looks along.
void aimRifle(const Figure& figure, Stance& stance, const Aim& aim);

/// How an aiming stance leans on both elbows.
struct FloorRest {
  double supportReach = 0.0;        ///< as wanted, or nearer where the support elbow would not reach the floor else
  std::array<double, 2> swivels{};  ///< that lay the elbows on the floor, or as near to it as they come
};
FloorRest restOnElbows(const Figure& figure, const Stance& stance, double supportReach);

}  // namespace lorica::manikin
