// Every property of a glTF that has everything is taken away, given another type, made negative, enormous or a wrong
// reference; the file loads or is refused, never otherwise.
#include <functional>

#include "GltfFaultCases.h"
#include "GltfTestTools.h"

namespace crevice {
namespace {

using test::Everything;
using test::Listener;
using test::TempFolder;

/// What takes the place of a value. Texts are put into the JSON as they stand, valid or not.
constexpr const char* kReplacements[] = {"null",
                                         "true",
                                         "\"\"",
                                         "\"x\"",
                                         "[]",
                                         "{}",
                                         "[0]",
                                         "-1",
                                         "0",
                                         "1",
                                         "0.5",
                                         "99",
                                         "1e300",
                                         "-1e300",
                                         "1e400",
                                         "NaN",
                                         "2147483648",
                                         "4294967295",
                                         "4294967296",
                                         "9007199254740993",
                                         "18446744073709551615",
                                         "[[[[]]]]"};

/// Calls `visit` for every value below `at`, with the object or list that holds it.
void visitValues(Value& at, const std::function<void(Value& holder, std::size_t index)>& visit) {
    const std::size_t count = at.isObject() ? at.members().size() : at.isArray() ? at.items().size() : 0;
    for (std::size_t i = 0; i < count; ++i) {
        visit(at, i);
        visitValues(at.isObject() ? at.members()[i].value : at.items()[i], visit);
    }
}

class Mutations {
public:
    explicit Mutations(Everything whole) : whole_(std::move(whole)) {
        document_ = parseJson(whole_.json, "everything");
        data_ = "data:application/octet-stream;base64," + test::encodeBase64(whole_.bytes);
    }

    /// Every `step`th mutation. Returns how many loaded and how many were refused.
    std::pair<int, int> run(std::size_t step) {
        visitValues(document_, [&](Value& holder, std::size_t index) {
            Value& value = holder.isObject() ? holder.members()[index].value : holder.items()[index];
            const Value before = value;
            for (const char* text : kReplacements) {
                value = Value::makeString("@mutated");
                if (++count_ % step == 0) tryLoad(text);
            }
            value = before;
            takeAway(holder, index, step);
            twice(holder, index, step);
        });
        return {loaded_, refused_};
    }

private:
    void takeAway(Value& holder, std::size_t index, std::size_t step) {
        const Value before = holder;
        if (holder.isObject())
            holder.members().erase(holder.members().begin() + std::ptrdiff_t(index));
        else
            holder.items().erase(holder.items().begin() + std::ptrdiff_t(index));
        if (++count_ % step == 0) tryLoad("");
        holder = before;
    }

    void twice(Value& holder, std::size_t index, std::size_t step) {
        if (!holder.isArray() || ++count_ % step) return;
        const Value before = holder;
        holder.items().push_back(Value(holder.items()[index]));
        tryLoad("");
        holder = before;
    }

    void tryLoad(const std::string& text) {
        std::string json = document_.toJson(-1);
        const auto put = [&](const std::string& mark, const std::string& by) {
            if (const std::size_t at = json.find(mark); at != std::string::npos) json.replace(at, mark.size(), by);
        };
        put("\"@mutated\"", text);
        put("@bytes", data_);
        const auto path = folder_.write("m.gltf", json);
        // A pose reads animations, too.
        LoadOptions options{.log = listener_.log, .limits = {.maxVertices = 10000}, .time = 0.5f};
        options.limits.maxFileBytes = 1u << 20;
        const std::string error = test::errorOf([&] { loadGltf(path, options); });
        if (error == "no error") {
            ++loaded_;
        } else {
            ++refused_;
            EXPECT_NE(error.find("m.gltf"), std::string::npos) << "no place: " << error;
        }
        listener_.text.clear();
    }

    const TempFolder folder_;
    Listener listener_;
    Everything whole_;
    Value document_;
    std::string data_;
    std::size_t count_ = 0;
    int loaded_ = 0, refused_ = 0;
};

// One in three of some 10,000.
TEST(GltfMutations, EveryPropertyMayBeAnything) {
    const auto [loaded, refused] = Mutations(Everything()).run(3);
    EXPECT_GT(loaded, 500);
    EXPECT_GT(refused, 1000);
}

}  // namespace
}  // namespace crevice
