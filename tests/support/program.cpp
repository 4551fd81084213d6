#include "tests/support/program.h"

#include <utility>

namespace rowland::test {

Command command(const std::string& program, std::string_view arguments) {
    Command result{program};
    std::string word;
    bool has_word = false;
    bool quoted = false;
    for (const char c : arguments) {
        if (c == '\'') {
            quoted = !quoted;
            has_word = true;
        } else if (quoted || (c != ' ' && c != '\n')) {
            word += c;
            has_word = true;
        } else if (std::exchange(has_word, false)) {
            result.push_back(std::exchange(word, {}));
        }
    }
    if (has_word) result.push_back(word);
    return result;
}

Ended run(const Command& command, const Surroundings& surroundings) {
    return Running(command, surroundings).wait();
}

}  // namespace rowland::test
