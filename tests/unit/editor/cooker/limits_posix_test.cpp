// The cooker under the limits of POSIX.
#include <gtest/gtest.h>

#include "tests/support/files.h"
#include "tests/support/program.h"

namespace rowland {
namespace {

/// The limits that a shell, a service or a batch system sets bind its children, and cannot be raised again.
TEST(CookedContent, DracoIsDecodedUnderFiniteHardLimits) {
    std::vector<std::string> limits{"ulimit -c 0"};
#if !defined(__SANITIZE_ADDRESS__) && !defined(__SANITIZE_THREAD__)  // their shadow memory takes terabytes of addresses
    limits.emplace_back("ulimit -v 8000000");
#endif
    for (const std::string& limit : limits) {
        const test::Ended ended = test::run({"/bin/sh", "-c", limit + "; exec \"$0\" check \"$1\"", ROWLAND_COOK,
                                             test::content_path("scenes/films.glb").string()});
        EXPECT_EQ(ended.code, 0) << limit << ": " << ended.err;
    }
}

}  // namespace
}  // namespace rowland
