#pragma once

#include <gmock/gmock.h>

#include <string>
#include <vector>

#include "engine/core/file.h"
#include "tests/support/expect.h"
#include "tests/support/files.h"

namespace rowland {

class File : public testing::Test {
 protected:
    std::filesystem::path path(const std::string& name) const { return folder_.path() / name; }

    std::vector<std::string> names() const {
        std::vector<std::string> result;
        for (const auto& entry : std::filesystem::directory_iterator(folder_.path()))
            result.push_back(entry.path().filename().string());
        return result;
    }

    test::TemporaryFolder folder_;
};

template <typename Action>
Error thrown_by(const Action& action) {
    try {
        action();
    } catch (const Error& error) {
        return error;
    }
    ADD_FAILURE() << "nothing was thrown";
    return Error({});
}

class Outputs : public testing::Test {
 protected:
    Outputs() { write_file_atomic(path("source.json"), "{}"); }
    std::filesystem::path path(const std::string& name) const { return folder_.path() / name; }
    std::string refusal(const std::vector<Output>& outputs) const {
        const std::vector<std::filesystem::path> inputs{path("source.json")};
        return test::message_of([&] { check_outputs(inputs, outputs); });
    }

    test::TemporaryFolder folder_;
};

}  // namespace rowland
