// Reads YAML: yaml-cpp splits the text into events; types, merge keys, limits and messages are ours.
#include <algorithm>
#include <sstream>
#include <unordered_map>

#include <fmt/format.h>
#include <yaml-cpp/eventhandler.h>
#include <yaml-cpp/yaml.h>

#include "core/Document.h"
#include "core/TextPlaces.h"
#include "core/YamlScalar.h"

namespace crevice {
namespace {

/// Values that aliases may copy in all: a few nested aliases would otherwise stand for billions.
constexpr std::size_t kMaxCopiedWeight = 200'000;
constexpr std::size_t kBytesPerWeight = 64;

/// Builds the tree from yaml-cpp's events, which come in text order.
class TreeBuilder final : public YAML::EventHandler {
public:
    TreeBuilder(std::string_view text, const TextPlaces& places, const DocumentLimits& limits)
        : text_(text), places_(places), limits_(limits) {}

    Value takeRoot() { return std::move(root_); }
    std::size_t offsetOf(const YAML::Mark& mark) const {
        return mark.line < 0 ? text_.size() : places_.offsetOf(mark.line, mark.column);
    }

    void OnDocumentStart(const YAML::Mark& mark) override {
        if (++documentCount_ < 2) return;
        if (text_.substr(offsetOf(mark)).starts_with("---") || documentMarkerBefore(offsetOf(mark))) {
            throw Error(placeOf(mark), "a second document begins here", "remove the line '---': one document is read");
        }
        throw Error(placeOf(mark), "this line does not continue the value above it",
                    "check the indentation: a list goes on with '- ', an object with 'key: value'");
    }
    void OnDocumentEnd() override {}

    void OnNull(const YAML::Mark& mark, YAML::anchor_t anchor) override {
        if (awaitsKey()) throw Error(placeOf(mark), "a key is missing before ':'", "write the key's name");
        Value value;
        value.setWhere(placeOf(mark));
        addLeaf(std::move(value), anchor);
    }

    void OnScalar(const YAML::Mark& mark, const std::string& tag, YAML::anchor_t anchor,
                  const std::string& text) override {
        const bool plain = tag == "?";
        SourceLoc where = scalarPlace(mark, text);
        if (awaitsKey()) {
            if (anchor != 0) anchored_[anchor] = {Value::makeString(text, where), 1};
            setKey(text, std::move(where), plain && text == "<<");
            return;
        }
        addLeaf(plain ? readPlainYamlScalar(text, where) : readTaggedYamlScalar(tag, text, where), anchor);
    }

    void OnAlias(const YAML::Mark& mark, YAML::anchor_t anchor) override {
        const SourceLoc where = tokenPlace(mark);
        const auto source = anchored_.find(anchor);
        if (source == anchored_.end()) {
            throw Error(where, "this alias stands inside the value it repeats", "a value cannot contain itself");
        }
        countCopies(source->second.weight, where);
        if (!awaitsKey()) {
            addValue(source->second.value, source->second.weight);
        } else if (source->second.value.isString()) {
            setKey(source->second.value.string(), where, false);
        } else {
            throw Error(where, "a key must be a word, found " + std::string(source->second.value.typeName()),
                        "write the key's name");
        }
    }

    void OnSequenceStart(const YAML::Mark& mark, const std::string& tag, YAML::anchor_t anchor,
                         YAML::EmitterStyle::value) override {
        checkCollectionTag(mark, tag, "tag:yaml.org,2002:seq");
        openFrame(Value::makeArray(placeOf(mark)), anchor);
    }
    void OnMapStart(const YAML::Mark& mark, const std::string& tag, YAML::anchor_t anchor,
                    YAML::EmitterStyle::value) override {
        checkCollectionTag(mark, tag, "tag:yaml.org,2002:map");
        openFrame(Value::makeObject(placeOf(mark)), anchor);
    }
    void OnSequenceEnd() override { closeFrame(); }
    void OnMapEnd() override { closeFrame(); }

private:
    struct Anchored {
        Value value;
        std::size_t weight = 0;
    };
    struct Entry {
        std::size_t index = 0;  // of the member
        bool merged = false;    // came by '<<': an explicit key may replace it
    };
    /// An array or object that is being read.
    struct Frame {
        Value value;
        YAML::anchor_t anchor = 0;
        std::size_t weight = 1;
        bool hasKey = false;
        bool mergeKey = false;
        std::string key;
        SourceLoc keyLoc;
        std::unordered_map<std::string, Entry> entries;
    };

