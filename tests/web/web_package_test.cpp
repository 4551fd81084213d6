// The npm packages of content/web, in the copies that `./rowland test --all` builds.

#include "tests/support/files.h"
#include "tests/support/program.h"

namespace rowland {
namespace {

bool runs(const test::Command& command) {
    return test::run(command).code == 0;
}

/// Runs a package's tests; `built`: a file that its build writes.
void expect_tests_pass(const std::string& name, const char* built, std::chrono::minutes limit) {
    const std::filesystem::path package = test::source_path("build/web/" + name);
    if (!runs({"/usr/bin/env", "npm", "--version"})) GTEST_SKIP() << "needs npm (Debian: nodejs, npm)";
    if (!runs({"/usr/bin/env", "chromium", "--version"})) GTEST_SKIP() << "needs chromium";
    if (!std::filesystem::exists(package / built))
        GTEST_SKIP() << "needs the built package: ./rowland test --all builds it";
    ROWLAND_TEST_DATA(probe, "probes/venice_sunset_256.hdr");
    const std::string data = probe.parent_path().parent_path().string();
    const test::Ended ended = test::run(
        {"/usr/bin/env", "npm", "test"},
        {.environment = {{"ROWLAND_TRADE", ROWLAND_TRADE}, {"ROWLAND_COOK", ROWLAND_COOK}, {"ROWLAND_DATA", data}},
         .folder = package,
         .limit = limit});
    EXPECT_EQ(ended.code, 0) << ended.out << ended.err;
    EXPECT_NE(ended.out.find("# skipped 0"), std::string::npos) << ended.out;
}

TEST(WebPackage, ItsTestsPassInABrowser) {
    expect_tests_pass("three", "dist/bake.wasm", std::chrono::minutes(25));
}

TEST(WebPackage, BabylonDrawsWhatThreeAndTheReferenceDraw) {
    expect_tests_pass("babylon", "dist/shared/bake.wasm", std::chrono::minutes(10));
}

TEST(WebPackage, ThePlugInOfGltfTransformKeepsGratingsAndItsSchemaIsTheParsers) {
    expect_tests_pass("gltf-transform", "dist/index.js", std::chrono::minutes(2));
}

}  // namespace
}  // namespace rowland
