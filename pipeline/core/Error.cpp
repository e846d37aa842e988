// Prints problems the way compilers do and collects several of them per run.
#include "core/Error.h"

#include <algorithm>
#include <cassert>
#include <filesystem>
#include <fstream>
#include <optional>

#include <fmt/format.h>

#include "core/Controls.h"

namespace crevice {
namespace {

constexpr int kMaxShownColumns = 160;  // longer source lines (minified JSON) are shown around the caret only

const char* severityName(Severity severity) {
    switch (severity) {
        case Severity::Error:
            return "error";
        case Severity::Warning:
            return "warning";
        case Severity::Note:
        case Severity::Verbose:
            return "note";
    }
    return "error";
}

std::string placePrefix(const SourceLoc& where) {
    if (where.file.empty()) return {};
    if (where.line <= 0) return where.file + ": ";
    if (where.column <= 0) return fmt::format("{}:{}: ", where.file, where.line);
    return fmt::format("{}:{}:{}: ", where.file, where.line, where.column);
}

/// Whether the bytes are as many as the first one promises (RFC 3629, 3).
bool isWholeCodePoint(const std::string& point) {
    const auto lead = static_cast<unsigned char>(point[0]);
    const std::size_t size = lead < 0x80   ? 1
                             : lead < 0xc2 ? 0
                             : lead < 0xe0 ? 2
                             : lead < 0xf0 ? 3
                             : lead < 0xf5 ? 4
                                           : 0;
    return point.size() == size;
}

/// The code points of a line, one string each; bytes that are no UTF-8 are shown as '?'.
std::vector<std::string> codePoints(const std::string& line) {
    std::vector<std::string> points;
    for (const char c : line) {
        const bool continues = (static_cast<unsigned char>(c) & 0xc0) == 0x80;
        if (continues && !points.empty()) {
            points.back() += c;
        } else {
            points.emplace_back(1, c == '\t' ? ' ' : c);
        }
    }
    for (std::string& point : points)
        if (!isWholeCodePoint(point)) point = "?";
    return points;
}

std::optional<std::string> readLine(const SourceLoc& where) {
    std::error_code ignored;
    if (where.file.empty() || where.line <= 0) return std::nullopt;
    if (!std::filesystem::is_regular_file(where.file, ignored)) return std::nullopt;
    std::ifstream in(where.file, std::ios::binary);
    std::string line;
    for (int number = 0; number < where.line; ++number) {
        if (!std::getline(in, line)) return std::nullopt;
    }
    if (where.line == 1 && line.starts_with("\xef\xbb\xbf")) line.erase(0, 3);
    if (!line.empty() && line.back() == '\r') line.pop_back();
    return line;
}

/// The source line and the caret below it, each indented by four spaces; empty when the file cannot be read again.
std::string sourceExcerpt(const SourceLoc& where) {
    const std::optional<std::string> line = readLine(where);
    if (!line) return {};
    const std::vector<std::string> points = codePoints(withoutControls(*line));
    const int width = static_cast<int>(points.size());
    int first = 0;
    if (width > kMaxShownColumns) {
        first = std::clamp(where.column - kMaxShownColumns / 2, 0, width - kMaxShownColumns);
    }
    const int last = std::min(width, first + kMaxShownColumns);
    std::string text = "\n    ";
    if (first > 0) text += "…";
    for (int i = first; i < last; ++i) text += points[static_cast<std::size_t>(i)];
    if (last < width) text += "…";
    if (where.column <= 0 || where.column > width + 1) return text;
    const int indent = where.column - 1 - first + (first > 0 ? 1 : 0);
    const int tildes = std::clamp(where.length - 1, 0, std::max(0, last - where.column));
    text += "\n    " + std::string(static_cast<std::size_t>(indent), ' ') + "^" +
            std::string(static_cast<std::size_t>(tildes), '~');
    return text;
}

std::string headline(const Problem& problem) { return placePrefix(problem.where) + problem.message; }

/// The first error, for what(): warnings that came before it do not explain why we stop.
std::string firstErrorHeadline(const std::vector<Problem>& problems) {
    assert(!problems.empty());
    for (const Problem& problem : problems) {
        if (problem.severity == Severity::Error) return headline(problem);
    }
    return problems.empty() ? std::string("unknown error") : headline(problems.front());
}

Problem makeProblem(Severity severity, SourceLoc where, std::string message, std::string help,
                    std::vector<Remark> remarks = {}) {
    return {severity, std::move(where), std::move(message), std::move(help), std::move(remarks)};
}

}  // namespace

std::string formatProblem(const Problem& problem) {
    std::string text = fmt::format("{}{}: {}", placePrefix(problem.where), severityName(problem.severity),
                                   withoutControls(problem.message));
    text += sourceExcerpt(problem.where);
    for (const Remark& remark : problem.remarks) {
        text += fmt::format("\n{}note: {}", placePrefix(remark.where), withoutControls(remark.message));
    }
    if (!problem.help.empty()) text += "\nhelp: " + withoutControls(problem.help);
    return text;
}

std::string formatError(const Error& error) {
    std::string text;
    for (const Problem& problem : error.problems()) {
        if (!text.empty()) text += '\n';
        text += formatProblem(problem);
    }
    return text;
}

Error::Error(std::vector<Problem> problems)
    : std::runtime_error(firstErrorHeadline(problems)), problems_(std::move(problems)) {}

Error::Error(SourceLoc where, std::string message, std::string help)
    : Error(std::vector<Problem>{makeProblem(Severity::Error, std::move(where), std::move(message), std::move(help))}) {
}

Error::Error(std::string message, std::string help) : Error(SourceLoc{}, std::move(message), std::move(help)) {}

void Problems::error(SourceLoc where, std::string message, std::string help, std::vector<Remark> remarks) {
    if (++errorCount_ > kMaxErrors) return;
    problems_.push_back(
        makeProblem(Severity::Error, std::move(where), std::move(message), std::move(help), std::move(remarks)));
}

void Problems::warning(SourceLoc where, std::string message, std::string help) {
    problems_.push_back(makeProblem(Severity::Warning, std::move(where), std::move(message), std::move(help)));
}

void Problems::verbose(SourceLoc where, std::string message, std::string help) {
    problems_.push_back(makeProblem(Severity::Verbose, std::move(where), std::move(message), std::move(help)));
}

void Problems::note(SourceLoc where, std::string message, std::string help) {
    problems_.push_back(makeProblem(Severity::Note, std::move(where), std::move(message), std::move(help)));
}

void Problems::add(const Error& error) {
    for (const Problem& problem : error.problems()) {
        if (problem.severity == Severity::Error && ++errorCount_ > kMaxErrors) continue;
        problems_.push_back(problem);
    }
}

void Problems::throwIfErrors() const {
    if (!hasErrors()) return;
    std::vector<Problem> thrown = problems_;
    if (errorCount_ > kMaxErrors) {
        const std::size_t more = errorCount_ - kMaxErrors;
        std::string message = fmt::format("{} more error{} not shown", more, more == 1 ? " is" : "s are");
        thrown.push_back(makeProblem(Severity::Note, SourceLoc{}, std::move(message),
                                     "repair those above first: some may follow from them"));
    }
    throw Error(std::move(thrown));
}

}  // namespace crevice
