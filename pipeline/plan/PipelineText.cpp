// Prints a merged document with the origin of each line.
#include <algorithm>

#include <fmt/format.h>

#include "plan/PipelineAsset.h"

namespace crevice {
namespace {

constexpr std::size_t kOriginColumn = 72;  // Origins stand in one column where lines are shorter.

/// An argument may hold a line break, which would end the comment.
std::string originText(const SourceLoc& where) {
    std::string file = where.file;
    std::replace_if(
        file.begin(), file.end(), [](char c) { return static_cast<unsigned char>(c) < 0x20; }, ' ');
    return where.line > 0 ? fmt::format("{}:{}", file, where.line) : file;
}

class TextPrinter {
public:
    std::string print(const Value& document) {
        printValue(document, "", "", 0);
        return std::move(text_);
    }

private:
    void line(int depth, const std::string& content, const SourceLoc* where) {
        std::string out(static_cast<std::size_t>(depth) * 2, ' ');
        out += content;
        if (where && !where->file.empty()) {
            if (out.size() < kOriginColumn) out.resize(kOriginColumn, ' ');
            out += "  // " + originText(*where);
        }
        text_ += out + '\n';
    }

    static bool isShort(const Value& value) {
        if (value.isObject()) return value.members().empty();
        if (!value.isArray()) return true;
        return std::none_of(value.items().begin(), value.items().end(),
                            [](const Value& item) { return item.isArray() || item.isObject(); });
    }

    /// Arrays of scalars stay on one line: "[1, 2]".
    static std::string shortText(const Value& value) {
        if (!value.isArray()) return value.toJson(-1);
        std::string text = "[";
        for (const Value& item : value.items()) text += (text.size() > 1 ? ", " : "") + item.toJson(-1);
        return text + "]";
    }

    void printValue(const Value& value, const std::string& prefix, const char* comma, int depth) {
        if (isShort(value)) {
            line(depth, prefix + shortText(value) + comma, &value.where());
        } else if (value.isArray()) {
            line(depth, prefix + "[", &value.where());
            const auto& items = value.items();
            for (std::size_t i = 0; i < items.size(); ++i)
                printValue(items[i], "", i + 1 < items.size() ? "," : "", depth + 1);
            line(depth, std::string("]") + comma, nullptr);
        } else {
            line(depth, prefix + "{", &value.where());
            const auto& members = value.members();
            for (std::size_t i = 0; i < members.size(); ++i)
                printValue(members[i].value, Value::makeString(members[i].key).toJson(-1) + ": ",
                           i + 1 < members.size() ? "," : "", depth + 1);
            line(depth, std::string("}") + comma, nullptr);
        }
    }

    std::string text_;
};

}  // namespace

std::string flattenText(const Value& document) { return TextPrinter().print(document); }

}  // namespace crevice
