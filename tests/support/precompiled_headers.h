#pragma once

// For the compiler alone (tests/support/CMakeLists.txt): a test still includes what it uses, unless the header that it
// tests or its fixture's does. More headers here would make a test that does not need them slower to compile than
// without this file: measured with json.hpp.

#include <gtest/gtest.h>

#include <filesystem>
#include <string>
#include <vector>
