// Case files are read by hand: their syntax must not disturb the syntax errors they hold.
#include "CaseFile.h"

#include <algorithm>
#include <fstream>
#include <regex>
#include <set>
#include <sstream>
#include <stdexcept>

#include "core/Files.h"

namespace crevice::errors {
namespace {

namespace fs = std::filesystem;

constexpr const char* kMarker = "=== ";
constexpr const char* kExpected = "expected";

[[noreturn]] void refuse(const fs::path& path, const std::string& why) {
    throw std::runtime_error(path.string() + ": " + why);
}

std::string trim(const std::string& text) {
    const std::size_t first = text.find_first_not_of(' ');
    if (first == std::string::npos) return {};
    return text.substr(first, text.find_last_not_of(' ') - first + 1);
}

std::vector<std::string> splitAt(const std::string& text, char separator) {
    std::vector<std::string> parts;
    std::istringstream stream(text);
    for (std::string part; std::getline(stream, part, separator);)
        if (!trim(part).empty()) parts.push_back(trim(part));
    return parts;
}

/// Words as a shell would split them; single quotes hold one word together.
std::vector<std::string> splitCommand(const std::string& text) {
    std::vector<std::string> words;
    std::string word;
    bool quoted = false, started = false;
    for (const char c : text) {
        if (c == '\'') {
            quoted = !quoted;
            started = true;
        } else if (c == ' ' && !quoted) {
            if (started) words.push_back(word);
            word.clear();
            started = false;
        } else {
            word += c;
            started = true;
        }
    }
    if (started) words.push_back(word);
    return words;
}

std::string decodeHex(const fs::path& path, const std::string& text) {
    std::string digits, bytes;
    std::copy_if(text.begin(), text.end(), std::back_inserter(digits), [](char c) { return c != ' ' && c != '\n'; });
    if (digits.size() % 2 != 0 || digits.find_first_not_of("0123456789abcdef") != std::string::npos)
        refuse(path, "a hex section holds something else than pairs of hex digits");
    for (std::size_t i = 0; i < digits.size(); i += 2)
        bytes += static_cast<char>(std::stoi(digits.substr(i, 2), nullptr, 16));
    return bytes;
}

void readHeader(Case& c, const std::string& line) {
    const std::size_t colon = line.find(": ");
    if (colon == std::string::npos) refuse(c.path, "'" + line + "' is no header");
    const std::string key = line.substr(0, colon), value = line.substr(colon + 2);
    if (key == "cause") {
        c.causes = splitAt(value, ',');
    } else if (key == "run") {
        c.words = splitCommand(value);
    } else if (key == "exit") {
        c.exitCode = std::stoi(value);
    } else if (key == "place" && (value == "column" || value == "file" || value == "none")) {
        c.place = value;
    } else {
        refuse(c.path, "unknown header '" + line + "'");
    }
}

void addSection(Case& c, const std::string& title, const std::string& body) {
    if (title == kExpected) {
        c.expected = body;
    } else if (title.starts_with("hex ")) {
        c.files.push_back({title.substr(4), decodeHex(c.path, body)});
    } else {
        c.files.push_back({title, body});
    }
}

}  // namespace

Case readCase(const fs::path& path) {
    Case c;
    c.path = path;
    c.area = path.parent_path().filename().string();
    c.name = path.stem().string();
    std::istringstream lines(readText(path));
    std::string title, body;
    bool inHeader = true;
    for (std::string line; std::getline(lines, line);) {
        if (line.starts_with(kMarker)) {
            if (!inHeader) addSection(c, title, body);
            inHeader = false;
            title = line.substr(4);
            body.clear();
        } else if (inHeader) {
            readHeader(c, line);
        } else {
            body += line + "\n";
        }
    }
    if (!inHeader) addSection(c, title, body);
    if (c.causes.empty() || c.words.empty()) refuse(path, "the headers 'cause' and 'run' are needed");
    return c;
}

std::vector<Case> readAllCases() {
    std::vector<Case> cases;
    for (const auto& entry : fs::recursive_directory_iterator(CREVICE_ERROR_CASES)) {
        if (!entry.is_regular_file()) continue;
        if (entry.path().extension() != ".case") refuse(entry.path(), "no case: only .case files live here");
        cases.push_back(readCase(entry.path()));
    }
    std::sort(cases.begin(), cases.end(), [](const Case& a, const Case& b) { return a.id() < b.id(); });
    return cases;
}

std::vector<std::string> listAreas() {
    std::set<std::string> areas;
    for (const auto& entry : fs::directory_iterator(CREVICE_ERROR_CASES))
        if (entry.is_directory()) areas.insert(entry.path().filename().string());
    return {areas.begin(), areas.end()};
}

void writeExpected(const Case& theCase, const std::string& text) {
    std::string whole = readText(theCase.path);
    const std::size_t at = whole.rfind(std::string("\n") + kMarker + kExpected + "\n");
    if (at != std::string::npos) whole.resize(at + 1);
    if (!whole.ends_with('\n')) whole += '\n';
    std::ofstream(theCase.path, std::ios::binary) << whole << kMarker << kExpected << "\n" << text;
}

std::vector<Headline> Case::headlines() const {
    static const std::regex kHeadline("^(?:([^ ].*?): )?error: (.*)$");
    std::vector<Headline> found;
    std::istringstream lines(expected);
    std::smatch match;
    for (std::string line; std::getline(lines, line);)
        if (std::regex_match(line, match, kHeadline)) found.push_back({match[1], match[2]});
    return found;
}

std::string messagePattern(const std::string& message) {
    // A name may hold spaces; its quote opens after a blank or bracket, which an apostrophe never does.
    static const std::regex kName("(^|[ (\\[>])'[^']*'"), kNumber("-?[0-9]+(\\.[0-9]+)?(e[-+]?[0-9]+)?");
    return std::regex_replace(std::regex_replace(message, kName, "$1'…'"), kNumber, "#");
}

}  // namespace crevice::errors
