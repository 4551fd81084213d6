// What the tests of ChildProcess run: does what the bytes that it receives tell.
#include <chrono>
#include <cstddef>
#include <cstdlib>
#include <thread>
#include <vector>

#include "engine/core/helper_process.h"

namespace {

/// A count of bytes and the bytes come back.
void echo() {
    std::size_t size = 0;
    if (!rowland::receive_from_starter(&size, sizeof size)) return;
    std::vector<char> bytes(size);
    if (!rowland::receive_from_starter(bytes.data(), size)) return;
    rowland::send_to_starter(bytes.data(), size);
}

}  // namespace

int main() {
    rowland::prepare_helper();
    for (char command = 0; rowland::receive_from_starter(&command, 1);) {
        if (command == 'e') echo();
        if (command == 'k') std::abort();
        if (command == 'x') return 3;
        while (command == 'h') std::this_thread::sleep_for(std::chrono::hours(1));
    }
}