    SourceLoc placeOf(const YAML::Mark& mark) const { return places_.at(offsetOf(mark)); }

    bool documentMarkerBefore(std::size_t offset) const {
        const std::size_t lastWord = text_.substr(0, offset).find_last_not_of(" \n");
        return lastWord != std::string_view::npos && lastWord >= 2 && text_.substr(lastWord - 2, 3) == "---";
    }

    SourceLoc tokenPlace(const YAML::Mark& mark) const {
        const std::size_t begin = offsetOf(mark);
        return places_.at(begin, std::min(text_.find_first_of(" \r\n,]}", begin), text_.size()));
    }

    SourceLoc scalarPlace(const YAML::Mark& mark, const std::string& content) const {
        const std::size_t begin = offsetOf(mark);
        const bool quoted = begin < text_.size() && (text_[begin] == '"' || text_[begin] == '\'');
        return places_.at(begin, begin + content.size() + (quoted ? 2 : 0));
    }

    void checkCollectionTag(const YAML::Mark& mark, const std::string& tag, std::string_view allowed) const {
        if (tag.empty() || tag == "?" || tag == "!" || tag == allowed) return;
        throw Error(placeOf(mark), fmt::format("tag '{}' is not known here", tag), "remove the tag");
    }

    bool awaitsKey() const { return !open_.empty() && open_.back().value.isObject() && !open_.back().hasKey; }

    void countNode(const SourceLoc& where) {
        if (++nodeCount_ <= limits_.maxNodes) return;
        throw Error(where, fmt::format("the document holds more than {} values", limits_.maxNodes),
                    "split the document");
    }

    void countCopies(std::size_t weight, const SourceLoc& where) {
        copiedWeight_ += weight;
        if (copiedWeight_ <= kMaxCopiedWeight) return;
        throw Error(where, fmt::format("the aliases of this document stand for more than {} values", kMaxCopiedWeight),
                    "use fewer aliases of values that themselves hold aliases");
    }

    void setKey(const std::string& text, SourceLoc where, bool mergeKey) {
        countNode(where);
        Frame& frame = open_.back();
        frame.hasKey = true;
        frame.mergeKey = mergeKey;
        frame.key = text;
        frame.keyLoc = std::move(where);
    }

    void addLeaf(Value value, YAML::anchor_t anchor) {
        countNode(value.where());
        const std::size_t weight = 1 + (value.isString() ? value.string().size() / kBytesPerWeight : 0);
        finishValue(std::move(value), anchor, weight);
    }

    void openFrame(Value value, YAML::anchor_t anchor) {
        if (awaitsKey()) {
            throw Error(value.where(), "a key must be a word, found " + std::string(value.typeName()),
                        "write the key's name; put a list or an object after ':'");
        }
        countNode(value.where());
        if (static_cast<int>(open_.size()) >= limits_.maxDepth) {
            throw Error(value.where(), fmt::format("the document nests deeper than {} levels", limits_.maxDepth),
                        "flatten the document");
        }
        open_.emplace_back().value = std::move(value);
        open_.back().anchor = anchor;
    }

    void closeFrame() {
        Frame frame = std::move(open_.back());
        open_.pop_back();
        finishValue(std::move(frame.value), frame.anchor, frame.weight);
    }

    void finishValue(Value value, YAML::anchor_t anchor, std::size_t weight) {
        if (anchor != 0) {
            countCopies(weight, value.where());
            anchored_[anchor] = {value, weight};
        }
        addValue(std::move(value), weight);
    }

