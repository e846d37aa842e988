// Levelled messages to stderr in the manner of compilers; an object that is passed, so that tests can listen.
#pragma once

#include <functional>
#include <string>
#include <string_view>

#include "core/Error.h"

namespace crevice {

enum class LogLevel { Error, Warning, Note, Verbose };

/// Receives messages at or below a level of detail and hands them to a sink (default: stderr), prefixed: `warning: …`.
/// Thread-safe as long as the sink is.
class Log {
public:
    using Sink = std::function<void(LogLevel, std::string_view)>;

    explicit Log(LogLevel detail = LogLevel::Note);
    Log(LogLevel detail, Sink sink);

    void setDetail(LogLevel detail) { detail_ = detail; }
    LogLevel detail() const { return detail_; }

    void write(LogLevel level, std::string_view message) const;
    void error(std::string_view message) const { write(LogLevel::Error, message); }
    void warning(std::string_view message) const { write(LogLevel::Warning, message); }
    void note(std::string_view message) const { write(LogLevel::Note, message); }
    void verbose(std::string_view message) const { write(LogLevel::Verbose, message); }
    /// Warnings and notes that were collected while reading, with their places; errors are thrown instead.
    void write(const Problems& problems) const;

private:
    LogLevel detail_;
    Sink sink_;
};

}  // namespace crevice
