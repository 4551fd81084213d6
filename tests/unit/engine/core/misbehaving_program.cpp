// What the tests of ChildProcess run: does what the bytes on its socket tell.
#include <unistd.h>

#include <csignal>
#include <cstddef>
#include <vector>

namespace {

/// False at the end of the input.
bool take(char* data, std::size_t size) {
    for (std::size_t done = 0; done < size;) {
        const ssize_t count = read(STDIN_FILENO, data + done, size - done);
        if (count <= 0) return false;
        done += static_cast<std::size_t>(count);
    }
    return true;
}

/// A count of bytes and the bytes come back.
void echo() {
    std::size_t size = 0;
    if (!take(reinterpret_cast<char*>(&size), sizeof size)) return;
    std::vector<char> bytes(size);
    if (!take(bytes.data(), size)) return;
    for (std::size_t done = 0; done < size;) {
        const ssize_t count = write(STDIN_FILENO, bytes.data() + done, size - done);
        if (count <= 0) return;
        done += static_cast<std::size_t>(count);
    }
}

}  // namespace

int main() {
    for (char command = 0; take(&command, 1);) {
        if (command == 'e') echo();
        if (command == 'k') raise(SIGKILL);
        if (command == 'x') return 3;
        if (command == 'h') pause();
    }
}
