// Every value is tried in one line first.
#include "cocos/import/ImportText.h"

namespace crevice::cocos {
namespace {

std::string quoted(const std::string& text) { return Value::makeString(text).toJson(-1); }

std::string inOneLine(const Value& value) {
    if (!value.isArray() && !value.isObject()) return value.toJson(-1);
    std::string text;
    if (value.isArray()) {
        for (const Value& item : value.items()) text += (text.empty() ? "" : ", ") + inOneLine(item);
        return "[" + text + "]";
    }
    for (const Member& member : value.members())
        text += (text.empty() ? " " : ", ") + quoted(member.key) + ": " + inOneLine(member.value);
    return text.empty() ? "{}" : "{" + text + " }";
}

void write(const Value& value, std::size_t indent, std::size_t before, std::size_t width, std::string& out) {
    const std::string line = inOneLine(value);
    const bool leaf = !value.isArray() && !value.isObject();
    if (leaf || before + line.size() <= width) {
        out += line;
        return;
    }
    const std::string spaces(indent + 2, ' ');
    auto separate = [&, first = true]() mutable {
        out += first ? "\n" : ",\n";
        out += spaces;
        first = false;
    };
    out += value.isArray() ? '[' : '{';
    if (value.isArray()) {
        for (const Value& item : value.items()) {
            separate();
            write(item, indent + 2, indent + 2, width, out);
        }
    } else {
        for (const Member& member : value.members()) {
            separate();
            const std::string key = quoted(member.key) + ": ";
            out += key;
            write(member.value, indent + 2, indent + 2 + key.size(), width, out);
        }
    }
    out += "\n" + std::string(indent, ' ') + (value.isArray() ? ']' : '}');
}

}  // namespace

std::string readableJson(const Value& value, std::size_t width) {
    std::string text;
    write(value, 0, width + 1, width, text);  // the document itself is never one line
    return text + "\n";
}

}  // namespace crevice::cocos
