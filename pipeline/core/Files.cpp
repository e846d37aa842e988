// Reads whole files, writes them atomically and names cache entries.
#include "core/Files.h"

#include <bit>
#include <cerrno>
#include <cstdlib>
#include <cstring>
#include <system_error>

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/stat.h>
#include <unistd.h>

#include "core/LimitedFiles.h"
#include "core/Limits.h"

namespace crevice {
namespace {

namespace fs = std::filesystem;

std::string systemReason(int code) { return std::generic_category().message(code); }

/// Closes a file descriptor when it leaves scope.
class OpenFile {
public:
    explicit OpenFile(int descriptor) : descriptor_(descriptor) {}
    OpenFile(const OpenFile&) = delete;
    OpenFile& operator=(const OpenFile&) = delete;
    ~OpenFile() { close(); }
    int get() const { return descriptor_; }
    /// False when the system reports a late write error.
    bool close() {
        const bool closed = descriptor_ < 0 || ::close(descriptor_) == 0;
        descriptor_ = -1;
        return closed;
    }

private:
    int descriptor_;
};

[[noreturn]] void failRead(const fs::path& path, const std::string& reason, std::string help) {
    throw Error(fmt::format("cannot read '{}': {}", path.string(), reason), std::move(help));
}

[[noreturn]] void failTooLarge(const fs::path& path, std::size_t maxBytes, std::string help) {
    failRead(path, fmt::format("it is larger than the {} bytes that are read", maxBytes), std::move(help));
}

/// Appends the file to a string or vector of bytes. `ifTooLarge`: the help then.
template <class Buffer>
Buffer readWhole(const fs::path& path, std::size_t maxBytes, const std::string& ifTooLarge = "use a smaller file") {
    const OpenFile file(::open(path.c_str(), O_RDONLY | O_CLOEXEC));
    if (file.get() < 0) {
        const int code = errno;
        failRead(path, systemReason(code),
                 code == ENOENT ? "check the spelling of the path" : "check the rights of the file");
    }
    struct stat info {};
    if (::fstat(file.get(), &info) != 0) failRead(path, systemReason(errno), {});
    if (S_ISDIR(info.st_mode)) failRead(path, "it is a folder", "name a file inside it");
    const auto expected = static_cast<std::size_t>(std::max<off_t>(info.st_size, 0));
    if (S_ISREG(info.st_mode) && expected > maxBytes) failTooLarge(path, maxBytes, ifTooLarge);

    constexpr std::size_t kStep = std::size_t(1) << 16;
    Buffer content;
    std::size_t filled = 0;
    content.resize(expected + 1);  // one more, so that the end of the file shows without a second growth
    for (;;) {
        if (filled == content.size()) content.resize(content.size() + std::max(kStep, content.size() / 2));
        const ssize_t got = ::read(file.get(), content.data() + filled, content.size() - filled);
        if (got < 0 && errno == EINTR) continue;
        if (got < 0) failRead(path, systemReason(errno), {});
        if (got == 0) break;
        filled += static_cast<std::size_t>(got);
        if (filled > maxBytes) failTooLarge(path, maxBytes, ifTooLarge);
    }
    content.resize(filled);
    return content;
}

[[noreturn]] void failWrite(const fs::path& path, int code) {
    std::string help;
    if (code == ENOENT) help = "make the folder first, or write elsewhere";
    if (code == EACCES || code == EPERM || code == EROFS) help = "choose a folder that may be written";
    if (code == ENOSPC || code == EDQUOT) help = "free some space, or write elsewhere";
    if (code == EFBIG) help = "raise the limit with `ulimit -f`, or write elsewhere";
    if (code == EISDIR) help = "name a file, not a folder";
    throw RenderError(fmt::format("cannot write '{}': {}", path.string(), systemReason(code)), std::move(help));
}

/// Zero, or the system's error number.
int writeAll(int descriptor, std::span<const std::byte> bytes) {
    while (!bytes.empty()) {
        const ssize_t written = ::write(descriptor, bytes.data(), bytes.size());
        if (written < 0 && errno == EINTR) continue;
        if (written < 0) return errno;
        bytes = bytes.subspan(static_cast<std::size_t>(written));
    }
    return 0;
}

/// Devices and pipes cannot be renamed over: /dev/null must stay what it is.
void writeInPlace(const fs::path& path, std::span<const std::byte> bytes) {
    OpenFile file(::open(path.c_str(), O_WRONLY | O_CLOEXEC));
    if (file.get() < 0) failWrite(path, errno);
    if (const int code = writeAll(file.get(), bytes)) failWrite(path, code);
    if (!file.close()) failWrite(path, errno);
}

/// A new file beside `path` that no other process or thread uses.
int openAside(const fs::path& path, fs::path& aside) {
    constexpr int kMaxTries = 10000;
    for (int number = 0; number < kMaxTries; ++number) {
        aside = path.parent_path() / fmt::format(".{}.{}-{}.tmp", path.filename().string(), ::getpid(), number);
        const int descriptor = ::open(aside.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, 0666);
        if (descriptor >= 0) return descriptor;
        if (errno != EEXIST) failWrite(path, errno);
    }
    failWrite(path, EEXIST);
}

void writeAside(const fs::path& path, std::span<const std::byte> bytes) {
    fs::path aside;
    OpenFile file(openAside(path, aside));
    int code = writeAll(file.get(), bytes);
    if (!file.close() && code == 0) code = errno;
    if (code == 0 && ::rename(aside.c_str(), path.c_str()) != 0) code = errno;
    if (code == 0) return;
    ::unlink(aside.c_str());
    failWrite(path, code);
}

/// Finalizer of splitmix64 (Steele, Lea and Flood 2014, constants of Stafford's variant 13): a bijection.
std::uint64_t mix(std::uint64_t x) {
    x = (x ^ (x >> 30)) * 0xbf58476d1ce4e5b9u;
    x = (x ^ (x >> 27)) * 0x94d049bb133111ebu;
    return x ^ (x >> 31);
}

}  // namespace

std::string readText(const fs::path& path, std::size_t maxBytes) { return readWhole<std::string>(path, maxBytes); }

std::vector<std::byte> readBytes(const fs::path& path, std::size_t maxBytes) {
    return readWhole<std::vector<std::byte>>(path, maxBytes);
}

std::vector<std::byte> readBytesWithin(const fs::path& path, std::size_t most) {
    return readWhole<std::vector<std::byte>>(path, most, raiseLimit("file-bytes"));
}

std::string readTextWithin(const fs::path& path, std::size_t most) {
    return readWhole<std::string>(path, most, raiseLimit("file-bytes"));
}

void writeFileAtomically(const fs::path& path, std::span<const std::byte> bytes) {
    std::error_code ignored;
    const fs::file_status status = fs::status(path, ignored);
    if (path.filename().empty() || fs::is_directory(status)) failWrite(path, EISDIR);
    if (fs::exists(status) && !fs::is_regular_file(status)) {
        writeInPlace(path, bytes);
        return;
    }
    // A link keeps pointing where it does: the file behind it is replaced.
    std::error_code failed;
    const fs::path target = fs::exists(status) ? fs::canonical(path, failed) : path;
    writeAside(failed ? path : target, bytes);
}

void writeFileAtomically(const fs::path& path, std::string_view text) {
    writeFileAtomically(path, std::as_bytes(std::span(text.data(), text.size())));
}

std::optional<fs::path> cacheFolder(std::string_view sub) try {
    fs::path base;
    const char* cacheHome = std::getenv("XDG_CACHE_HOME");
    const char* home = std::getenv("HOME");
    if (cacheHome && fs::path(cacheHome).is_absolute()) {
        base = cacheHome;
    } else if (home && fs::path(home).is_absolute()) {
        base = fs::path(home) / ".cache";
    } else {
        return std::nullopt;
    }
    fs::path folder = base / "crevice" / fs::path(sub);
    std::error_code failed;
    fs::create_directories(folder, failed);
    if (!fs::is_directory(folder, failed) || ::access(folder.c_str(), W_OK | X_OK) != 0) return std::nullopt;
    return folder;
} catch (const std::exception&) {
    return std::nullopt;  // a cache is a convenience: without memory or with an odd name there is none
}

/// Two lanes that take in every 64-bit word by different bijections, so that a difference in a word can die in neither.
std::string contentHash(std::string_view bytes) {
    std::uint64_t a = 0x9e3779b97f4a7c15u;
    std::uint64_t b = 0xd1b54a32d192ed03u;
    const auto takeIn = [&](std::uint64_t word) {
        a = mix(a ^ word);
        b = mix(std::rotl(b, 23) + word * 0x9fb21c651e98df25u);
    };
    std::size_t pos = 0;
    for (; pos + sizeof(std::uint64_t) <= bytes.size(); pos += sizeof(std::uint64_t)) {
        std::uint64_t word;
        std::memcpy(&word, bytes.data() + pos, sizeof word);
        takeIn(word);
    }
    std::uint64_t rest = 0;
    if (pos < bytes.size()) std::memcpy(&rest, bytes.data() + pos, bytes.size() - pos);
    takeIn(rest);
    takeIn(bytes.size());
    const std::uint64_t high = mix(a + b);
    const std::uint64_t low = mix(b ^ std::rotl(a, 32));
    return fmt::format("{:016x}{:016x}", high, low);
}

}  // namespace crevice
