// From statements to declarations: qualifiers, types, names, array sizes, members and what pragmas say of them.
#include "cocos/Interface.h"

#include <algorithm>
#include <limits>
#include <map>

#include <fmt/format.h>

#include "cocos/BlockRules.h"
#include "cocos/GlslStatements.h"
#include "cocos/GlslTypes.h"
#include "cocos/Pragmas.h"
#include "cocos/TextConstants.h"

namespace crevice::cocos {
namespace {

/// Vulkan's limits are far below; a number beyond it is a mistake, and nothing is allocated for it.
constexpr std::int64_t kMostLocations = 4096;
constexpr int kLargestNumber = 1 << 20;

bool isQualifier(std::string_view word) {
    static constexpr std::string_view kWords[] = {
        "flat",     "smooth",    "noperspective", "centroid", "sample",   "patch",    "invariant",
        "precise",  "highp",     "mediump",       "lowp",     "coherent", "volatile", "restrict",
        "readonly", "writeonly", "const",         "in",       "out",      "uniform",  "buffer"};
    return std::find(std::begin(kWords), std::end(kWords), word) != std::end(kWords);
}

/// One of the names that a statement declares.
struct Declarator {
    std::size_t token;
    ArraySize size;
};

class InterfaceReader {
public:
    InterfaceReader(const StageText& stage, Problems& problems)
        : stage_(stage), problems_(problems), tokens_(tokenizeGlsl(stage.flat.text)) {}

    StageInterface read() {
        result_.stage = stage_.stage;
        constants_.addText(tokens_);
        for (const StageMacro& macro : stage_.macros)
            if (macro.info.range && !macro.inferred) constants_.addLimit(macro.info.name, macro.info.range->second);
        for (const GlslStatement& statement : findInterfaceStatements(tokens_)) {
            addSubpassInputs(tokens_[statement.storage].line);
            if (statement.storage == statement.end)
                readStruct(statement);
            else if (statement.brace != 0)
                readBlock(statement);
            else
                readVariables(statement);
        }
        addSubpassInputs(std::numeric_limits<int>::max());
        return std::move(result_);
    }

private:
    std::size_t offset(std::size_t token) const {
        return static_cast<std::size_t>(tokens_[token].text.data() - stage_.flat.text.data());
    }
    SourceLoc place(std::size_t token) const {
        const GlslToken& t = tokens_[token];
        return stage_.flat.locate(t.line, t.column, static_cast<int>(t.text.size()));
    }
    /// The next token that is no preprocessor line, or `end`.
    std::size_t skipDirectives(std::size_t at, std::size_t end) const {
        while (at < end && tokens_[at].directive) ++at;
        return at;
    }
    std::size_t behindParens(std::size_t at, std::size_t end) const {
        int depth = 0;
        for (; at < end; ++at) {
            if (tokens_[at].text == "(") ++depth;
            if (tokens_[at].text == ")" && --depth == 0) return at + 1;
        }
        return end;
    }

    void readStruct(const GlslStatement& statement);
    void readBlock(const GlslStatement& statement);
    void readVariables(const GlslStatement& statement);
    std::vector<Declarator> readDeclarators(std::size_t at, std::size_t end, const ArraySize& typeSize,
                                            InterfaceStatement& where) const;
    InterfaceStatement readQualifiers(const GlslStatement& statement, std::size_t& at, std::size_t end,
                                      InterfaceDeclaration& declaration) const;
    void readLayout(std::size_t begin, std::size_t end, InterfaceStatement& where,
                    InterfaceDeclaration& declaration) const;
    int numberOf(std::size_t begin, std::size_t end) const;
    ArraySize readSize(std::size_t& at, std::size_t end) const;
    std::vector<InterfaceMember> readMembers(std::size_t begin, std::size_t end) const;
    std::int64_t locationsOf(std::string_view type, const ArraySize& size) const;
    void add(InterfaceDeclaration declaration, std::size_t nameToken, const std::vector<PragmaMark>& marks);
    std::vector<PragmaMark> takeMarks(int line);
    void addSubpassInputs(int line);
    std::uint32_t conditionsAt(int line) const {
        const auto index = static_cast<std::size_t>(line - 1);
        return index < stage_.conditionOf.size() ? stage_.conditionOf[index] : 0;
    }

