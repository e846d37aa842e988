// Starts the program in a folder of its own and catches what it says and leaves.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include <gtest/gtest.h>

namespace crevice::cli {

struct Outcome {
    int code = -1;  ///< Exit code; -1 = ended by a signal.
    std::string out, err;
};

/// What the program's stdout or stderr is, besides a pipe that is read.
enum class Stream { Read, ClosedPipe, FullDisk, Terminal };

/// A test with an empty working folder that is gone afterwards.
class CliTest : public testing::Test {
protected:
    void SetUp() override;
    void TearDown() override;

    Outcome run(const std::vector<std::string>& arguments) { return runWith(arguments, Stream::Read, Stream::Read); }
    Outcome runWith(const std::vector<std::string>& arguments, Stream out, Stream err);
    /// One string, split at spaces.
    Outcome run(const std::string& arguments);

    /// Sends SIGTERM as soon as a file appears. Code -1 when that ended the program.
    Outcome runInterrupted(const std::string& arguments);

    /// Kills the program `delayMs` milliseconds after a new file has appeared, or lets it end if none does.
    void runKilled(const std::string& arguments, int delayMs);

    void write(const std::string& name, const std::string& text) const;
    /// Everything in the working folder, hidden files included, sorted, as relative paths.
    std::vector<std::string> files() const;
    std::filesystem::path path(const std::string& name) const { return folder_ / name; }

    /// Runs, expects code 2 (or 1), `message` and `help` on stderr, nothing on stdout and no new file.
    void expectRefused(const std::string& arguments, const std::string& message, const std::string& help, int code = 2);

    static void expectHas(const std::string& text, const std::string& part) {
        EXPECT_NE(text.find(part), std::string::npos) << "'" << part << "' is not in: " << text;
    }

private:
    std::filesystem::path folder_;
};

std::vector<std::string> splitWords(const std::string& text, char separator = ' ');

}  // namespace crevice::cli
