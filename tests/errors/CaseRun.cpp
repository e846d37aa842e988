// posix_spawn in a fresh folder, with streams into files beside it and a limit of time.
#include "CaseRun.h"

#include <algorithm>
#include <chrono>
#include <fstream>
#include <map>
#include <regex>
#include <stdexcept>
#include <thread>

#include <fcntl.h>
#include <signal.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include "core/Files.h"

extern char** environ;

namespace crevice::errors {
namespace {

namespace fs = std::filesystem;
using Clock = std::chrono::steady_clock;

constexpr auto kTimeLimit = std::chrono::seconds(60);  // generous: builds with sanitizers run these too

/// A folder that is gone afterwards: `case` inside it is what the program sees, its streams lie beside.
class Workplace {
public:
    explicit Workplace(const Case& c) {
        std::string name = "crevice-error-" + c.area + "-" + c.name + "-" + std::to_string(getpid());
        root_ = fs::canonical(fs::temp_directory_path()) / name;
        fs::remove_all(root_);
        fs::create_directories(folder());
        for (const InputFile& file : c.files) {
            const fs::path path = folder() / file.name;
            fs::create_directories(path.parent_path());
            std::ofstream(path, std::ios::binary) << file.bytes;
        }
    }
    ~Workplace() {
        std::error_code ignored;
        fs::remove_all(root_, ignored);
    }
    Workplace(const Workplace&) = delete;
    Workplace& operator=(const Workplace&) = delete;

    fs::path folder() const { return root_ / "case"; }
    fs::path stream(const char* name) const { return root_ / name; }

    std::map<std::string, std::string> content() const {
        std::map<std::string, std::string> files;
        for (const auto& entry : fs::recursive_directory_iterator(folder()))
            if (entry.is_regular_file())
                files[entry.path().lexically_relative(folder()).string()] = readText(entry.path());
        return files;
    }

private:
    fs::path root_;
};

/// The environment of the tests, but with the assets of this source tree and a cache of our own.
std::vector<std::string> makeEnvironment() {
    std::vector<std::string> variables;
    for (char** entry = environ; *entry; ++entry) {
        const std::string variable = *entry;
        if (!variable.starts_with("CREVICE_DATA_DIR=") && !variable.starts_with("XDG_CACHE_HOME="))
            variables.push_back(variable);
    }
    variables.push_back("CREVICE_DATA_DIR=" CREVICE_TEST_SOURCE_DIR);
    variables.push_back("XDG_CACHE_HOME=" CREVICE_ERROR_CACHE);
    return variables;
}

std::vector<char*> pointersTo(std::vector<std::string>& words) {
    std::vector<char*> pointers;
    for (std::string& word : words) pointers.push_back(word.data());
    pointers.push_back(nullptr);
    return pointers;
}

pid_t spawn(const Case& c, const Workplace& place) {
    std::vector<std::string> words{CREVICE_PROGRAM}, variables = makeEnvironment();
    words.insert(words.end(), c.words.begin(), c.words.end());
    const std::vector<char*> arguments = pointersTo(words), environment = pointersTo(variables);
    constexpr int kCreate = O_CREAT | O_TRUNC | O_WRONLY;
    posix_spawn_file_actions_t actions;
    posix_spawn_file_actions_init(&actions);
    posix_spawn_file_actions_addopen(&actions, STDIN_FILENO, "/dev/null", O_RDONLY, 0);
    posix_spawn_file_actions_addopen(&actions, STDOUT_FILENO, place.stream("out").c_str(), kCreate, 0600);
    posix_spawn_file_actions_addopen(&actions, STDERR_FILENO, place.stream("err").c_str(), kCreate, 0600);
    posix_spawn_file_actions_addchdir_np(&actions, place.folder().c_str());
    pid_t child = -1;
    const int failed = posix_spawn(&child, arguments[0], &actions, nullptr, arguments.data(), environment.data());
    posix_spawn_file_actions_destroy(&actions);
    if (failed != 0) throw std::runtime_error(std::string("cannot start ") + arguments[0]);
    return child;
}

void waitFor(pid_t child, Answer& answer) {
    const Clock::time_point limit = Clock::now() + kTimeLimit;
    int status = 0;
    bool late = false;
    while (waitpid(child, &status, WNOHANG) == 0) {
        if (!late && Clock::now() > limit) {
            late = true;
            kill(child, SIGKILL);
        }
        std::this_thread::sleep_for(std::chrono::milliseconds(1));
    }
    if (WIFEXITED(status)) answer.exitCode = WEXITSTATUS(status);
    answer.end = late                  ? "it did not end in time"
                 : WIFSIGNALED(status) ? "signal " + std::to_string(WTERMSIG(status))
                                       : "exit code " + std::to_string(answer.exitCode);
}

void replaceAll(std::string& text, const std::string& from, const std::string& to) {
    for (std::size_t at = text.find(from); at != std::string::npos; at = text.find(from, at + to.size()))
        text.replace(at, from.size(), to);
}

/// Names of the shipped assets of a kind as messages list them: "crease, default".
std::string listAssets(const char* folder, const std::string& ending) {
    std::vector<std::string> names;
    const fs::path root = fs::path(CREVICE_TEST_SOURCE_DIR) / folder;
    if (!fs::is_directory(root)) return "none";
    for (const auto& entry : fs::recursive_directory_iterator(root)) {
        const std::string name = entry.path().lexically_relative(root).generic_string();
        if (name.ends_with(ending)) names.push_back(name.substr(0, name.size() - ending.size()));
    }
    std::sort(names.begin(), names.end());
    std::string text;
    for (const std::string& name : names) text += (text.empty() ? "" : ", ") + name;
    return text;
}

/// Another effect, or another line in a shipped file, must not change the text of a case.
std::string withoutAssetDetails(std::string text) {
    replaceAll(text, "effects: " + listAssets("effects", ".effect"), "effects: $EFFECTS");
    replaceAll(text, "flow files: " + listAssets("assets/pipelines/flows", ".flow.json"), "flow files: $FLOWS");
    replaceAll(text, "pipelines: " + listAssets("assets/pipelines", ".pipeline.json"), "pipelines: $PIPELINES");
    replaceAll(text, ": " + listAssets("assets/scenes", ".scene.json"), ": $SCENES");
    static const std::regex kPlace("(\\$DATA/[^ :\n]+):[0-9]+(:[0-9]+)?");
    return std::regex_replace(text, kPlace, "$1:LINE:COLUMN");
}

}  // namespace

Answer runCase(const Case& theCase) {
    const Workplace place(theCase);
    const std::map<std::string, std::string> before = place.content();
    Answer answer;
    waitFor(spawn(theCase, place), answer);
    answer.results = readText(place.stream("out"));
    answer.messages = readText(place.stream("err"));
    replaceAll(answer.messages, place.folder().string(), "$CASE");
    replaceAll(answer.messages, CREVICE_TEST_SOURCE_DIR, "$DATA");
    answer.messages = withoutAssetDetails(std::move(answer.messages));
    const std::map<std::string, std::string> after = place.content();
    for (const auto& [name, bytes] : after) {
        const auto known = before.find(name);
        if (known == before.end() || known->second != bytes) answer.newFiles.push_back(name);
    }
    for (const auto& [name, bytes] : before)
        if (!after.contains(name)) answer.newFiles.push_back(name + " (gone)");
    return answer;
}

}  // namespace crevice::errors
