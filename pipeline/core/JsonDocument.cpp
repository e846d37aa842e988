// Reads JSON: nlohmann-json judges syntax, types and values; a token walk beside it supplies the places.
#include <algorithm>
#include <limits>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "core/Document.h"
#include "core/JsonRepeats.h"
#include "core/JsonSyntax.h"
#include "core/TextPlaces.h"

namespace crevice {
namespace {

/// Members in text order, equal keys side by side.
std::vector<const Member*> sortedByKey(const Value& object) {
    std::vector<const Member*> sorted;
    sorted.reserve(object.members().size());
    for (const Member& member : object.members()) sorted.push_back(&member);
    std::stable_sort(sorted.begin(), sorted.end(), [](auto* a, auto* b) { return a->key < b->key; });
    return sorted;
}

/// Throws at the first key that a finished object holds twice, naming both places.
void checkDuplicateKeys(const Value& object) {
    const std::vector<const Member*> sorted = sortedByKey(object);
    const Member* second = nullptr;
    const Member* first = nullptr;
    for (std::size_t i = 1; i < sorted.size(); ++i) {
        const bool twice = sorted[i - 1]->key == sorted[i]->key;
        if (twice && (!second || sorted[i] < second)) {
            first = sorted[i - 1];
            second = sorted[i];
        }
    }
    if (!second) return;
    Problem problem;
    problem.where = second->keyLoc;
    problem.message = fmt::format("key '{}' stands twice in this object", second->key);
    problem.help = "remove or rename one of the two";
    problem.remarks.push_back({first->keyLoc, fmt::format("'{}' stands here first", first->key)});
    throw Error(std::vector<Problem>{std::move(problem)});
}

/// Of members with the same key the last one stays.
void keepLast(Value& object, const RepeatedKey& tell) {
    const std::vector<const Member*> sorted = sortedByKey(object);
    std::vector<bool> overridden(sorted.size(), false);
    const Member* const first = object.members().data();
    bool any = false;
    for (std::size_t i = 1; i < sorted.size(); ++i) {
        if (sorted[i - 1]->key != sorted[i]->key) continue;
        any = overridden[std::size_t(sorted[i - 1] - first)] = true;
        tell(sorted[i]->key, sorted[i]->keyLoc);
    }
    if (!any) return;
    std::vector<Member> kept;
    for (std::size_t i = 0; i < overridden.size(); ++i)
        if (!overridden[i]) kept.push_back(std::move(object.members()[i]));
    object.members() = std::move(kept);
}

/// Receives the parser's events in text order and builds the tree. Member names are those nlohmann-json prescribes.
class TreeBuilder {
public:
    /// `repeated`: null = repeated keys are errors.
    TreeBuilder(std::string_view text, const TextPlaces& places, const DocumentLimits& limits,
                const RepeatedKey* repeated)
        : text_(text), places_(places), limits_(limits), repeated_(repeated) {
        if (text.starts_with("\xef\xbb\xbf")) state_.end = 3;
    }

    Value takeRoot() { return std::move(root_); }

    bool null() {
        Value value;
        value.setWhere(nextToken());
        return add(std::move(value));
    }
    bool boolean(bool value) { return add(Value::makeBool(value, nextToken())); }
    bool number_integer(std::int64_t value) { return add(Value::makeInteger(value, nextToken())); }
    bool number_unsigned(std::uint64_t value) {
        const bool fits = value <= static_cast<std::uint64_t>(std::numeric_limits<std::int64_t>::max());
        if (fits) return number_integer(static_cast<std::int64_t>(value));
        return add(Value::makeReal(static_cast<double>(value), nextToken()));
    }
    bool number_float(double value, const std::string&) { return add(Value::makeReal(value, nextToken())); }
    bool string(std::string& value) { return add(Value::makeString(std::move(value), nextToken())); }
    bool binary(nlohmann::json::binary_t&) { return false; }  // never sent for text