    void addValue(Value value, std::size_t weight) {
        if (open_.empty()) {
            root_ = std::move(value);
            return;
        }
        Frame& frame = open_.back();
        frame.weight += weight + 1 + frame.key.size() / kBytesPerWeight;
        if (frame.value.isArray()) {
            frame.value.items().push_back(std::move(value));
            return;
        }
        frame.hasKey = false;
        if (frame.mergeKey) {
            merge(frame, value);
        } else {
            addMember(frame, std::move(value));
        }
    }

    void addMember(Frame& frame, Value value) {
        std::vector<Member>& members = frame.value.members();
        const auto [entry, isNew] = frame.entries.try_emplace(frame.key, Entry{members.size(), false});
        if (isNew) {
            members.push_back({std::move(frame.key), std::move(frame.keyLoc), std::move(value)});
            return;
        }
        Member& present = members[entry->second.index];
        if (!entry->second.merged) throwDuplicate(frame, present);
        present.keyLoc = std::move(frame.keyLoc);
        present.value = std::move(value);
        entry->second.merged = false;
    }

    [[noreturn]] static void throwDuplicate(const Frame& frame, const Member& first) {
        Problem problem;
        problem.where = frame.keyLoc;
        problem.message = fmt::format("key '{}' stands twice in this object", frame.key);
        problem.help = "remove or rename one of the two";
        problem.remarks.push_back({first.keyLoc, fmt::format("'{}' stands here first", first.key)});
        throw Error(std::vector<Problem>{std::move(problem)});
    }

    /// `<<: *x` or `<<: [*x, *y]`: keys that are not there yet are copied; explicit ones and earlier sources win.
    static void merge(Frame& frame, Value& source) {
        if (source.isObject()) {
            mergeObject(frame, source);
            return;
        }
        const bool objects = source.isArray() && std::all_of(source.items().begin(), source.items().end(),
                                                             [](const Value& item) { return item.isObject(); });
        if (!objects) {
            throw Error(frame.keyLoc, fmt::format("'<<' must merge objects, found {}", source.typeName()),
                        "write '<<: *anchor' or '<<: [*first, *second]' with anchors of objects");
        }
        for (Value& item : source.items()) mergeObject(frame, item);
    }

    static void mergeObject(Frame& frame, Value& source) {
        std::vector<Member>& members = frame.value.members();
        for (Member& member : source.members()) {
            const bool isNew = frame.entries.try_emplace(member.key, Entry{members.size(), true}).second;
            if (isNew) members.push_back(std::move(member));
        }
    }

    std::string_view text_;
    const TextPlaces& places_;
    const DocumentLimits& limits_;
    Value root_;
    std::vector<Frame> open_;
    std::unordered_map<YAML::anchor_t, Anchored> anchored_;
    std::size_t nodeCount_ = 0;
    std::size_t copiedWeight_ = 0;
    int documentCount_ = 0;
};

/// Without byte order mark and carriage returns, and with spaces for tabs, which may not indent YAML: lines and columns
/// stay.
std::string normalize(std::string_view text) {
    if (text.starts_with("\xef\xbb\xbf")) text.remove_prefix(3);
    std::string plain;
    plain.reserve(text.size());
    for (std::size_t i = 0; i < text.size(); ++i) {
        const bool endsLine = i + 1 == text.size() || text[i + 1] == '\n';
        if (text[i] == '\r' && endsLine) continue;
        plain += text[i] == '\t' ? ' ' : text[i];
    }
    return plain;
}

}  // namespace

Value parseYaml(std::string_view text, const std::string& file, int firstLine, const DocumentLimits& limits) {
    checkDocumentSize(text, file, limits.maxBytes);
    const std::string plain = normalize(text);
    const TextPlaces places(plain, file, firstLine);
    checkPlainText(plain, places);
    TreeBuilder builder(plain, places, limits);
    try {
        std::istringstream stream(plain);
        YAML::Parser parser(stream);
        while (parser.HandleNextDocument(builder)) {
        }
    } catch (const YAML::Exception& error) {
        throw Error(std::vector<Problem>{explainYamlSyntax(plain, places, builder.offsetOf(error.mark), error.msg)});
    }
    return builder.takeRoot();
}

}  // namespace crevice
