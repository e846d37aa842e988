// Faults that a glTF may have, one small file each, with what Crevice answers: named as Khronos' glTF-Validator names
// them (its ISSUES.md), so that a validator's report and ours can be laid side by side. docs/gltf-faults.md lists them.
#pragma once

#include <cstring>
#include <string>
#include <utility>
#include <vector>

namespace crevice::test {

enum class Answer {
    Refused,  ///< An Error: nothing can be drawn rightly.
    Fault,    ///< A warning, and an Error with --strict.
    Told,     ///< A note or warning, with --strict as well.
    Silent    ///< Nothing to say.
};

/// A whole glTF whose every part is right: a skinned, morphed, animated, textured square.
struct Everything {
    std::string json;  ///< Without the bytes: "@bytes" stands for the data URI.
    std::vector<unsigned char> bytes;
    Everything();
};

/// Where the parts of Everything::bytes lie.
enum Part {
    kPositions = 0,
    kNormals = 48,
    kTangents = 96,
    kCoordinates = 160,
    kJoints = 192,
    kWeights = 208,
    kIndices = 272,
    kTimes = 284,
    kMoves = 292,
    kTurns = 316,
    kMorphs = 348,
    kMatrices = 356,
    kTarget = 484,
    kColours = 532,
    kSparse = 596,
    kPicture = 612
};

struct FaultCase {
    const char* code;
    Answer answer;
    const char* says;  ///< Part of the message; empty for Silent.
    /// "accessors.0.count" and its new JSON; empty JSON takes the entry away.
    std::vector<std::pair<std::string, std::string>> edits{};
    /// Bytes put at an offset.
    std::vector<std::pair<int, std::vector<unsigned char>>> data{};
};

template <class T>
std::vector<unsigned char> bytesOf(std::initializer_list<T> values) {
    std::vector<unsigned char> bytes(values.size() * sizeof(T));
    std::memcpy(bytes.data(), values.begin(), bytes.size());
    return bytes;
}

std::vector<FaultCase> schemaFaults();
std::vector<FaultCase> semanticFaults();
std::vector<FaultCase> linkFaults();
std::vector<FaultCase> dataFaults();

}  // namespace crevice::test
