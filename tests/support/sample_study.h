// A study with every kind of verdict in it, made up: what reports are tested on.
#pragma once

#include "study/study.h"

namespace pellucid::test {

Study sample_study();

}  // namespace pellucid::test
