#pragma once

/// \file
/// Studies at random, for properties; shrinks with RapidCheck.

#include <rapidcheck.h>

#include "lorica/study/study.h"

namespace lorica::test {

rc::Gen<study::Study> anyStudy();

}  // namespace lorica::test
