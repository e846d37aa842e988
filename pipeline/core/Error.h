// Errors with a place, the offending names and what to do; the only way Crevice reports bad input.
#pragma once

#include <cstddef>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

namespace crevice {

/// A place in an input. Lines and columns count from 1; 0 = unknown. `length` is the width of the caret underline.
struct SourceLoc {
    std::string file;
    int line = 0;
    int column = 0;
    int length = 1;
};

enum class Severity { Error, Warning, Note, Verbose };

/// A secondary remark of a problem: where the other half of a clash stands.
struct Remark {
    SourceLoc where;
    std::string message;
};

/// One thing wrong with an input.
struct Problem {
    Severity severity = Severity::Error;
    SourceLoc where;
    std::string message;  ///< What is wrong, names in single quotes, no final full stop.
    std::string help;     ///< What to do; empty = nothing better than the message.
    std::vector<Remark> remarks{};
};

/// `file:line:col: error: message`, the source line with a caret (re-read from the file where it exists), remarks as
/// `note:`, `help:`. Ends without a newline.
std::string formatProblem(const Problem& problem);

/// Bad input or environment: one or more problems. The program exits with 2.
class Error : public std::runtime_error {
public:
    explicit Error(std::vector<Problem> problems);
    Error(SourceLoc where, std::string message, std::string help = {});
    /// An error without a place, such as a missing driver.
    explicit Error(std::string message, std::string help = {});

    const std::vector<Problem>& problems() const { return problems_; }

private:
    std::vector<Problem> problems_;
};

/// The input was fine and the work failed while it ran (a Vulkan call, a full disk). The program exits with 1.
class RenderError : public Error {
public:
    using Error::Error;
};

/// Collects problems while an asset is read, so that several mistakes are reported in one run.
class Problems {
public:
    static constexpr std::size_t kMaxErrors = 20;

    void error(SourceLoc where, std::string message, std::string help = {}, std::vector<Remark> remarks = {});
    void warning(SourceLoc where, std::string message, std::string help = {});
    void note(SourceLoc where, std::string message, std::string help = {});
    /// A note that is said only when asked for details.
    void verbose(SourceLoc where, std::string message, std::string help = {});
    /// Takes over the problems of an exception caught below.
    void add(const Error& error);

    bool hasErrors() const { return errorCount_ > 0; }
    const std::vector<Problem>& all() const { return problems_; }
    /// Throws an Error with everything collected (at most kMaxErrors errors, then a line with the number left out).
    void throwIfErrors() const;

private:
    std::vector<Problem> problems_;
    std::size_t errorCount_ = 0;
};

/// The message of an Error as the program prints it: every problem formatted, one after the other.
std::string formatError(const Error& error);

}  // namespace crevice
