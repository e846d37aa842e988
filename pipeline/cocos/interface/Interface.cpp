// From statements to declarations: qualifiers, types, names, array sizes, members and what pragmas say of them.
#include "cocos/interface/InterfaceReader.h"

#include <algorithm>
#include <limits>

#include <fmt/format.h>

#include "cocos/interface/BlockRules.h"
#include "cocos/interface/GlslTypes.h"
#include "cocos/text/Pragmas.h"

namespace crevice::cocos {

StageInterface InterfaceReader::read() {
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
    if (common.kind >= InterfaceKind::Input && common.literal.location >= 0 && names.size() > 1 &&
        !statement.conditional)
        problems_.error(place(names[1].token),
                        fmt::format("'{}' has location {} of '{}'", tokens_[names[1].token].text,
                                    common.literal.location, tokens_[names[0].token].text),
                        "a layout holds for each name of its declaration: write one declaration for each");
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

bool isEngineName(std::string_view name) {
    return name.size() > 2 && (name[0] == 'c' || name[0] == 'C') && (name[1] == 'c' || name[1] == 'C');
}

StageInterface readInterface(const StageText& stage, Problems& problems) {
    return InterfaceReader(stage, problems).read();
}

}  // namespace crevice::cocos