    const StageText& stage_;
    Problems& problems_;
    std::vector<GlslToken> tokens_;
    TextConstants constants_;
    StageInterface result_;
    std::map<std::string_view, std::int64_t> structs_;  ///< Locations that a struct takes.
    std::size_t nextMark_ = 0, nextSubpass_ = 0;
};

/// `[N][M]` behind a name or a type. `at` ends behind it.
ArraySize InterfaceReader::readSize(std::size_t& at, std::size_t end) const {
    ArraySize size;
    while (at < end && tokens_[at].text == "[") {
        const std::size_t first = ++at;
        for (int depth = 1; at < end; ++at) {
            if (tokens_[at].text == "[") ++depth;
            if (tokens_[at].text == "]" && --depth == 0) break;
        }
        const auto value = constants_.evaluate(tokens_.data() + first, tokens_.data() + at);
        const bool usable = value && value->value > 0 && value->value < std::numeric_limits<std::int32_t>::max();
        size.array = true;
        size.certain = size.certain && usable && value->certain;
        size.count =
            std::min<std::int64_t>(size.count * (usable ? value->value : 1), std::numeric_limits<std::int32_t>::max());
        if (at < end) ++at;
    }
    return size;
}

std::int64_t InterfaceReader::locationsOf(std::string_view type, const ArraySize& size) const {
    std::int64_t each = 1;
    if (const GlslType* known = findGlslType(type)) {
        each = known->columns * (known->componentBytes == 8 && known->components > 2 ? 2 : 1);
    } else if (const auto it = structs_.find(type); it != structs_.end()) {
        each = it->second;
    }
    return std::min(each * size.count, kMostLocations + 1);
}

std::vector<InterfaceMember> InterfaceReader::readMembers(std::size_t begin, std::size_t end) const {
    std::vector<InterfaceMember> members;
    std::string type;
    ArraySize typeSize;
    for (std::size_t at = begin; at < end;) {
        const std::string_view text = tokens_[at].text;
        if (tokens_[at].directive || text == "," || isQualifier(text)) {
            ++at;
        } else if (text == ";") {
            type.clear();
            ++at;
        } else if (text == "layout") {
            at = behindParens(at, end);
        } else if (!tokens_[at].isName()) {
            ++at;
        } else if (type.empty()) {
            type = text;
            typeSize = readSize(++at, end);
        } else {
            const SourceLoc where = place(at);
            ArraySize size = readSize(++at, end);
            if (!size.array) size = typeSize;
            members.push_back({std::string(text), type, size, where});
        }
    }
    return members;
}

void InterfaceReader::readStruct(const GlslStatement& statement) {
    const std::size_t name = skipDirectives(statement.begin + 1, statement.brace);
    if (name >= statement.brace) return;
    std::int64_t sum = 0;
    for (const InterfaceMember& member : readMembers(statement.brace + 1, statement.close))
        sum = std::min(sum + locationsOf(member.type, member.size), kMostLocations + 1);
    structs_[tokens_[name].text] = sum;
}

int InterfaceReader::numberOf(std::size_t begin, std::size_t end) const {
    const auto value = constants_.evaluate(tokens_.data() + begin, tokens_.data() + end);
    if (!value || value->value < 0 || value->value > kLargestNumber) return -1;
    return static_cast<int>(value->value);
}

/// `layout(a = 1, b)` from its word to behind its parenthesis: numbers are taken out, the rest stays.
void InterfaceReader::readLayout(std::size_t begin, std::size_t end, InterfaceStatement& where,
                                 InterfaceDeclaration& declaration) const {
    std::string kept;
    std::size_t at = begin + 2;
    while (at + 1 < end) {
        std::size_t last = at;
        int depth = 0;
        while (last + 1 < end && (tokens_[last].text != "," || depth > 0)) {
            if (tokens_[last].text == "(") ++depth;
            if (tokens_[last].text == ")") --depth;
            ++last;
        }
        const std::string_view key = tokens_[at].text;
        int* number = key == "set"                      ? &declaration.literal.set
                      : key == "binding"                ? &declaration.literal.binding
                      : key == "location"               ? &declaration.literal.location
                      : key == "input_attachment_index" ? &declaration.literal.attachment
                                                        : nullptr;
        const int value = number != nullptr && last > at + 2 ? numberOf(at + 2, last) : -1;
        if (value >= 0) {
            *number = value;
        } else if (last > at) {
            const std::size_t from = offset(at), to = offset(last - 1) + tokens_[last - 1].text.size();
            kept += (kept.empty() ? "" : ", ") + stage_.flat.text.substr(from, to - from);
        }
        at = last + 1;
    }
    const std::size_t from = offset(begin);
    where.layouts.push_back({from, offset(end - 1) + 1 - from, std::move(kept)});
}

/// The words around the storage word. `at` begins behind it and ends on the type.
InterfaceStatement InterfaceReader::readQualifiers(const GlslStatement& statement, std::size_t& at, std::size_t end,
                                                   InterfaceDeclaration& declaration) const {
    InterfaceStatement where;
    where.storage = offset(statement.storage);
    where.begin = where.storage;
    const auto read = [&](std::size_t from, std::size_t to) {
        for (std::size_t i = from; i < to;) {
            const std::string_view word = tokens_[i].text;
            if (word == "readonly") declaration.readOnly = true;
            if (word == "writeonly") declaration.writeOnly = true;
            if (word == "layout" && i + 1 < to && tokens_[i + 1].text == "(") {
                const std::size_t behind = behindParens(i, to);
                where.begin = std::min(where.begin, offset(i));
                readLayout(i, behind, where, declaration);
                i = behind;
            } else if (isQualifier(word)) {
                where.begin = std::min(where.begin, offset(i++));
            } else if (i >= statement.storage) {
                return i;
            } else {
                ++i;  // a macro's call in front of the declaration
            }
        }
        return to;
    };
    read(statement.begin, statement.storage);
    at = read(statement.storage, end);
    return where;
}

std::vector<PragmaMark> InterfaceReader::takeMarks(int line) {
    std::vector<PragmaMark> marks;
    for (; nextMark_ < stage_.marks.size() && stage_.marks[nextMark_].line <= line; ++nextMark_)
        marks.push_back(stage_.marks[nextMark_]);
    return marks;
}

void InterfaceReader::add(InterfaceDeclaration declaration, std::size_t nameToken,
                          const std::vector<PragmaMark>& marks) {
    declaration.name = tokens_[nameToken].text;
    declaration.where = place(nameToken);
    declaration.conditions = conditionsAt(tokens_[nameToken].line);
    declaration.statement = result_.statements.size() - 1;
    const bool resource = declaration.kind < InterfaceKind::Input;
    for (const PragmaMark& mark : marks) {
        if (mark.kind == PragmaMark::Kind::Format) declaration.formatMark = mark.value;
        if (!resource) continue;
        if (mark.kind == PragmaMark::Kind::BuiltinGlobal) declaration.builtin = Builtin::Global;
        if (mark.kind == PragmaMark::Kind::BuiltinLocal) declaration.builtin = Builtin::Local;
    }
    if (declaration.locations > kMostLocations) {
        problems_.error(declaration.where,
                        fmt::format("'{}' takes more than {} locations", declaration.name, kMostLocations),
                        "declare a smaller array");
        declaration.locations = 1;
    }
    result_.declarations.push_back(std::move(declaration));
}

void InterfaceReader::readBlock(const GlslStatement& statement) {
    const std::string_view storage = tokens_[statement.storage].text;
    InterfaceDeclaration block;
    std::size_t at = 0;
    InterfaceStatement where = readQualifiers(statement, at, statement.brace, block);
    if (at >= statement.brace || !tokens_[at].isName() || tokens_[at].text.starts_with("gl_")) return;
    where.end = offset(statement.brace);
    block.kind = storage == "uniform"  ? InterfaceKind::Block
                 : storage == "buffer" ? InterfaceKind::Buffer
                 : storage == "in"     ? InterfaceKind::Input
                                       : InterfaceKind::Output;
    block.members = readMembers(statement.brace + 1, statement.close);
    std::size_t instance = skipDirectives(statement.close + 1, statement.end);
    if (instance < statement.end) block.size = readSize(++instance, statement.end);
    if (block.kind >= InterfaceKind::Input) {
        block.locations = 0;
        for (const InterfaceMember& member : block.members)
            block.locations = std::min(block.locations + locationsOf(member.type, member.size), kMostLocations + 1);
    }
    const auto marks = takeMarks(tokens_[statement.storage].line);
    result_.statements.push_back(std::move(where));
    add(std::move(block), at, marks);
    if (storage == "uniform") checkBlock(result_.declarations.back(), problems_);
}

/// `v_uv, v_colors[2]` from `at` to `end`: what each declares, and its text into `where`.
std::vector<Declarator> InterfaceReader::readDeclarators(std::size_t at, std::size_t end, const ArraySize& typeSize,
                                                         InterfaceStatement& where) const {
    std::vector<Declarator> names;
    where.firstName = offset(skipDirectives(at, end));
    for (at = skipDirectives(at, end); at < end; at = skipDirectives(at + 1, end)) {
        Declarator declarator{at, {}};
        const std::size_t from = offset(at);
        declarator.size = readSize(++at, end);
        const std::size_t to = offset(at - 1) + tokens_[at - 1].text.size();
        if (!declarator.size.array) declarator.size = typeSize;
        if (tokens_[declarator.token].isName()) {
            names.push_back(declarator);
            where.declarators.push_back(stage_.flat.text.substr(from, to - from));
        }
        while (at < end && tokens_[at].text != ",") ++at;
    }
    return names;
}

void InterfaceReader::readVariables(const GlslStatement& statement) {
    const std::string_view storage = tokens_[statement.storage].text;
    InterfaceDeclaration common;
    std::size_t at = 0;
    InterfaceStatement where = readQualifiers(statement, at, statement.end, common);
    // `out PRECISION vec2 v_uv`: of several words the last is the name, and the one before it the type.
    while (at + 2 < statement.end && tokens_[at + 1].isName() && tokens_[at + 2].isName() &&
           !tokens_[at + 1].directive && !tokens_[at + 2].directive)
        ++at;
    if (at + 1 >= statement.end || !tokens_[at].isName()) return;  // `layout(local_size_x = 8) in;`
    common.type = tokens_[at].text;
    const ArraySize typeSize = readSize(++at, statement.end);
    const GlslType* type = findGlslType(common.type);
    common.kind = storage == "in" ? InterfaceKind::Input : InterfaceKind::Output;
    if (storage == "uniform" || storage == "buffer") {
        if (type == nullptr || !type->resource) {
            if (!statement.conditional) reportLooseUniform(place(skipDirectives(at, statement.end)), problems_);
            return;
        }
        common.kind = *type->resource;
    } else {
        const bool crossing = (stage_.stage == kVertexBit) == (common.kind == InterfaceKind::Output);
        where.flat = crossing && type != nullptr && type->integer;
        for (std::size_t i = statement.begin; i < at; ++i)
            if (tokens_[i].text == "flat") where.flat = false;
    }
    const std::vector<Declarator> names = readDeclarators(at, statement.end, typeSize, where);
    where.end = offset(statement.end) + 1;
    const auto marks = takeMarks(tokens_[statement.storage].line);
    result_.statements.push_back(std::move(where));
    for (const Declarator& name : names) {
        if (tokens_[name.token].text.starts_with("gl_")) continue;
        InterfaceDeclaration declaration = common;
        declaration.size = name.size;
        if (declaration.kind >= InterfaceKind::Input) declaration.locations = locationsOf(common.type, name.size);
        add(std::move(declaration), name.token, marks);
    }
}

/// `#pragma subpassColor in NAME` declares the input itself: its line is empty and takes the declaration.
void InterfaceReader::addSubpassInputs(int line) {
    for (; nextSubpass_ < stage_.marks.size() && stage_.marks[nextSubpass_].line < line; ++nextSubpass_) {
        const PragmaMark& mark = stage_.marks[nextSubpass_];
        const bool subpass = mark.kind == PragmaMark::Kind::SubpassColor || mark.kind == PragmaMark::Kind::SubpassDepth;
        if (!subpass || mark.name.empty()) continue;
        InterfaceStatement where;
        where.fromPragma = true;
        for (int i = 1; i < mark.line && where.begin != std::string::npos; ++i)
            where.begin = stage_.flat.text.find('\n', where.begin + (i > 1 ? 1 : 0));
        if (where.begin == std::string::npos) continue;
        if (mark.line > 1) ++where.begin;
        where.end = where.storage = where.begin;
        result_.statements.push_back(where);
        const bool output = mark.value != "in";
        const std::string prefix = mark.scalar == 'f' ? "" : std::string(1, mark.scalar);
        InterfaceDeclaration declared;
        declared.kind = output ? InterfaceKind::Output : InterfaceKind::SubpassInput;
        declared.name = mark.name;
        declared.type = prefix + (output ? "vec4" : "subpassInput");
        (output ? declared.literal.location : declared.literal.attachment) = subpassNumber(stage_.marks, mark, output);
        declared.conditions = conditionsAt(mark.line);
        declared.where = stage_.flat.locate(mark.line);
        declared.statement = result_.statements.size() - 1;
        result_.declarations.push_back(std::move(declared));
    }
}

}  // namespace

bool isEngineName(std::string_view name) {
    return name.size() > 2 && (name[0] == 'c' || name[0] == 'C') && (name[1] == 'c' || name[1] == 'C');
}

StageInterface readInterface(const StageText& stage, Problems& problems) {
    return InterfaceReader(stage, problems).read();
}

}  // namespace crevice::cocos
