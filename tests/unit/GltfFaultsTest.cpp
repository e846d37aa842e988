// Every fault that Khronos' validator has a code for is answered: refused, told, or passed over, as the case says.
#include <charconv>
#include <set>

#include "GltfFaultCases.h"
#include "GltfTestTools.h"

namespace crevice {
namespace {

using test::Answer;
using test::contains;
using test::Everything;
using test::FaultCase;
using test::Listener;
using test::TempFolder;

/// Puts `json` at "accessors.0.count"; takes the entry away when it is empty.
void edit(Value& document, const std::string& path, const std::string& json) {
    Value* at = &document;
    std::size_t begin = 0;
    for (;;) {
        const std::size_t dot = path.find('.', begin);
        const std::string key = path.substr(begin, dot - begin);
        const bool isLast = dot == std::string::npos;
        if (at->isArray()) {
            const std::size_t index = std::stoul(key);
            if (isLast && index == at->items().size()) at->items().emplace_back();
            ASSERT_LT(index, at->items().size()) << path;
            if (isLast && json.empty()) {
                at->items().erase(at->items().begin() + std::ptrdiff_t(index));
                return;
            }
            at = &at->items()[index];
        } else {
            ASSERT_TRUE(at->isObject()) << path;
            if (isLast && json.empty()) return at->erase(key);
            if (!at->find(key)) at->set(key, Value::makeObject());
            at = at->find(key);
        }
        if (isLast) break;
        begin = dot + 1;
    }
    *at = parseJson(json, "edit");
}

std::string makeText(const FaultCase& fault) {
    Everything whole;
    Value document = parseJson(whole.json, "everything");
    for (const auto& [path, json] : fault.edits) edit(document, path, json);
    for (const auto& [at, bytes] : fault.data)
        std::memcpy(whole.bytes.data() + at, bytes.data(),
                    std::min(bytes.size(), whole.bytes.size() - std::size_t(at)));
    std::string text = document.toJson();
    const std::string mark = "@bytes";
    if (const std::size_t at = text.find(mark); at != std::string::npos)
        text.replace(at, mark.size(), "data:application/octet-stream;base64," + test::encodeBase64(whole.bytes));
    return text;
}

struct Outcome {
    std::string told, error;
};

Outcome load(const FaultCase& fault, bool strict) {
    const TempFolder folder;
    Listener listener;
    const auto path = folder.write("t.gltf", makeText(fault));
    const std::string error = test::errorOf([&] { loadGltf(path, {.log = listener.log, .strict = strict}); });
    return {listener.text, error};
}

void expectAnswer(const FaultCase& fault) {
    SCOPED_TRACE(std::string(fault.code) + ": " + fault.says);
    const Outcome mild = load(fault, false), strict = load(fault, true);
    const bool refused = fault.answer == Answer::Refused, isFault = fault.answer == Answer::Fault;
    EXPECT_EQ(mild.error == "no error", !refused) << mild.error;
    EXPECT_EQ(strict.error == "no error", !refused && !isFault) << strict.error;
    const std::string& place = refused ? mild.error : mild.told;
    if (fault.answer == Answer::Silent) {
        EXPECT_EQ(mild.told, "");
        return;
    }
    EXPECT_TRUE(contains(place, fault.says)) << place;
    EXPECT_TRUE(contains(place, "t.gltf")) << "no place: " << place;
    if (isFault) {
        EXPECT_TRUE(contains(strict.error, fault.says)) << strict.error;
        EXPECT_TRUE(contains(strict.error, "t.gltf:")) << "no line: " << strict.error;
    }
}

TEST(GltfFaults, WhatIsRightIsNotTold) {
    const Outcome outcome = load({.code = "", .answer = Answer::Silent, .says = ""}, true);
    EXPECT_EQ(outcome.error, "no error");
    EXPECT_EQ(outcome.told, "");
}

TEST(GltfFaults, TypesRangesAndRequiredProperties) {
    for (const FaultCase& fault : test::schemaFaults()) expectAnswer(fault);
}
TEST(GltfFaults, PropertiesThatContradictEachOther) {
    for (const FaultCase& fault : test::semanticFaults()) expectAnswer(fault);
}
TEST(GltfFaults, ReferencesThatDoNotFit) {
    for (const FaultCase& fault : test::linkFaults()) expectAnswer(fault);
}
TEST(GltfFaults, ValuesThatDoNotFit) {
    for (const FaultCase& fault : test::dataFaults()) expectAnswer(fault);
}

}  // namespace
}  // namespace crevice
