// The walk over a stage's declarations: its state, and what its parts share.
#pragma once

#include <map>
#include <string_view>
#include <vector>

#include "cocos/interface/GlslStatements.h"
#include "cocos/interface/Interface.h"
#include "cocos/text/TextConstants.h"

namespace crevice::cocos {

/// Vulkan's limits are far below; a number beyond it is a mistake, and nothing is allocated for it.
constexpr std::int64_t kMostLocations = 4096;
constexpr int kLargestNumber = 1 << 20;

/// Words in front of a type.
bool isInterfaceQualifier(std::string_view word);

/// One of the names that a statement declares.
struct Declarator {
    std::size_t token;
    ArraySize size;
};

class InterfaceReader {
public:
    InterfaceReader(const StageText& stage, Problems& problems)
        : stage_(stage), problems_(problems), tokens_(tokenizeGlsl(stage.flat.text)) {}

    StageInterface read();

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
    std::size_t behindParens(std::size_t at, std::size_t end) const;

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

}  // namespace crevice::cocos
