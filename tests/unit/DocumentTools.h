// What the tests of JSON and YAML share: the one problem of a text that must not parse, and where it is.
#pragma once

#include <string>

#include <gtest/gtest.h>

#include "core/Document.h"

namespace crevice::test {

/// A text that is no document, and what is said of it.
struct SyntaxCase {
    const char* text;
    int line;
    int column;
    const char* message;
};

/// The only problem of `parse(text)`, which has to come with help and to name the file, "doc.json" or "doc.yaml".
template <class Parse>
Problem onlyProblem(const std::string& text, Parse parse) {
    try {
        const Value value = parse(text);
        ADD_FAILURE() << "accepted: " << text << " as " << value.toJson(-1);
    } catch (const Error& error) {
        EXPECT_EQ(error.problems().size(), 1u);
        EXPECT_FALSE(error.problems().front().help.empty()) << error.what();
        EXPECT_TRUE(error.problems().front().where.file.starts_with("doc.")) << error.what();
        return error.problems().front();
    }
    return {};
}

inline void expectPlace(const SourceLoc& where, int line, int column, int length) {
    EXPECT_EQ(where.line, line);
    EXPECT_EQ(where.column, column);
    EXPECT_EQ(where.length, length);
}

inline void expectExplained(const Problem& problem, const SyntaxCase& expected) {
    EXPECT_EQ(problem.message, expected.message);
    EXPECT_EQ(problem.where.line, expected.line) << expected.text;
    EXPECT_EQ(problem.where.column, expected.column) << expected.text;
}

}  // namespace crevice::test
