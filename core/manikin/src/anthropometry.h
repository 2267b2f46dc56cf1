#pragma once

/// \file
/// Sizes of a person's body from the survey's percentiles (resources/tables/anthropometry.csv: ANSUR II).

#include <string_view>

#include "lorica/human/person.h"

namespace lorica::manikin {

/// What a dimension grows with.
enum class GrowsWith {
  stature,  ///< heights, lengths, hands and feet
  head,     ///< the head: with stature within the survey, not beyond it
  build     ///< girths, breadths and depths: mass for the stature
};

/// Sizes of one person. A dimension lies at the table's percentile that the person has in stature or in mass over
/// stature: the 5th percentile of both has every dimension's 5th percentile, and so on, linear between 5, 50 and 95.
/// Beyond these, where the survey says nothing, lengths go with stature, the head stays, and breadths, depths and
/// girths with the square root of mass over stature, as a body of the same shape does; what grows more slowly up to the
/// 95th percentile (wrist and ankle) goes on as slowly.
class Anthropometry {
 public:
  explicit Anthropometry(const human::Person& person);

  /// Metres. Throws InputError when the table lacks the dimension.
  double size(std::string_view dimension, GrowsWith with) const;

  const human::Person& person() const { return person_; }
  /// -1 at the 5th percentile, 0 at the median, 1 at the 95th.
  double statureScore() const { return statureScore_; }
  double buildScore() const { return buildScore_; }

 private:
  human::Person person_;
  double statureScore_ = 0.0;
  double buildScore_ = 0.0;
  double beyondStature_ = 1.0;  ///< stature over that of the nearer end of the survey's percentiles; 1 within them
  double beyondBuild_ = 1.0;    ///< the same of mass over stature
};

/// The row of anthropometryTable() that has a dimension of a sex. Throws InputError when there is none.
std::size_t surveyRow(human::Sex sex, std::string_view dimension);

/// A dimension of a sex at a score, in metres or kilograms.
double surveyValue(human::Sex sex, std::string_view dimension, double score);

}  // namespace lorica::manikin
