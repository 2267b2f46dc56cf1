#include "lorica/manikin/body.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "body_fit.h"
#include "body_mesh.h"
#include "body_weights.h"
#include "lorica/base/error.h"
#include "lorica/stats/intervals.h"

namespace lorica::manikin {

double PersonLimits::leastBmi(human::Sex sex, double stature) const {
  // Found by making persons: below this, lungs and liver no longer fit beside the heart.
  const bool male = sex == human::Sex::male;
  return 17.0 + (male ? 20.0 : 22.0) * std::max(stature - (male ? 1.75 : 1.70), 0.0);
}

void checkPerson(const human::Person& person, const PersonLimits& limits) {
  if (!(person.stature >= limits.leastStature && person.stature <= limits.greatestStature)) {
    throw base::InputError("", "stature",
                           fmt::format("expected {:.2f} to {:.2f} m, found {:.4g} m", limits.leastStature,
                                       limits.greatestStature, person.stature));
  }
  const double perBmi = person.stature * person.stature;
  // A limit that was rounded once is still within.
  const double least = limits.leastBmi(person.sex, person.stature) * perBmi * (1.0 - 1e-12);
  const double greatest = limits.greatestBmi * perBmi * (1.0 + 1e-12);
  if (!(person.mass >= least && person.mass <= greatest)) {
    throw base::InputError("", "mass",
                           fmt::format("expected {:.0f} to {:.0f} kg for a {} of {:.2f} m, found {:.4g} kg",
                                       std::ceil(least), std::floor(greatest),
                                       person.sex == human::Sex::male ? "man" : "woman", person.stature, person.mass));
  }
}

human::Person personAtPercentile(human::Sex sex, double percentile) {
  LORICA_CHECK(percentile > 0.0 && percentile < 100.0, "a percentile lies between 0 and 100");
  constexpr double scoreOf95 = 1.6448536269514722;
  const double score = stats::normalQuantile(percentile / 100.0) / scoreOf95;
  return {sex, surveyValue(sex, "stature", score), surveyValue(sex, "weightkg", score)};
}

Body makeBody(const human::Person& person, base::Threads threads, const base::Progress& progress) {
  checkPerson(person);
  const Anthropometry sizes(person);
  const BodyJoints joints = bodyJoints(sizes);
  const BodyField field(sizes, joints, fitBody(sizes, joints, threads, progress));
  progress.report(0.2);
  Body body;
  body.person = person;
  body.skin = skinMesh(sizes, joints, field, threads, progress);
  progress.report(0.9);
  body.weights = bodyWeights(body.skin, sizes, joints, field, threads);
  body.skeleton = bodySkeleton(joints);
  return body;
}

}  // namespace lorica::manikin
