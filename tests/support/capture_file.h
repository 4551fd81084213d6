#pragma once

#include <cstdio>
#include <memory>
#include <stdexcept>
#include <string>

namespace rowland::test {

/// A nameless file that a program's output goes to.
using CaptureFile = std::unique_ptr<std::FILE, int (*)(std::FILE*)>;

inline CaptureFile open_capture() {
    CaptureFile file(std::tmpfile(), std::fclose);
    if (!file) throw std::runtime_error("no temporary file");
    return file;
}

/// Everything in it, from its beginning.
inline std::string content(std::FILE* file) {
    std::rewind(file);
    std::string text;
    for (int c = std::fgetc(file); c != EOF; c = std::fgetc(file)) text += static_cast<char>(c);
    return text;
}

}  // namespace rowland::test
