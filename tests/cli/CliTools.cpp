// posix_spawn with both streams redirected; output is read from files, a terminal's through its other end.
#include "CliTools.h"

#include <algorithm>
#include <array>
#include <fstream>
#include <sstream>

#include <fcntl.h>
#include <signal.h>
#include <spawn.h>
#include <stdlib.h>
#include <sys/wait.h>
#include <unistd.h>

#include "core/Files.h"

extern char** environ;

namespace crevice::cli {
namespace {

namespace fs = std::filesystem;

/// One stream of the child and how to learn what was written to it.
class ChildStream {
public:
    ChildStream(Stream kind, fs::path file) : kind_(kind), file_(std::move(file)) {
        if (kind == Stream::Read) descriptor_ = ::open(file_.c_str(), O_CREAT | O_TRUNC | O_WRONLY | O_CLOEXEC, 0600);
        if (kind == Stream::FullDisk) descriptor_ = ::open("/dev/full", O_WRONLY | O_CLOEXEC);
        if (kind == Stream::ClosedPipe) {
            int ends[2] = {-1, -1};
            EXPECT_EQ(pipe2(ends, O_CLOEXEC), 0);
            ::close(ends[0]);
            descriptor_ = ends[1];
        }
        if (kind == Stream::Terminal) {
            master_ = posix_openpt(O_RDWR | O_NOCTTY | O_CLOEXEC);
            EXPECT_TRUE(master_ >= 0 && grantpt(master_) == 0 && unlockpt(master_) == 0);
            descriptor_ = ::open(ptsname(master_), O_RDWR | O_NOCTTY | O_CLOEXEC);
        }
        EXPECT_GE(descriptor_, 0);
    }
    int descriptor() const { return descriptor_; }
    /// The child has started: only it holds the stream now. A terminal is read until the child ends.
    std::string finish() {
        ::close(descriptor_);
        std::string text;
        std::array<char, 4096> buffer;
        for (ssize_t n; master_ >= 0 && (n = ::read(master_, buffer.data(), buffer.size())) > 0;) {
            text.append(buffer.data(), static_cast<std::size_t>(n));
        }
        if (master_ >= 0) ::close(master_);
        return text;
    }
    /// After the child's end.
    std::string text() const { return kind_ == Stream::Read ? readText(file_) : std::string(); }

private:
    Stream kind_;
    fs::path file_;
    int descriptor_ = -1, master_ = -1;
};

pid_t spawn(const std::vector<std::string>& arguments, const fs::path& folder, int out, int err) {
    posix_spawn_file_actions_t actions;
    posix_spawn_file_actions_init(&actions);
    posix_spawn_file_actions_addopen(&actions, STDIN_FILENO, "/dev/null", O_RDONLY, 0);
    posix_spawn_file_actions_adddup2(&actions, out, STDOUT_FILENO);
    posix_spawn_file_actions_adddup2(&actions, err, STDERR_FILENO);
    posix_spawn_file_actions_addchdir_np(&actions, folder.c_str());
    std::vector<char*> words;
    std::string program = CREVICE_PROGRAM;
    words.push_back(program.data());
    std::vector<std::string> copies = arguments;
    for (std::string& copy : copies) words.push_back(copy.data());
    words.push_back(nullptr);
    pid_t child = -1;
    const int failed = posix_spawn(&child, program.c_str(), &actions, nullptr, words.data(), environ);
    posix_spawn_file_actions_destroy(&actions);
    EXPECT_EQ(failed, 0) << "cannot start " << program;
    return child;
}

}  // namespace

void CliTest::SetUp() {
    const testing::TestInfo* info = testing::UnitTest::GetInstance()->current_test_info();
    std::string name = std::string("crevice-cli-") + info->test_suite_name() + "-" + info->name();
    std::replace(name.begin(), name.end(), '/', '-');
    folder_ = fs::temp_directory_path() / (name + "-" + std::to_string(getpid()));
    fs::remove_all(folder_);
    fs::create_directories(folder_);
    setenv("CREVICE_DATA_DIR", CREVICE_TEST_SOURCE_DIR, 1);
}

void CliTest::TearDown() { fs::remove_all(folder_); }

Outcome CliTest::runWith(const std::vector<std::string>& arguments, Stream out, Stream err) {
    const fs::path base = folder_.parent_path() / (folder_.filename().string() + ".stream");
    ChildStream outStream(out, base.string() + "-out"), errStream(err, base.string() + "-err");
    const pid_t child = spawn(arguments, folder_, outStream.descriptor(), errStream.descriptor());
    Outcome outcome;
    if (child < 0) return outcome;
    outcome.out = outStream.finish();
    outcome.err = errStream.finish();
    int status = 0;
    waitpid(child, &status, 0);
    outcome.code = WIFEXITED(status) ? WEXITSTATUS(status) : -1;
    outcome.out += outStream.text();
    outcome.err += errStream.text();
    fs::remove(base.string() + "-out");
    fs::remove(base.string() + "-err");
    return outcome;
}

Outcome CliTest::run(const std::string& arguments) { return run(splitWords(arguments)); }

Outcome CliTest::runInterrupted(const std::string& arguments) {
    const int null = ::open("/dev/null", O_WRONLY | O_CLOEXEC);
    const pid_t child = spawn(splitWords(arguments), folder_, null, null);
    ::close(null);
    if (child < 0) return {};
    int status = 0;
    pid_t ended = 0;
    while (files().empty() && (ended = waitpid(child, &status, WNOHANG)) == 0) usleep(1000);
    EXPECT_EQ(ended, 0) << "it ended before it wrote anything";
    kill(child, SIGTERM);
    waitpid(child, &status, 0);
    Outcome outcome;
    if (WIFEXITED(status)) outcome.code = WEXITSTATUS(status);
    return outcome;
}

void CliTest::runKilled(const std::string& arguments, int delayMs) {
    const std::size_t before = files().size();
    const int null = ::open("/dev/null", O_WRONLY | O_CLOEXEC);
    const pid_t child = spawn(splitWords(arguments), folder_, null, null);
    ::close(null);
    if (child < 0) return;
    int status = 0;
    pid_t ended = 0;
    while (files().size() == before && (ended = waitpid(child, &status, WNOHANG)) == 0) usleep(500);
    if (ended != 0) return;
    usleep(static_cast<useconds_t>(delayMs) * 1000);
    kill(child, SIGKILL);
    waitpid(child, &status, 0);
}

void CliTest::write(const std::string& name, const std::string& text) const {
    std::ofstream(folder_ / name, std::ios::binary) << text;
}

std::vector<std::string> CliTest::files() const {
    std::vector<std::string> names;
    for (const auto& entry : fs::recursive_directory_iterator(folder_)) {
        if (entry.is_regular_file()) names.push_back(entry.path().lexically_relative(folder_).string());
    }
    std::sort(names.begin(), names.end());
    return names;
}

void CliTest::expectRefused(const std::string& arguments, const std::string& message, const std::string& help,
                            int code) {
    SCOPED_TRACE("crevice " + arguments);
    const std::vector<std::string> before = files();
    const Outcome outcome = run(arguments);
    EXPECT_EQ(outcome.code, code);
    EXPECT_EQ(outcome.out, "");
    EXPECT_NE(outcome.err.find("error: " + message), std::string::npos) << outcome.err;
    EXPECT_NE(outcome.err.find("help: "), std::string::npos) << outcome.err;
    EXPECT_NE(outcome.err.find(help), std::string::npos) << outcome.err;
    EXPECT_EQ(files(), before);
}

std::vector<std::string> splitWords(const std::string& text, char separator) {
    std::vector<std::string> words;
    std::istringstream stream(text);
    for (std::string word; std::getline(stream, word, separator);) {
        if (!word.empty()) words.push_back(word);
    }
    return words;
}

}  // namespace crevice::cli
