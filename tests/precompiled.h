// The headers that most tests parse, compiled once.
#pragma once

#include "unilateral/case/read_case.h"
#include "unilateral/precompiled.h"
#include "unilateral/solve.h"

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>
