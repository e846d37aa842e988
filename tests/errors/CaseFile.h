// A case: one text file with a mistaken input, the command that reads it and the whole message expected.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace crevice::errors {

/// One `error:` of a message, taken apart.
struct Headline {
    std::string place;    ///< "file:3:7", "file" or empty.
    std::string message;  ///< What follows "error: ".
};

struct InputFile {
    std::string name;
    std::string bytes;
};

/// Headers (`key: value`), then sections that begin with `=== NAME`: input files as they are, `=== hex NAME` as hex
/// digits, and last `=== expected`.
struct Case {
    std::filesystem::path path;
    std::string area, name;           ///< Folder and file stem below cases/.
    std::vector<std::string> causes;  ///< Header `cause`: one id per error, in the order of the message.
    std::vector<std::string> words;   ///< Header `run`: the arguments of crevice, split at spaces; 'one word'.
    std::string place = "column";     ///< Header `place`: column, file (binary and missing files) or none (arguments).
    int exitCode = 2;                 ///< Header `exit`.
    std::vector<InputFile> files;
    std::string expected;

    std::string id() const { return area + "/" + name; }
    std::vector<Headline> headlines() const;
};

/// Throws std::runtime_error that names the file and what is wrong with it.
Case readCase(const std::filesystem::path& path);
/// Every file below cases/, sorted by area and name.
std::vector<Case> readAllCases();
std::vector<std::string> listAreas();
/// Replaces the section `expected` in the case's file.
void writeExpected(const Case& theCase, const std::string& text);

/// The message with its names and numbers taken out: what all errors of one cause share.
std::string messagePattern(const std::string& message);

}  // namespace crevice::errors