    bool start_object(std::size_t) { return open(Value::makeObject(nextToken()), JsonState::After::ObjectStart); }
    bool start_array(std::size_t) { return open(Value::makeArray(nextToken()), JsonState::After::ArrayStart); }
    bool end_object() {
        if (repeated_)
            keepLast(*open_.back(), *repeated_);
        else
            checkDuplicateKeys(*open_.back());
        return close();
    }
    bool end_array() { return close(); }
    bool key(std::string& name) {
        SourceLoc where = nextToken();
        state_.after = JsonState::After::Key;
        state_.key = name;
        open_.back()->members().push_back({std::move(name), std::move(where), Value()});
        return true;
    }

    bool parse_error(std::size_t byte, const std::string&, const nlohmann::json::exception& error) {
        const std::size_t stop = byte > 0 ? byte - 1 : 0;
        throw Error(std::vector<Problem>{explainJsonSyntax(text_, places_, state_, stop, error.what())});
    }

private:
    /// The place of the token that caused the event: the first one after the last that is no ',' or ':'.
    SourceLoc nextToken() {
        JsonToken token = jsonTokenAt(text_, state_.end);
        while (token.begin < text_.size() && (text_[token.begin] == ',' || text_[token.begin] == ':')) {
            token = jsonTokenAt(text_, token.end);
        }
        state_.begin = token.begin;
        state_.end = token.end;
        return places_.at(token.begin, token.end);
    }

    Value& place(Value value) {
        if (++nodeCount_ > limits_.maxNodes) {
            throw Error(value.where(), fmt::format("the document holds more than {} values", limits_.maxNodes),
                        "split the document");
        }
        if (open_.empty()) {
            root_ = std::move(value);
            return root_;
        }
        Value& parent = *open_.back();
        if (parent.isArray()) return parent.items().emplace_back(std::move(value));
        return parent.members().back().value = std::move(value);
    }

    bool add(Value value) {
        place(std::move(value));
        finishValue();
        return true;
    }

    bool open(Value value, JsonState::After after) {
        Value& placed = place(std::move(value));
        if (static_cast<int>(open_.size()) >= limits_.maxDepth) {
            throw Error(placed.where(), fmt::format("the document nests deeper than {} levels", limits_.maxDepth),
                        "flatten the document");
        }
        // Stable: a parent's list grows only after its child is closed.
        open_.push_back(&placed);
        state_.after = after;
        state_.opener = placed.where();
        return true;
    }

    bool close() {
        nextToken();
        open_.pop_back();
        state_.opener = open_.empty() ? SourceLoc{} : open_.back()->where();
        finishValue();
        return true;
    }

    void finishValue() {
        state_.after = open_.empty()             ? JsonState::After::Document
                       : open_.back()->isArray() ? JsonState::After::ArrayValue
                                                 : JsonState::After::ObjectValue;
    }

    std::string_view text_;
    const TextPlaces& places_;
    const DocumentLimits& limits_;
    const RepeatedKey* repeated_;
    JsonState state_;
    Value root_;
    std::vector<Value*> open_;
    std::size_t nodeCount_ = 0;
};

Value parse(std::string_view text, const std::string& file, const DocumentLimits& limits, const RepeatedKey* repeated) {
    checkDocumentSize(text, file, limits.maxBytes);
    const TextPlaces places(text, file);
    TreeBuilder builder(text, places, limits, repeated);
    constexpr bool kStrict = true;
    constexpr bool kIgnoreComments = true;
    nlohmann::json::sax_parse(text, &builder, nlohmann::json::input_format_t::json, kStrict, kIgnoreComments);
    return builder.takeRoot();
}

}  // namespace

Value parseJson(std::string_view text, const std::string& file, const DocumentLimits& limits) {
    return parse(text, file, limits, nullptr);
}

Value parseJsonLastWins(std::string_view text, const std::string& file, const DocumentLimits& limits,
                        const RepeatedKey& repeated) {
    return parse(text, file, limits, &repeated);
}

}  // namespace crevice
