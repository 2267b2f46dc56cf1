#include "lorica/manikin/body.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "body_fit.h"
#include "body_mesh.h"
#include "body_weights.h"
#include "lorica/base/error.h"

namespace lorica::manikin {

namespace {

/// Quantile of the standard normal distribution (Acklam's rational approximation, relative error below 1.2e-9).
double normalQuantile(double share) {
  constexpr std::array a{-3.969683028665376e+01, 2.209460984245205e+02,  -2.759285104469687e+02,
                         1.383577518672690e+02,  -3.066479806614716e+01, 2.506628277459239e+00};
  constexpr std::array b{-5.447609879822406e+01, 1.615858368580409e+02, -1.556989798598866e+02, 6.680131188771972e+01,
                         -1.328068155288572e+01};
  constexpr std::array c{-7.784894002430293e-03, -3.223964580411365e-01, -2.400758277161838e+00,
                         -2.549732539343734e+00, 4.374664141464968e+00,  2.938163982698783e+00};
  constexpr std::array d{7.784695709041462e-03, 3.224671290700398e-01, 2.445134137142996e+00, 3.754408661907416e+00};
  if (share > 0.5) {
    return -normalQuantile(1.0 - share);
  }
  if (share < 0.02425) {
    const double q = std::sqrt(-2.0 * std::log(share));
    return (((((c[0] * q + c[1]) * q + c[2]) * q + c[3]) * q + c[4]) * q + c[5]) /
           ((((d[0] * q + d[1]) * q + d[2]) * q + d[3]) * q + 1.0);
  }
  const double q = share - 0.5;
  const double r = q * q;
  return (((((a[0] * r + a[1]) * r + a[2]) * r + a[3]) * r + a[4]) * r + a[5]) * q /
         (((((b[0] * r + b[1]) * r + b[2]) * r + b[3]) * r + b[4]) * r + 1.0);
}

}  // namespace

void checkPerson(const human::Person& person, const PersonLimits& limits) {
  if (!(person.stature >= limits.leastStature && person.stature <= limits.greatestStature)) {
    throw base::InputError("", "stature",
                           fmt::format("expected {:.2f} to {:.2f} m, found {:.4g} m", limits.leastStature,
                                       limits.greatestStature, person.stature));
  }
  const double perBmi = person.stature * person.stature;
  const double least = limits.leastBmi * perBmi;
  const double greatest = limits.greatestBmi * perBmi;
  if (!(person.mass >= least && person.mass <= greatest)) {
    throw base::InputError("", "mass",
                           fmt::format("expected {:.0f} to {:.0f} kg for a stature of {:.2f} m, found {:.4g} kg",
                                       std::ceil(least), std::floor(greatest), person.stature, person.mass));
  }
}

human::Person personAtPercentile(human::Sex sex, double percentile) {
  LORICA_CHECK(percentile > 0.0 && percentile < 100.0, "a percentile lies between 0 and 100");
  constexpr double scoreOf95 = 1.6448536269514722;
  const double score = normalQuantile(percentile / 100.0) / scoreOf95;
  return {sex, surveyValue(sex, "stature", score), surveyValue(sex, "weightkg", score)};
}

Body makeBody(const human::Person& person, base::Threads threads) {
  checkPerson(person);
  const Anthropometry sizes(person);
  const BodyJoints joints = bodyJoints(sizes);
  const BodyField field(sizes, joints, fitBody(sizes, joints, threads));
  Body body;
  body.person = person;
  body.skin = skinMesh(sizes, joints, field, threads);
  body.weights = bodyWeights(body.skin, sizes, joints, field, threads);
  body.skeleton = bodySkeleton(joints);
  return body;
}

}  // namespace lorica::manikin
