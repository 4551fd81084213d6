// The npm packages: content/web/three/test in a browser, in the copy that `./rowland web` builds, and
// content/web/gltf-transform/test, in the copy that `./rowland test --all` builds.

#include "tests/support/files.h"
#include "tests/support/program.h"

namespace rowland {
namespace {

bool runs(const test::Command& command) {
    return test::run(command).code == 0;
}

TEST(WebPackage, ItsTestsPassInABrowser) {
    const std::filesystem::path package = test::source_path("build/web/three");
    if (!runs({"/usr/bin/env", "npm", "--version"})) GTEST_SKIP() << "needs npm (Debian: nodejs, npm)";
    if (!runs({"/usr/bin/env", "chromium", "--version"})) GTEST_SKIP() << "needs chromium";
    if (!std::filesystem::exists(package / "dist/bake.wasm"))
        GTEST_SKIP() << "needs the built package: ./rowland web --out FOLDER";
    ROWLAND_TEST_DATA(probe, "probes/venice_sunset_256.hdr");
    const std::string data = probe.parent_path().parent_path().string();
    const test::Ended ended = test::run({"/usr/bin/env", "npm", "test"},
                                        {.environment = {{"ROWLAND_TRADE", ROWLAND_TRADE}, {"ROWLAND_DATA", data}},
                                         .folder = package,
                                         .limit = std::chrono::minutes(15)});
    EXPECT_EQ(ended.code, 0) << ended.out << ended.err;
    EXPECT_EQ(ended.out.find("# skipped 1"), std::string::npos) << ended.out;
}

TEST(WebPackage, ThePlugInOfGltfTransformKeepsGratingsAndItsSchemaIsTheParsers) {
    const std::filesystem::path package = test::source_path("build/web/gltf-transform");
    if (!runs({"/usr/bin/env", "npm", "--version"})) GTEST_SKIP() << "needs npm (Debian: nodejs, npm)";
    if (!std::filesystem::exists(package / "dist/index.js")) GTEST_SKIP() << "needs the built package: npm run build";
    const test::Ended ended = test::run(
        {"/usr/bin/env", "npm", "test"},
        {.environment = {{"ROWLAND_TRADE", ROWLAND_TRADE}}, .folder = package, .limit = std::chrono::minutes(2)});
    EXPECT_EQ(ended.code, 0) << ended.out << ended.err;
    EXPECT_NE(ended.out.find("# skipped 0"), std::string::npos) << ended.out;
}

}  // namespace
}  // namespace rowland
