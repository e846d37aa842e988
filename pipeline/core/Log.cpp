// Writes messages with a compiler's prefixes; spdlog does the writing and is seen by this file alone.
#include "core/Log.h"

#include <memory>

#include <spdlog/logger.h>
#include <spdlog/sinks/stdout_sinks.h>

#include "core/Controls.h"

namespace crevice {
namespace {

const char* prefixOf(LogLevel level) {
    switch (level) {
        case LogLevel::Error:
            return "error: ";
        case LogLevel::Warning:
            return "warning: ";
        case LogLevel::Note:
            return "note: ";
        case LogLevel::Verbose:
            return "";
    }
    return "";
}

/// A logger of its own per Log: spdlog's global registry stays out of it.
Log::Sink makeStderrSink() {
    auto logger = std::make_shared<spdlog::logger>("crevice", std::make_shared<spdlog::sinks::stderr_sink_mt>());
    logger->set_pattern("%v");
    logger->set_level(spdlog::level::trace);
    logger->flush_on(spdlog::level::trace);
    return [logger = std::move(logger)](LogLevel level, std::string_view message) {
        logger->log(level == LogLevel::Error ? spdlog::level::err : spdlog::level::info,
                    spdlog::string_view_t(message.data(), message.size()));
    };
}

LogLevel levelOf(Severity severity) {
    switch (severity) {
        case Severity::Error:
            return LogLevel::Error;
        case Severity::Warning:
            return LogLevel::Warning;
        case Severity::Note:
            return LogLevel::Note;
        case Severity::Verbose:
            return LogLevel::Verbose;
    }
    return LogLevel::Error;
}

}  // namespace

Log::Log(LogLevel detail) : Log(detail, makeStderrSink()) {}

Log::Log(LogLevel detail, Sink sink) : detail_(detail), sink_(std::move(sink)) {}

void Log::write(LogLevel level, std::string_view message) const {
    if (level > detail_ || !sink_) return;
    sink_(level, prefixOf(level) + withoutControls(std::string(message)));
}

void Log::write(const Problems& problems) const {
    for (const Problem& problem : problems.all()) {
        const LogLevel level = levelOf(problem.severity);
        const bool wanted = problem.severity != Severity::Error && level <= detail_;  // errors are thrown, not logged
        if (wanted && sink_) sink_(level, formatProblem(problem));
    }
}

}  // namespace crevice
